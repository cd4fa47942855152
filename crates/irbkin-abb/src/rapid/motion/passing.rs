//! Singularities that a line or an arc passes.

use alloc::vec::Vec;

use super::drive::{Drive, Here};
use super::goal::{Goal, Place};
use super::joints::Path;
use crate::rapid::calc::wrong::passes;
use crate::rapid::data::settings::SingArea;
use crate::rapid::motion::thresholds::{ELBOW_ZONE, SHOULDER_ZONE};
use irbkin::thresholds::WRIST_ZONE;
use irbkin::{Pose, SingularityKind, Slot};
use irbkin_motion::internal::part;

/// The bit of cfx that is the side of the wrist.
const WRIST_SIDE: i32 = 1;

impl<const N: usize> Drive<'_, '_, N> {
    /// Report the singularities that a line or an arc passes: of each kind the nearest place.
    pub(super) fn check_singularities(&mut self, index: usize, here: &Here<N>, path: &Path<N>) {
        let is_off = self.goals[index].step.settings.sing_area == SingArea::Off;
        let kinds = [
            (SingularityKind::WRIST, 1, WRIST_ZONE),
            (SingularityKind::ELBOW, 2, ELBOW_ZONE),
            (SingularityKind::SHOULDER, 4, SHOULDER_ZONE),
        ];
        let mut nearest = [(f64::INFINITY, 0); 3];
        let mut last = self.robot.slot_of(&here.q).map(Slot::index);
        for (sample, q) in path.q.iter().enumerate() {
            let Some(at) = self.robot.singular_distances(q) else { return };
            let slot = self.robot.slot_of(q).map(Slot::index);
            let crossed = slot.zip(last).map_or(0, |(slot, last)| slot ^ last);
            last = slot;
            let distances = [at.wrist, at.elbow, at.shoulder];
            for ((kind, distance), near) in kinds.iter().zip(distances).zip(&mut nearest) {
                let distance = if crossed & kind.1 == 0 { distance } else { 0.0 };
                if distance < near.0 {
                    *near = (distance, sample + 1);
                }
            }
        }
        for ((kind, _, bound), (distance, sample)) in kinds.into_iter().zip(nearest) {
            if distance < bound && (is_off || kind != SingularityKind::WRIST) {
                let part = part(sample, path.q.len());
                self.found(index, passes(kind, part, distance).with_value(distance, bound));
            }
        }
    }

    /// The joints along poses of the flange at whose end the wrist is on the other side: its axes
    /// go evenly to the programmed configuration.
    pub(super) fn turned_over(
        &self,
        goal: &Goal<'_, N>,
        flanges: &[Pose],
        from: &[f64; N],
    ) -> Option<Vec<[f64; N]>> {
        let (Some(Place::Tool(_, wanted)), true) = (goal.place, goal.step.settings.conf_l) else {
            return None;
        };
        if self.flange.configuration(from).ok()?.cfx ^ wanted.configuration.cfx != WRIST_SIDE {
            return None;
        }
        let to = self.flange.ik_configured(flanges.last()?, wanted.near(*from)).ok()?;
        self.flange.with_even_wrist(flanges, [from, &to.q], self.interrupt)
    }
}
