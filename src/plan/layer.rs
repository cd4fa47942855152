//! The nodes of a plan at one pose: every tool angle on every branch, as columns of joint angles.

use alloc::vec;
use alloc::vec::Vec;

use crate::kinematics::Pose;
use crate::paths::Turn;

/// Where a node stands in its layer: a branch and a tool angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    pub(super) slot: usize,
    pub(super) bin: usize,
}

/// What all layers of a search have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    pub(super) slots: usize,
    /// Tool angles of a layer.
    pub(super) bins: usize,
    /// Their distance [rad].
    pub(super) step: f64,
    /// Whether the last one is next to the first.
    pub(super) cyclic: bool,
}

impl Grid {
    pub(super) fn number(&self, node: Node) -> usize {
        node.slot * self.bins + node.bin
    }

    pub(super) fn node(&self, number: usize) -> Node {
        Node { slot: number / self.bins, bin: number % self.bins }
    }

    /// Number of nodes of a layer.
    pub(super) fn len(&self) -> usize {
        self.slots * self.bins
    }
}

/// Two nodes of neighboring layers, by their numbers.
pub(super) type Edge = [usize; 2];

/// The nodes of one pose.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    pub(super) pose: Pose,
    /// When the tool is there [s].
    pub(super) time: f64,
    /// Index of the pose in the path; `None` of a pose that the search put between two.
    pub(super) index: Option<usize>,
    /// How often the way between two poses of the path was halved for this layer.
    pub(super) depth: u32,
    /// The angle of the first bin [rad].
    pub(super) base: f64,
    /// The one bin that is not where the grid has it, with its angle [rad]: that of a joint vector
    /// that is given.
    pub(super) own: Option<(usize, f64)>,
    /// Joint angles, each at its first turn [rad]: of each slot, of each joint, of each bin. NaN
    /// where no turn is inside the limits.
    pub(super) q: Vec<f64>,
    /// Whether each slot has a node.
    pub(super) present: Vec<bool>,
    /// Nodes that the caller accepted.
    pub(super) accepted: Vec<usize>,
    /// Nodes that the caller rejected.
    pub(super) rejected: Vec<usize>,
    /// How the orientation turns from the layer before; `None` of the first one.
    pub(super) turn: Option<Turn>,
    /// Edges from the layer before that lead from one branch to another, through a singularity.
    pub(super) crossings: Vec<Edge>,
    /// Edges from the layer before that are not continuous.
    pub(super) refused: Vec<Edge>,
    /// Whether every edge from the layer before was looked at.
    pub(super) is_examined: bool,
}

impl Layer {
    pub(super) fn new(pose: Pose, time: f64, index: Option<usize>, grid: &Grid) -> Self {
        Self {
            pose,
            time,
            index,
            depth: 0,
            base: 0.0,
            own: None,
            q: vec![f64::NAN; 6 * grid.len()],
            present: vec![false; grid.slots],
            accepted: Vec::new(),
            rejected: Vec::new(),
            turn: None,
            crossings: Vec::new(),
            refused: Vec::new(),
            is_examined: false,
        }
    }

    /// The joint angles of a node [rad]; `None` if it has none inside the limits.
    pub(super) fn joints(&self, grid: &Grid, node: Node) -> Option<[f64; 6]> {
        let start = node.slot * 6 * grid.bins + node.bin;
        let q: [f64; 6] = core::array::from_fn(|joint| self.q[start + joint * grid.bins]);
        (!q[0].is_nan()).then_some(q)
    }

    /// Put joint angles at a node; `None` takes it away.
    pub(super) fn put(&mut self, grid: &Grid, node: Node, q: Option<[f64; 6]>) {
        let start = node.slot * 6 * grid.bins + node.bin;
        for (joint, angle) in q.unwrap_or([f64::NAN; 6]).into_iter().enumerate() {
            self.q[start + joint * grid.bins] = angle;
        }
        self.present[node.slot] = match q {
            Some(_) => true,
            None => self.angles(grid, node.slot, 0).iter().any(|angle| !angle.is_nan()),
        };
    }

    /// The angles of a joint at the bins of a slot.
    pub(super) fn angles(&self, grid: &Grid, slot: usize, joint: usize) -> &[f64] {
        let start = (slot * 6 + joint) * grid.bins;
        &self.q[start..start + grid.bins]
    }

    /// The nodes, by branch, then by angle.
    pub(super) fn nodes<'a>(&'a self, grid: &'a Grid) -> impl Iterator<Item = (Node, [f64; 6])> {
        (0..grid.len()).filter_map(move |number| {
            let node = grid.node(number);
            if !self.present[node.slot] {
                return None;
            }
            self.joints(grid, node).map(|q| (node, q))
        })
    }

    /// The tool angle of a bin [rad].
    pub(super) fn tool_angle(&self, grid: &Grid, bin: usize) -> f64 {
        match self.own {
            Some((own, angle)) if own == bin => angle,
            #[expect(clippy::cast_precision_loss, reason = "small counts")]
            _ => self.base + bin as f64 * grid.step,
        }
    }
}
