//! Lines, words and numbers of text files, in whatever encoding their comments are.

use crate::mesh::decimal::{Float, float};

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

/// Behind the white space that a text begins with, but for the end of a line.
#[inline]
pub(super) fn skip_blanks(mut text: &[u8]) -> &[u8] {
    while let [b' ' | b'\t' | b'\r' | b'\x0c', rest @ ..] = text {
        text = rest;
    }
    text
}

/// The first word of a text and what follows it.
pub(super) fn split_word(text: &[u8]) -> (&[u8], &[u8]) {
    text.split_at(text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len()))
}

/// The line that a text begins with, its end included, and what follows it.
#[inline]
pub(super) fn split_line(text: &[u8]) -> (&[u8], &[u8]) {
    text.split_at(text.iter().position(|&byte| byte == b'\n').map_or(text.len(), |end| end + 1))
}

/// The number on the rest of a line that is the next word, and what follows it; the word, where it is no number, which is
/// empty where none is left.
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

/// The next three words of a line as numbers, and what follows them.
#[inline]
pub(super) fn next_vector(mut text: &[u8]) -> Result<([f32; 3], &[u8]), &[u8]> {
    let mut vector = [0.0; 3];
    for x in &mut vector {
        (*x, text) = next_number(text)?;
    }
    Ok((vector, text))
}

/// A word as it is shown in a message: on one line, and not too long for it.
pub(super) fn shown(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let start = String::from_utf8_lossy(&word[..word.len().min(LONGEST)]);
    format!("{start:?}{}", if word.len() > LONGEST { "..." } else { "" })
}
