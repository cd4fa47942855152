//! Numbers and strings as RAPID text.

use core::fmt;

use alloc::format;

/// The size from which a number is written with an exponent.
const LARGE: f64 = 1e7;

/// The size below which a number is written with an exponent.
const SMALL: f64 = 1e-4;

/// Write a number with the fewest digits that read back as the same number, with an exponent as ABB
/// writes it: `9E+09`.
///
/// RAPID has no negative zero, and no number that is not finite: such a number is written as in
/// Rust.
pub(crate) fn write_number(f: &mut impl fmt::Write, number: f64) -> fmt::Result {
    let size = number.abs();
    if size == 0.0 {
        return f.write_str("0");
    }
    if !number.is_finite() || (SMALL..LARGE).contains(&size) {
        return write!(f, "{number}");
    }
    let scientific = format!("{number:e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let (sign, exponent) =
        exponent.strip_prefix('-').map_or(('+', exponent), |exponent| ('-', exponent));
    write!(f, "{digits}E{sign}{exponent:0>2}")
}

/// Write a string in quotes.
pub(crate) fn write_text(f: &mut impl fmt::Write, text: &str) -> fmt::Result {
    f.write_char('"')?;
    for character in text.chars() {
        match character {
            '"' => f.write_str("\"\"")?,
            '\\' => f.write_str("\\\\")?,
            '\0'..='\x1f' | '\x7f' => write!(f, "\\{:02X}", u32::from(character))?,
            _ => f.write_char(character)?,
        }
    }
    f.write_char('"')
}
