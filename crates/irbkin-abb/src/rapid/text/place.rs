//! Lines and columns of a text, and the part of it that a message repeats.

use crate::prelude::*;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};

/// Most characters of the text that a message repeats.
const REPEATED: usize = 40;

#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) byte: usize,
    pub(crate) line: usize,
    pub(crate) column: usize,
}

impl Place {
    pub(crate) const BEGINNING: Self = Self { byte: 0, line: 1, column: 1 };

    /// The place of another byte. The time is linear in the distance, and in the length of the
    /// line on the way back over its end.
    pub(crate) fn moved(self, text: &str, byte: usize) -> Self {
        if byte >= self.byte {
            return self.advanced(text, byte);
        }
        let passed = text.get(byte..self.byte).unwrap_or_default();
        let lines = newlines(passed.as_bytes());
        let line = self.line.saturating_sub(lines);
        if lines == 0 {
            let column = self.column.saturating_sub(characters(passed));
            return Self { byte, line, column };
        }
        let begin = text.get(..byte).and_then(|before| before.rfind('\n')).map_or(0, |at| at + 1);
        Self { byte, line, column: 1 + characters(text.get(begin..byte).unwrap_or_default()) }
    }

    fn advanced(self, text: &str, byte: usize) -> Self {
        let passed = text.get(self.byte..byte).unwrap_or_default();
        let lines = newlines(passed.as_bytes());
        let (column, last_line) = match passed.rfind('\n') {
            Some(at) => (1, &passed[at + 1..]),
            None => (self.column, passed),
        };
        Self { byte, line: self.line + lines, column: column + characters(last_line) }
    }
}

/// The number of characters, without a byte order mark.
fn characters(text: &str) -> usize {
    text.chars().filter(|character| *character != '\u{feff}').count()
}

/// The number of newlines. A byte counts a chunk's, so that many bytes are compared at once.
fn newlines(bytes: &[u8]) -> usize {
    let of_piece = |piece: &[u8]| piece.iter().map(|byte| u8::from(*byte == b'\n')).sum::<u8>();
    bytes.chunks(usize::from(u8::MAX)).map(|piece| usize::from(of_piece(piece))).sum()
}

pub(crate) fn fault_at(text: &str, near: Place, byte: usize, kind: RapidFaultKind) -> RapidFault {
    let Place { line, column, .. } = near.moved(text, byte);
    RapidFault { line, column, kind }
}

pub(crate) fn excerpt(text: &str) -> String {
    let mut short: String = text.chars().take(REPEATED).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_from_any_other() {
        let text = "\u{feff}ab\n\nc\u{e9}d\r\n\u{e9}x\n";
        let all: std::vec::Vec<usize> = text.char_indices().map(|(byte, _)| byte).collect();
        for from in &all {
            let near = Place::BEGINNING.advanced(text, *from);
            for byte in &all {
                let (near, direct) = (near.moved(text, *byte), Place::BEGINNING.moved(text, *byte));
                assert_eq!((near.line, near.column), (direct.line, direct.column), "{from} {byte}");
            }
        }
        let place = Place::BEGINNING.moved(text, text.len() - 2);
        assert_eq!((place.line, place.column), (4, 2));
    }
}
