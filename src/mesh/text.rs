//! Lines, words and numbers of text files, whatever the encoding of their comments.

/// The lines of a text, each with its number, counted from 1.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    (1..).zip(bytes.split(|&byte| byte == b'\n'))
}

/// The words of a line, between white space.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A word as a number.
pub(super) fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A text without its leading white space; the end of a line is kept.
#[inline]
pub(super) fn skip_blanks(mut text: &[u8]) -> &[u8] {
    while let [b' ' | b'\t' | b'\r' | b'\x0c', rest @ ..] = text {
        text = rest;
    }
    text
}

/// The first word of a text, and the text after it.
pub(super) fn split_word(text: &[u8]) -> (&[u8], &[u8]) {
    text.split_at(text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len()))
}

/// The line that a text begins with, its end included, and the text after it.
#[inline]
pub(super) fn split_line(text: &[u8]) -> (&[u8], &[u8]) {
    text.split_at(text.iter().position(|&byte| byte == b'\n').map_or(text.len(), |end| end + 1))
}

/// The next word on the rest of a line as a number, and the text after it; the word itself if it is not a number, empty
/// if none is left.
#[inline]
pub(super) fn next_number<T: Float>(text: &[u8]) -> Result<(T, &[u8]), &[u8]> {
    let text = skip_blanks(text);
    match float(text) {
        Some(read) => Ok(read),
        None => {
            let (word, rest) = split_word(text);
            number(word).map(|number| (number, rest)).ok_or(word)
        }
    }
}

/// The next three words of a line as numbers, and the text after them.
#[inline]
pub(super) fn next_vector<T: Float + Copy + Default>(mut text: &[u8]) -> Result<([T; 3], &[u8]), &[u8]> {
    let mut vector = [T::default(); 3];
    for x in &mut vector {
        (*x, text) = next_number(text)?;
    }
    Ok((vector, text))
}

/// A word as it is shown in a message: on one line, and not too long.
pub(super) fn shown(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let start = String::from_utf8_lossy(&word[..word.len().min(LONGEST)]);
    format!("{start:?}{}", if word.len() > LONGEST { "..." } else { "" })
}

/// The powers of ten that are exact in `f64`.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];
/// The largest number of digits that always fit into 64 bits.
const MOST_DIGITS: usize = 19;
/// The powers of ten up to that.
const TENS: [u64; MOST_DIGITS + 1] = {
    let mut powers = [1; MOST_DIGITS + 1];
    let mut i = 1;
    while i <= MOST_DIGITS {
        powers[i] = 10 * powers[i - 1];
        i += 1;
    }
    powers
};

/// A number type of mesh files.
pub(super) trait Float: std::str::FromStr {
    /// The number nearest to what `number` was rounded from, where the rounding leaves no doubt.
    fn from_rounded(number: f64) -> Option<Self>;
}

impl Float for f64 {
    #[inline]
    fn from_rounded(number: f64) -> Option<Self> {
        Some(number)
    }
}

impl Float for f32 {
    #[inline]
    fn from_rounded(number: f64) -> Option<Self> {
        // The bits that f32 does not have; and f32 has still fewer bits below its normal numbers.
        let dropped = number.to_bits() & ((1 << 29) - 1);
        let is_normal = number.abs() >= f64::from(f32::MIN_POSITIVE) || number == 0.0;
        (is_normal && dropped != 1 << 28).then_some(number as f32)
    }
}

/// The number that `text` begins with, up to white space or the end of the text, and the text after it. `None` if this
/// is not a number, or has to be read with more care.
#[inline]
pub(super) fn float<T: Float>(text: &[u8]) -> Option<(T, &[u8])> {
    let (is_negative, unsigned) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let (mut digits, mut rest) = integer(unsigned);
    let mut count = unsigned.len() - rest.len();
    let mut exponent = 0;
    if let [b'.', behind @ ..] = rest {
        let (fraction, behind_fraction) = integer(behind);
        let places = behind.len() - behind_fraction.len();
        count += places;
        if count > MOST_DIGITS {
            return None;
        }
        digits = digits * TENS[places] + fraction;
        exponent = -(places as i32);
        rest = behind_fraction;
    }
    if !(1..=MOST_DIGITS).contains(&count) || digits > 1 << 53 {
        return None;
    }
    if let [b'e' | b'E', behind @ ..] = rest {
        let (more, behind) = signed(behind)?;
        exponent += more;
        rest = behind;
    }
    let power = *POWERS.get(exponent.unsigned_abs() as usize)?;
    // (From a signed integer is one instruction.)
    let digits = digits as i64 as f64;
    let number = if exponent < 0 { digits / power } else { digits * power };
    let number = T::from_rounded(if is_negative { -number } else { number })?;
    ends_word(rest).then_some((number, rest))
}

/// A short exponent.
fn signed(text: &[u8]) -> Option<(i32, &[u8])> {
    let (sign, unsigned) = match text {
        [b'-', rest @ ..] => (-1, rest),
        [b'+', rest @ ..] => (1, rest),
        _ => (1, text),
    };
    let (value, rest) = integer(unsigned);
    (1..=3).contains(&(unsigned.len() - rest.len())).then(|| (sign * value as i32, rest))
}

/// The digits that `text` begins with as a number, modulo 2^64, and the text after them.
#[inline]
pub(super) fn integer(mut text: &[u8]) -> (u64, &[u8]) {
    let mut value = 0u64;
    while let Some(&bytes) = text.first_chunk() {
        let (eight, count) = up_to_eight(bytes);
        value = value.wrapping_mul(TENS[count]).wrapping_add(eight);
        text = &text[count..];
        if count < 8 {
            return (value, text);
        }
    }
    while let [digit @ b'0'..=b'9', rest @ ..] = text {
        value = value.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
        text = rest;
    }
    (value, text)
}

/// The value of the digits that eight bytes begin with, and how many they are: all at once, in one word, since their
/// number is not predictable.
#[inline]
fn up_to_eight(bytes: [u8; 8]) -> (u64, usize) {
    const EACH: u64 = 0x0101_0101_0101_0101;
    let word = u64::from_le_bytes(bytes) ^ (b'0' as u64 * EACH);
    // The highest bit of each byte that is not below 10. A carry out of a byte only disturbs those behind it.
    let others = (word.wrapping_add((0x80 - 10) * EACH) | word) & (0x80 * EACH);
    let count = (others.trailing_zeros() / 8) as usize;
    // The first digits, with zeros before them; none for a shift by 64.
    let word = word.checked_shl(64 - 8 * count as u32).unwrap_or(0);
    // Neighbours are joined: 1, 2, then 4 digits (Lemire 2018).
    let pairs = word.wrapping_mul(10).wrapping_add(word >> 8) & 0x00ff_00ff_00ff_00ff;
    let fours = pairs.wrapping_mul(100).wrapping_add(pairs >> 16) & 0x0000_ffff_0000_ffff;
    let eight = fours.wrapping_mul(10_000).wrapping_add(fours >> 32) & 0xffff_ffff;
    (eight, count)
}

/// True if a word ends here.
#[inline]
pub(super) fn ends_word(rest: &[u8]) -> bool {
    rest.first().is_none_or(u8::is_ascii_whitespace)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// True if a word was read; asserts that it then gives the number of `parse`.
    fn check(word: &str) -> bool {
        fn bits<T: Float + Into<f64>>(word: &str, behind: &str) -> bool {
            let text = format!("{word}{behind}");
            let Some((number, rest)) = float::<T>(text.as_bytes()) else { return false };
            assert_eq!(rest, behind.as_bytes(), "{text:?}");
            let parsed: Result<T, _> = word.parse();
            let parsed: f64 = parsed.unwrap_or_else(|_| panic!("{word:?} is no number")).into();
            assert_eq!(number.into().to_bits(), parsed.to_bits(), "{word:?}");
            true
        }
        let single = bits::<f32>(word, "");
        assert_eq!(single, bits::<f32>(word, " 1 2 3 4 5 6 7\n"), "{word:?}");
        bits::<f64>(word, "\t");
        bits::<f64>(word, "");
        single
    }

    #[test]
    fn plain_numbers_are_read_and_odd_ones_are_not() {
        for word in
            ["0", "-0", "1", "+1.", ".5", "-.5e3", "0.0503644", "123456789", "1e-5", "1E+05", "-1234567.1234567"]
        {
            assert!(check(word), "{word}");
        }
        for word in ["", "-", ".", "e5", "1e", "1e+", "--1", "1.2.3", "0x1", "1_0", "nan", "inf", "1f", "1/2", "1,5"] {
            assert_eq!(float::<f32>(word.as_bytes()).map(|_| ()), None, "{word}");
            assert_eq!(float::<f64>(format!("{word} 12345678").as_bytes()).map(|_| ()), None, "{word}");
        }
    }

    #[test]
    fn numbers_midway_between_floats_are_left_to_parse() {
        // 1 + 2^-24, and this a little more or less: one rounding to f64 makes all of them the same.
        for word in ["1.000000059604644775", "1.000000059604644776", "1.0000000596046448", "16777217", "16777219"] {
            check(word);
        }
        assert!(!check("16777217") && check("16777218"));
        for bits in (0..2000u32).map(|i| i.wrapping_mul(0x9e37_79b9) & 0x7f7f_ffff) {
            let (low, high) = (f64::from(f32::from_bits(bits)), f64::from(f32::from_bits(bits + 1)));
            for digits in 5..18 {
                for x in [low, (low + high) / 2.0, high] {
                    check(&format!("{x:.digits$e}"));
                    check(&format!("{x:.digits$}"));
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn what_is_read_is_what_parse_reads(word in "[+-]?[0-9]{0,12}\\.?[0-9]{0,12}([eE][+-]?[0-9]{0,3})?") {
            check(&word);
        }

        #[test]
        fn any_bytes_are_read_as_parse_reads_them(word in "[-+.eE0-9:/ a;]{0,12}") {
            if let Some((number, rest)) = float::<f64>(word.as_bytes()) {
                let read = &word[..word.len() - rest.len()];
                prop_assert_eq!(read.parse::<f64>().map(f64::to_bits), Ok(number.to_bits()));
            }
        }

        #[test]
        fn runs_of_digits_are_read_to_their_end(digits in "[0-9]{0,19}", behind in "[:/x ]?.{0,9}") {
            let behind = behind.trim_start_matches(|c: char| c.is_ascii_digit());
            let text = format!("{digits}{behind}");
            let value = if digits.is_empty() { 0 } else { digits.parse().unwrap() };
            prop_assert_eq!(integer(text.as_bytes()), (value, behind.as_bytes()));
        }
    }
}
