//! Numbers in readable form.

/// `1234567` as `1,234,567`.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A number of `digits` significant digits without trailing zeros; very large and small ones with a power of ten.
pub fn rounded(number: f64, digits: usize) -> String {
    if number == 0.0 || !number.is_finite() {
        return number.abs().to_string();
    }
    let magnitude = number.abs().log10().floor();
    if !(-4.0..6.0).contains(&magnitude) {
        let text = format!("{number:.*e}", digits - 1);
        let (mantissa, exponent) = text.split_once('e').expect("scientific notation has an exponent");
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    let decimals = (digits as f64 - 1.0 - magnitude).max(0.0) as usize;
    trimmed(&format!("{number:.decimals$}")).to_owned()
}

/// A decimal number without trailing zeros.
fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_by_three() {
        let texts = [0, 12, 999, 1000, 65_536, 1_234_567].map(grouped);
        assert_eq!(texts, ["0", "12", "999", "1,000", "65,536", "1,234,567"]);
    }

    #[test]
    fn rounds_to_significant_digits() {
        let texts = [0.0, -0.25, 0.1 + 0.2, 0.000834567, 1234.5, 12_345_678.0, 1e-9].map(|x| rounded(x, 3));
        assert_eq!(texts, ["0", "-0.25", "0.3", "0.000835", "1234", "1.23e7", "1e-9"]);
    }
}
