//! The fields of a request, and the sentences that refuse them.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use irbkin::{Pose, pose, thresholds};
use serde_json::{Map, Value};

/// Largest text of a module or of a URDF [bytes].
pub(crate) const MOST_TEXT: usize = 4_000_000;

/// Why a request is refused, in a sentence.
#[derive(Debug)]
pub(crate) struct Refusal(pub(crate) String);

macro_rules! refusals {
    ($($Error:ty)*) => {$(
        impl From<$Error> for Refusal {
            fn from(error: $Error) -> Self {
                Self(error.to_string())
            }
        }
    )*};
}
refusals! { irbkin::Error irbkin_motion::Error irbkin_abb::Error }

impl From<String> for Refusal {
    fn from(sentence: String) -> Self {
        Self(sentence)
    }
}

/// An object of JSON, and its name in a sentence: empty for the request itself.
pub(crate) struct Request<'a> {
    fields: &'a Map<String, Value>,
    prefix: String,
}

impl<'a> Request<'a> {
    pub(crate) fn new(fields: &'a Map<String, Value>, prefix: String) -> Self {
        Self { fields, prefix }
    }

    /// The name of the object in a sentence.
    pub(crate) fn name(&self) -> &str {
        self.prefix.trim_end_matches('.')
    }

    /// The name of a field in a sentence.
    fn named(&self, field: &str) -> String {
        format!("{}{field}", self.prefix)
    }

    pub(crate) fn refused<T>(&self, field: &str, words: &str) -> Result<T, Refusal> {
        Err(format!("{} {words}", self.named(field)).into())
    }

    /// The value of a field; none if it is missing or `null`.
    fn value(&self, field: &str) -> Option<&'a Value> {
        self.fields.get(field).filter(|value| !value.is_null())
    }

    pub(crate) fn has(&self, field: &str) -> bool {
        self.value(field).is_some()
    }

    /// A text of at most [`MOST_TEXT`] bytes.
    pub(crate) fn text(&self, field: &str) -> Result<&'a str, Refusal> {
        match self.value(field) {
            None => self.refused(field, "is missing: it must be a text"),
            Some(Value::String(text)) if text.len() > MOST_TEXT => {
                let words = format!("has {} bytes, it must have at most {MOST_TEXT}", text.len());
                self.refused(field, &words)
            }
            Some(Value::String(text)) => Ok(text),
            Some(other) => self.refused(field, &format!("is {}, it must be a text", kind(other))),
        }
    }

    pub(crate) fn optional_text(&self, field: &str) -> Result<Option<&'a str>, Refusal> {
        self.has(field).then(|| self.text(field)).transpose()
    }

    /// Whether a flag is set; not if it is missing.
    pub(crate) fn flag(&self, field: &str) -> Result<bool, Refusal> {
        match self.value(field) {
            None => Ok(false),
            Some(Value::Bool(flag)) => Ok(*flag),
            Some(other) => {
                self.refused(field, &format!("is {}, it must be true or false", kind(other)))
            }
        }
    }

    /// The objects of a list with at most so many.
    pub(crate) fn objects(&self, field: &str, most: usize) -> Result<Vec<Request<'a>>, Refusal> {
        let items = match self.value(field) {
            None => return self.refused(field, "is missing: it must be a list"),
            Some(Value::Array(items)) => items,
            Some(other) => {
                return self.refused(field, &format!("is {}, it must be a list", kind(other)));
            }
        };
        if items.len() > most {
            let words = format!("has {} items, it must have at most {most}", items.len());
            return self.refused(field, &words);
        }
        let object = |(index, item): (usize, &'a Value)| {
            let name = format!("{}[{index}]", self.named(field));
            match item {
                Value::Object(fields) => Ok(Request::new(fields, format!("{name}."))),
                other => Err(format!("{name} is {}, it must be an object", kind(other)).into()),
            }
        };
        items.iter().enumerate().map(object).collect()
    }

    /// An index of a list with so many items; 0 if it is missing.
    pub(crate) fn index(&self, field: &str, count: usize) -> Result<usize, Refusal> {
        let Some(value) = self.value(field) else { return Ok(0) };
        let index = value.as_u64().and_then(|it| usize::try_from(it).ok());
        match index.filter(|it| *it < count) {
            Some(index) => Ok(index),
            None => self.refused(field, &format!("is {value}, it must be 0 to {}", count - 1)),
        }
    }

    /// A number of at most the size of `bound`.
    fn number(&self, field: &str, bound: f64) -> Result<f64, Refusal> {
        match self.value(field) {
            None => self.refused(field, "is missing: it must be a number"),
            Some(value) => number(&self.named(field), value, bound),
        }
    }

    /// A list of `K` numbers of at most the size of `bound`.
    fn numbers<const K: usize>(&self, field: &str, bound: f64) -> Result<[f64; K], Refusal> {
        let items = match self.value(field) {
            None => return self.refused(field, &format!("is missing: it must be {K} numbers")),
            Some(Value::Array(items)) => items,
            Some(other) => {
                let words = format!("is {}, it must be a list of {K} numbers", kind(other));
                return self.refused(field, &words);
            }
        };
        let Ok(items) = <&[Value; K]>::try_from(items.as_slice()) else {
            let words = format!("has {} numbers, it must have {K}", items.len());
            return self.refused(field, &words);
        };
        let mut numbers = [0.0; K];
        for (index, (to, item)) in numbers.iter_mut().zip(items).enumerate() {
            *to = number(&format!("{}[{index}]", self.named(field)), item, bound)?;
        }
        Ok(numbers)
    }

    /// Joint angles [rad].
    pub(crate) fn joints<const N: usize>(&self, field: &str) -> Result<[f64; N], Refusal> {
        self.numbers(field, thresholds::MOST_ANGLE)
    }

    /// The angle of a joint [rad].
    pub(crate) fn angle(&self, field: &str) -> Result<f64, Refusal> {
        self.number(field, thresholds::MOST_ANGLE)
    }

    /// A point, a direction or the edges of a box [m].
    pub(crate) fn point(&self, field: &str) -> Result<[f64; 3], Refusal> {
        self.numbers(field, thresholds::MOST_LENGTH)
    }

    /// A length [m].
    pub(crate) fn length(&self, field: &str) -> Result<f64, Refusal> {
        self.number(field, thresholds::MOST_LENGTH)
    }

    /// A pose by the first three rows of its matrix.
    pub(crate) fn pose(&self, field: &str) -> Result<Pose, Refusal> {
        let twelve: [f64; 12] = self.numbers(field, thresholds::MOST_LENGTH)?;
        let mut rows = [0.0; 16];
        for (to, from) in rows.iter_mut().zip(twelve.into_iter().chain([0.0, 0.0, 0.0, 1.0])) {
            *to = from;
        }
        let named = |error: irbkin::Error| Refusal(format!("{}: {error}", self.named(field)));
        pose::from_rows(&rows).map_err(named)
    }

    pub(crate) fn optional_pose(&self, field: &str) -> Result<Option<Pose>, Refusal> {
        self.has(field).then(|| self.pose(field)).transpose()
    }
}

fn number(name: &str, value: &Value, bound: f64) -> Result<f64, Refusal> {
    match value.as_f64() {
        Some(number) if number.abs() <= bound => Ok(number),
        Some(number) => Err(format!("{name} = {number:e}, it must be at most {bound:e}").into()),
        None => Err(format!("{name} is {}, it must be a number", kind(value)).into()),
    }
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

/// The first three rows of a matrix.
pub(crate) fn twelve(pose: &Pose) -> [f64; 12] {
    let mut twelve = [0.0; 12];
    for (to, from) in twelve.iter_mut().zip(pose::to_rows(pose)) {
        *to = from;
    }
    twelve
}
