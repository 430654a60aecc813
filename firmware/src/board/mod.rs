//! What stands between the application and a board's pins.
//!
//! - [`ads8688`] — the analogue-to-digital converters of the reference ECU.

pub mod ads8688;
