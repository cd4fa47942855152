//! Numbers and strings as RAPID writes them.

use alloc::string::String;

use super::words::is_word_byte;

/// The powers of ten that are exact.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Largest number of digits for which every number is exact.
const EXACT_DIGITS: usize = 15;

/// The decimal number that begins at a byte, with its end. The byte is a digit, or a point before a
/// digit. `None` for what is invalid, not finite or not decimal, which [`number`] reads.
pub(crate) fn decimal(text: &str, start: usize) -> Option<(f64, usize)> {
    let bytes = text.as_bytes();
    let (mut mantissa, point) = digits(bytes, start, 0);
    let (mut end, mut decimals) = (point, 0);
    if bytes.get(point) == Some(&b'.') {
        (mantissa, end) = digits(bytes, point + 1, mantissa);
        decimals = end - point - 1;
    }
    let count = point - start + decimals;
    let (mut power, mut is_large) = (0, true);
    if let Some(b'e' | b'E') = bytes.get(end) {
        let sign = bytes.get(end + 1);
        is_large = sign != Some(&b'-');
        let exponent = end + 1 + usize::from(matches!(sign, Some(b'+' | b'-')));
        (power, end) = digits(bytes, exponent, 0);
        if !(1..=2).contains(&(end - exponent)) {
            return None;
        }
    }
    // The next byte may belong to it, as in 0x1F, 1.5.2 and 12abc.
    let follows = bytes.get(end).copied().unwrap_or(b' ');
    if is_word_byte(follows) || !follows.is_ascii() || follows == b'.' {
        return None;
    }
    let power = usize::try_from(power).ok()?;
    let (up, down) = if is_large { (power, decimals) } else { (0, decimals + power) };
    let value = match (POWERS.get(up.saturating_sub(down)), POWERS.get(down.saturating_sub(up))) {
        (Some(up), Some(down)) if count <= EXACT_DIGITS => {
            // Digits and powers are exact and one of the powers is 1: one operation rounds, to the
            // nearest number, as parsing does.
            #[expect(clippy::cast_precision_loss, reason = "at most 15 digits are exact")]
            let exact = mantissa as f64;
            exact * up / down
        }
        _ => text[start..end].parse().ok()?,
    };
    value.is_finite().then_some((value, end))
}

/// The number of a sequence of digits that continue `before`, and its end. More than 19 digits
/// overflow: the caller counts them.
fn digits(bytes: &[u8], start: usize, before: u64) -> (u64, usize) {
    let (mut number, mut at) = (before, start);
    for byte in bytes.get(start..).unwrap_or_default() {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    (number, at)
}

/// A number as RAPID writes it, without a sign; infinite if it is too large.
pub(crate) fn number(text: &str) -> Option<f64> {
    let radix = match text.as_bytes() {
        [b'0', b'x' | b'X', ..] => 16,
        [b'0', b'o' | b'O', ..] => 8,
        [b'0', b'b' | b'B', ..] => 2,
        // It has digits, and no letters except an exponent's: "inf" and "nan" do not get here.
        _ => return text.parse().ok(),
    };
    let digits =
        text.get(2..).filter(|digits| digits.bytes().all(|b| b.is_ascii_alphanumeric()))?;
    #[expect(clippy::cast_precision_loss, reason = "rounded as any other number is")]
    u64::from_str_radix(digits, radix).ok().map(|value| value as f64)
}

/// A string without its quotes: "" is a quote, \\ a backslash and \ with two hexadecimal digits the
/// character with that number.
pub(crate) fn unquoted(quoted: &str) -> String {
    let inner = quoted.get(1..quoted.len().saturating_sub(1)).unwrap_or_default();
    let mut text = String::new();
    let mut rest = inner;
    while let Some(character) = rest.chars().next() {
        let mut taken = character.len_utf8();
        let mut meant = character;
        let code = rest.get(1..3).filter(|code| code.bytes().all(|byte| byte.is_ascii_hexdigit()));
        match (character, code) {
            ('"', _) => taken = 2,
            ('\\', _) if rest[1..].starts_with('\\') => taken = 2,
            ('\\', Some(code)) => {
                meant = u8::from_str_radix(code, 16).map_or(character, char::from);
                taken = 3;
            }
            _ => {}
        }
        text.push(meant);
        rest = rest.get(taken..).unwrap_or_default();
    }
    text
}

#[cfg(test)]
mod tests {
    use std::format;

    use super::*;

    /// Digits, point and exponent of every length around the bounds of what is exact.
    #[test]
    fn decimals_are_the_nearest_numbers() {
        let digits = "9876543210987654321098765";
        let mut compared = 0;
        for (first, count) in (0..5).flat_map(|first| (1..=20).map(move |count| (first, count))) {
            let digits = &digits[first..first + count];
            for point in 0..=count {
                for exponent in ["", "e0", "E5", "E+07", "e-7", "E22", "E23", "e-22", "E-23", "E99"]
                {
                    let (whole, decimals) = digits.split_at(point);
                    let text = format!("{whole}.{decimals}{exponent}");
                    let (value, end) = decimal(&text, 0).unwrap();
                    let nearest: f64 = text.parse().unwrap();
                    assert_eq!((value.to_bits(), end), (nearest.to_bits(), text.len()), "{text}");
                    compared += 1;
                }
            }
        }
        assert_eq!(compared, 5 * 230 * 10);
    }

    #[test]
    fn numbers_beyond_the_exact_range_are_parsed_by_the_standard_library() {
        for text in ["0x1F", "1.5.2", "12abc", "1_", "1E", "1E+", "1E100", "1e400", "1\u{e9}"] {
            assert_eq!(decimal(text, 0), None, "{text}");
        }
        assert_eq!(decimal("[12,3]", 1), Some((12.0, 3)));
    }
}
