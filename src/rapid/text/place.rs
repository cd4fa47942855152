//! Lines and columns of a text, and the part of it that a message repeats.

use alloc::string::String;

use crate::error::{RapidFault, RapidFaultKind};

/// Most characters of the text that a message repeats.
const REPEATED: usize = 40;

/// A byte with its line and column.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) byte: usize,
    pub(crate) line: usize,
    pub(crate) column: usize,
}

impl Place {
    /// The first byte of a text.
    pub(crate) const BEGINNING: Self = Self { byte: 0, line: 1, column: 1 };

    /// The place of a later byte.
    pub(crate) fn advanced(self, text: &str, byte: usize) -> Self {
        let passed = text.get(self.byte..byte).unwrap_or_default();
        let lines = newlines(passed.as_bytes());
        let (column, last_line) = match passed.rfind('\n') {
            Some(at) => (1, &passed[at + 1..]),
            None => (self.column, passed),
        };
        let characters = last_line.chars().filter(|character| *character != '\u{feff}').count();
        Self { byte, line: self.line + lines, column: column + characters }
    }
}

/// The number of newlines. A byte counts a chunk's, so that many bytes are compared at once.
fn newlines(bytes: &[u8]) -> usize {
    let of_piece = |piece: &[u8]| piece.iter().map(|byte| u8::from(*byte == b'\n')).sum::<u8>();
    bytes.chunks(usize::from(u8::MAX)).map(|piece| usize::from(of_piece(piece))).sum()
}

/// An error at a byte of a text.
pub(crate) fn fault_at(text: &str, byte: usize, kind: RapidFaultKind) -> RapidFault {
    let Place { line, column, .. } = Place::BEGINNING.advanced(text, byte);
    RapidFault { line, column, kind }
}

/// The first characters of a piece of text, for a message.
pub(crate) fn excerpt(text: &str) -> String {
    let mut short: String = text.chars().take(REPEATED).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    short
}
