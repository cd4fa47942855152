//! The end of a line or an arc: its joints, and whether they are meant by its confdata.

use alloc::format;

use super::drive::{Drive, apart};
use super::goal::Place;
use super::joints::nearest_written;
use crate::rapid::calc::confdata::{near, over_quarters};
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::motion::thresholds::{NEAR_CONFDATA, NEAR_CONFDATA_OF_LINE};
use irbkin::follow::SingularityMode;
use irbkin::thresholds::CONFIGURATION_EDGE;

impl<const N: usize> Drive<'_, '_, N> {
    /// The joints at the target of a line or an arc, and whether they have its configuration.
    pub(super) fn arrived(&mut self, index: usize, end: &[f64; N], is_rounded: bool) -> [f64; N] {
        let goal = &self.goals[index];
        let Some(Place::Tool(pose, wanted)) = goal.place else { return *end };
        let pose = goal.frames.flange(&pose);
        let mut q = *end;
        if is_rounded && let Ok(nearest) = self.flange.ik_nearest_at(&pose, end, wanted.arm_angle) {
            q = nearest;
        }
        if !goal.step.settings.conf_l {
            return q;
        }
        let found = self.flange.configuration(&q).unwrap_or_default();
        let confdata = wanted.configuration;
        let before = self.other.take();
        let is_met = || {
            self.flange
                .ik_configured(&pose, wanted.near(q))
                .is_ok_and(|solution| apart(&solution.q, &q, SingularityMode::Through).is_none())
        };
        if found == confdata || is_met() {
            return q;
        }
        let is_nearest = |by: f64| {
            nearest_written(self.flange, &pose, &wanted)
                .is_none_or(|(_, least)| by <= least.by + CONFIGURATION_EDGE)
        };
        let over = over_quarters(self.flange, &q, confdata).filter(|over| {
            over.by <= NEAR_CONFDATA || over.by <= NEAR_CONFDATA_OF_LINE && is_nearest(over.by)
        });
        if let Some(over) = over {
            self.found(index, near(&over, confdata, found));
        } else {
            let words = format!(
                "arrives with the configuration {found}, its target has {confdata}: correct its \
                 confdata, or program ConfL\\Off"
            );
            // As of the move before: the branch is the cause, not each target.
            let is_same = |it: &(_, _, usize)| (it.0, it.1) == (confdata, found);
            let since = before.filter(is_same).map_or(index, |it| it.2);
            self.other = Some((confdata, found, since));
            let finding = Finding::new(Code::OtherConfiguration, words);
            self.found(index, finding.caused_by(format!("{since}")));
        }
        q
    }
}
