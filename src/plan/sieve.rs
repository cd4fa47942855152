//! Whether the whole grid of a long path may have a better way than one that is known: a bound
//! along some of its poses (docs/plan.md, eq. 9, 10).

use alloc::vec;
use alloc::vec::Vec;

use super::ends::Given;
use super::field::{Ends, Field};
use super::guide::{FINER_STRIDE, first_stride};
use super::layer::{Grid, Layer, Waypoint};
use super::nodes::{Arm, SPECIAL};
use super::options::PlanOrder;
use super::search::Window;
use super::window::Most;
use crate::error::Error;
use crate::kinematics::{Status, nearest_turn, pose_to_rows};

/// One of so many pairs of cells that a search looks at is looked at here; then it is given up.
const WORTH: usize = 4;

/// By how much rounding may lengthen the way of a joint, relative to it [1] and beyond that [rad].
const ROUNDING: f64 = 1e-9;

/// What is free at a pose, with the joint angles of all branches there.
#[derive(Clone, Default)]
struct Cell {
    /// Joint angles that a way may reach [rad].
    branches: Vec<[f64; 6]>,
    /// Whether a way may reach any others: at a singularity they depend on the layers beside.
    any: bool,
}

impl Cell {
    fn is_reached(&self) -> bool {
        self.any || !self.branches.is_empty()
    }
}

/// A path that is looked at with longer and longer strides left out.
struct Sieve<'a> {
    arm: Arm<'a>,
    grid: Grid,
    /// Without nodes.
    layers: Vec<Layer>,
    /// The joint angles that are given for the first and for the last layer.
    given: &'a [Option<Given>; 2],
    /// The windows of all edges of a way with a bottleneck of at most `most` (eq. 7).
    windows: Vec<Window>,
    most: f64,
    /// How many more pairs of cells may be looked at.
    left: usize,
}

/// Whether a way through the whole grid may have a bottleneck of at most `most`.
pub(super) fn may_be_passed(
    arm: Arm<'_>,
    points: &[Waypoint],
    given: &[Option<Given>; 2],
    most: f64,
) -> Result<bool, Error> {
    let grid = arm.grid();
    let mut layers = arm.layers(&Grid { slots: 0, ..grid }, points)?;
    let last = layers.len() - 1;
    for (layer, given) in [0, last].into_iter().zip(given) {
        layers[layer].own = given.map(|given| given.own);
    }
    let left = layers.len() * grid.stations.len() * grid.bins / WORTH;
    let mut sieve = Sieve { arm, grid, layers, given, windows: Vec::new(), most, left };
    sieve.windows = sieve.field().windows(Most::Bottleneck(most));
    let mut stride = first_stride(points.len());
    while stride > 1 {
        if !sieve.is_passed(stride) {
            return Ok(false);
        }
        stride /= FINER_STRIDE;
    }
    Ok(true)
}

impl Sieve<'_> {
    fn field(&self) -> Field<'_> {
        Field {
            grid: self.grid,
            joints: self.arm.joints,
            freedom: self.arm.freedom,
            layers: &self.layers,
            speed: self.most,
            expected: None,
            ends: Ends::default(),
            whole: true,
            order: PlanOrder::Bottleneck,
            soft: None,
            watch: self.arm.watch,
        }
    }

    /// Whether nothing shows that no way passes, of every so many layers and the last one.
    fn is_passed(&mut self, stride: usize) -> bool {
        let last = self.layers.len() - 1;
        let all: Vec<usize> = (0..self.grid.stations.len() * self.grid.bins).collect();
        let mut cells = self.cells(0, &all);
        let mut layer = 0;
        while layer < last && self.left > 0 && self.arm.watch.goes_on() {
            let next = (layer + stride).min(last);
            cells = self.next(&cells, [layer, next]);
            if !cells.iter().any(Cell::is_reached) {
                return false;
            }
            layer = next;
        }
        true
    }

    /// The cells of a layer that a way may reach from those of one before it.
    fn next(&mut self, before: &[Cell], [layer, next]: [usize; 2]) -> Vec<Cell> {
        let window = self.window([layer, next]);
        let (mut numbers, mut sources) = (Vec::new(), Vec::new());
        for number in 0..before.len() {
            let own: Vec<&Cell> = self.around(number, window).map(|from| &before[from]).collect();
            let own: Vec<&Cell> = own.into_iter().filter(|cell| cell.is_reached()).collect();
            if !own.is_empty() {
                self.left = self.left.saturating_sub(own.len());
                numbers.push(number);
                sources.push(own);
            }
            if self.left == 0 {
                return before.to_vec();
            }
        }
        let time = self.layers[next].time - self.layers[layer].time;
        let bounds = self.arm.joints.velocity.map(|velocity| {
            let way = self.most * velocity * time;
            way * (1.0 + ROUNDING) + ROUNDING
        });
        let mut cells = self.cells(next, &numbers);
        for (number, sources) in numbers.into_iter().zip(sources) {
            let is_near = |q: &[f64; 6]| {
                let mut all = sources.iter().flat_map(|from| &from.branches);
                all.any(|from| self.is_within(from, q, &bounds))
            };
            if sources.iter().all(|from| !from.any) {
                cells[number].branches.retain(is_near);
            }
        }
        cells
    }

    /// Cells of a layer, with all joint angles there; the others without any.
    fn cells(&self, layer: usize, numbers: &[usize]) -> Vec<Cell> {
        let (grid, at, freedom) = (&self.grid, &self.layers[layer], self.arm.freedom);
        let mut cells = vec![Cell::default(); grid.stations.len() * grid.bins];
        let first = self.given[0].filter(|_| layer == 0);
        let last = self.given[1].filter(|_| layer + 1 == self.layers.len());
        if let Some(given) = first.or(last) {
            let number = given.own.station * grid.bins + given.own.bin;
            cells[number].branches.extend(numbers.contains(&number).then_some(given.q));
            return cells;
        }
        let values = |number: usize| at.values(grid, number / grid.bins);
        let mut allowed = numbers.to_vec();
        allowed.retain(|number| freedom.allows(&values(*number)));
        let pose = |number: &usize| {
            let angle = at.tool_angle(grid, number % grid.bins);
            pose_to_rows(&freedom.tool(&at.pose, &values(*number), angle))
        };
        let poses: Vec<_> = allowed.iter().map(pose).collect();
        let mut q = vec![0.0; poses.len() * grid.slots * 6];
        let mut status = vec![0; poses.len() * grid.slots];
        self.arm.solve_part(&poses, &mut q, &mut status);
        let rows = q.as_chunks::<6>().0.chunks(grid.slots).zip(status.chunks(grid.slots));
        for (number, (q, status)) in allowed.into_iter().zip(rows) {
            let inside = |status: &u8| status & Status::WITHIN_LIMITS.bits() != 0;
            let all = q.iter().zip(status).filter(|(_, status)| inside(status));
            cells[number].branches.extend(all.map(|(q, _)| *q));
            cells[number].any = status.iter().any(|status| status & SPECIAL.bits() != 0);
        }
        cells
    }

    /// How far a way may go from a layer to a later one: as far as all its edges together (eq. 10).
    fn window(&self, [layer, next]: [usize; 2]) -> Window {
        let field = self.field();
        let all = self.windows[layer + 1..=next].iter();
        let sum = all.fold(Window::default(), |sum, own| sum.with(own, |sum, own| sum + own));
        sum.with(&field.full_window(), usize::min)
    }

    /// The cells from which a way may come to one.
    fn around(&self, number: usize, window: Window) -> impl Iterator<Item = usize> {
        let grid = self.grid;
        let (station, bin) = (number / grid.bins, number % grid.bins);
        let [below, above] = window.bins;
        grid.stations.around(station, window.stations).flat_map(move |station| {
            let bins = (0..=below + above).filter_map(move |at| grid.bin_at(bin, at, below));
            bins.map(move |bin| station * grid.bins + bin)
        })
    }

    /// Whether no joint is farther from joint angles than it may go (eq. 9).
    fn is_within(&self, from: &[f64; 6], to: &[f64; 6], bounds: &[f64; 6]) -> bool {
        let joints = self.arm.joints;
        (0..6).all(|joint| {
            let (step, _) = joints.step(joint, from[joint], to[joint]);
            let is_either = [from, to].iter().any(|q| joints.is_either_end(joint, q[joint]));
            let step = if is_either { nearest_turn(step, 0.0) } else { step };
            step.abs() <= bounds[joint]
        })
    }
}
