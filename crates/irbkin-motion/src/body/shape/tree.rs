//! A tree of boxes around items, which finds the least value of thousands of them.

use nalgebra::Vector3;

use super::segment::{NOWHERE, Nearest, Segment, at, part_near};
use crate::prelude::*;
use irbkin::{Interrupt, Interrupted, Pose};

/// Items of a leaf, at most.
const LEAF: usize = 4;

/// By how much a bound must exceed a value, relative to it: more than rounding [1].
const BOUND: f64 = 1e-9;

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    /// The least coordinates [m].
    pub(crate) low: Vector3<f64>,
    /// The largest coordinates [m].
    pub(crate) high: Vector3<f64>,
}

impl Bounds {
    pub(crate) fn of<'a>(points: impl IntoIterator<Item = &'a Vector3<f64>>) -> Self {
        let empty = Vector3::repeat(f64::INFINITY);
        let around = |own: Self, point: &Vector3<f64>| Self {
            low: own.low.inf(point),
            high: own.high.sup(point),
        };
        points.into_iter().fold(Self { low: empty, high: -empty }, around)
    }

    /// The box around it as seen from the frame in which its own has a pose.
    pub(super) fn moved(&self, pose: &Pose) -> Self {
        let center = pose.rotation * self.center() + pose.translation.vector;
        let half = pose.rotation.matrix().abs() * (0.5 * (self.high - self.low));
        Self { low: center - half, high: center + half }
    }

    /// The box with all that is within a radius [m] of it.
    pub(super) fn widened(&self, radius: f64) -> Self {
        Self { low: self.low.add_scalar(-radius), high: self.high.add_scalar(radius) }
    }

    /// How far a point is from it [m].
    pub(crate) fn distance(&self, point: &Vector3<f64>) -> f64 {
        (self.low - point).sup(&(point - self.high)).sup(&Vector3::zeros()).norm()
    }

    /// Its middle [m].
    pub(crate) fn center(&self) -> Vector3<f64> {
        0.5 * (self.low + self.high)
    }

    /// The radius of the ball around it [m].
    pub(super) fn radius(&self) -> f64 {
        0.5 * (self.high - self.low).norm()
    }

    /// A square [m^2] that the square of its distance from a segment is not less than, up to
    /// rounding (docs/theory/cell.md, eq. 7).
    pub(super) fn square_from(&self, segment: &Segment) -> f64 {
        let way = way_to(segment, &self.center());
        let half = 0.5 * (self.high - self.low);
        square_along(&way, way.norm_squared() - way.abs().dot(&half))
    }

    pub(super) fn contains(&self, point: &Vector3<f64>) -> bool {
        (0..3).all(|axis| self.low[axis] <= point[axis] && point[axis] <= self.high[axis])
    }
}

/// The way from the nearest point of a segment to a point. The whole segment is behind the plane
/// across it through the nearest point.
pub(super) fn way_to(segment: &Segment, point: &Vector3<f64>) -> Vector3<f64> {
    point - at(segment, part_near(segment, point))
}

/// A square [m^2] that the square of the distance of a segment from points is not less than, up to
/// rounding, by a way that begins on the segment and the least product with it of ways to the
/// points.
pub(super) fn square_along(way: &Vector3<f64>, least: f64) -> f64 {
    if least > 0.0 { least * least / way.norm_squared() * (1.0 - BOUND) } else { 0.0 }
}

/// A square [m^2] above the square of a distance, by more than rounding.
pub(super) fn above(distance: f64) -> f64 {
    distance * distance * (1.0 + BOUND) + f64::MIN_POSITIVE
}

#[derive(Clone, Debug, PartialEq)]
struct Node {
    bounds: Bounds,
    /// Of a leaf, the first of its items; of another node, its second child. The first child is
    /// the next node.
    next: usize,
    /// How many items a leaf has; 0 of another node.
    count: usize,
}

/// Nodes that are left to be looked into, at most: each halves its items.
const LEFT: usize = 64;

/// A tree of boxes around items, each of which is halved along its longest edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// The items of the leaves, one leaf after another.
    items: Vec<usize>,
}

impl Tree {
    pub(crate) fn new(boxes: &[Bounds], interrupt: Interrupt<'_>) -> Result<Self, Interrupted> {
        let mut items: Vec<usize> = (0..boxes.len()).collect();
        let mut nodes = Vec::new();
        if !items.is_empty() {
            split(boxes, &mut items, 0, &mut nodes, interrupt)?;
        }
        Ok(Self { nodes, items })
    }

    pub(super) fn bounds(&self) -> &Bounds {
        &self.nodes[0].bounds
    }

    /// Pass on the items of each leaf whose boxes are all near, until one stops it; returns whether
    /// one does.
    #[inline(always)]
    pub(crate) fn stops_near(
        &self,
        is_near: impl Fn(&Bounds) -> bool,
        mut stops: impl FnMut(&[usize]) -> bool,
    ) -> bool {
        let mut left = [0; LEFT];
        let mut count = self.nodes.len().min(1);
        while count > 0 {
            count -= 1;
            let at = left[count];
            let node = &self.nodes[at];
            if !is_near(&node.bounds) {
                continue;
            }
            if node.count == 0 {
                left[count..count + 2].copy_from_slice(&[node.next, at + 1]);
                count += 2;
            } else if stops(&self.items[node.next..node.next + node.count]) {
                return true;
            }
        }
        false
    }

    /// Find the least `value` of an item that is less than `most`. Boxes whose `bound`, which is at
    /// most the values of the items inside, is not less than a value found are not looked into.
    pub(crate) fn search(
        &self,
        most: f64,
        bound: impl Fn(&Bounds) -> f64,
        mut value: impl FnMut(usize) -> f64,
    ) {
        let mut least = most;
        if !self.nodes.is_empty() && bound(self.bounds()) < least {
            self.look(0, &bound, &mut value, &mut least);
        }
    }

    /// The nearest points of a segment and of the items, if the square of their distance is less
    /// than `most`, or the first that are near enough; `nearer` returns the nearer of those known
    /// and of an item.
    pub(super) fn nearest(
        &self,
        segment: &Segment,
        most: f64,
        is_enough: impl Fn(f64) -> bool,
        nearer: impl Fn(Nearest, usize) -> Nearest,
    ) -> Nearest {
        let mut nearest = (most, NOWHERE.1);
        self.search(
            most,
            |bounds| bounds.square_from(segment),
            |item| {
                nearest = nearer(nearest, item);
                if is_enough(nearest.0) { f64::NEG_INFINITY } else { nearest.0 }
            },
        );
        nearest
    }

    fn look(
        &self,
        at: usize,
        bound: &impl Fn(&Bounds) -> f64,
        value: &mut impl FnMut(usize) -> f64,
        least: &mut f64,
    ) {
        let node = &self.nodes[at];
        if node.count > 0 {
            for item in &self.items[node.next..node.next + node.count] {
                *least = least.min(value(*item));
            }
            return;
        }
        let mut children = [at + 1, node.next].map(|at| (bound(&self.nodes[at].bounds), at));
        if children[1].0 < children[0].0 {
            children.swap(0, 1);
        }
        for (bounded, at) in children {
            if bounded < *least {
                self.look(at, bound, value, least);
            }
        }
    }
}

/// Add the node of some items, the first of which is number `first`, and the nodes below it.
fn split(
    boxes: &[Bounds],
    items: &mut [usize],
    first: usize,
    nodes: &mut Vec<Node>,
    interrupt: Interrupt<'_>,
) -> Result<(), Interrupted> {
    let corners = items.iter().flat_map(|item| [&boxes[*item].low, &boxes[*item].high]);
    let bounds = Bounds::of(corners);
    let at = nodes.len();
    if items.len() <= LEAF {
        nodes.push(Node { bounds, next: first, count: items.len() });
        return Ok(());
    }
    interrupt.check(nodes.len())?;
    nodes.push(Node { bounds, next: 0, count: 0 });
    let axis = (bounds.high - bounds.low).imax();
    let middle = items.len() / 2;
    let place = |item: &usize| boxes[*item].low[axis] + boxes[*item].high[axis];
    items.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
    let (low, high) = items.split_at_mut(middle);
    split(boxes, low, first, nodes, interrupt)?;
    nodes[at].next = nodes.len();
    split(boxes, high, first + middle, nodes, interrupt)
}
