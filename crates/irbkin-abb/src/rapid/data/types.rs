//! The types of RAPID: their names and components, and the atoms that values consist of.

use crate::prelude::*;
use alloc::borrow::Cow;
use arrayvec::ArrayVec;
use core::fmt;

use irbkin::Configuration;

#[derive(Debug)]
pub(crate) struct Type {
    pub(crate) name: &'static str,
    pub(crate) shape: Shape,
}

#[derive(Debug)]
pub(crate) enum Shape {
    Num,
    /// A number of confdata.
    Whole,
    Bool,
    Text,
    /// Components by their names, in order.
    Record(&'static [(&'static str, &'static Type)]),
}

const fn record(name: &'static str, components: &'static [(&'static str, &'static Type)]) -> Type {
    Type { name, shape: Shape::Record(components) }
}

pub(crate) static NUM: Type = Type { name: "num", shape: Shape::Num };
pub(crate) static DNUM: Type = Type { name: "dnum", shape: Shape::Num };
static WHOLE: Type = Type { name: "num", shape: Shape::Whole };
static BOOL: Type = Type { name: "bool", shape: Shape::Bool };
static STRING: Type = Type { name: "string", shape: Shape::Text };
pub(crate) static POS: Type = record("pos", &[("x", &NUM), ("y", &NUM), ("z", &NUM)]);
pub(crate) static ORIENT: Type =
    record("orient", &[("q1", &NUM), ("q2", &NUM), ("q3", &NUM), ("q4", &NUM)]);
pub(crate) static CONFDATA: Type =
    record("confdata", &[("cf1", &WHOLE), ("cf4", &WHOLE), ("cf6", &WHOLE), ("cfx", &WHOLE)]);
#[rustfmt::skip]
pub(crate) static EXTJOINT: Type = record("extjoint", &[
    ("eax_a", &NUM), ("eax_b", &NUM), ("eax_c", &NUM),
    ("eax_d", &NUM), ("eax_e", &NUM), ("eax_f", &NUM),
]);
#[rustfmt::skip]
static ROBJOINT: Type = record("robjoint", &[
    ("rax_1", &NUM), ("rax_2", &NUM), ("rax_3", &NUM),
    ("rax_4", &NUM), ("rax_5", &NUM), ("rax_6", &NUM),
]);
pub(crate) static POSE: Type = record("pose", &[("trans", &POS), ("rot", &ORIENT)]);
#[rustfmt::skip]
pub(crate) static LOADDATA: Type = record("loaddata", &[
    ("mass", &NUM), ("cog", &POS), ("aom", &ORIENT), ("ix", &NUM), ("iy", &NUM), ("iz", &NUM),
]);
#[rustfmt::skip]
pub(crate) static ROBTARGET: Type = record("robtarget", &[
    ("trans", &POS), ("rot", &ORIENT), ("robconf", &CONFDATA), ("extax", &EXTJOINT),
]);
pub(crate) static JOINTTARGET: Type =
    record("jointtarget", &[("robax", &ROBJOINT), ("extax", &EXTJOINT)]);
pub(crate) static TOOLDATA: Type =
    record("tooldata", &[("robhold", &BOOL), ("tframe", &POSE), ("tload", &LOADDATA)]);
#[rustfmt::skip]
pub(crate) static WOBJDATA: Type = record("wobjdata", &[
    ("robhold", &BOOL), ("ufprog", &BOOL), ("ufmec", &STRING),
    ("uframe", &POSE), ("oframe", &POSE),
]);
#[rustfmt::skip]
pub(crate) static SPEEDDATA: Type = record("speeddata", &[
    ("v_tcp", &NUM), ("v_ori", &NUM), ("v_leax", &NUM), ("v_reax", &NUM),
]);
#[rustfmt::skip]
pub(crate) static ZONEDATA: Type = record("zonedata", &[
    ("finep", &BOOL), ("pzone_tcp", &NUM), ("pzone_ori", &NUM), ("pzone_eax", &NUM),
    ("zone_ori", &NUM), ("zone_leax", &NUM), ("zone_reax", &NUM),
]);

impl Type {
    pub(crate) fn components(&self) -> &'static [(&'static str, &'static Type)] {
        match self.shape {
            Shape::Record(components) => components,
            _ => &[],
        }
    }

    /// The number of atoms of a value.
    pub(crate) fn size(&self) -> usize {
        match self.shape {
            Shape::Record(components) => components.iter().map(|(_, of)| of.size()).sum(),
            _ => 1,
        }
    }

    /// The component with a name, in any case, and the atoms before it.
    pub(crate) fn component(&self, wanted: &str) -> Option<(&'static Type, usize)> {
        let components = self.components();
        let place = components.iter().position(|(name, _)| name.eq_ignore_ascii_case(wanted))?;
        let before = components[..place].iter().map(|(_, of)| of.size()).sum();
        Some((components[place].1, before))
    }

    /// The type that components lead to, and the atoms before it.
    pub(crate) fn part(
        &'static self,
        components: &[Cow<'_, str>],
    ) -> Option<(&'static Self, usize)> {
        components.iter().try_fold((self, 0), |(of, begin), component| {
            let (part, before) = of.component(component)?;
            Some((part, begin + before))
        })
    }

    /// The words for an expected value, for a message.
    pub(crate) fn wanted(&self) -> &'static str {
        match self.shape {
            Shape::Num | Shape::Whole => "a number",
            Shape::Bool => "TRUE or FALSE",
            Shape::Text => "a string",
            Shape::Record(_) => self.name,
        }
    }

    /// Write atoms as RAPID does, without blanks.
    pub(crate) fn write<'a>(
        &self,
        f: &mut fmt::Formatter<'_>,
        atoms: &mut impl Iterator<Item = &'a Atom>,
    ) -> fmt::Result {
        let Shape::Record(components) = self.shape else {
            return match atoms.next() {
                Some(Atom::Num(number)) => write_number(f, *number),
                Some(Atom::Whole(number)) => write_number(f, f64::from(*number)),
                Some(Atom::Bool(is)) => f.write_str(if *is { "TRUE" } else { "FALSE" }),
                Some(Atom::Text(text)) => write_text(f, text),
                None => Ok(()),
            };
        };
        for (i, (_, component)) in components.iter().enumerate() {
            f.write_str(if i == 0 { "[" } else { "," })?;
            component.write(f, atoms)?;
        }
        f.write_str("]")
    }
}

/// A component without components.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Atom {
    Num(f64),
    Whole(i32),
    Bool(bool),
    Text(String),
}

/// Most atoms of a value: tooldata has so many.
const MOST_ATOMS: usize = 19;

/// The atoms of a value, in the order of RAPID's components.
pub(crate) type Atoms = ArrayVec<Atom, MOST_ATOMS>;

/// Atoms that a value is made of, one after the other.
pub(crate) type Source = arrayvec::IntoIter<Atom, MOST_ATOMS>;

pub(crate) fn are_finite(atoms: &Atoms) -> bool {
    atoms.iter().all(|atom| !matches!(atom, Atom::Num(number) if !number.is_finite()))
}

/// A value in memory that consists of atoms.
pub(crate) trait Part: Sized {
    fn put(&self, atoms: &mut Atoms);

    /// Make it of the next atoms; `None` if they are of other types.
    fn take(atoms: &mut Source) -> Option<Self>;
}

pub(crate) trait Record: Part {
    const TYPE: &'static Type;
}

impl Record for f64 {
    const TYPE: &'static Type = &NUM;
}

impl Record for [f64; 3] {
    const TYPE: &'static Type = &POS;
}

impl Record for [f64; 4] {
    const TYPE: &'static Type = &ORIENT;
}

macro_rules! atom {
    ($($Type:ty: $Atom:ident;)*) => {$(
        impl Part for $Type {
            fn put(&self, atoms: &mut Atoms) {
                atoms.push(Atom::$Atom(self.clone()));
            }

            fn take(atoms: &mut Source) -> Option<Self> {
                match atoms.next()? {
                    Atom::$Atom(value) => Some(value),
                    _ => None,
                }
            }
        }
    )*};
}

atom!(f64: Num; i32: Whole; bool: Bool; String: Text;);

impl<const N: usize> Part for [f64; N] {
    fn put(&self, atoms: &mut Atoms) {
        for number in self {
            number.put(atoms);
        }
    }

    fn take(atoms: &mut Source) -> Option<Self> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = f64::take(atoms)?;
        }
        Some(numbers)
    }
}

impl Part for Configuration {
    fn put(&self, atoms: &mut Atoms) {
        let Self { cf1, cf4, cf6, cfx } = self;
        for number in [cf1, cf4, cf6, cfx] {
            number.put(atoms);
        }
    }

    fn take(atoms: &mut Source) -> Option<Self> {
        let mut next = || i32::take(atoms);
        Some(Self { cf1: next()?, cf4: next()?, cf6: next()?, cfx: next()? })
    }
}

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
