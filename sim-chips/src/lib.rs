//! Simulated chips behind the traits a board's drivers use, `no_std`, so that the harness and the emulated image link the same.
//!
//! They are written from the data sheets alone and share nothing with the drivers: a mistake in one shows against the other.
//!
//! - [`ads8688`] — the analogue-to-digital converter, byte by byte as its SPI speaks, with everything that can break;
//! - [`nor_flash`] — flash memory that is erased by sectors, only ever clears bits, and loses power when told to;
//! - [`pins`] — pins, PWM outputs and a CAN controller's mailboxes.
#![no_std]
#![forbid(unsafe_code)]

pub mod ads8688;
pub mod nor_flash;
pub mod pins;
