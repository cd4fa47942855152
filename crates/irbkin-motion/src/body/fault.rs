//! Shapes, bodies and cells that are refused.

use crate::prelude::*;
use thiserror::Error;

use irbkin::internal::Names;

/// Why a shape, a body or a cell is refused. Lengths in meters; links and obstacles count from 0.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BodyFault {
    #[error(
        "{shape} {field}[{index}] is {value} m, its size must be at most {most} m: is it in \
         millimeters? Meters are wanted"
    )]
    Point { shape: &'static str, field: &'static str, index: usize, value: f64, most: f64 },
    #[error(
        "{shape} {field} is {value} m, it must be at most {most} m: is it in millimeters? Meters \
         are wanted, and a floor or wall without end is a half space"
    )]
    Large { shape: &'static str, field: &'static str, value: f64, most: f64 },
    #[error("{field} is {value} m, it must be {least:e} to {most:e} m")]
    Length { field: &'static str, value: f64, least: f64, most: f64 },
    #[error("normal has length zero: it must point out of the solid, as [0, 0, 1] of a floor does")]
    Normal,
    #[error("{field} has {count} points, it must have {least} to {most}")]
    Count { field: &'static str, count: usize, least: usize, most: usize },
    #[error("{field}: point {row} has the coordinate {value}, every one must be finite [m]")]
    Row { field: &'static str, row: usize, value: f64 },
    #[error(
        "{field} extend over {span} m, more than {most} m: are they in millimeters? scale=0.001 \
         makes meters"
    )]
    Span { field: &'static str, span: f64, most: f64 },
    /// `thickness`: how far the points are from a plane [m].
    #[error(
        "points are in a plane within {thickness:e} m, a convex hull must be {least:e} m thick at \
         least: give a plate by points on both of its sides"
    )]
    Flat { thickness: f64, least: f64 },
    /// `senses`: how many triangles use the edge in one sense and in the other.
    #[error(
        "the mesh is not closed: the edge from {:?} to {:?} m belongs to {}; {count} edges are open, \
         by more than a micrometer. Close it, fill it by Shape.convex, or take its surface alone by \
         solid=False",
        .edge[0], .edge[1],
        match .senses[0] + .senses[1] {
            1 => String::from("one triangle only"),
            2 => String::from("two triangles that face opposite sides"),
            count => format!("{count} triangles, {} in one sense", .senses[0]),
        }
    )]
    Open { edge: [[f64; 3]; 2], senses: [u32; 2], count: usize },
    #[error(
        "the mesh encloses no volume: it is {thickness:e} m thick, it must be {least:e} m at least; \
         take its surface alone by solid=False"
    )]
    NoVolume { thickness: f64, least: f64 },
    #[error("a hull has {found} points, it must have {most} at most: leave out those inside")]
    HullPoints { found: usize, most: usize },
    #[error("a face of a hull has the corner {face}, its {count} points count from 0")]
    HullFace { face: u8, count: usize },
    #[error(
        "a point of a hull is {height:e} m outside of one of its faces: their corners must be \
         counterclockwise, seen from outside of a convex hull"
    )]
    HullBeyond { height: f64 },
    #[error("a hull is of link {link}, which has no capsules: give some that contain it")]
    HullLink { link: usize },
    #[error("a union has no shape: give one at least")]
    NoShape,
    #[error(
        "links {} and {} are no pair to be kept apart: they must be two links with capsules",
        .pair[0], .pair[1]
    )]
    Pair { pair: [usize; 2] },
    #[error(
        "links {} and {} are no pair to be kept apart: the flange carries one, they do not move \
         against each other", .pair[0], .pair[1]
    )]
    Rigid { pair: [usize; 2] },
    #[error(
        "a capsule is of link {link}: the arm has {dof} joints, its links are 0 to {dof}, and {} is \
         carried by the flange", dof + 1
    )]
    NoLink { link: usize, dof: usize },
    #[error("excess has {found} lengths, it must have {wanted}, one of each link, or none")]
    ExcessCount { found: usize, wanted: usize },
    #[error(
        "boxes, spheres, capsules and cylinders are attached, no half space, hull, mesh or point \
         cloud: irbkin.body.cover makes capsules of a mesh"
    )]
    NoCover,
    #[error(
        "excess is {excess} m, {most} capsules or fewer contain the shape with {least} m or more: allow \
         that, or give the shape in smaller pieces"
    )]
    Excess { excess: f64, least: f64, most: usize },
    #[error(
        "shape {index} reaches {length} m from the flange, more than the arm's {bound} m: is it in \
         meters, in the flange frame?"
    )]
    LargerThanArm { index: usize, length: f64, bound: f64 },
    #[error(
        "the kinematic table has {length} m of lengths in all, an approximate body needs more than 0 \
         and at most {bound} m, ten times the size of the arm: give a body by with_body"
    )]
    Lengths { length: f64, bound: f64 },
    #[error("obstacle {index} has the name of another one: each must have its own")]
    TwoNames { index: usize },
    #[error("may_touch: no obstacle has the name {name:?}, there are: {existing}")]
    NoObstacle { name: String, existing: Names },
    #[error(
        "may_touch: there is no link {link} that could touch {name:?}: links 1 to 8 move, link 0 is \
         not compared"
    )]
    NoMovingLink { name: String, link: usize },
    #[error(
        "the robot has no body: give one by with_body, of capsules that contain its links, or its \
         approximate_body()"
    )]
    NoBody,
    #[error("the robot has no body: {why}; or give it one by with_body")]
    NotRead { why: String },
}
