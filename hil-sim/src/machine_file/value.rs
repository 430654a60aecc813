//! The two kinds of numbers a machine file holds. Each says what it allows; serde adds where it stands.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};

/// A coordinate, an angle or a height: any finite number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number(pub(super) f64);

/// A length or a cylinder's end of travel: finite and above 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Length(pub(super) f64);

struct FiniteNumber;
struct PositiveLength;

impl Visitor<'_> for FiniteNumber {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a finite number")
    }
    fn visit_f64<E: Error>(self, x: f64) -> Result<Number, E> {
        if x.is_finite() { Ok(Number(x)) } else { Err(E::invalid_value(Unexpected::Float(x), &self)) }
    }
    fn visit_i64<E: Error>(self, n: i64) -> Result<Number, E> {
        self.visit_f64(n as f64)
    }
}

impl Visitor<'_> for PositiveLength {
    type Value = Length;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a finite length above 0")
    }
    fn visit_f64<E: Error>(self, x: f64) -> Result<Length, E> {
        if x.is_finite() && x > 0.0 { Ok(Length(x)) } else { Err(E::invalid_value(Unexpected::Float(x), &self)) }
    }
    fn visit_i64<E: Error>(self, n: i64) -> Result<Length, E> {
        if n > 0 { Ok(Length(n as f64)) } else { Err(E::invalid_value(Unexpected::Signed(n), &self)) }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_f64(FiniteNumber)
    }
}

impl<'de> Deserialize<'de> for Length {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_f64(PositiveLength)
    }
}
