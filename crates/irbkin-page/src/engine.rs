//! The page: what earlier requests set, and the dispatch of a request.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;

use irbkin::{on, on_configured};
use irbkin_motion::cell::Cell;
use serde::Serialize;
use serde_json::Value;

use super::catalog::Catalog;
use super::cell::{self, Obstacles};
use super::check::Checked;
use super::forward::Posture;
use super::inverse::PoseSolutions;
use super::motion::Motion;
use super::program::Program;
use super::request::{Refusal, Request};
use super::robot::{self, Arm, Arms};
use super::target::Meant;

/// A robot, a cell and a program, and the answers about them.
#[derive(Debug, Default)]
pub struct Page {
    robot: Option<Arms>,
    cell: Cell,
    program: Option<Program>,
}

/// Evaluate one expression on an arm that may have configurations; refuse another.
macro_rules! configured {
    ($arm:expr, $inner:ident => $body:expr) => {
        on_configured!($arm, $inner => $body, arm => Err(arm.lacks_configurations().into()))
    };
}

/// The answer to a request that is not refused.
#[derive(Serialize)]
struct Granted<T> {
    ok: T,
}

/// The answer to a request that is refused.
#[derive(Serialize)]
struct Refused<'a> {
    error: &'a str,
}

impl Page {
    /// The answer to a request, both JSON text: `{"ok": ...}` or `{"error": "a sentence"}`.
    pub fn answer(&mut self, request: &str) -> String {
        let answer = match serde_json::from_str(request) {
            Ok(Value::Object(fields)) => self.granted(&Request::new(&fields, String::new())),
            Ok(_) => return refused("a request must be an object of JSON"),
            Err(error) => return refused(&format!("the request is not JSON: {error}")),
        };
        answer.unwrap_or_else(|Refusal(sentence)| refused(&sentence))
    }

    fn granted(&mut self, request: &Request<'_>) -> Result<String, Refusal> {
        match request.text("do")? {
            "catalog" => ok(Catalog::all()),
            "robot" => {
                let robot = self.robot.insert(robot::read(request)?);
                on!(robot, robot => ok(Arm::of(robot)))
            }
            "cell" => {
                self.cell = cell::read(request)?;
                ok(Obstacles::of(&self.cell))
            }
            "fk" => on!(self.robot()?, robot => ok(Posture::read(robot, &self.cell, request)?)),
            "ik" => {
                on!(self.robot()?, robot => ok(PoseSolutions::read(robot, &self.cell, request)?))
            }
            "ik_target" => {
                configured!(self.robot()?, robot => ok(Meant::read(robot, request)?))
            }
            "check" => {
                self.read_program(request)?;
                let program = self.program()?;
                configured!(self.robot()?, robot => ok(Checked::of(robot, program, &self.cell, request)?))
            }
            "motion" => {
                self.read_program(request)?;
                configured!(self.robot()?, robot => ok(Motion::of(robot, self.program()?, request)?))
            }
            other => Err(Refusal(format!(
                "do is {:?}, it must be catalog, robot, cell, fk, ik, ik_target, check or motion",
                other.chars().take(40).collect::<String>()
            ))),
        }
    }

    fn robot(&self) -> Result<&Arms, Refusal> {
        let none = || Refusal("there is no robot: send {\"do\": \"robot\"} first".to_owned());
        self.robot.as_ref().ok_or_else(none)
    }

    /// Read the modules of a request, if it has some.
    fn read_program(&mut self, request: &Request<'_>) -> Result<(), Refusal> {
        if request.has("modules") {
            self.program = Some(Program::read(request)?);
        }
        Ok(())
    }
    fn program(&self) -> Result<&Program, Refusal> {
        let none = || Refusal("there is no program: modules is missing".to_owned());
        self.program.as_ref().ok_or_else(none)
    }
}

fn ok<T: Serialize>(ok: T) -> Result<String, Refusal> {
    serde_json::to_string(&Granted { ok })
        .map_err(|error| Refusal(format!("the answer cannot be written: {error}")))
}

/// The answer that refuses a request, in a sentence.
#[must_use]
pub fn refused(error: &str) -> String {
    let plain = |_| r#"{"error":"the request is refused"}"#.to_owned();
    serde_json::to_string(&Refused { error }).unwrap_or_else(plain)
}
