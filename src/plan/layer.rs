//! The nodes of a plan at one pose: every tool angle on every branch, as columns of joint angles.

use alloc::vec;
use alloc::vec::Vec;

use super::freedom::Values;
use super::stations::Stations;
use crate::error::Error;
use crate::kinematics::Pose;
use crate::paths::Turn;

/// Where a node stands in its layer: a branch, the values of the free axes, and a tool angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    pub(super) slot: usize,
    pub(super) station: usize,
    pub(super) bin: usize,
}

/// What all layers of a search have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    pub(super) slots: usize,
    /// Values of the free axes.
    pub(super) stations: Stations,
    /// Tool angles of a layer.
    pub(super) bins: usize,
    /// Their distance [rad].
    pub(super) step: f64,
    /// Whether the last one is next to the first.
    pub(super) cyclic: bool,
}

impl Grid {
    pub(super) fn number(&self, node: Node) -> usize {
        self.row(node.slot, node.station) * self.bins + node.bin
    }

    pub(super) fn node(&self, number: usize) -> Node {
        let (row, bin) = (number / self.bins, number % self.bins);
        Node { slot: row / self.stations.len(), station: row % self.stations.len(), bin }
    }

    /// The row of the tool angles of a branch, at values of the free axes.
    pub(super) fn row(&self, slot: usize, station: usize) -> usize {
        slot * self.stations.len() + station
    }

    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.slots * self.stations.len()
    }

    /// Number of nodes of a layer.
    pub(super) fn len(&self) -> usize {
        self.rows() * self.bins
    }

    /// The bin that an offset of a window leads to, which reaches so far below a bin.
    pub(super) fn bin_at(&self, bin: usize, offset: usize, below: usize) -> Option<usize> {
        if self.cyclic {
            return Some((bin + offset + self.bins - below % self.bins) % self.bins);
        }
        (bin + offset).checked_sub(below).filter(|bin| *bin < self.bins)
    }

    /// How many bins two are apart.
    pub(super) fn apart(&self, one: usize, other: usize) -> usize {
        let apart = one.abs_diff(other);
        if self.cyclic { apart.min(self.bins - apart) } else { apart }
    }
}

/// A pose of a path that is searched.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waypoint {
    pub(super) index: usize,
    pub(super) pose: Pose,
    /// When the tool is there [s].
    pub(super) time: f64,
}

/// How the orientation turns to each pose of a path from the one before.
pub(super) fn turns(path: &[Waypoint]) -> Result<Vec<Option<Turn>>, Error> {
    let before = core::iter::once(None).chain(path.iter().map(Some));
    let turn = |(point, before): (&Waypoint, Option<&Waypoint>)| {
        let before = before.map(|before| &before.pose.rotation);
        before.map(|from| Turn::new(from, &point.pose.rotation, None, point.index)).transpose()
    };
    path.iter().zip(before).map(turn).collect()
}

/// Where a joint vector that is given stands, and what is free there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Own {
    pub(super) station: usize,
    pub(super) bin: usize,
    pub(super) angle: f64,
    pub(super) values: Values,
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
    /// The values of the first station [m, rad].
    pub(super) bases: Values,
    /// The one node that is not where the grid has it: that of a joint vector that is given.
    pub(super) own: Option<Own>,
    /// Joint angles, each at its first turn [rad]: of each joint, of each node. NaN where no turn is
    /// inside the limits.
    pub(super) q: Vec<f64>,
    /// Whether each row has a node.
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
    /// Edges from the layer before with a larger bottleneck are not continuous.
    pub(super) cap: f64,
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
            bases: Values::default(),
            own: None,
            q: vec![f64::NAN; 6 * grid.len()],
            present: vec![false; grid.rows()],
            accepted: Vec::new(),
            rejected: Vec::new(),
            turn: None,
            crossings: Vec::new(),
            refused: Vec::new(),
            cap: f64::INFINITY,
            is_examined: false,
        }
    }

    /// The joint angles of a node [rad]; `None` if it has none inside the limits.
    pub(super) fn joints(&self, grid: &Grid, node: Node) -> Option<[f64; 6]> {
        let number = grid.number(node);
        let q: [f64; 6] = core::array::from_fn(|joint| self.q[joint * grid.len() + number]);
        (!q[0].is_nan()).then_some(q)
    }

    /// Put joint angles at a node; `None` takes it away.
    pub(super) fn put(&mut self, grid: &Grid, node: Node, q: Option<[f64; 6]>) {
        let (row, number) = (grid.row(node.slot, node.station), grid.number(node));
        for (joint, angle) in q.unwrap_or([f64::NAN; 6]).into_iter().enumerate() {
            self.q[joint * grid.len() + number] = angle;
        }
        self.present[row] = match q {
            Some(_) => true,
            None => self.angles(grid, row, 0).iter().any(|angle| !angle.is_nan()),
        };
    }

    /// The angles of a joint at the bins of a row.
    pub(super) fn angles(&self, grid: &Grid, row: usize, joint: usize) -> &[f64] {
        let start = row * grid.bins;
        &self.column(grid, joint)[start..start + grid.bins]
    }

    /// The angles of a joint at all nodes.
    pub(super) fn column(&self, grid: &Grid, joint: usize) -> &[f64] {
        &self.q[joint * grid.len()..(joint + 1) * grid.len()]
    }

    /// The nodes, by branch, then by the values of the free axes, then by tool angle.
    pub(super) fn nodes<'a>(&'a self, grid: &'a Grid) -> impl Iterator<Item = (Node, [f64; 6])> {
        let rows = (0..grid.rows()).filter(|row| self.present[*row]);
        rows.flat_map(move |row| {
            (0..grid.bins).filter_map(move |bin| {
                let node = grid.node(row * grid.bins + bin);
                self.joints(grid, node).map(|q| (node, q))
            })
        })
    }

    /// Whether a branch has a node.
    pub(super) fn has_slot(&self, grid: &Grid, slot: usize) -> bool {
        let count = grid.stations.len();
        self.present[slot * count..(slot + 1) * count].iter().any(|present| *present)
    }

    /// The tool angle of a bin [rad].
    pub(super) fn tool_angle(&self, grid: &Grid, bin: usize) -> f64 {
        match self.own {
            Some(own) if own.bin == bin => own.angle,
            #[expect(clippy::cast_precision_loss, reason = "small counts")]
            _ => self.base + bin as f64 * grid.step,
        }
    }

    /// The values of the free axes at a station [m, rad].
    pub(super) fn values(&self, grid: &Grid, station: usize) -> Values {
        match self.own {
            Some(own) if own.station == station => own.values,
            _ => grid.stations.values(&self.bases, station),
        }
    }
}
