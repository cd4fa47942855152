//! Links behind a joint beside the chain, as a gripper's fingers: capsules that contain them
//! wherever the joint is.
//!
//! A capsule is all that is within its radius of its axis, so what contains the axis wherever it
//! is, made thicker by the radius, contains the capsule. The way of the joint is divided into
//! pieces, with the axis in the middle of each:
//!
//! - *Turned by up to `eta` from there*, a point `rho` from the joint's axis is moved by
//!   `2 rho sin(eta / 2)`, less than `rho eta`. `rho` is largest at an end of the axis.
//! - *Slid by `v` in all*, the axis passes over a parallelogram. It is divided across its shorter
//!   sides, and is nowhere farther than half of a piece from a line along the longer ones.
//!
//! That is what the radius grows by.

use core::f64::consts::PI;

use nalgebra::{Rotation3, Unit, Vector3};

use super::joint::Joint;
use super::tree::Tree;
use crate::body::Capsule;
use crate::prelude::*;
use crate::urdf::fault::UrdfFault;
use irbkin::Pose;
use irbkin::internal::thresholds::MOST_REACH;

/// By how much a capsule may grow: this length [m] or half of its radius, unless the pieces are
/// more than [`MOST_PIECES`].
const GROWTH: f64 = 0.005;

/// Pieces of the way of a capsule behind any number of joints, at most.
const MOST_PIECES: f64 = 32.0;

/// Joints beside the chain one behind the other, at most: a finger has four. Each link has a list of
/// its own.
const MOST_JOINTS: usize = 16;

/// The way of a link that moves with the chain: from the chain outwards, the joints beside it.
#[derive(Clone)]
pub struct Carrier {
    /// Number of joints of the chain between the base and the link.
    pub(super) after: usize,
    /// Each with its frame at zero in the frame of the one before.
    pub beside: Vec<(Pose, Sweep)>,
    /// The link in the frame of the last of them, or of the link of the chain.
    pub pose: Pose,
}

/// A joint beside the chain: its axis in its frame, and its limits [rad or m].
#[derive(Clone)]
pub struct Sweep {
    direction: Vector3<f64>,
    is_slide: bool,
    range: [f64; 2],
}

impl Carrier {
    /// Capsules that contain the given ones of the link wherever the joints are, in the link of the
    /// chain, and by how much they are thicker [m].
    pub fn swept(&self, capsules: &[Capsule]) -> (Vec<Capsule>, f64) {
        #[expect(clippy::cast_precision_loss, reason = "a few joints")]
        let most = MOST_PIECES.powf(1.0 / self.beside.len().max(1) as f64).floor();
        let (mut found, mut growth) = (Vec::new(), 0.0_f64);
        for capsule in capsules {
            let mut all = Vec::from([capsule.moved(&self.pose)]);
            for (pose, sweep) in self.beside.iter().rev() {
                let pieces = all.iter().flat_map(|one| sweep.pieces(one, most));
                all = pieces.map(|piece| piece.moved(pose)).collect();
            }
            let thickest = all.iter().map(Capsule::radius).fold(0.0, f64::max);
            growth = growth.max(thickest - capsule.radius());
            found.extend(all);
        }
        (found, growth)
    }
}

impl Sweep {
    /// The way of a joint that is behind so many others beside the chain.
    pub(super) fn of(joint: &Joint<'_>, before: usize, tree: &Tree<'_>) -> Result<Self, UrdfFault> {
        let refused = |what| UrdfFault::Beside {
            link: tree.links[joint.child].to_owned(),
            joint: joint.name.to_owned(),
            what,
        };
        let is_slide = match joint.kind {
            "prismatic" => true,
            "revolute" | "continuous" => false,
            kind => return Err(refused(kind.to_owned())),
        };
        if before == MOST_JOINTS {
            return Err(refused(format!("behind {MOST_JOINTS} others")));
        }
        let others = format!("a mimic behind {MOST_JOINTS} others");
        let mut range = range_of(joint, tree, MOST_JOINTS)?.ok_or_else(|| refused(others))?;
        // NaN where both are infinite.
        let way = range[1] - range[0];
        if is_slide && (way.is_nan() || way > MOST_REACH) {
            return Err(refused(format!("prismatic, with limits {way} m apart")));
        } else if !is_slide && (way.is_nan() || way > 2.0 * PI) {
            range = [-PI, PI];
        }
        Ok(Self { direction: joint.direction()?, is_slide, range })
    }

    /// Capsules in the frame of the joint that contain one wherever the joint is.
    fn pieces(&self, capsule: &Capsule, most: f64) -> Vec<Capsule> {
        let [a, b] = capsule.ends().map(Vector3::from);
        let (along, [lower, upper]) = (b - a, self.range);
        let way = upper - lower;
        let slid = self.direction * way;
        let is_across = self.is_slide && slid.norm() > along.norm();
        let off = |end: &Vector3<f64>| self.direction.cross(end).norm();
        let length = match (self.is_slide, is_across) {
            (false, _) => way * off(&a).max(off(&b)),
            (true, false) => way,
            (true, true) => along.norm(),
        };
        let count = (length / (2.0 * GROWTH.max(0.5 * capsule.radius()))).ceil().clamp(1.0, most);
        let radius = capsule.radius() + 0.5 * length / count;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 32")]
        let pieces = (0..count as u32).map(|piece| (f64::from(piece) + 0.5) / count);
        let made = pieces.map(|part| {
            let at = lower + part * way;
            let ends = if is_across {
                let start = a + along * part + self.direction * lower;
                [start, start + slid]
            } else if self.is_slide {
                [a, b].map(|end| end + self.direction * at)
            } else {
                let axis = Unit::new_unchecked(self.direction);
                [a, b].map(|end| Rotation3::from_axis_angle(&axis, at) * end)
            };
            Capsule::known(ends[0].into(), ends[1].into(), radius)
        });
        made.collect()
    }
}

/// Where a joint may be, infinite for everywhere: where its own limits allow, and where the joint
/// takes it that it follows, which may follow another; `None` if more than so many others do.
fn range_of(
    joint: &Joint<'_>,
    tree: &Tree<'_>,
    others: usize,
) -> Result<Option<[f64; 2]>, UrdfFault> {
    let [lower, upper] = joint.range()?;
    let mut range = [lower.min(upper), lower.max(upper)];
    let followed = tree.joint(joint.followed());
    if let (Some([multiplier, offset]), Some(followed)) = (joint.mimic_numbers()?, followed) {
        let Some(others) = others.checked_sub(1) else { return Ok(None) };
        let Some(ends) = range_of(followed, tree, others)? else { return Ok(None) };
        for end in ends {
            // Of an endless way a multiplier of zero leaves nothing.
            let end = if multiplier == 0.0 { offset } else { multiplier * end + offset };
            range = [range[0].min(end), range[1].max(end)];
        }
    }
    Ok(Some(range))
}
