//! The excavator control application.
#![no_std]
#![forbid(unsafe_code)]
