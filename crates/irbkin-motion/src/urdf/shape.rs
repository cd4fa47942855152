//! Checks the shape of a text before it is parsed: a text that would take the parser longer than
//! linear time is rejected.
//!
//! The parser compares each attribute of an element with those before it, and each namespace with
//! all that are in scope: 100 kB of nested declarations take seconds. This scan is one pass without
//! memory. It reads tags, quotes, comments and character data as the parser does; if a text is not
//! XML, the parser stops no later than where the two could differ.

use crate::prelude::*;
use crate::urdf::fault::UrdfFault;

/// Most namespaces in a text [1]: real ones declare about ten. Each name is looked up among all of
/// them.
const MOST_NAMESPACES: usize = 256;

/// Most attributes of an element [1]: real ones have at most ten. Each is compared with all others.
const MOST_ATTRIBUTES: usize = 256;

/// Reject a text with more namespaces, or more attributes in an element, than can be read in linear
/// time.
pub(super) fn check_shape(text: &str) -> Result<(), UrdfFault> {
    let mut namespaces = 0;
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        let end = if let Some(terminator) = end_of_text(rest) {
            end_of(rest, terminator)
        } else {
            let tag = Tag::read(rest);
            namespaces += tag.namespaces;
            check_tag(&tag, namespaces, || line(text, rest))?;
            tag.length
        };
        rest = &rest[end..];
    }
    Ok(())
}

/// A text that a parser refuses for what is of no arm, without that, if it can be told apart: a
/// prefix without a namespace gets one, `&` that begins no reference is one, comments that hold `--`
/// are emptied, and a document type that declares nothing is left out. Entities stay. Lines stay where they are.
pub(super) fn mended(text: &str, error: &roxmltree::Error) -> Option<String> {
    match error {
        roxmltree::Error::UnknownNamespace(prefix, _) if prefix != "xacro" => {
            let root = prolog(text).find(|rest| end_of_text(rest).is_none())?;
            let at = text.len() - root.len() + 1 + Tag::read(root).name.len();
            Some(format!("{} xmlns:{prefix}=\"urn:{prefix}\"{}", &text[..at], &text[at..]))
        }
        roxmltree::Error::DtdDetected => {
            let rest = prolog(text).find(|rest| rest.starts_with("<!DOCTYPE"))?;
            let (start, kind) = (text.len() - rest.len(), &rest[..end_of(rest, ">")]);
            let lines: String = kind.matches('\n').collect();
            (!kind.contains('['))
                .then(|| format!("{}{lines}{}", &text[..start], &text[start + kind.len()..]))
        }
        roxmltree::Error::InvalidComment(_) => {
            let (start, part) = text.split_once("<!--")?;
            let emptied = |part: &str| {
                let (comment, rest) = part.split_once("-->")?;
                Some(comment.matches('\n').collect::<String>() + rest)
            };
            let parts: Option<String> = part.split("<!--").map(emptied).collect();
            parts.map(|parts| start.to_owned() + &parts)
        }
        roxmltree::Error::MalformedEntityReference(_) => {
            let mut parts = text.split('&');
            let mut whole = parts.next()?.to_owned();
            for part in parts {
                let is_name = |c: char| c.is_alphanumeric() || "#_-.:".contains(c);
                let name = part.trim_start_matches(is_name);
                let is_reference = name.starts_with(';') && name.len() < part.len();
                whole.push_str(if is_reference { "&" } else { "&amp;" });
                whole.push_str(part);
            }
            Some(whole)
        }
        _ => None,
    }
}

/// The rests of a text from each markup on, up to the first tag.
fn prolog(text: &str) -> impl Iterator<Item = &str> {
    let from = |text: &str| text.find('<');
    let mut at = from(text);
    core::iter::from_fn(move || {
        let rest = &text[at?..];
        let next = end_of_text(rest).map(|end| text.len() - rest.len() + end_of(rest, end));
        at = next.and_then(|next| from(&text[next..]).map(|more| next + more));
        Some(rest)
    })
}

/// The end of a markup that is not a tag.
fn end_of_text(markup: &str) -> Option<&'static str> {
    let markups = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("</", ">"), ("<!", ">")];
    markups.into_iter().find(|(start, _)| markup.starts_with(start)).map(|(_, end)| end)
}

fn end_of(markup: &str, terminator: &str) -> usize {
    markup.find(terminator).map_or(markup.len(), |at| at + terminator.len())
}

fn check_tag(tag: &Tag<'_>, namespaces: usize, line: impl Fn() -> usize) -> Result<(), UrdfFault> {
    if namespaces > MOST_NAMESPACES {
        return Err(UrdfFault::Namespaces { line: line(), bound: MOST_NAMESPACES });
    }
    if tag.attributes > MOST_ATTRIBUTES {
        let (line, element) = (line(), tag.name.to_owned());
        return Err(UrdfFault::Attributes { line, element, bound: MOST_ATTRIBUTES });
    }
    Ok(())
}

/// The line on which `rest`, the end of `text`, begins, from 1.
fn line(text: &str, rest: &str) -> usize {
    text[..text.len() - rest.len()].matches('\n').count() + 1
}

/// An opening tag.
struct Tag<'a> {
    name: &'a str,
    /// Length with its brackets.
    length: usize,
    /// Attributes that declare a namespace.
    namespaces: usize,
    /// The others.
    attributes: usize,
}

impl<'a> Tag<'a> {
    /// The tag at the beginning of a text. An attribute is counted by its equals sign outside
    /// quotes.
    fn read(text: &'a str) -> Self {
        let is_name = |c: char| !(c.is_ascii_whitespace() || matches!(c, '>' | '/' | '='));
        let name = text[1..].split(|c| !is_name(c)).next().unwrap_or_default();
        let mut tag = Tag { name, length: text.len(), namespaces: 0, attributes: 0 };
        let mut word = 1 + name.len();
        let mut quote = None;
        for (at, byte) in text.bytes().enumerate().skip(word) {
            match (quote, byte) {
                (Some(open), _) if byte == open => (quote, word) = (None, at + 1),
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => {
                    let declares = text[word..at].trim_start().starts_with("xmlns");
                    let count = if declares { &mut tag.namespaces } else { &mut tag.attributes };
                    *count += 1;
                    word = at + 1;
                }
                (None, b'>') => {
                    tag.length = at + 1;
                    break;
                }
                _ => {}
            }
        }
        tag
    }
}
