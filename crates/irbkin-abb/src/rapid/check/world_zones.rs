//! World zones that stop the robot: volumes that the TCP must not enter, and spaces of the axes.
//! They count for every move, if their corners are constant and no statement switches them off.

use crate::prelude::*;
use crate::rapid::calc::frames::Frames;
use crate::rapid::data::expression::{Expression, Form};
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::{Content, Storage};
use crate::rapid::data::records::NOT_THERE;
use crate::rapid::data::statement::{Instruction, Statement, StatementKind};
use crate::rapid::data::types::Atom;
use crate::rapid::program::whole::Program;
use irbkin::Robot;

/// The least extent of a box along each axis [mm]. Source: `WZBoxDef` in the RAPID reference
/// manual.
const LEAST_EXTENT: f64 = 10.0;

/// A volume in the world [mm], or a space of the angles of the first six axes [deg].
#[derive(Clone, Copy)]
enum Shape {
    Box([f64; 3], [f64; 3]),
    Sphere {
        center: [f64; 3],
        radius: f64,
    },
    /// Along z, from its center up, or down with a negative height.
    Cylinder {
        center: [f64; 3],
        radius: f64,
        height: f64,
    },
    Axes([f64; 6], [f64; 6]),
}

/// A zone that stops the robot.
pub(super) struct WorldZone {
    name: String,
    line: usize,
    shape: Shape,
    /// Whether it must not be entered; else it must not be left.
    is_inside: bool,
}

impl Shape {
    /// The shape that an instruction defines with numbers; `None` if it is none.
    fn new(instruction: &str, numbers: &[f64]) -> Option<Self> {
        let three = |at: usize| numbers.get(at..at + 3)?.try_into().ok();
        let axes = |at: usize| numbers.get(at..at + 6)?.try_into().ok();
        match instruction {
            "wzboxdef" => {
                let (one, other): ([f64; 3], [f64; 3]) = (three(0)?, three(3)?);
                let corner =
                    |of: fn(f64, f64) -> f64| core::array::from_fn(|i| of(one[i], other[i]));
                Some(Self::Box(corner(f64::min), corner(f64::max)))
            }
            "wzsphdef" => Some(Self::Sphere { center: three(0)?, radius: *numbers.get(3)? }),
            "wzcyldef" => {
                let (radius, height) = (*numbers.get(3)?, *numbers.get(4)?);
                Some(Self::Cylinder { center: three(0)?, radius, height })
            }
            // A jointtarget has six external axes behind its own.
            "wzlimjointdef" => Some(Self::Axes(axes(0)?, axes(12)?)),
            _ => None,
        }
    }

    /// Whether the TCP [mm], or the axes [deg], are in it.
    fn contains(&self, tcp: [f64; 3], axes: &[f64]) -> bool {
        let from = |center: &[f64; 3]| core::array::from_fn::<_, 3, _>(|i| tcp[i] - center[i]);
        match self {
            Self::Box(low, high) => (0..3).all(|i| (low[i]..=high[i]).contains(&tcp[i])),
            Self::Sphere { center, radius } => {
                from(center).iter().map(|it| it * it).sum::<f64>() <= radius * radius
            }
            Self::Cylinder { center, radius, height } => {
                let [x, y, z] = from(center);
                x * x + y * y <= radius * radius
                    && (0.0..=height.abs()).contains(&(z * height.signum()))
            }
            Self::Axes(low, high) => {
                axes.iter().zip(low.iter().zip(high)).all(|(q, (low, high))| {
                    (*low >= NOT_THERE || q >= low) && (*high >= NOT_THERE || q <= high)
                })
            }
        }
    }
}

impl WorldZone {
    /// The finding on the joints along a move.
    pub(super) fn entry<const N: usize>(
        &self,
        flange: &Robot<N>,
        frames: &Frames,
        along: &[[f64; N]],
    ) -> Option<Finding> {
        let is_entered = |q: &[f64; N]| {
            let tcp = frames.tcp(&flange.fk(q)).translation.vector * 1e3;
            self.shape.contains(tcp.into(), &q.map(f64::to_degrees)) == self.is_inside
        };
        along.iter().find(|q| is_entered(q))?;
        let what = if matches!(self.shape, Shape::Axes(..)) { "axes are" } else { "TCP is" };
        let side = if self.is_inside { "inside" } else { "outside" };
        let Self { name, line, .. } = self;
        let words = format!("the {what} {side} the world zone {name} of line {line}");
        Some(Finding::new(Code::WorldZone, words.clone()).caused_by(words))
    }
}

/// The zones of a program, and the findings on boxes that are none.
pub(super) fn world_zones(program: &Program<'_>) -> (Vec<WorldZone>, Vec<Finding>) {
    let all: Vec<_> = instructions(program).collect();
    let name_of = |it: &Instruction, argument: usize| {
        it.arguments.required.get(argument).and_then(Expression::referred).map(|it| it.0)
    };
    let is_one = |it: &Instruction, names: &[&str]| {
        it.name.as_deref().is_some_and(|name| names.contains(&name))
    };
    // The zones that stop the robot, with their shapes.
    let mut stopping: Vec<(Option<String>, Option<String>)> = Vec::new();
    for (.., it) in all.iter().filter(|(.., it)| is_one(it, &["wzlimsup"])) {
        stopping.push((name_of(it, 0), name_of(it, 1)));
    }
    for (.., it) in all.iter().filter(|(.., it)| is_one(it, &["wzdisable", "wzfree"])) {
        stopping.retain(|(zone, _)| *zone != name_of(it, 0));
    }
    let (mut zones, mut found) = (Vec::new(), Vec::new());
    for (module, statement, instruction) in all {
        let shape = name_of(instruction, 0);
        let Some(name) =
            shape.filter(|it| stopping.iter().any(|(_, own)| own.as_ref() == Some(it)))
        else {
            continue;
        };
        let numbers = instruction.arguments.required.iter().skip(1);
        let numbers = numbers.map(|it| numbers_of(program, module, statement, it));
        let Some(numbers) = numbers.collect::<Option<Vec<_>>>() else { continue };
        let of = instruction.name.as_deref().unwrap_or_default();
        let Some(shape) = Shape::new(of, &numbers.concat()) else { continue };
        if let Shape::Box(low, high) = shape
            && (0..3).any(|i| high[i] - low[i] < LEAST_EXTENT)
        {
            let words = format!("its corners are less than {LEAST_EXTENT} mm apart along an axis");
            let finding = Finding::new(Code::WorldZone, words).at_statement(statement, 0);
            found.push(finding.in_module(module));
            continue;
        }
        let is_inside = !instruction.arguments.optional.iter().any(|it| it.is("Outside"));
        zones.push(WorldZone { name, line: statement.line, shape, is_inside });
    }
    (zones, found)
}

/// The instructions of a program, with the indices of their modules.
fn instructions<'m>(
    program: &Program<'m>,
) -> impl Iterator<Item = (usize, &'m Statement, &'m Instruction)> {
    let modules = program.modules.iter().enumerate();
    modules.flat_map(|(index, module)| {
        module.statements.iter().filter_map(move |statement| match &statement.kind {
            StatementKind::Instruction(it) => Some((index, statement, &**it)),
            _ => None,
        })
    })
}

/// The numbers of a constant value, in the order of its components.
fn numbers_of(
    program: &Program<'_>,
    module: usize,
    statement: &Statement,
    expression: &Expression<'_>,
) -> Option<Vec<f64>> {
    match &expression.form {
        Form::Number(value) => Some(Vec::from([*value])),
        Form::Aggregate(parts) => {
            let parts = parts.iter().map(|it| numbers_of(program, module, statement, it));
            Some(parts.collect::<Option<Vec<_>>>()?.concat())
        }
        Form::Name(name) => {
            let (lower, routine) = (name.to_lowercase(), statement.routine.as_deref());
            let local = program.local(module, &routine.unwrap_or_default().to_lowercase(), &lower);
            let local = local.filter(|it| it.storage == Storage::Const);
            let Content::Single(value) =
                &local.or_else(|| program.unassigned(module, &lower))?.content
            else {
                return None;
            };
            let number = |atom: Atom| match atom {
                Atom::Num(number) => Some(number),
                _ => None,
            };
            value.atoms().into_iter().map(number).collect()
        }
        _ => None,
    }
}
