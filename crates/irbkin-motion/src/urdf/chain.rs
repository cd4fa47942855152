//! The joints between two links.

use alloc::collections::BTreeSet;

use super::joint::Joint;
use super::tree::{Tree, quoted};
use crate::prelude::*;
use crate::urdf::fault::UrdfFault;
use irbkin::internal::Names;
#[cfg(feature = "std")]
use irbkin::internal::similar;

/// Number of links up to which a message for an unknown one lists all names, and of chains that a
/// message proposes.
const FEW: usize = 12;

/// Number of joints of the longest arm: part of a longer chain is one, part of such an arm is not.
const MOST_JOINTS: usize = 7;

/// Names of the tool's frame, the first that a file has: ROS-Industrial's convention, then others.
const TOOLS: [&str; 4] = ["tool0", "tcp", "flange", "grasp"];

/// Number of ends of chains up to which a message looks for chains that could be taken.
const MOST_ENDS: usize = 64;

/// The base, and the joints from there to the tip, revolute or fixed but for a rail; the number of
/// revolute ones is in `wanted`. Then a remark on how the tip was chosen among several.
pub(super) fn chain_between<'t, 'a>(
    tree: &'t Tree<'a>,
    base: Option<&str>,
    tip: Option<&str>,
    wanted: &[usize],
) -> Result<(usize, Vec<&'t Joint<'a>>, String), UrdfFault> {
    let base = match base {
        Some(name) => named(tree, "base", name)?,
        None => only_root(tree)?,
    };
    let grips = grippers(tree);
    let (tip, mut remark) = match tip {
        Some(name) => (named(tree, "tip", name)?, String::new()),
        None => only_tip(tree, base, wanted, &grips)?,
    };
    let mut chain = Vec::new();
    let mut link = tip;
    while link != base {
        let names = || UrdfFault::NotBelow {
            tip: tree.links[tip].to_owned(),
            base: tree.links[base].to_owned(),
        };
        let above = tree.above[link].ok_or_else(names)?;
        let joint = &tree.joints[above];
        if grips[above] {
            remark = format!("joint {:?} may be a gripper's", joint.name);
        }
        chain.push(joint);
        link = joint.parent;
    }
    chain.reverse();
    let fault = match chain.iter().try_fold(Way::default(), |way, joint| way.through(joint)) {
        Ok(way) if wanted.contains(&way.turning) => return Ok((base, chain, remark)),
        Ok(Way { turning: found, .. }) => {
            let [base, tip] = [base, tip].map(|link| tree.links[link].to_owned());
            let count = UrdfFault::JointCount { base, tip, found, wanted: wanted.to_vec() };
            chain.iter().find(|joint| joint.is_linkage()).map_or(count, |joint| joint.mimic())
        }
        Err(fault) => fault,
    };
    Err(proposing(fault, tree, base, &[tip], (wanted, &grips)))
}

/// The joints of a chain up to the one that slides, taken from it; none without a rail.
pub(super) fn take_rail<'t, 'a>(chain: &mut Vec<&'t Joint<'a>>) -> Vec<&'t Joint<'a>> {
    let slide = chain.iter().position(|joint| joint.slides());
    chain.drain(..slide.map_or(0, |slide| slide + 1)).collect()
}

/// A fault of the chains to `ends`, with the bases and tips of chains on them that could be taken.
fn proposing(
    fault: UrdfFault,
    tree: &Tree<'_>,
    base: usize,
    ends: &[usize],
    (wanted, grips): (&[usize], &[bool]),
) -> UrdfFault {
    let mut chains = Vec::new();
    for &end in ends.iter().take(MOST_ENDS) {
        for chain in chains_above(tree, base, end, (wanted, grips)) {
            if !chains.contains(&chain) {
                chains.push(chain);
            }
        }
    }
    if chains.is_empty() {
        return fault;
    }
    let chains = chains.into_iter().map(|(from, to, joints)| {
        let [from_name, to_name] = [from, to].map(|link| tree.links[link]);
        let base = if from == base { String::new() } else { format!("base={from_name:?} and ") };
        format!("{base}tip={to_name:?} ({joints} joints)")
    });
    UrdfFault::Proposing { fault: Box::new(fault), chains: chains.take(FEW).collect() }
}

/// The chains of a wanted number of revolute joints between a base and an end below it, as first
/// link, last link and number: between two joints that must not be in a chain, or may be a gripper's,
/// all; of more joints than an arm has, the first and the last ones.
fn chains_above(
    tree: &Tree<'_>,
    base: usize,
    end: usize,
    (wanted, grips): (&[usize], &[bool]),
) -> Vec<(usize, usize, usize)> {
    let mut joints = Vec::new();
    let mut link = end;
    while link != base {
        let Some(above) = tree.above[link] else { break };
        joints.push(above);
        link = tree.joints[above].parent;
    }
    let most = wanted.iter().copied().max().unwrap_or_default();
    let mut chains = Vec::new();
    let (mut way, mut first) = (Way::default(), link);
    // The links on both sides of each revolute joint since `first`.
    let mut turning: Vec<[usize; 2]> = Vec::new();
    for index in joints.into_iter().rev().map(Some).chain([None]) {
        let joint = index.map(|index| &tree.joints[index]);
        let arm = joint.filter(|_| index.is_some_and(|index| !grips[index]));
        if let Some((joint, Ok(next))) = arm.map(|joint| (joint, way.through(joint))) {
            way = next;
            if joint.turns() {
                turning.push([joint.parent, joint.child]);
            }
            continue;
        }
        match turning.len() {
            count if wanted.contains(&count) => chains.push((first, turning[count - 1][1], count)),
            count if count > most && count > MOST_JOINTS => {
                chains.push((first, turning[most - 1][1], most));
                chains.push((turning[count - most][0], turning[count - 1][1], most));
            }
            _ => {}
        }
        first = joint.map_or(first, |joint| joint.child);
        way = Way::default();
        turning.clear();
    }
    chains
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
        (None, _) => Err(UrdfFault::NoLinks),
        _ => Err(UrdfFault::Roots { links: tree.quoted(tree.roots()) }),
    }
}

/// The path from the base to a link.
#[derive(Clone, Copy, Default)]
struct Way<'a> {
    /// Number of revolute joints.
    turning: usize,
    /// Name of the second of them.
    second: &'a str,
    /// Whether a joint on it moves.
    moves: bool,
    /// Whether the joint of a linkage is on it.
    coupled: bool,
    /// The first joint that must not be on the path.
    barred_by: Option<usize>,
    /// The first joint that may be a gripper's.
    gripper: Option<usize>,
}

impl<'a> Way<'a> {
    /// The path with one joint more, if that may be on it.
    fn through(self, joint: &Joint<'a>) -> Result<Self, UrdfFault> {
        joint.fault(self.moves)?;
        if joint.is_linkage() {
            let is_beside_joint_3 = matches!(self.turning, 2 | 3);
            let may_be = is_beside_joint_3 && self.second == joint.followed() && !self.coupled;
            return may_be.then_some(Self { coupled: true, ..self }).ok_or_else(|| joint.mimic());
        }
        let turning = self.turning + usize::from(joint.turns());
        let second = if joint.turns() && turning == 2 { joint.name } else { self.second };
        Ok(Self { turning, second, moves: self.moves || joint.kind != "fixed", ..self })
    }
}

/// Joints of a finger, at most.
const MOST_FINGER: usize = 2;

/// Of each joint, whether it may be a gripper's: by its name, as a last one that another one follows,
/// or as one of several fingers on a link.
fn grippers<'a>(tree: &Tree<'a>) -> Vec<bool> {
    let carriers = carriers(tree);
    let follower = |joint: &Joint<'a>| (joint.followed(), carriers[joint.parent]);
    let followed: BTreeSet<_> = tree.joints.iter().map(follower).collect();
    let is_end = |link: &usize| tree.below[*link].is_empty();
    let ends: BTreeSet<_> =
        (0..tree.links.len()).filter(is_end).map(|link| carriers[link]).collect();
    let is_own = |joint: &Joint<'_>| joint.turns() && joint.followed().is_empty();
    // Joints on the longest way from a link to an end.
    let mut longest = vec![0; tree.links.len()];
    for link in tree.hanging_on(tree.roots()).into_iter().rev() {
        let below = tree.below[link].iter().map(|&index| &tree.joints[index]);
        let lengths = below.map(|joint| longest[joint.child] + usize::from(is_own(joint)));
        longest[link] = lengths.max().unwrap_or(0);
    }
    let is_short = |joint: &Joint<'_>| is_own(joint) && longest[joint.child] < MOST_FINGER;
    let mut fingers = vec![0; tree.links.len()];
    for joint in tree.joints.iter().filter(|joint| is_short(joint)) {
        fingers[carriers[joint.parent]] += 1;
    }
    let grips = |joint: &Joint<'_>| {
        let moves_one_beside = followed.contains(&(joint.name, carriers[joint.parent]));
        let moves_the_tip =
            followed.contains(&(joint.name, joint.child)) && !ends.contains(&joint.child);
        let drives = moves_one_beside || moves_the_tip || joint.name.contains("drive");
        let is_finger = is_short(joint) && fingers[carriers[joint.parent]] > 1;
        is_finger || (drives && longest[joint.child] == 0) || is_named_as_gripper(tree, joint)
    };
    tree.joints.iter().map(|joint| joint.turns() && grips(joint)).collect()
}

/// Whether a joint moves a part of a gripper, by its name or that of its link. A link may be a whole
/// gripper that an arm carries, and a wrist may turn one.
fn is_named_as_gripper(tree: &Tree<'_>, joint: &Joint<'_>) -> bool {
    let [name, link] = [joint.name, tree.links[joint.child]].map(str::to_lowercase);
    let has = |text: &str, words: &[&str]| words.iter().any(|word| text.contains(word));
    let parts = ["jaw", "finger", "claw", "knuckle", "thumb", "proximal", "distal"];
    let is_whole = has(&name, &["gripper", "palm"]) && !has(&name, &["yaw", "pitch", "roll"]);
    is_whole || has(&name, &parts) || has(&link, &parts)
}

/// The link behind the last joint above each link that is not fixed.
fn carriers(tree: &Tree<'_>) -> Vec<usize> {
    let mut carriers: Vec<usize> = (0..tree.links.len()).collect();
    for link in tree.hanging_on(tree.roots()) {
        let below = tree.below[link].iter().map(|&index| &tree.joints[index]);
        for joint in below.filter(|joint| joint.kind == "fixed") {
            carriers[joint.child] = carriers[link];
        }
    }
    carriers
}

/// The only link at the end of a chain whose number of joints is in `wanted`. A frame is never
/// guessed: if there are several, none is chosen, except one of [`TOOLS`] if all of them are fixed
/// to one link, which the remark says then. Nor if a joint may be a gripper's: one of [`grippers`],
/// or the last one if another end is on a link before it.
fn only_tip(
    tree: &Tree<'_>,
    base: usize,
    wanted: &[usize],
    grips: &[bool],
) -> Result<(usize, String), UrdfFault> {
    let mut ways = vec![Way::default(); tree.links.len()];
    let carriers = carriers(tree);
    let mut ends = Vec::new();
    for link in tree.hanging_on([base].into_iter()) {
        for &index in &tree.below[link] {
            let joint = &tree.joints[index];
            let way = ways[link];
            let barred = Way { barred_by: way.barred_by.or(Some(index)), ..way };
            let gripper = way.gripper.or(grips[index].then_some(index));
            ways[joint.child] = Way { gripper, ..way.through(joint).unwrap_or(barred) };
        }
        if tree.below[link].is_empty() {
            ends.push(link);
        }
    }
    let can_be =
        |link: &&usize| ways[**link].barred_by.is_none() && wanted.contains(&ways[**link].turning);
    let (base_link, wanted_counts) = (base, wanted.to_vec());
    let base = tree.links[base].to_owned();
    let above = |link: usize| tree.above[carriers[link]].map(|joint| &tree.joints[joint]);
    let before = |link: usize| above(link).map(|joint| joint.parent);
    let tips: Vec<usize> = ends.iter().filter(can_be).copied().collect();
    let (arms, hands): (Vec<usize>, Vec<usize>) =
        tips.iter().copied().partition(|tip| ways[*tip].gripper.is_none());
    let last = arms.first().and_then(|&tip| above(tip));
    // A finger may have two joints.
    let others = last.map(|last| [Some(last.parent), before(last.parent)]);
    let others = others.map(|others| others.map(|it| it.map(|link| carriers[link])));
    let is_before = |link: &&usize| {
        let is_end = ways[**link].barred_by.is_none() && !can_be(link);
        is_end && others.is_some_and(|others| others.contains(&Some(carriers[**link])))
    };
    let shorter: Vec<usize> = ends.iter().filter(is_before).copied().collect();
    let named = |link: usize| remark(tree, link, ways[link]);
    let are_on_one_link = |tips: &[usize]| tips.iter().all(|it| carriers[*it] == carriers[tips[0]]);
    let frame = |name: &&str| tips.iter().copied().find(|tip| tree.links[*tip] == *name);
    let chosen = match tips[..] {
        [tip] => Some(tip),
        _ if are_on_one_link(&tips) => TOOLS.iter().find_map(frame),
        _ => None,
    };
    match (last, chosen) {
        (Some(last), _) if !shorter.is_empty() && are_on_one_link(&arms) => {
            let ends = arms.into_iter().chain(shorter).map(named).collect();
            Err(UrdfFault::MayBeGripper { base, joint: last.name.to_owned(), ends })
        }
        (Some(_), Some(tip)) => {
            let others = tree.quoted(tips.into_iter().filter(|it| *it != tip));
            let remark = format!("tip {:?}, beside it {others}", tree.links[tip]);
            Ok((tip, if others.is_empty() { String::new() } else { remark }))
        }
        (Some(_), None) => {
            let hands = (!hands.is_empty()).then(|| format!("{} of a gripper", hands.len()));
            let tips = arms.into_iter().chain(shorter).map(named).chain(hands).collect();
            Err(UrdfFault::SeveralTips { base, wanted: wanted_counts, tips })
        }
        (None, _) => {
            let remarks = ends.iter().copied().map(named).collect();
            let before = |end: &usize| ways[*end].gripper.map(|joint| tree.joints[joint].parent);
            let axes = ends.iter().filter_map(before).map(|link| ways[link].turning).max();
            // Wheels are no gripper's.
            let axes = axes.filter(|axes| *axes > 2);
            let is_whole = |way: &Way<'_>| way.barred_by.is_none() && !way.coupled;
            let of_ends = || ends.iter().map(|&link| ways[link]);
            let most = of_ends()
                .map(|way| way.turning)
                .max()
                .filter(|_| of_ends().all(|it| is_whole(&it)));
            let fault = UrdfFault::NoTip {
                base,
                wanted: wanted_counts,
                ends: remarks,
                most: axes.or(most).unwrap_or_default(),
                grips: axes.is_some(),
            };
            let turns = |link: &usize| tree.above[*link].is_some_and(|it| tree.joints[it].turns());
            let below = |joint: &Joint<'_>| tree.hanging_on([joint.child].into_iter());
            let mut barred = of_ends().filter_map(|way| way.barred_by).map(|it| &tree.joints[it]);
            let slides = barred.any(|it| it.slides() && below(it).iter().any(turns));
            let fault = if slides { UrdfFault::Sliding { fault: Box::new(fault) } } else { fault };
            Err(proposing(fault, tree, base_link, &ends, (wanted, grips)))
        }
    }
}

/// A link at the end of a chain, and the reason why it cannot be the tip.
fn remark(tree: &Tree<'_>, link: usize, way: Way<'_>) -> String {
    let name = tree.links[link];
    if let Some(joint) = way.gripper {
        return format!(
            "{name:?} (behind joint {:?}, which may be a gripper's)",
            tree.joints[joint].name
        );
    }
    match way.barred_by.map(|joint| &tree.joints[joint]) {
        Some(joint) if joint.turns() || joint.is_linkage() => {
            format!("{name:?} (behind joint {:?}, a mimic)", joint.name)
        }
        Some(joint) => format!("{name:?} (behind joint {:?}, {})", joint.name, joint.kind),
        None if way.coupled => format!("{name:?} ({}, and a mimic)", way.turning),
        None => format!("{name:?} ({})", way.turning),
    }
}
