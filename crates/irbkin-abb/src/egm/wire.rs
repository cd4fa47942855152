//! The wire format of proto2: tags, varints, doubles and messages with their length.
//!
//! Reference: Protocol Buffers, Encoding. Unknown fields are skipped, groups are refused. A list of
//! doubles is read packed or not, and written not packed, as EGM's is declared.

use super::fault::{EgmFault, EgmFaultKind};
use crate::prelude::*;

/// The largest payload of a UDP datagram over IPv4 [bytes].
const MOST_BYTES: usize = 65_507;
/// The longest varint, of 64 bits [bytes].
const MOST_VARINT: usize = 10;
/// The largest number of a field.
const MOST_NUMBER: u64 = (1 << 29) - 1;
const VARINT: u64 = 0;
const DOUBLE: u64 = 1;
const LENGTH: u64 = 2;
const FLOAT: u64 = 5;

type Read<T> = Result<T, EgmFault>;

/// The rest of a message; offsets count from the beginning of the datagram.
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Read<Self> {
        let reader = Self { bytes, at: 0 };
        let (found, most) = (bytes.len(), MOST_BYTES);
        if found > most {
            return Err(reader.fault("message", EgmFaultKind::TooLong { found, most }));
        }
        Ok(reader)
    }

    fn fault(&self, field: &'static str, kind: EgmFaultKind) -> EgmFault {
        EgmFault { at: self.at, field, kind }
    }

    fn wire_type(&self, field: &'static str, found: u64, wanted: &'static str) -> EgmFault {
        self.fault(field, EgmFaultKind::WireType { found, wanted })
    }

    fn varint(&mut self, field: &'static str) -> Read<u64> {
        let mut value = 0;
        for (i, byte) in self.bytes[self.at..].iter().take(MOST_VARINT).enumerate() {
            value |= u64::from(byte & 0x7f) << (7 * i);
            if *byte < 0x80 {
                self.at += i + 1;
                return Ok(value);
            }
        }
        let is_long = self.bytes.len() - self.at >= MOST_VARINT;
        let truncated = EgmFaultKind::Truncated { missing: 1 };
        let long = EgmFaultKind::Varint { most: MOST_VARINT };
        Err(self.fault(field, if is_long { long } else { truncated }))
    }

    fn take(&mut self, length: u64, field: &'static str) -> Read<Reader<'a>> {
        let left = self.bytes.len() - self.at;
        match usize::try_from(length) {
            Ok(length) if length <= left => {
                let taken = Reader { bytes: &self.bytes[..self.at + length], at: self.at };
                self.at += length;
                Ok(taken)
            }
            wrong => {
                let missing = wrong.map_or(usize::MAX, |length| length - left);
                Err(self.fault(field, EgmFaultKind::Truncated { missing }))
            }
        }
    }

    fn double(&mut self, field: &'static str) -> Read<f64> {
        let taken = self.take(8, field)?;
        let mut bytes = [0; 8];
        bytes.copy_from_slice(&taken.bytes[taken.at..]);
        Ok(f64::from_le_bytes(bytes))
    }

    fn skip(&mut self, wire: u64) -> Read<()> {
        let field = "an unknown field";
        match wire {
            VARINT => self.varint(field).map(drop),
            DOUBLE => self.take(8, field).map(drop),
            LENGTH => self.varint(field).and_then(|length| self.take(length, field)).map(drop),
            FLOAT => self.take(4, field).map(drop),
            found => Err(self.wire_type(field, found, "0, 1, 2 or 5")),
        }
    }

    /// Read all fields: `take` gets number and wire type, and reads the value if it knows it.
    pub(super) fn fields(
        &mut self,
        mut take: impl FnMut(u64, u64, &mut Self) -> Read<bool>,
    ) -> Read<()> {
        while self.at < self.bytes.len() {
            let tag = self.varint("message")?;
            let (number, wire) = (tag >> 3, tag & 7);
            if number == 0 || number > MOST_NUMBER {
                let kind = EgmFaultKind::Number { found: number, most: MOST_NUMBER };
                return Err(self.fault("message", kind));
            }
            if !take(number, wire, self)? {
                self.skip(wire)?;
            }
        }
        Ok(())
    }
}

fn put_varint(mut value: u64, out: &mut Vec<u8>) {
    while value >= 0x80 {
        out.push(value.to_le_bytes()[0] | 0x80);
        value >>= 7;
    }
    out.push(value.to_le_bytes()[0]);
}

/// A value behind a tag.
pub(super) trait Value: Default {
    const WIRE: u64;
    fn put(&self, out: &mut Vec<u8>);
    /// Read it; a message that came before is merged.
    fn take(&mut self, from: &mut Reader, field: &'static str) -> Read<()>;
}

/// A field of a message: none or one value, or any number of doubles.
pub(super) trait Field {
    fn put(&self, number: u64, out: &mut Vec<u8>);
    fn take(&mut self, wire: u64, from: &mut Reader, field: &'static str) -> Read<()>;
}

pub(super) trait Message: Default {
    fn put_fields(&self, out: &mut Vec<u8>);
    fn take_field(&mut self, number: u64, wire: u64, from: &mut Reader) -> Read<bool>;
}

impl<V: Value> Field for Option<V> {
    fn put(&self, number: u64, out: &mut Vec<u8>) {
        if let Some(value) = self {
            put_varint(number << 3 | V::WIRE, out);
            value.put(out);
        }
    }

    fn take(&mut self, wire: u64, from: &mut Reader, field: &'static str) -> Read<()> {
        if wire != V::WIRE {
            let wanted = match V::WIRE {
                VARINT => "0",
                DOUBLE => "1",
                _ => "2",
            };
            return Err(from.wire_type(field, wire, wanted));
        }
        self.get_or_insert_default().take(from, field)
    }
}

impl Field for Vec<f64> {
    fn put(&self, number: u64, out: &mut Vec<u8>) {
        for value in self {
            put_varint(number << 3 | DOUBLE, out);
            value.put(out);
        }
    }

    fn take(&mut self, wire: u64, from: &mut Reader, field: &'static str) -> Read<()> {
        match wire {
            DOUBLE => self.push(from.double(field)?),
            LENGTH => {
                let length = from.varint(field)?;
                let mut packed = from.take(length, field)?;
                while packed.at < packed.bytes.len() {
                    self.push(packed.double(field)?);
                }
            }
            found => return Err(from.wire_type(field, found, "1 or 2")),
        }
        Ok(())
    }
}

impl Value for f64 {
    const WIRE: u64 = DOUBLE;

    fn put(&self, out: &mut Vec<u8>) {
        out.extend(self.to_le_bytes());
    }

    fn take(&mut self, from: &mut Reader, field: &'static str) -> Read<()> {
        *self = from.double(field)?;
        Ok(())
    }
}

/// Numbers that are varints: how they become 64 bits, and back.
macro_rules! varints {
    ($($Number:ident: $put:expr, $take:expr;)*) => {$(
        impl Value for $Number {
            const WIRE: u64 = VARINT;

            fn put(&self, out: &mut Vec<u8>) {
                let put: fn($Number) -> u64 = $put;
                put_varint(put(*self), out);
            }

            fn take(&mut self, from: &mut Reader, field: &'static str) -> Read<()> {
                let (at, value) = (from.at, from.varint(field)?);
                let take: fn(u64) -> Result<$Number, u64> = $take;
                *self = take(value).map_err(|most| {
                    EgmFault { at, field, kind: EgmFaultKind::TooLarge { value, most } }
                })?;
                Ok(())
            }
        }
    )*};
}

varints! {
    u64: |it| it, Ok;
    u32: u64::from, |it| u32::try_from(it).map_err(|_| u32::MAX.into());
    bool: u64::from, |it| Ok(it != 0);
    // An enum: negative numbers have 64 bits.
    i32: |it| i64::from(it).cast_unsigned(),
        |it| i32::try_from(it.cast_signed()).map_err(|_| i32::MAX.unsigned_abs().into());
}

impl<M: Message> Value for M {
    const WIRE: u64 = LENGTH;

    fn put(&self, out: &mut Vec<u8>) {
        put_nested(out, |inner| self.put_fields(inner));
    }

    fn take(&mut self, from: &mut Reader, field: &'static str) -> Read<()> {
        let length = from.varint(field)?;
        from.take(length, field)?.fields(|number, wire, inner| self.take_field(number, wire, inner))
    }
}

/// The message whose one field is a list of doubles.
impl Message for Vec<f64> {
    fn put_fields(&self, out: &mut Vec<u8>) {
        Field::put(self, 1, out);
    }

    fn take_field(&mut self, number: u64, wire: u64, from: &mut Reader) -> Read<bool> {
        if number == 1 {
            Field::take(self, wire, from, "an element")?;
        }
        Ok(number == 1)
    }
}

/// The message of required fields 1 to N. It replaces one that came before.
impl<V: Value + Copy, const N: usize> Value for [V; N]
where
    Self: Default,
{
    const WIRE: u64 = LENGTH;

    fn put(&self, out: &mut Vec<u8>) {
        put_nested(out, |inner| {
            self.iter().zip(1..).for_each(|(value, number)| Some(*value).put(number, inner));
        });
    }

    fn take(&mut self, from: &mut Reader, field: &'static str) -> Read<()> {
        let length = from.varint(field)?;
        let mut found = [None; N];
        let mut inner = from.take(length, field)?;
        inner.fields(|number, wire, inner| {
            let index = usize::try_from(number - 1).unwrap_or(N);
            let Some(value) = found.get_mut(index) else { return Ok(false) };
            Field::take(value, wire, inner, field).map(|()| true)
        })?;
        for (i, (own, value)) in self.iter_mut().zip(found).enumerate() {
            let kind = EgmFaultKind::Missing { number: i + 1, count: N };
            *own = value.ok_or_else(|| inner.fault(field, kind))?;
        }
        Ok(())
    }
}

/// Write the bytes of a message with their number before them.
fn put_nested(out: &mut Vec<u8>, put: impl FnOnce(&mut Vec<u8>)) {
    let mut inner = Vec::new();
    put(&mut inner);
    put_varint(u64::try_from(inner.len()).unwrap_or(u64::MAX), out);
    out.extend(inner);
}
