//! The values of the free axes as one number: a station.

use super::freedom::{FreeAxis, Values};
use crate::kinematics::thresholds::MOST_FREE_AXES;

/// How far a window reaches along each axis, below and above.
pub(super) type Reach = [[u16; 2]; MOST_FREE_AXES];

/// A grid of the values of all free axes; the last axis changes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stations {
    counts: [usize; MOST_FREE_AXES],
    pub(super) steps: Values,
    len: usize,
}

impl Stations {
    /// A grid of so many values of each axis, so far apart [m, rad].
    pub(super) fn new(counts: [usize; MOST_FREE_AXES], steps: Values) -> Self {
        Self { counts, steps, len: counts.iter().product() }
    }

    /// The grid that axes ask for.
    pub(super) fn of(axes: &[FreeAxis]) -> Self {
        let mut grid = Self::default();
        for (axis, own) in axes.iter().enumerate() {
            (grid.counts[axis], grid.steps[axis]) = (own.steps, own.step());
        }
        Self::new(grid.counts, grid.steps)
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// The number of each axis at a station.
    pub(super) fn numbers(&self, mut station: usize) -> [usize; MOST_FREE_AXES] {
        let mut numbers = [0; MOST_FREE_AXES];
        for axis in (0..MOST_FREE_AXES).rev() {
            numbers[axis] = station % self.counts[axis];
            station /= self.counts[axis];
        }
        numbers
    }

    /// The station of numbers.
    pub(super) fn station(&self, numbers: [usize; MOST_FREE_AXES]) -> usize {
        (0..MOST_FREE_AXES).fold(0, |station, axis| station * self.counts[axis] + numbers[axis])
    }

    /// The values at a station [m, rad], those of the first one given.
    pub(super) fn values(&self, bases: &Values, station: usize) -> Values {
        if self.len == 1 {
            return *bases;
        }
        let numbers = self.numbers(station);
        #[expect(clippy::cast_precision_loss, reason = "small counts")]
        core::array::from_fn(|axis| bases[axis] + numbers[axis] as f64 * self.steps[axis])
    }

    /// The stations within reach of one, from the one with the least numbers on.
    pub(super) fn around(self, station: usize, reach: Reach) -> impl Iterator<Item = usize> {
        let near = if self.len == 1 { Near::default() } else { self.near(station, reach) };
        (0..near.stations.len).map(move |number| {
            if near.stations.len == 1 {
                return station;
            }
            let numbers = near.stations.numbers(number);
            self.station(core::array::from_fn(|axis| near.first[axis] + numbers[axis]))
        })
    }

    fn near(&self, station: usize, reach: Reach) -> Near {
        let own = self.numbers(station);
        let (mut first, mut counts) = (own, [1; MOST_FREE_AXES]);
        for axis in 0..MOST_FREE_AXES {
            let [below, above] = reach[axis].map(usize::from);
            first[axis] = own[axis].saturating_sub(below);
            counts[axis] = (own[axis] + above).min(self.counts[axis] - 1) - first[axis] + 1;
        }
        Near { first, stations: Self::new(counts, self.steps) }
    }

    /// Whether no axis has more than one step between two stations.
    pub(super) fn are_neighbors(&self, [one, other]: [usize; 2]) -> bool {
        let [one, other] = [one, other].map(|station| self.numbers(station));
        one.iter().zip(&other).all(|(one, other)| one.abs_diff(*other) <= 1)
    }

    /// A window of all stations.
    pub(super) fn full_reach(&self) -> Reach {
        self.counts.map(|count| [u16::try_from(count - 1).unwrap_or(u16::MAX); 2])
    }
}

/// A part of a grid.
#[derive(Clone, Copy, Default)]
struct Near {
    first: [usize; MOST_FREE_AXES],
    stations: Stations,
}

impl Default for Stations {
    fn default() -> Self {
        Self::new([1; MOST_FREE_AXES], Values::default())
    }
}
