//! Arms with the shapes of the tools and parts that moves carry.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use crate::Error;
use crate::rapid::data::moves::Move;
use crate::rapid::program::walker::{Run, Step};
use irbkin::Pose;
use irbkin_motion::Arm;
use irbkin_motion::body::Shape;

/// Shapes in the flange frame, which it carries in moves with the tool or the work object of a name,
/// in lower case.
pub type Carried = BTreeMap<String, Vec<Shape>>;

/// The names of what a move carries: of its tool and its work object those that have shapes and are
/// not known to be stationary.
pub(super) fn carried_by(step: &Move, carried: &Carried) -> Vec<String> {
    let is_held = !matches!(&step.tool.value, Ok(tool) if !tool.robhold);
    let tool = Some(&step.tool.text).filter(|_| is_held);
    let wobj = step.wobj.as_ref();
    let part = wobj.filter(|it| !matches!(&it.value, Ok(wobj) if !wobj.robhold));
    let part = part.map(|wobj| &wobj.text);
    let names = [tool, part].into_iter().flatten().map(|text| text.to_lowercase());
    names.filter(|name| carried.contains_key(name)).collect()
}

/// The arms that the moves of a program are made with, beside the names of what they carry.
pub(super) fn carriers<const N: usize>(
    arm: &Arm<N>,
    runs: &[Run<'_>],
    carried: &Carried,
) -> Result<Vec<(Vec<String>, Arm<N>)>, Error> {
    let mut arms = Vec::from([(Vec::new(), arm.clone())]);
    for step in runs.iter().flat_map(|run| &run.steps) {
        let Step::Move(stepped) = step else { continue };
        let names = carried_by(&stepped.step, carried);
        if arms.iter().all(|(own, _)| *own != names) {
            let shapes: Vec<Shape> =
                names.iter().flat_map(|name| &carried[name]).cloned().collect();
            arms.push((names, arm.clone().with_attached(&shapes, &Pose::identity(), None)?));
        }
    }
    Ok(arms)
}
