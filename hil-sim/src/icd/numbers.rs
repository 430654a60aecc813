//! Numbers as text.

/// A factor, offset or limit: exactly where it is a power of two, else as short as tells it from its neighbours.
pub(super) fn number(x: f32) -> String {
    let is_power_of_two = x.to_bits() & 0x007f_ffff == 0;
    if is_power_of_two { f64::from(x).to_string() } else { x.to_string() }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn powers_of_two_are_exact_and_decimals_are_short() {
        assert_eq!(number(1.0 / 32768.0), "0.000030517578125");
        assert_eq!(number(0.001), "0.001");
        assert_eq!(number(-250.0), "-250");
        assert_eq!(number(0.0), "0");
    }
}
