//! The layers of a path as a graph to search, and how far apart what is free at two neighboring
//! poses needs to be searched (docs/theory/plan.md, eq. 7).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::axes::Carried;
use super::freedom::{FreeAxis, Freedom, Motion};
use super::graph::{Grid, Layer, Moved, Node, Window};
use super::joints::{NodeCost, PlannedJoints};
use super::lanes::Rates;
use super::options::PlanOrder;
use irbkin::Interrupt;
use irbkin::internal::lanes::whole_below;

/// Part of a step by which rounding may shorten a window [1].
const ROUNDING: f64 = 1e-6;

/// The conditions at the ends of a joint path.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ends {
    /// The turns of the joints at the first and at the last pose of the path, where they are given.
    pub(super) first: Option<[i32; 6]>,
    pub(super) last: Option<[i32; 6]>,
    /// Whether a joint path to the last layer ends with the joint angles that it begins with.
    pub(super) closed: bool,
}

/// Layers, with everything that a search through them needs.
#[derive(Clone, Copy)]
pub(super) struct Ladder<'a> {
    pub(super) grid: Grid,
    pub(super) joints: &'a PlannedJoints,
    pub(super) freedom: &'a Freedom,
    pub(super) layers: &'a [Layer],
    /// The part of the velocity limits that no joint may exceed.
    pub(super) speed: f64,
    /// An estimate of the cost that comes first.
    pub(super) expected: Option<f64>,
    pub(super) ends: Ends,
    /// Whether only joint paths through all layers count.
    pub(super) whole: bool,
    pub(super) order: PlanOrder,
    pub(super) node_cost: Option<NodeCost<'a>>,
    pub(super) interrupt: Interrupt<'a>,
}

/// The largest cost of an edge.
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

/// How far the tool may turn, times a factor, if each joint and each external axis moves as far as
/// it may.
#[derive(Clone)]
pub(super) struct Farthest {
    most: Most,
    /// How far it may turn [rad].
    turn: f64,
}

impl Ladder<'_> {
    pub(super) fn time(&self, layer: usize) -> f64 {
        self.layers[layer].time - self.layers[layer - 1].time
    }

    pub(super) fn rates(&self, layer: usize) -> Rates {
        Rates::of(self.joints, self.time(layer))
    }

    /// The cost of moving the free axes from a cell to one of the next layer.
    #[inline]
    pub(super) fn moved(&self, layer: usize, [from, to]: [usize; 2]) -> Moved {
        if self.freedom.external == 0 {
            return Moved::default();
        }
        let before = self.layers[layer - 1].values(&self.grid, from);
        let values = self.layers[layer].values(&self.grid, to);
        self.freedom.moved(self.time(layer), &before, &values)
    }

    pub(super) fn bottleneck(&self, layer: usize, [from, to]: [Node; 2]) -> f64 {
        let q_before = self.layers[layer - 1].joints(&self.grid, from).unwrap_or_default();
        let q = self.layers[layer].joints(&self.grid, to).unwrap_or_default();
        let moved = self.moved(layer, [from.cell, to.cell]);
        self.rates(layer).cost(&self.joints.steps(&q_before, &q), moved).0
    }

    /// The largest bottleneck of the edges along nodes.
    pub(super) fn bottleneck_along(&self, nodes: &[Node], from: usize) -> f64 {
        let edges = nodes.windows(2).enumerate();
        let each = edges.map(|(step, two)| self.bottleneck(from + step + 1, [two[0], two[1]]));
        each.fold(0.0, f64::max)
    }

    pub(super) fn farthest(&self, most: Most) -> Farthest {
        let axes = || self.freedom.axes.iter();
        let of_axis = |axis: &FreeAxis| most.of_axis(axis.velocity, axis.weight);
        let each = self.joints.velocity.iter().zip(&self.joints.weights);
        let joints = most.of_axes(each.map(|(velocity, weight)| most.of_axis(*velocity, *weight)));
        let turns = |is_one: fn(&Carried) -> bool| -> f64 {
            let turning = axes()
                .filter(|axis| matches!(axis.motion, Motion::Carrier(carried) if is_one(&carried)));
            turning.map(of_axis).sum()
        };
        let by_tool = turns(|carried| matches!(carried, Carried::Tool(..)));
        let by_positioners =
            turns(|carried| matches!(carried, Carried::Object(..) | Carried::Arm(..)));
        Farthest { most, turn: joints + by_tool + by_positioners }
    }

    /// The window into a layer outside of which every edge costs more (eq. 7).
    pub(super) fn window(&self, layer: usize, farthest: &Farthest) -> Window {
        let (before, layer) = (&self.layers[layer - 1], &self.layers[layer]);
        let (most, cone) = (farthest.most, self.freedom.cone);
        let factor = most.factor(layer.time - before.time);
        let mut window = self.grid.full_window();
        let turned = layer.turn.map_or(0.0, |turn| turn.angle) + factor * farthest.turn;
        // The values of a joint vector that is given are next to its cell's.
        let has_own = before.own.or(layer.own).is_some();
        for (number, axis) in self.freedom.axes.iter().enumerate() {
            let distance = match axis.motion {
                Motion::Carrier(_) => factor * most.of_axis(axis.velocity, axis.weight),
                // How much faster the two angles of a tilted tool are than its direction.
                Motion::Tilt(_) => turned * cone / cone.sin(),
                // How much faster the twist of a tilted tool is than the tool.
                Motion::Rotation(_) => turned / (0.5 * cone).cos(),
            };
            let step = self.grid.steps[number];
            let distance = distance + if has_own { step } else { 0.0 };
            let shift = axis.difference(layer.first[number], before.first[number]);
            let full = window[number];
            window[number] =
                [count(distance + shift, step, full[0]), count(distance - shift, step, full[1])];
        }
        window
    }
}

/// How many steps a distance has, at most `full`.
fn count(distance: f64, step: f64, full: usize) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "at most the number of values; NaN of a single one is 0"
    )]
    let count = whole_below(distance / step + ROUNDING).clamp(0.0, full as f64) as usize;
    count
}
