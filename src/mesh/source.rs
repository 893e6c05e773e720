//! The contents of a file, read block by block: never in memory as a whole.

use std::io::{self, BufRead, Read, Seek};

/// The source of contents: a file, or bytes in memory.
pub(super) trait Input: Read + Seek {}

impl<T: Read + Seek> Input for T {}

/// A block. The buffer grows only for a line that is longer.
const BLOCK: usize = 1 << 17;

/// An input, and the block of it that is being read.
///
/// If the input cannot be read, the contents end, and [`Source::failure`] says why.
pub(super) struct Source<'a> {
    input: &'a mut dyn Input,
    length: u64,
    /// The bytes that were read from the input.
    read: u64,
    /// The buffer, of which `buffer[start..end]` has not been consumed.
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    /// The end of the whole lines in the buffer, as far as they have been looked for.
    lines_end: usize,
    failure: Option<io::Error>,
}

impl<'a> Source<'a> {
    /// The contents of an input of `length` bytes.
    pub fn new(input: &'a mut dyn Input, length: u64) -> Self {
        let buffer = vec![0; BLOCK];
        Self { input, length, read: 0, buffer, start: 0, end: 0, lines_end: 0, failure: None }
    }

    /// The number of bytes of the contents.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The number of bytes that have not been consumed.
    pub fn remaining(&self) -> u64 {
        self.length.saturating_sub(self.read) + (self.end - self.start) as u64
    }

    /// At least `count` of the next bytes, which fit into a block; fewer at the end of the contents.
    #[inline]
    pub fn at_least(&mut self, count: usize) -> &[u8] {
        if self.end - self.start < count {
            self.refill();
        }
        &self.buffer[self.start..self.end]
    }

    /// Some of the next lines, whole ones: only the last of the contents may lack its end. `None` after that.
    #[inline]
    pub fn whole_lines(&mut self) -> Option<&[u8]> {
        if self.start >= self.lines_end {
            self.find_lines();
        }
        (self.start < self.lines_end).then(|| &self.buffer[self.start..self.lines_end])
    }

    /// Consumes the next `count` bytes.
    #[inline]
    pub fn skip(&mut self, count: usize) {
        self.start += count;
    }

    /// All of the contents, from their start, for what cannot be read in one pass.
    pub fn whole(&mut self) -> Vec<u8> {
        let mut bytes = Vec::new();
        if let Err(error) = self.input.rewind().and_then(|()| self.input.read_to_end(&mut bytes)) {
            self.failure = Some(error);
        }
        bytes
    }

    /// The reason why the input could not be read to its end, if so.
    pub fn failure(self) -> Option<io::Error> {
        self.failure
    }

    fn find_lines(&mut self) {
        loop {
            let rest = &self.buffer[self.start..self.end];
            if let Some(last) = rest.iter().rposition(|&byte| byte == b'\n') {
                self.lines_end = self.start + last + 1;
                return;
            }
            if !self.refill() {
                self.lines_end = self.end;
                return;
            }
        }
    }

    /// Reads until the buffer is full or the contents end. Returns whether anything was read.
    fn refill(&mut self) -> bool {
        if self.end - self.start == self.buffer.len() {
            self.buffer.resize(2 * self.buffer.len(), 0);
        }
        self.buffer.copy_within(self.start..self.end, 0);
        (self.start, self.end, self.lines_end) = (0, self.end - self.start, 0);
        let before = self.end;
        while self.end < self.buffer.len() && self.failure.is_none() {
            match self.input.read(&mut self.buffer[self.end..]) {
                Ok(0) => break,
                Ok(count) => self.end += count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => self.failure = Some(error),
            }
        }
        self.read += (self.end - before) as u64;
        self.end > before
    }
}

impl Read for Source<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.skip(count);
        Ok(count)
    }
}

impl BufRead for Source<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        Ok(self.at_least(1))
    }

    fn consume(&mut self, count: usize) {
        self.skip(count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_whole_however_long_they_are() {
        for length in [1, 100, BLOCK - 1, BLOCK, 3 * BLOCK] {
            let line = |i: usize| format!("{i}{}\n", "x".repeat(length));
            for end in ["", "last"] {
                let text: String = (0..5).map(line).chain([end.to_owned()]).collect();
                let mut input = io::Cursor::new(text.as_bytes());
                let mut source = Source::new(&mut input, text.len() as u64);
                let mut read = String::new();
                while let Some(lines) = source.whole_lines() {
                    let lines = std::str::from_utf8(lines).unwrap().to_owned();
                    assert!(lines.ends_with('\n') || read.len() + lines.len() == text.len());
                    source.skip(lines.len());
                    read += &lines;
                    assert_eq!(source.remaining() as usize, text.len() - read.len());
                }
                assert!(read == text && source.whole() == text.as_bytes() && source.failure().is_none());
            }
        }
    }

    #[test]
    fn an_input_that_fails_ends_with_the_reason() {
        struct Failing(u8);
        impl Read for Failing {
            fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
                self.0 += 1;
                let kind = [io::ErrorKind::Interrupted, io::ErrorKind::TimedOut][usize::from(self.0 > 2)];
                if self.0 == 2 { (&b"one\ntwo"[..]).read(buffer) } else { Err(kind.into()) }
            }
        }
        impl Seek for Failing {
            fn seek(&mut self, _: io::SeekFrom) -> io::Result<u64> {
                Ok(0)
            }
        }
        let mut input = Failing(0);
        let mut source = Source::new(&mut input, 100);
        assert_eq!(source.whole_lines(), Some(&b"one\n"[..]));
        source.skip(4);
        assert_eq!(source.whole_lines(), Some(&b"two"[..]));
        source.skip(3);
        assert_eq!(source.whole_lines(), None);
        assert_eq!(source.failure().unwrap().kind(), io::ErrorKind::TimedOut);
    }
}
