//! The two kinds of numbers a machine file holds. Each says what it allows; serde adds where it stands.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};

/// A coordinate, an angle or a height: any finite number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number(pub(super) f64);

/// A length, a cylinder's end of travel or a mass: above 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Length(pub(super) f64);

/// Beyond these no machine is built, in metres, inches, degrees, kg or kg m².
const MOST: f64 = 1e5;
const LEAST: f64 = 1e-6;

struct FiniteNumber;
struct PositiveLength;

impl Visitor<'_> for FiniteNumber {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a finite number within −100000…100000")
    }
    fn visit_f64<E: Error>(self, x: f64) -> Result<Number, E> {
        if x.abs() <= MOST { Ok(Number(x)) } else { Err(E::invalid_value(Unexpected::Float(x), &self)) }
    }
    fn visit_i64<E: Error>(self, n: i64) -> Result<Number, E> {
        self.visit_f64(n as f64)
    }
}

impl Visitor<'_> for PositiveLength {
    type Value = Length;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a finite number above 0, within 0.000001…100000")
    }
    fn visit_f64<E: Error>(self, x: f64) -> Result<Length, E> {
        if (LEAST..=MOST).contains(&x) { Ok(Length(x)) } else { Err(E::invalid_value(Unexpected::Float(x), &self)) }
    }
    fn visit_i64<E: Error>(self, n: i64) -> Result<Length, E> {
        self.visit_f64(n as f64)
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
