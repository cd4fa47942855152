//! Bounds of velocity, acceleration and jerk as bounds of the differences of a joint's control
//! points, and the braking motion from its last control points to rest, in closed form
//! (docs/theory/stream.md, eq. 2 to 10).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::reason::Bound;
use crate::trajectory::thresholds::LIMIT_ROUNDING;

/// By how much a difference may exceed its bound, as a part of it [1]: a checked trajectory may
/// exceed its own by [`LIMIT_ROUNDING`], its second difference may have changed what is left of the
/// first.
const ROUNDING: f64 = 2.0 * LIMIT_ROUNDING;

/// Rounding of a third difference, as a part of the control points and a radian [1]: of eight of
/// them, each given to a few digits of the last place.
const DIGITS: f64 = 32.0 * f64::EPSILON;

/// Phases of a braking motion: five, and more only where rounding splits one [1].
const PHASES: usize = 10;

/// Bounds of the differences of a joint's control points [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) first: f64,
    pub(super) second: f64,
    pub(super) third: f64,
}

impl Bounds {
    /// Of a joint with limits of velocity, acceleration and jerk, for a cycle [s] (eq. 2). Without
    /// a limit, what the others leave.
    pub(super) fn new(cycle: f64, velocity: f64, acceleration: f64, jerk: f64) -> Self {
        let first = velocity * cycle;
        let second = (acceleration * cycle * cycle).min(2.0 * first);
        let third = (jerk * cycle * cycle * cycle).min(2.0 * second);
        Self { first, second, third }
    }

    /// The control point behind `end`, or the bound that it exceeds, its value and the bound
    /// [rad, s] (eq. 3, 6).
    pub(super) fn check(&self, end: End, next: f64, cycle: f64) -> Result<End, (Bound, f64, f64)> {
        let first = next - end.point;
        let behind = End { point: next, first, second: first - end.first };
        let digits = digits_of(next.abs().max(end.point.abs()));
        let left = peak(behind, self.third);
        let square = cycle * cycle;
        for (bound, value, limit, unit) in [
            (Bound::Velocity, first, self.first, cycle),
            (Bound::Acceleration, behind.second, self.second, square),
            (Bound::Jerk, behind.second - end.second, self.third, square * cycle),
            (Bound::VelocityAhead, left, self.first * (1.0 + ROUNDING), cycle),
        ] {
            if exceeds(value, limit, digits) {
                return Err((bound, value / unit, limit / unit));
            }
        }
        Ok(behind)
    }

    /// The least and the greatest second difference of the next control point; the braking motion's
    /// is between them.
    pub(super) fn seconds(&self, end: End) -> [f64; 2] {
        let ahead = |room: f64| -ramp_to_zero(room.max(0.0), self.third);
        let low = (-self.second).max(end.second - self.third).max(-ahead(self.first + end.first));
        let high = self.second.min(end.second + self.third).min(ahead(self.first - end.first));
        [low, high]
    }
}

/// Rounding of a third difference of control points near one [rad].
pub(super) fn digits_of(point: f64) -> f64 {
    DIGITS * (1.0 + point.abs())
}

/// Whether a difference is beyond its bound (eq. 3).
pub(super) fn exceeds(value: f64, limit: f64, digits: f64) -> bool {
    value.is_nan() || value.abs() > limit * (1.0 + ROUNDING) + digits
}

/// The end of the control points of a joint: the last one, and the last differences.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct End {
    pub(super) point: f64,
    pub(super) first: f64,
    pub(super) second: f64,
}

impl End {
    /// By the last three control points.
    pub(super) fn of([before, last, point]: [f64; 3]) -> Self {
        let first = point - last;
        Self { point, first, second: first - (last - before) }
    }

    /// With one more control point, by its second difference.
    pub(super) fn then(self, second: f64) -> Self {
        let first = self.first + second;
        Self { point: self.point + first, first, second }
    }

    fn is_at_rest(self) -> bool {
        self.first == 0.0 && self.second == 0.0
    }
}

/// Steps in which the second difference changes evenly.
#[derive(Clone, Copy, Debug, Default)]
struct Phase {
    /// How many there are, a whole number.
    steps: f64,
    /// Where they begin; its second difference is the first step's.
    from: End,
    /// The third difference from the second step on.
    third: f64,
}

impl Phase {
    /// The end after some steps (eq. 5).
    fn after(&self, steps: f64) -> End {
        let End { point, first, second } = self.from;
        let pairs = 0.5 * steps * (steps - 1.0);
        End {
            point: point
                + steps * (first + 0.5 * (steps + 1.0) * second)
                + self.third * pairs * (steps + 1.0) / 3.0,
            first: first + steps * second + self.third * pairs,
            second: second + self.third * (steps - 1.0),
        }
    }

    /// The last step before the joint moves the other way.
    fn turn(&self) -> f64 {
        let (mut before, mut behind) = (0.0, self.steps);
        while behind - before > 1.0 {
            let middle = (0.5 * (before + behind)).floor();
            if self.after(middle).first * self.from.first > 0.0 {
                before = middle;
            } else {
                behind = middle;
            }
        }
        before
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Brake {
    phases: [Phase; PHASES],
    used: usize,
    /// Steps until the joint is at rest, a whole number.
    pub(super) steps: f64,
    /// The control point at which it rests.
    pub(super) stop: f64,
    /// The step after which the joint turns back, and the control point there.
    turn: Option<(f64, f64)>,
    from: f64,
}

/// The sum of a first second difference `size` and those that follow it in steps of `third` to zero
/// (eq. 7).
fn ramped(size: f64, third: f64) -> f64 {
    let whole = (size / third).floor();
    (whole + 1.0) * (size - 0.5 * whole * third)
}

/// The inverse of [`ramped`], and how many second differences follow the first (eq. 8).
fn ramp_of(sum: f64, third: f64) -> (f64, f64) {
    let whole = (0.5 * ((1.0 + 8.0 * sum / third).sqrt() - 1.0)).floor();
    (sum / (whole + 1.0) + 0.5 * whole * third, whole)
}

/// The second difference by which a first difference is brought to zero, of either sign.
pub(super) fn ramp_to_zero(first: f64, third: f64) -> f64 {
    -ramp_of(first.abs(), third).0.copysign(first)
}

/// The first difference that is left when the second one goes to zero at once (eq. 4).
pub(super) fn peak(end: End, third: f64) -> f64 {
    let size = end.second.abs();
    end.first + (ramped(size, third) - size).copysign(end.second)
}

/// The second difference of the next step of the braking motion (eq. 9).
pub(super) fn braking(end: End, bounds: &Bounds) -> f64 {
    let ideal = ramp_to_zero(end.first, bounds.third);
    let (low, high) = (end.second - bounds.third, end.second + bounds.third);
    ideal.max(low).min(high).max(-bounds.second).min(bounds.second)
}

impl Brake {
    /// The braking motion from the end of the control points.
    pub(super) fn new(end: End, bounds: &Bounds) -> Self {
        let mut brake = Self {
            phases: [Phase::default(); PHASES],
            used: 0,
            steps: 0.0,
            stop: end.point,
            turn: None,
            from: end.point,
        };
        let mut at = end;
        while !at.is_at_rest() && brake.used < PHASES {
            let (phase, is_last) = next_phase(at, bounds);
            let next = phase.after(phase.steps);
            if brake.turn.is_none() && at.first != 0.0 && at.first * next.first <= 0.0 && !is_last {
                let turn = phase.turn();
                brake.turn = Some((brake.steps + turn, phase.after(turn).point));
            }
            brake.phases[brake.used] = phase;
            brake.used += 1;
            brake.steps += phase.steps;
            (brake.stop, at) = (next.point, next);
            if is_last {
                break;
            }
        }
        brake
    }

    /// The control point after some steps, a whole number.
    pub(super) fn at(&self, steps: f64) -> f64 {
        if steps >= self.steps {
            return self.stop;
        }
        let mut left = steps;
        for phase in &self.phases[..self.used] {
            if left <= phase.steps {
                return phase.after(left).point;
            }
            left -= phase.steps;
        }
        self.stop
    }

    /// The least and the greatest control point from one step to another.
    pub(super) fn range(&self, from: f64, to: f64) -> [f64; 2] {
        let (one, other) = (self.at(from), self.at(to));
        let [low, high] = [one.min(other), one.max(other)];
        match self.turn {
            Some((step, point)) if from < step && step < to => [low.min(point), high.max(point)],
            _ => [low, high],
        }
    }

    /// The least and the greatest control point of all.
    pub(super) fn extent(&self) -> [f64; 2] {
        let [low, high] = [self.from.min(self.stop), self.from.max(self.stop)];
        self.turn.map_or([low, high], |(_, point)| [low.min(point), high.max(point)])
    }
}

/// The steps of the braking motion that follow, in which one of its bounds decides, and whether
/// they end at rest (eq. 10).
fn next_phase(at: End, bounds: &Bounds) -> (Phase, bool) {
    // As if what is left of the velocity were positive.
    let sign = if peak(at, bounds.third) < 0.0 { -1.0 } else { 1.0 };
    let (first, second, third) = (sign * at.first, sign * at.second, bounds.third);
    let next = sign * braking(at, bounds);
    let phase = |steps: f64, change: f64| Phase {
        steps,
        from: End { second: sign * next, ..at },
        third: sign * change,
    };
    if next > -bounds.second && next > second - third {
        let (_, whole) = ramp_of(first.abs(), third);
        return (phase(whole + 1.0, -third.copysign(next)), true);
    }
    let least = |steps: f64| steps.floor().max(1.0);
    if second - third <= -bounds.second {
        let kept = ramped(bounds.second, third) - bounds.second;
        return (phase(least((first - kept) / bounds.second), 0.0), false);
    }
    let steps = if second > 0.0 {
        second / third
    } else {
        let left = first - (ramped(-second, third) + second);
        let steps = (second + (second * second + third * left).max(0.0).sqrt()) / third;
        steps.min((bounds.second + second) / third)
    };
    (phase(least(steps), -third), false)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bounds, and ends of control points within them.
    fn cases() -> impl Iterator<Item = (Bounds, End)> {
        let numbers = [-1.0, -0.83, -0.31, -0.05, -1e-3, 0.0, 2e-4, 0.02, 0.4, 0.77, 1.0];
        let bounds = [[1.3e-2, 1.3e-4, 3.8e-6], [4e-3, 1e-3, 2e-3], [2e-2, 1e-6, 1e-9]];
        bounds.into_iter().flat_map(move |[first, second, third]| {
            let bounds = Bounds { first, second, third };
            numbers.into_iter().flat_map(move |one| {
                let ends = numbers.into_iter().map(move |two| End {
                    point: 0.7,
                    first: one * first,
                    second: two * second,
                });
                ends.map(move |end| (bounds, end))
            })
        })
    }

    #[test]
    fn phases_are_the_steps_of_the_law() {
        for (bounds, end) in cases() {
            let brake = Brake::new(end, &bounds);
            let (mut at, mut low, mut high) = (end, end.point, end.point);
            let mut steps = 0.0;
            while !at.is_at_rest() {
                let second = braking(at, &bounds);
                assert!(second.abs() <= bounds.second);
                assert!((second - at.second).abs() <= bounds.third * (1.0 + 1e-9), "{end:?}");
                at = at.then(second);
                steps += 1.0;
                (low, high) = (low.min(at.point), high.max(at.point));
                assert!((brake.at(steps) - at.point).abs() < 1e-10, "{bounds:?} {end:?} {steps}");
                assert!(steps < 1e5);
            }
            assert!((brake.stop - at.point).abs() < 1e-10);
            // Rounding may leave a few steps of nothing.
            assert!((brake.steps - steps).abs() <= 4.0, "{} {steps}", brake.steps);
            assert!(brake.used <= PHASES - 2, "{end:?} {}", brake.used);
            let extent = brake.extent();
            assert!((extent[0] - low).abs() < 1e-10 && (extent[1] - high).abs() < 1e-10);
        }
    }

    /// The nearest stop, of all sequences of a few second differences.
    fn least(at: End, bounds: &Bounds, left: u32) -> f64 {
        if at.first == 0.0 && at.second.abs() <= bounds.third {
            return at.point;
        }
        if left == 0 || at.first < 0.0 {
            return f64::INFINITY;
        }
        let choices = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|change| at.second + change);
        let choices = choices.into_iter().filter(|second| second.abs() <= bounds.second);
        choices.map(|second| least(at.then(second), bounds, left - 1)).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn no_motion_within_the_bounds_stops_nearer_without_turning_back() {
        let bounds = Bounds { first: 10.0, second: 3.0, third: 1.0 };
        for (first, second) in [(2.0, 0.0), (3.0, -1.0), (2.5, 0.5), (4.0, -2.0)] {
            let end = End { point: 0.0, first, second };
            let brake = Brake::new(end, &bounds);
            assert!(brake.stop <= least(end, &bounds, 8) + 1e-12, "{first} {second}");
        }
    }

    #[test]
    fn a_first_difference_that_ends_where_it_is_zero_is_the_peak() {
        for (bounds, end) in cases() {
            let mut at = end;
            while at.second != 0.0 {
                let less = (at.second.abs() - bounds.third).max(0.0);
                at = at.then(less.copysign(at.second));
            }
            assert!((at.first - peak(end, bounds.third)).abs() < 1e-12);
        }
    }
}
