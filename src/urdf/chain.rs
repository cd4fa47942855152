//! The joints between two links.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::joint::Joint;
use super::tree::{Tree, quoted};
use crate::error::{Names, UrdfFault};
#[cfg(feature = "std")]
use crate::spelling::similar;

/// Number of links up to which a message for an unknown one lists all names.
const FEW: usize = 12;

/// The joints from base to tip, all of them revolute or fixed; the number of revolute ones is in
/// `wanted`.
pub(super) fn chain_between<'t, 'a>(
    tree: &'t Tree<'a>,
    base: Option<&str>,
    tip: Option<&str>,
    wanted: &[usize],
) -> Result<Vec<&'t Joint<'a>>, UrdfFault> {
    let base = match base {
        Some(name) => named(tree, "base", name)?,
        None => only_root(tree)?,
    };
    let tip = match tip {
        Some(name) => named(tree, "tip", name)?,
        None => only_tip(tree, base, wanted)?,
    };
    let mut chain = Vec::new();
    let mut link = tip;
    while link != base {
        let names = || UrdfFault::NotBelow {
            tip: tree.links[tip].to_owned(),
            base: tree.links[base].to_owned(),
        };
        let joint = &tree.joints[tree.above[link].ok_or_else(names)?];
        chain.push(joint);
        link = joint.parent;
    }
    chain.reverse();
    let way = chain.iter().try_fold(Way::default(), |way, joint| way.through(joint))?;
    let found = way.turning;
    if wanted.contains(&found) {
        return Ok(chain);
    }
    let [base, tip] = [base, tip].map(|link| tree.links[link].to_owned());
    Err(UrdfFault::JointCount { base, tip, found, wanted: wanted.to_vec() })
}

fn named(tree: &Tree<'_>, field: &'static str, name: &str) -> Result<usize, UrdfFault> {
    tree.link(name).ok_or_else(|| {
        let links = if tree.links.len() <= FEW {
            tree.quoted(0..tree.links.len())
        } else {
            close_to(tree, name)
        };
        UrdfFault::NoSuchLink { field, name: name.to_owned(), links }
    })
}

/// Links whose names contain the wanted one or have a similar spelling, the closest first.
#[cfg(feature = "std")]
fn close_to(tree: &Tree<'_>, wanted: &str) -> Names {
    const LEAST_SIMILARITY: f64 = 0.7;
    const LONGEST: usize = 200;
    let similarity = |name: &str| match name {
        _ if !wanted.is_empty() && name.contains(wanted) => 1.0,
        // The comparison takes time proportional to the product of both lengths.
        _ if name.len().max(wanted.len()) > LONGEST => 0.0,
        _ => strsim::jaro_winkler(name, wanted),
    };
    let names = tree.links.iter().copied();
    similar(names, similarity, LEAST_SIMILARITY).into_iter().map(quoted).collect()
}

#[cfg(not(feature = "std"))]
fn close_to(tree: &Tree<'_>, wanted: &str) -> Names {
    tree.links
        .iter()
        .filter(|name| !wanted.is_empty() && name.contains(wanted))
        .map(|name| quoted(name))
        .collect()
}

fn only_root(tree: &Tree<'_>) -> Result<usize, UrdfFault> {
    let mut roots = tree.roots();
    match (roots.next(), roots.next()) {
        (Some(root), None) => Ok(root),
        _ => Err(UrdfFault::Roots { links: tree.quoted(tree.roots()) }),
    }
}

/// The path from the base to a link.
#[derive(Clone, Copy, Default)]
struct Way<'a> {
    /// Number of revolute joints.
    turning: usize,
    /// Name of the last of them.
    last: &'a str,
    /// Whether the joint of a linkage is on it.
    coupled: bool,
    /// The first joint that must not be on the path.
    barred_by: Option<usize>,
}

impl<'a> Way<'a> {
    /// The path with one joint more, if that may be on it.
    fn through(self, joint: &Joint<'a>) -> Result<Self, UrdfFault> {
        joint.fault()?;
        if joint.is_linkage() {
            let is_behind_joint_2 = (self.turning, self.last) == (2, joint.followed());
            let may_be = is_behind_joint_2 && !self.coupled;
            return may_be.then_some(Self { coupled: true, ..self }).ok_or_else(|| joint.mimic());
        }
        let turning = self.turning + usize::from(joint.turns());
        Ok(Self { turning, last: if joint.turns() { joint.name } else { self.last }, ..self })
    }
}

/// The only link at the end of a chain whose number of joints is in `wanted`. A frame is never
/// guessed: if there are several, none is chosen.
fn only_tip(tree: &Tree<'_>, base: usize, wanted: &[usize]) -> Result<usize, UrdfFault> {
    let mut ways = vec![Way::default(); tree.links.len()];
    let mut ends = Vec::new();
    for link in tree.hanging_on([base].into_iter()) {
        for &index in &tree.below[link] {
            let joint = &tree.joints[index];
            let way = ways[link];
            let barred = Way { barred_by: way.barred_by.or(Some(index)), ..way };
            ways[joint.child] = way.through(joint).unwrap_or(barred);
        }
        if tree.below[link].is_empty() {
            ends.push(link);
        }
    }
    let can_be =
        |link: &&usize| ways[**link].barred_by.is_none() && wanted.contains(&ways[**link].turning);
    let (base, wanted_counts) = (tree.links[base].to_owned(), wanted.to_vec());
    match (ends.iter().find(can_be), ends.iter().filter(can_be).count()) {
        (Some(&tip), 1) => Ok(tip),
        (Some(_), _) => {
            let tips = tree.quoted(ends.iter().filter(can_be).copied());
            Err(UrdfFault::SeveralTips { base, wanted: wanted_counts, tips })
        }
        (None, _) => {
            let ends = ends.iter().map(|&link| remark(tree, link, ways[link])).collect();
            Err(UrdfFault::NoTip { base, wanted: wanted_counts, ends })
        }
    }
}

/// A link at the end of a chain, and the reason why it cannot be the tip.
fn remark(tree: &Tree<'_>, link: usize, way: Way<'_>) -> String {
    let name = tree.links[link];
    match way.barred_by.map(|joint| &tree.joints[joint]) {
        Some(joint) if joint.turns() || joint.is_linkage() => {
            format!("{name:?} (behind joint {:?}, a mimic)", joint.name)
        }
        Some(joint) => format!("{name:?} (behind joint {:?}, {})", joint.name, joint.kind),
        None => format!("{name:?} ({})", way.turning),
    }
}
