//! Bytes changed a little, as a seed determines: what stands in for the fuzzer where there is none.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// Numbers that are trouble wherever a text has one.
const NUMBERS: [&str; 12] =
    ["nan", "inf", "-inf", "0", "-0.0", "-1.0", "1e308", "1e-308", "5e-324", "1e19", "999999999999999999999", "\"1\""];

/// Changes of bytes, in an order that the seed determines.
#[derive(Clone, Debug)]
pub struct Mutator(ChaCha8Rng);

impl Mutator {
    /// Of a seed.
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// One of so many.
    pub fn below(&mut self, count: usize) -> usize {
        self.0.next_u32() as usize % count.max(1)
    }

    /// One to four changes of `bytes`; `other` is what some of them are mixed with.
    pub fn changed(&mut self, bytes: &[u8], other: &[u8]) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        for _ in 0..1 + self.below(4) {
            self.change(&mut bytes, other);
        }
        bytes
    }

    fn change(&mut self, bytes: &mut Vec<u8>, other: &[u8]) {
        let (from, to) = self.range(bytes.len());
        match self.below(9) {
            0 | 1 if from < bytes.len() => bytes[from] ^= 1 << self.below(8),
            2 if from < bytes.len() => bytes[from] = self.0.next_u32() as u8,
            3 if from < bytes.len() => bytes[from] = [0, 1, 0x7f, 0x80, 0xff][self.below(5)],
            4 => drop(bytes.drain(from..to)),
            5 => {
                let again = bytes[from..to].to_vec();
                bytes.splice(to..to, again);
            }
            6 => {
                let (first, last) = self.range(other.len());
                bytes.splice(from..to, other[first..last].iter().copied());
            }
            // A float of eight bytes becomes one that is none.
            7 if to + 8 <= bytes.len() => {
                let odd = [f64::NAN, f64::INFINITY, -1.0, 0.0, f64::MAX, f64::MIN_POSITIVE];
                bytes[to..to + 8].copy_from_slice(&odd[self.below(odd.len())].to_le_bytes());
            }
            _ => self.number(bytes, from),
        }
    }

    /// A part, most often a short one.
    fn range(&mut self, length: usize) -> (usize, usize) {
        let from = self.below(length + 1);
        let most = [1, 4, 16, 64, 256][self.below(5)];
        (from, length.min(from + self.below(most + 1)))
    }

    /// The first number of the text from here on becomes another.
    fn number(&mut self, bytes: &mut Vec<u8>, from: usize) {
        let is_number = |byte: &u8| byte.is_ascii_digit() || b"+-.".contains(byte);
        let Some(at) = bytes[from..].iter().position(u8::is_ascii_digit).map(|at| from + at) else { return };
        let length = bytes[at..].iter().position(|byte| !is_number(byte)).unwrap_or(bytes.len() - at);
        let number = NUMBERS[self.below(NUMBERS.len())];
        bytes.splice(at..at + length, number.bytes());
    }
}
