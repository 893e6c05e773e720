//! Lines, words and numbers of text files, in whatever encoding their comments are.

/// The lines of a text, each with its number, counted from 1.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    (1..).zip(bytes.split(|&byte| byte == b'\n'))
}

/// What stands between white space.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A word as a number.
pub(super) fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The first three words as numbers; what follows is left aside.
pub(super) fn vector<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<[f32; 3], String> {
    let mut vector = [0.0; 3];
    for x in &mut vector {
        let word = words.next().ok_or("fewer than three numbers")?;
        *x = number(word).ok_or_else(|| format!("{} is not a number", shown(word)))?;
    }
    Ok(vector)
}

/// A word as it is shown in a message: on one line, and not too long for it.
pub(super) fn shown(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let start = String::from_utf8_lossy(&word[..word.len().min(LONGEST)]);
    format!("{start:?}{}", if word.len() > LONGEST { "..." } else { "" })
}
