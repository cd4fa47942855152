//! The ladder graph of a plan: at each pose a layer of nodes, every branch at every value of what
//! is free (docs/theory/plan.md, section 1).

use crate::error::Error;
use crate::paths::Turn;
use crate::plan::thresholds::MOST_FREE_AXES;
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::lanes::{Column, LANES};

/// A value of each free axis [m, rad]; 0 beyond the last axis.
pub(super) type Values = [f64; MOST_FREE_AXES];

/// For the edges into a layer: how many values below and above they come from, along each axis.
pub(super) type Window = [[usize; 2]; MOST_FREE_AXES];

/// Two nodes of neighboring layers, by their numbers.
pub(super) type Edge = [usize; 2];

/// Joint angles [rad], with the values of the free axes.
pub(super) type Posture = ([f64; 6], Values);

/// The cost of moving the free axes: a part of a velocity limit, and a square (eq. 4).
#[derive(Clone, Copy, Default)]
pub(super) struct Moved {
    pub(super) most: f64,
    pub(super) squares: f64,
}

/// A branch at values of the free axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    pub(super) slot: usize,
    pub(super) cell: usize,
}

/// The grid of all free axes, shared by all layers: a cell for each combination of values, the
/// last axis changing first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    pub(super) slots: usize,
    /// Slots of a cell, filled up to whole lanes.
    pub(super) width: usize,
    pub(super) cells: usize,
    /// Number of values of each axis.
    pub(super) counts: [usize; MOST_FREE_AXES],
    /// Distance of the values of each axis [m, rad].
    pub(super) steps: Values,
    /// Whether the last value of an axis is next to the first.
    cyclic: [bool; MOST_FREE_AXES],
}

impl Grid {
    pub(super) fn new(
        slots: usize,
        counts: [usize; MOST_FREE_AXES],
        steps: Values,
        cyclic: [bool; MOST_FREE_AXES],
    ) -> Self {
        let (width, cells) = (slots.next_multiple_of(LANES), counts.iter().product());
        Self { slots, width, cells, counts, steps, cyclic }
    }

    /// Count the numbers of nodes of a layer, those that fill up lanes included.
    pub(super) fn len(&self) -> usize {
        self.cells * self.width
    }

    pub(super) fn number(&self, node: Node) -> usize {
        node.cell * self.width + node.slot
    }

    pub(super) fn node(&self, number: usize) -> Node {
        Node { slot: number % self.width, cell: number / self.width }
    }

    /// The number of the value of each axis in a cell.
    pub(super) fn numbers(&self, mut cell: usize) -> [usize; MOST_FREE_AXES] {
        let mut numbers = [0; MOST_FREE_AXES];
        for axis in (0..MOST_FREE_AXES).rev().filter(|axis| self.counts[*axis] > 1) {
            numbers[axis] = cell % self.counts[axis];
            cell /= self.counts[axis];
        }
        numbers
    }

    /// The cell with a value of each axis.
    pub(super) fn cell(&self, numbers: [usize; MOST_FREE_AXES]) -> usize {
        numbers.iter().zip(self.counts).fold(0, |cell, (number, count)| cell * count + number)
    }

    /// The values in a cell [m, rad], from the values of the first cell.
    pub(super) fn values(&self, first: &Values, cell: usize) -> Values {
        if self.cells == 1 {
            return *first;
        }
        let numbers = self.numbers(cell);
        #[expect(clippy::cast_precision_loss, reason = "small counts")]
        core::array::from_fn(|axis| first[axis] + numbers[axis] as f64 * self.steps[axis])
    }

    pub(super) fn around(&self, cell: usize, window: &Window) -> Around {
        let (mut first, mut sizes) = (self.numbers(cell), [1; MOST_FREE_AXES]);
        let (mut last, mut left) = (0, 1);
        for axis in (0..MOST_FREE_AXES).filter(|axis| self.counts[*axis] > 1) {
            let ([below, above], own, count) = (window[axis], first[axis], self.counts[axis]);
            if self.cyclic[axis] {
                first[axis] = (own + count - below % count) % count;
                sizes[axis] = (below + above + 1).min(count);
            } else {
                first[axis] = own.saturating_sub(below);
                sizes[axis] = (own + above).min(count - 1) - first[axis] + 1;
            }
            left *= sizes[axis];
            last = if sizes[axis] > 1 { axis } else { last };
        }
        let (at, counts, cell) = ([0; MOST_FREE_AXES], self.counts, self.cell(first));
        Around { sizes, at, first, counts, last, cell, left }
    }

    /// The largest number of steps along an axis from one cell to another.
    pub(super) fn apart(&self, [one, other]: [usize; 2]) -> usize {
        let [one, other] = [one, other].map(|cell| self.numbers(cell));
        let each = (0..MOST_FREE_AXES).map(|axis| {
            let apart = one[axis].abs_diff(other[axis]);
            if self.cyclic[axis] { apart.min(self.counts[axis] - apart) } else { apart }
        });
        each.max().unwrap_or_default()
    }

    pub(super) fn full_window(&self) -> Window {
        core::array::from_fn(|axis| {
            let others = self.counts[axis] - 1;
            if self.cyclic[axis] { [others / 2, others.div_ceil(2)] } else { [others; 2] }
        })
    }

    /// All cells, nearest to `start` first, each but that with a neighbor nearer to it.
    pub(super) fn outward(&self, start: usize) -> Vec<(usize, Option<usize>)> {
        let center = self.numbers(start);
        let mut cells: Vec<_> = (0..self.cells)
            .map(|cell| {
                let mut numbers = self.numbers(cell);
                let apart: usize =
                    numbers.iter().zip(center).map(|(own, at)| own.abs_diff(at)).sum();
                let differs =
                    (0..MOST_FREE_AXES).rev().find(|axis| numbers[*axis] != center[*axis]);
                let beside = differs.map(|axis| {
                    let is_above = numbers[axis] > center[axis];
                    numbers[axis] = if is_above { numbers[axis] - 1 } else { numbers[axis] + 1 };
                    self.cell(numbers)
                });
                (apart, cell, beside)
            })
            .collect();
        cells.sort_unstable_by_key(|(apart, cell, _)| (*apart, *cell));
        cells.into_iter().map(|(_, cell, beside)| (cell, beside)).collect()
    }
}

/// The cells of a window, one after the other.
pub(super) struct Around {
    /// Of each axis: how many values the window has, which of them is next, and the first.
    sizes: [usize; MOST_FREE_AXES],
    at: [usize; MOST_FREE_AXES],
    first: [usize; MOST_FREE_AXES],
    /// Of each axis of the grid.
    counts: [usize; MOST_FREE_AXES],
    /// The last axis along which the window has several values.
    last: usize,
    /// The next cell, and how many are left.
    cell: usize,
    left: usize,
}

impl Iterator for Around {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        self.left = self.left.checked_sub(1)?;
        let cell = self.cell;
        let mut stride = self.counts[self.last + 1..].iter().product::<usize>();
        for axis in (0..=self.last).rev() {
            let (first, count) = (self.first[axis], self.counts[axis]);
            let wrapped =
                |at: usize| if first + at < count { first + at } else { first + at - count };
            let before = wrapped(self.at[axis]);
            self.at[axis] =
                if self.at[axis] + 1 < self.sizes[axis] { self.at[axis] + 1 } else { 0 };
            self.cell = self.cell + stride * wrapped(self.at[axis]) - stride * before;
            if self.at[axis] > 0 {
                break;
            }
            stride *= count;
        }
        Some(cell)
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

/// The turn of the orientation to each pose of a path from the pose before.
pub(super) fn turns(path: &[Waypoint]) -> Result<Vec<Option<Turn>>, Error> {
    let before = core::iter::once(None).chain(path.iter().map(Some));
    let turn = |(point, before): (&Waypoint, Option<&Waypoint>)| {
        let before = before.map(|before| &before.pose.rotation);
        before.map(|from| Turn::new(from, &point.pose.rotation, None, point.index)).transpose()
    };
    path.iter().zip(before).map(turn).collect()
}

/// The cell of a joint vector that is given, and the values of the free axes there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Own {
    pub(super) cell: usize,
    pub(super) values: Values,
}

/// The nodes of one pose.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    pub(super) pose: Pose,
    /// When the tool is there [s].
    pub(super) time: f64,
    /// Index of the pose in the path; `None` of a pose that the search put between two.
    pub(super) index: Option<usize>,
    /// How often the step between two poses of the path was halved for this layer.
    pub(super) depth: u32,
    /// The values of the first cell [m, rad].
    pub(super) first: Values,
    /// The one cell with values of its own, not on the grid: of a joint vector that is given.
    pub(super) own: Option<Own>,
    /// Joint angles, each at its first turn [rad]: of each joint, in lanes of slots. NaN where no
    /// turn is inside the limits.
    pub(super) q: Vec<[Column; 6]>,
    pub(super) accepted: Vec<usize>,
    /// Nodes that the caller rejected, as edges from themselves, and edges whose motion from the
    /// pose before does not pass its test: each with these joint angles [rad] and free axes.
    pub(super) failed: Vec<(Edge, Vec<Posture>)>,
    /// How the orientation turns from the layer before; `None` of the first one.
    pub(super) turn: Option<Turn>,
    /// Edges from the layer before that lead from one branch to another, through a singularity.
    pub(super) crossings: Vec<Edge>,
    /// Edges from the layer before that are not continuous.
    pub(super) refused: Vec<Edge>,
    /// Steps from the layer before, by their joint angles, that were shown to be continuous.
    pub(super) proven: Vec<[[f64; 6]; 2]>,
    /// Edges from the layer before with a larger bottleneck are not continuous; negative where the
    /// work was used up before that was known.
    pub(super) cap: f64,
    /// Whether every edge from the layer before was examined.
    pub(super) is_examined: bool,
}

impl Layer {
    pub(super) fn new(pose: Pose, time: f64, index: Option<usize>, grid: &Grid) -> Self {
        Self {
            pose,
            time,
            index,
            depth: 0,
            first: Values::default(),
            own: None,
            q: vec![[[f64::NAN; LANES]; 6]; grid.len() / LANES],
            accepted: Vec::new(),
            failed: Vec::new(),
            turn: None,
            crossings: Vec::new(),
            refused: Vec::new(),
            proven: Vec::new(),
            cap: f64::INFINITY,
            is_examined: false,
        }
    }

    /// The joint angles of a node [rad]; `None` if it has none inside the limits.
    pub(super) fn joints(&self, grid: &Grid, node: Node) -> Option<[f64; 6]> {
        let number = grid.number(node);
        let (columns, lane) = (&self.q[number / LANES], number % LANES);
        (!columns[0][lane].is_nan()).then(|| core::array::from_fn(|joint| columns[joint][lane]))
    }

    /// Put joint angles at a node; `None` takes it away.
    pub(super) fn put(&mut self, grid: &Grid, node: Node, q: Option<[f64; 6]>) {
        let number = grid.number(node);
        for (column, angle) in self.q[number / LANES].iter_mut().zip(q.unwrap_or([f64::NAN; 6])) {
            column[number % LANES] = angle;
        }
    }

    /// The nodes, by cell, then by branch.
    pub(super) fn nodes<'a>(&'a self, grid: &'a Grid) -> impl Iterator<Item = (Node, [f64; 6])> {
        (0..grid.len()).filter_map(move |number| {
            let node = grid.node(number);
            self.joints(grid, node).map(|q| (node, q))
        })
    }

    /// The nodes of a branch.
    pub(super) fn of_slot(&self, grid: &Grid, slot: usize) -> Vec<(Node, [f64; 6])> {
        let nodes = (0..grid.cells).map(|cell| Node { slot, cell });
        nodes.filter_map(|node| Some((node, self.joints(grid, node)?))).collect()
    }

    /// The values of the free axes in a cell [m, rad].
    pub(super) fn values(&self, grid: &Grid, cell: usize) -> Values {
        match self.own {
            Some(own) if own.cell == cell => own.values,
            _ => grid.values(&self.first, cell),
        }
    }
}
