//! What every image that runs the application needs.

pub(crate) mod constant_watch;
pub(crate) mod stack_guard;
