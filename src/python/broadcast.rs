//! Arguments with leading dimensions of their own, as NumPy broadcasts them.

use pyo3::prelude::*;

use super::arrays::Rows;
use super::errors::Fault;
use super::wording::shape;

/// An argument among others.
pub(super) struct Argument<'a, 'py> {
    pub(super) field: &'static str,
    pub(super) fault: Fault,
    pub(super) rows: &'a mut Rows<'py>,
}

/// Gives all arguments the same leading dimensions.
pub(super) fn together<'py>(py: Python<'py>, arguments: &mut [Argument<'_, 'py>]) -> PyResult<()> {
    let mut lead = Vec::new();
    for (number, argument) in arguments.iter().enumerate() {
        lead = joined(&lead, &argument.rows.lead).ok_or_else(|| {
            let others = arguments[..number]
                .iter()
                .map(|other| format!("{} of shape {}", other.field, shape(other.rows.shape())))
                .collect::<Vec<_>>()
                .join(" and ");
            argument.fault.error(
                py,
                format!(
                    "{} of shape {} cannot be broadcast with {others}: leading dimensions must be equal, or 1, or left out",
                    argument.field,
                    shape(argument.rows.shape()),
                ),
            )
        })?;
    }
    for Argument { field, fault, rows } in arguments.iter_mut().filter(|it| it.rows.lead != lead) {
        **rows = rows.broadcast(&lead, field, *fault)?;
    }
    Ok(())
}

/// The shape that arrays of two shapes have together.
fn joined(one: &[usize], other: &[usize]) -> Option<Vec<usize>> {
    let (long, short) = if one.len() < other.len() { (other, one) } else { (one, other) };
    let mut shape = long.to_vec();
    let start = long.len() - short.len();
    for (size, other) in shape[start..].iter_mut().zip(short) {
        *size = match (*size, *other) {
            (one, other) if one == other => one,
            (1, other) => other,
            (one, 1) => one,
            _ => return None,
        };
    }
    Some(shape)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_joined_as_numpy_joins_them() {
        for (one, other, both) in [
            (&[] as &[usize], &[] as &[usize], Some(&[] as &[usize])),
            (&[], &[2, 3], Some(&[2, 3])),
            (&[3], &[2, 1], Some(&[2, 3])),
            (&[2, 3], &[1], Some(&[2, 3])),
            (&[0], &[1], Some(&[0])),
            (&[0], &[2], None),
            (&[2, 3], &[2], None),
        ] {
            assert_eq!(joined(one, other).as_deref(), both, "{one:?} {other:?}");
            assert_eq!(joined(other, one).as_deref(), both, "{other:?} {one:?}");
        }
    }
}
