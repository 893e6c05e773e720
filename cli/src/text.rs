//! Numbers as people read them.

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

/// The day, as `2026-01-31`, that is so many seconds after the beginning of 1970, in UTC.
pub fn date(seconds: u64) -> String {
    let (mut year, mut day) = (1970, seconds / 86_400);
    let is_leap = |year: u64| year.is_multiple_of(4) && !year.is_multiple_of(100) || year.is_multiple_of(400);
    while day >= 365 + u64::from(is_leap(year)) {
        day -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let mut month = 1;
    for length in [31, 28 + u64::from(is_leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30] {
        if day < length {
            break;
        }
        day -= length;
        month += 1;
    }
    format!("{year}-{month:02}-{:02}", day + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        let days =
            [0, 31, 58, 59, 364, 365, 11_016, 11_017, 19_723 + 59, 19_723 + 365].map(|day| date(day * 86_400 + 7));
        let expected = [
            "1970-01-01",
            "1970-02-01",
            "1970-02-28",
            "1970-03-01",
            "1970-12-31",
            "1971-01-01",
            "2000-02-29",
            "2000-03-01",
            "2024-02-29",
            "2024-12-31",
        ];
        assert_eq!(days, expected);
    }

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
