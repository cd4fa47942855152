//! RAPID's reserved words, and what may be a name.

/// Whether a byte may be anywhere in a word: an ASCII letter, a digit or an underscore.
pub(crate) fn is_word_byte(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// The end of the letters, digits and underscores from a byte on.
pub(crate) fn end_of_word(text: &str, start: usize) -> usize {
    let bytes = text.as_bytes();
    let mut end = start;
    while bytes.get(end).is_some_and(|byte| is_word_byte(*byte)) {
        end += 1;
    }
    if bytes.get(end).is_none_or(u8::is_ascii) {
        return end;
    }
    let belongs = |character: &char| character.is_alphanumeric() || *character == '_';
    end + text[end..].chars().take_while(belongs).map(char::len_utf8).sum::<usize>()
}

pub(crate) fn words_of(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// Whether a text ends with a word, in any case.
pub(crate) fn ends_with(text: &str, word: &str) -> bool {
    let start = text.len().saturating_sub(word.len());
    text.get(start..).is_some_and(|end| end.eq_ignore_ascii_case(word))
}

/// Whether RAPID could read it as a declared name.
pub(crate) fn is_name(text: &str) -> bool {
    end_of_word(text, 0) == text.len() && is_name_token(text)
}

/// Whether a word of letters, digits and underscores may be a declared name.
pub(crate) fn is_name_token(word: &str) -> bool {
    word.chars().next().is_some_and(char::is_alphabetic) && !is_reserved(word)
}

/// RAPID's reserved words, sorted.
#[rustfmt::skip]
const RESERVED: [&str; 55] = [
    "ALIAS", "AND", "BACKWARD", "CASE", "CONNECT", "CONST", "DEFAULT", "DIV", "DO", "ELSE",
    "ELSEIF", "ENDFOR", "ENDFUNC", "ENDIF", "ENDMODULE", "ENDPROC", "ENDRECORD", "ENDTEST",
    "ENDTRAP", "ENDWHILE", "ERROR", "EXIT", "FALSE", "FOR", "FROM", "FUNC", "GOTO", "IF", "INOUT",
    "LOCAL", "MOD", "MODULE", "NOSTEPIN", "NOT", "OR", "PERS", "PROC", "RAISE", "RECORD", "RETRY",
    "RETURN", "STEP", "SYSMODULE", "TEST", "THEN", "TO", "TRAP", "TRUE", "TRYNEXT", "UNDO", "VAR",
    "VIEWONLY", "WHILE", "WITH", "XOR",
];

/// Defines enums whose variants are words of RAPID.
macro_rules! words {
    ($(
        $(#[$meta:meta])*
        $visibility:vis enum $Enum:ident { $($(#[$note:meta])* $Variant:ident = $word:literal,)* }
    )*) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $visibility enum $Enum {
            $($(#[$note])* $Variant,)*
        }

        impl $Enum {
            /// Its word in RAPID.
            #[must_use]
            $visibility fn name(self) -> &'static str {
                match self {
                    $(Self::$Variant => $word,)*
                }
            }

            /// The variant with a word, in any case.
            pub(crate) fn named(word: &str) -> Option<Self> {
                $(if word.eq_ignore_ascii_case($word) {
                    return Some(Self::$Variant);
                })*
                None
            }
        }
    )*};
}
pub(crate) use words;

pub(crate) fn is_reserved(word: &str) -> bool {
    let capitals = || word.bytes().map(|byte| byte.to_ascii_uppercase());
    RESERVED.binary_search_by(|own| own.bytes().cmp(capitals())).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reserved_words_are_sorted() {
        assert!(RESERVED.is_sorted());
    }

    #[test]
    fn reserved_words_are_found_in_any_case() {
        assert!(RESERVED.iter().all(|word| is_reserved(word) && is_reserved(&word.to_lowercase())));
        for word in ["", "p10", "endmodules", "tool0", "Modul", "\u{e9}\u{e9}"] {
            assert!(!is_reserved(word), "{word}");
        }
    }

    #[test]
    fn words_end_where_their_letters_end() {
        for (text, end) in
            [("p10;", 3), ("_a b", 2), ("\u{e9}t\u{e9}1,", 6), ("a\u{a0}b", 1), ("", 0)]
        {
            assert_eq!(end_of_word(text, 0), end, "{text}");
        }
    }
}
