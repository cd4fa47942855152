//! A plan that is interrupted ends at once, wherever that happens.

use super::{PlanError, PlanOptions, PlanOrder, ToolRotation};
use crate::arm::Arm;
use irbkin::Interrupt;

#[test]
fn a_plan_ends_wherever_it_is_interrupted() {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let path = std::vec![robot.fk(&[0.3, -0.2, 0.4, 0.5, 0.6, 0.7]); 200];
    for order in [PlanOrder::Bottleneck, PlanOrder::Sum] {
        let rotation = ToolRotation::full(12).ok();
        let options = PlanOptions { rotation, order, ..PlanOptions::default() };
        let mut stopped = 0;
        loop {
            let asked = core::cell::Cell::new(0);
            let is_enough = || asked.replace(asked.get() + 1) >= stopped;
            match robot.planned(&path, &options, None, Interrupt::when(&is_enough)) {
                Err(PlanError::Stopped) => stopped += 1,
                planned => {
                    assert_eq!(planned.unwrap().q.len(), path.len());
                    break;
                }
            }
        }
        assert!(stopped > 10, "{stopped}");
    }
}
