//! How far apart what is free at two neighboring poses needs to be looked at (docs/plan.md, eq. 7).

use alloc::vec::Vec;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::Vector3;

use super::carrier::Carried;
use super::field::Field;
use super::freedom::{FreeAxis, Motion};
use super::layer::Layer;
use super::search::Window;
use super::stations::Reach;
use crate::kinematics::thresholds::MOST_FREE_AXES;
use crate::lanes::whole_below;

/// Part of a step by which rounding may shorten a window [1].
const ROUNDING: f64 = 1e-6;

impl Window {
    /// The window with another size to each side.
    pub(super) fn each(self, size: impl Fn(usize) -> usize) -> Self {
        self.with(&self, |own, _| size(own))
    }

    /// The window with sizes of two.
    pub(super) fn with(self, other: &Self, size: impl Fn(usize, usize) -> usize) -> Self {
        let narrow = |size: usize| u16::try_from(size).unwrap_or(u16::MAX);
        Self {
            bins: [0, 1].map(|side| size(self.bins[side], other.bins[side])),
            stations: core::array::from_fn(|axis| {
                [0, 1].map(|side| {
                    let [own, other] = [self, *other].map(|window| window.stations[axis][side]);
                    narrow(size(usize::from(own), usize::from(other)))
                })
            }),
        }
    }
}

/// What an edge may cost at most.
#[derive(Clone, Copy)]
pub(super) enum Most {
    Bottleneck(f64),
    Sum(f64),
}

impl Most {
    /// The factor of [`Farthest`] for a step that takes `time` [s].
    fn factor(self, time: f64) -> f64 {
        match self {
            Self::Bottleneck(most) => most * time,
            Self::Sum(most) => most.sqrt(),
        }
    }

    /// How far an axis may move for a factor of 1 [m, rad].
    fn of_axis(self, velocity: f64, weight: f64) -> f64 {
        match self {
            Self::Bottleneck(_) => velocity,
            // An axis that costs nothing may move as far as it likes.
            Self::Sum(_) => 1.0 / weight.max(f64::MIN_POSITIVE).sqrt(),
        }
    }

    /// How far axes may move together.
    fn of_axes(self, each: impl Iterator<Item = f64>) -> f64 {
        match self {
            Self::Bottleneck(_) => each.sum(),
            // By Cauchy and Schwarz.
            Self::Sum(_) => each.map(|own| own * own).sum::<f64>().sqrt(),
        }
    }
}

/// How far the tool may come, times a factor, if each joint and each external axis does what it
/// may.
struct Farthest {
    most: Most,
    /// How far it may turn [rad].
    turn: f64,
    /// How far it may move [m], by joints and tracks.
    shift: f64,
    /// How far positioners may turn, with the points they turn about.
    positioners: Vec<(Vector3<f64>, f64)>,
}

impl Field<'_> {
    /// A window of everything.
    pub(super) fn full_window(&self) -> Window {
        let bins = self.grid.bins;
        let bins = if self.grid.cyclic { [(bins - 1) / 2, bins / 2] } else { [bins - 1; 2] };
        Window { bins, stations: self.grid.stations.full_reach() }
    }

    /// Windows outside of which every edge costs more than `most` (eq. 7).
    pub(super) fn windows(&self, most: Most) -> Vec<Window> {
        let farthest = self.farthest(most);
        // The first one has nothing before it.
        let before = self.layers.iter().take(1).chain(self.layers);
        self.layers
            .iter()
            .zip(before)
            .map(|(layer, before)| self.window(before, layer, &farthest))
            .collect()
    }

    fn farthest(&self, most: Most) -> Farthest {
        let axes = || self.freedom.axes.iter();
        let of_axis = |axis: &FreeAxis| most.of_axis(axis.velocity, axis.weight);
        let each = self.joints.velocity.iter().zip(&self.joints.weights);
        let joints = most.of_axes(each.map(|(velocity, weight)| most.of_axis(*velocity, *weight)));
        let positioners: Vec<_> = axes()
            .filter_map(|axis| match axis.motion {
                Motion::Carrier(Carried::Object(_, point)) => Some((point, of_axis(axis))),
                _ => None,
            })
            .collect();
        let tracks: f64 = axes()
            .filter(|axis| matches!(axis.motion, Motion::Carrier(Carried::Robot(_))))
            .map(of_axis)
            .sum();
        Farthest {
            most,
            turn: joints + positioners.iter().map(|(_, turn)| turn).sum::<f64>(),
            shift: joints * self.joints.reach + tracks,
            positioners,
        }
    }

    fn window(&self, before: &Layer, layer: &Layer, farthest: &Farthest) -> Window {
        let most = farthest.most;
        let factor = most.factor(layer.time - before.time);
        let turn = layer.turn.map_or(0.0, |turn| turn.angle);
        let has_own = before.own.or(layer.own).is_some();
        let full = self.full_window();
        // The place of a joint vector that is given is next to that of its node.
        let beside = |step: f64| if has_own { step } else { 0.0 };
        let sides = |distance: f64, shift: f64, step: f64, full: [usize; 2]| {
            let size = |distance: f64, full: usize| {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    clippy::cast_precision_loss,
                    reason = "at most the number of values; NaN of a single one is 0"
                )]
                let size = whole_below(distance / step + ROUNDING).clamp(0.0, full as f64) as usize;
                size
            };
            let distance = distance + beside(step);
            [size(distance + shift, full[0]), size(distance - shift, full[1])]
        };
        let turned = turn + factor * farthest.turn;
        // How much faster the twist of a tilted tool is than the tool.
        let twisted = turned / (0.5 * self.freedom.cone).cos();
        let shift = self.freedom.angle_step(layer.base, before.base);
        let bins = sides(twisted, shift, self.grid.step, full.bins);
        let mut stations: Reach = [[0; 2]; MOST_FREE_AXES];
        for (number, axis) in self.freedom.axes.iter().enumerate() {
            let distance = match axis.motion {
                Motion::Carrier(_) => factor * most.of_axis(axis.velocity, axis.weight),
                // How much faster its two angles are than its direction.
                Motion::Tilt(_) => turned * self.freedom.cone / self.freedom.cone.sin(),
                Motion::Offset(_) => shifted(before, layer, factor, farthest),
            };
            let shift = before.bases[number] - layer.bases[number];
            let step = self.grid.stations.steps[number];
            let full = full.stations[number].map(usize::from);
            let own = sides(distance, shift, step, full);
            stations[number] = own.map(|size| u16::try_from(size).unwrap_or(u16::MAX));
        }
        Window { bins, stations }
    }
}

/// How far the tool may move relative to the path [m].
fn shifted(before: &Layer, layer: &Layer, factor: f64, farthest: &Farthest) -> f64 {
    let [from, to] = [before, layer].map(|layer| layer.pose.translation.vector);
    let about =
        |(point, turn): &(Vector3<f64>, f64)| turn * (from - point).norm().max((to - point).norm());
    let positioners: f64 = farthest.positioners.iter().map(about).sum();
    (to - from).norm() + factor * (farthest.shift + positioners)
}
