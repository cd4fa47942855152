//! Names that are spelled like another one.

use alloc::vec::Vec;

/// The names that are similar enough, the most similar first. Similarities are from 0 to 1.
#[doc(hidden)]
pub fn similar<'a>(
    names: impl Iterator<Item = &'a str>,
    similarity: impl Fn(&str) -> f64,
    least: f64,
) -> Vec<&'a str> {
    let mut ranked = Vec::new();
    ranked.extend(names.map(|name| (similarity(name), name)).filter(|(one, _)| *one >= least));
    sort(&mut ranked);
    ranked.into_iter().map(|(_, name)| name).collect()
}

fn sort(ranked: &mut [(f64, &str)]) {
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
}
