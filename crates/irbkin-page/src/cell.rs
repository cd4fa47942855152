//! `cell`: the obstacles around the robot.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use irbkin::Pose;
use irbkin_motion::body::Shape;
use irbkin_motion::cell::Cell;
use serde::Serialize;

use super::request::{Refusal, Request};

/// Most obstacles of a cell: a page draws them, and compares each link with each.
const MOST_OBSTACLES: usize = 1000;

/// The cell that was set.
#[derive(Debug, Serialize)]
pub struct Obstacles {
    /// The names of the obstacles.
    pub names: Vec<String>,
    /// How far the arm is to stay from them [m].
    pub margin: f64,
}

impl Obstacles {
    pub(crate) fn of(cell: &Cell) -> Self {
        let names = cell.obstacles().iter().map(|(name, _)| name.clone()).collect();
        Self { names, margin: cell.margin() }
    }
}

/// The cell of a request: `obstacles`, each with `name`, `shape` and the numbers of the shape, and
/// `margin` [m], by default zero.
pub(crate) fn read(request: &Request<'_>) -> Result<Cell, Refusal> {
    let obstacles = request.objects("obstacles", MOST_OBSTACLES)?;
    let obstacles = obstacles.iter().map(|it| Ok((it.text("name")?.to_owned(), shape(it)?)));
    let obstacles = obstacles.collect::<Result<_, Refusal>>()?;
    let margin = if request.has("margin") { request.length("margin")? } else { 0.0 };
    Ok(Cell::new(obstacles, margin)?)
}

/// The shape of an obstacle, in the frame of the world: of a `box` its `size` and `pose`, of a
/// `sphere` its `radius` and `center`, of a `capsule` its ends `a` and `b` and its `radius`, of a
/// `cylinder` its `radius`, its `length` along z and its `pose`, of a `half_space` the `normal` that
/// points out of it and a `point` of its plane.
fn shape(obstacle: &Request<'_>) -> Result<Shape, Refusal> {
    let pose = || Ok::<_, Refusal>(obstacle.optional_pose("pose")?.unwrap_or(Pose::identity()));
    let named = |error: irbkin_motion::Error| Refusal(format!("{}: {error}", obstacle.name()));
    match obstacle.text("shape")? {
        "box" => Shape::cuboid(obstacle.point("size")?, &pose()?),
        "sphere" => Shape::sphere(obstacle.length("radius")?, obstacle.point("center")?),
        "capsule" => {
            let [a, b] = [obstacle.point("a")?, obstacle.point("b")?];
            Shape::capsule(a, b, obstacle.length("radius")?)
        }
        "cylinder" => {
            Shape::cylinder(obstacle.length("radius")?, obstacle.length("length")?, &pose()?)
        }
        "half_space" => Shape::half_space(obstacle.point("normal")?, obstacle.point("point")?),
        other => {
            return obstacle.refused(
                "shape",
                &format!(
                    "is {:?}, it must be box, sphere, capsule, cylinder or half_space",
                    other.chars().take(40).collect::<String>()
                ),
            );
        }
    }
    .map_err(named)
}
