//! What every image that runs the application needs.

pub(crate) mod stack_guard;
