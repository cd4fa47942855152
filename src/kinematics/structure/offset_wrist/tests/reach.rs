//! How far poses are out of reach.

use super::{Frame, PI, arms, joints};
use crate::kinematics::structure::offset_wrist::hand::Hand;
use crate::kinematics::structure::offset_wrist::reach::shortfall;

/// Angles of joint 6 of the scan.
const SCANNED: usize = 2000;

#[test]
fn the_shortfall_is_the_least_of_a_scan_and_none_is_beyond_that_is_reached() {
    for (name, arm) in arms() {
        let (mut beyond, mut close) = (0, 0);
        for (number, q) in joints(7).take(600).enumerate() {
            let mut frame = Frame::of(&arm.chain.fk(&q));
            assert!(!arm.constants.is_circle_beyond(&frame), "{name}: {q:?}");
            let factor = 0.05 * (number % 60) as f64;
            frame.origin = frame.origin.map(|x| factor * x);
            let hand = Hand::of(&arm.constants.lengths, &frame);
            let least = (0..SCANNED)
                .map(|number| number as f64 * (2.0 * PI / SCANNED as f64))
                .map(|angle| shortfall(arm.constants.excesses(&hand, angle.sin_cos().into())))
                .fold(f64::INFINITY, f64::min);
            let found = arm.constants.missed(&frame).shortfall();
            let found = if found.is_nan() { 0.0 } else { found };
            let step = arm.constants.lengths.circle * 2.0 * PI / SCANNED as f64;
            assert!(found <= least + 1e-12, "{name}: {found} of {least}");
            close += usize::from(found > least - 0.01 * step - 1e-12);
            if arm.constants.is_circle_beyond(&frame) {
                beyond += 1;
                assert!(found > 0.0, "{name}: {frame:?}");
            }
        }
        assert!(beyond > 100 && close > 500, "{name}: {beyond}, {close}");
    }
}
