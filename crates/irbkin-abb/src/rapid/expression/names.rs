//! Names as an expression looks them up, and RAPID's own data: tool0, wobj0, load0,
//! speeds and zones.

use alloc::borrow::Cow;
use core::ops::Range;

use crate::prelude::*;
use crate::rapid::data::expression::Expression;
use crate::rapid::data::module::Content;
use crate::rapid::data::moves::Target;
use crate::rapid::data::records::{LoadData, SpeedData, ToolData, WobjData, ZoneData};
use crate::rapid::data::unread::{AssignedBy, Reason, Unresolved};
use crate::rapid::data::value::{DataType, Value};
use irbkin_motion::internal::PREDEFINED as ZONES;

pub(crate) trait Names {
    fn find(&self, at: At, name: &str) -> Lookup<'_>;

    /// An element, from 0, of an array of a size, by the text of an index that is not known; every
    /// one is asked for.
    fn element(&self, _index: &str, _size: usize) -> Option<usize> {
        None
    }

    /// What a function of the program returns, as it is called by an expression of a text.
    fn returned(&self, _text: &str, _call: &Expression<'_>) -> Option<Value> {
        None
    }

    /// Why some of these atoms of a datum may be different where the program moves, if others are
    /// for a cause.
    fn cause_of<'c>(
        &'c self,
        _at: At,
        _name: &str,
        _atoms: Range<usize>,
        cause: Cause<'c>,
    ) -> Option<Cause<'c>> {
        Some(cause)
    }

    /// The value of a function of the robot, which is known where a program is followed.
    fn ask(&self, function: &str, _question: Question) -> Result<Target, Reason> {
        Err(Reason::Function { name: function.to_string() })
    }
}

/// A tool, and the work object that it is seen in.
pub(crate) type ToolIn = (ToolData, WobjData);

/// What a function of the robot asks.
pub(crate) enum Question {
    /// Where the robot is: in a tool and a work object, by default the last move's, or in joints.
    Here(Option<(Option<ToolData>, Option<WobjData>)>),
    /// The joints of a robtarget, or the robtarget of joints.
    Converted(Target, ToolIn),
}

/// Where a name is used.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct At {
    /// Index of the routine, from 1; 0 for the module.
    pub(crate) routine: usize,
    /// The innermost loop around it.
    pub(crate) inside_loop: Option<usize>,
}

pub(crate) enum Lookup<'r> {
    Datum {
        content: &'r Content,
        can_change: bool,
        /// Why its value, or a part of it, may be different where the program moves.
        cause: Option<Cause<'r>>,
    },
    /// Of RAPID's own data.
    Predefined(Value),
    /// Nothing declares it.
    NotHere,
    Unknown(Unresolved),
}

/// The reason why a datum has no known value where the program moves.
#[derive(Clone, Copy)]
pub(crate) struct Cause<'a> {
    /// The assigned datum: itself or one that its declaration refers to.
    pub(crate) name: &'a str,
    pub(crate) by: By<'a>,
}

/// The place of the assignment.
#[derive(Clone, Copy)]
pub(crate) enum By<'a> {
    Line(usize),
    /// Another module, and the line there, if that is known.
    Module(Option<&'a str>, Option<usize>),
}

impl Cause<'_> {
    /// The cause as the reason why the name that is referred to has no value.
    pub(crate) fn of(&self, referred: &str) -> Unresolved {
        let by = match self.by {
            By::Line(line) => AssignedBy::Line(line),
            By::Module(module, line) => AssignedBy::Module(module.map(String::from), line),
        };
        if lower(self.name) == lower(referred) {
            Unresolved::Assigned { by }
        } else {
            Unresolved::AssignedThrough { name: self.name.to_string(), by }
        }
    }
}

pub(crate) fn lower(name: &str) -> Cow<'_, str> {
    if name.bytes().all(|byte| byte.is_ascii() && !byte.is_ascii_uppercase()) {
        Cow::Borrowed(name)
    } else {
        Cow::Owned(name.to_lowercase())
    }
}

pub(crate) struct NoNames;

impl Names for NoNames {
    fn find(&self, _: At, _: &str) -> Lookup<'_> {
        Lookup::NotHere
    }
}

/// The speeds of the tool center point by their names: v5 [mm/s] to v7000.
/// Source: the speeddata table of the RAPID reference manual.
const SPEEDS: [u16; 25] = [
    5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500, 2000, 2500,
    3000, 4000, 5000, 6000, 7000,
];

/// The speed of `vmax` [mm/s]: more than any robot reaches. A controller has its robot's.
const VMAX: f64 = 10_000.0;

pub(crate) fn predefined_names(data_type: DataType) -> Vec<String> {
    match data_type {
        DataType::ToolData => Vec::from(["tool0".to_string()]),
        DataType::WobjData => Vec::from(["wobj0".to_string()]),
        DataType::LoadData => Vec::from(["load0".to_string()]),
        DataType::SpeedData => {
            let max = core::iter::once("vmax".to_string());
            SPEEDS.iter().map(|speed| format!("v{speed}")).chain(max).collect()
        }
        DataType::ZoneData => ZONES.iter().map(|(name, ..)| (*name).to_string()).collect(),
        _ => Vec::new(),
    }
}

/// How the names of RAPID's other constants begin, in lower case. Source: the word list of
/// KnoP-01/rapid-for-vim.
const FAMILIES: &str = "aio_ aw_ btn busstate_ c_motset c_progdisp cap_ corr_ css_ ct_ diskhome diskram disktemp ee_ \
    egm_ err_ errstr_ event_ fc_ flp1 fllwtime gap_ handler_ icon inpos iobus_ iounit_ irbp_ level_ \
    ltapp__ mpm_ op_ pm_ rob_ run_ sen_ sigorig_ socket_ state_ stoptime str_ sys_ tc_ tp_ \
    trigg_mode tsp_ tune_ type_ usbdisk vlin vrot";

/// More constants, in lower case, and the data of ABB's module `user`.
const CONSTANTS: &str = "clock1 dint edge end_of_list eof eof_bin eof_num eq errno gt gteq high \
    int intno lint low lt lteq noteq opadd opdiv opmod opmult opsub reg1 reg2 reg3 reg4 reg5 \
    resabort rescancel resignore resno resok resretry resunkwn resyes sint stempty timeout udint \
    uint ulint usint wait_max";

/// Whether a name in lower case is a constant of RAPID without a value here, or a datum of `user`.
pub(crate) fn is_constant(lower: &str) -> bool {
    let is_of_type = ["_domain", "_err", "_mode"].iter().any(|end| lower.ends_with(end));
    is_of_type
        || CONSTANTS.split(' ').any(|it| it == lower)
        || FAMILIES.split(' ').any(|begin| lower.starts_with(begin))
}

pub(crate) fn predefined(lower: &str) -> Option<Value> {
    match lower.as_bytes().first()? {
        b'p' if lower == "pi" => Some(Value::Num(core::f64::consts::PI)),
        b't' if lower == "tool0" => Some(Value::ToolData(ToolData::TOOL0)),
        b'w' if lower == "wobj0" => Some(Value::WobjData(WobjData::WOBJ0)),
        b'l' if lower == "load0" => Some(Value::LoadData(LoadData::LOAD0)),
        b'v' => {
            let speed = lower[1..].parse().ok().filter(|speed| SPEEDS.contains(speed));
            let is_number = lower[1..].starts_with(|digit| matches!(digit, '1'..='9'));
            let speed = speed.filter(|_| is_number).map(f64::from);
            let speed = speed.or((lower == "vmax").then_some(VMAX))?;
            Some(Value::SpeedData(SpeedData::of(speed)))
        }
        b'f' | b'z' => {
            let (name, tcp, ori, degrees) = *ZONES.iter().find(|(name, ..)| *name == lower)?;
            // External axes have the numbers of the reorientation.
            Some(Value::ZoneData(ZoneData {
                finep: name == "fine",
                pzone_tcp_mm: tcp,
                pzone_ori_mm: ori,
                pzone_eax_mm: ori,
                zone_ori_deg: degrees,
                zone_leax_mm: ori,
                zone_reax_deg: degrees,
            }))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_and_zones_have_the_numbers_of_their_names() {
        for speed in SPEEDS {
            let Some(Value::SpeedData(data)) = predefined(&format!("v{speed}")) else { panic!() };
            assert_eq!((data.v_tcp_mm_s, data.v_ori_deg_s), (f64::from(speed), 500.0));
        }
        for (name, millimeters, ..) in &ZONES[2..] {
            assert_eq!(name[1..].parse(), Ok(*millimeters));
            let Some(Value::ZoneData(zone)) = predefined(name) else { panic!() };
            assert_eq!((zone.finep, zone.pzone_tcp_mm), (false, *millimeters));
        }
        let Some(Value::ZoneData(fine)) = predefined("fine") else { panic!() };
        assert!(fine.finep);
        for name in ["", "v", "v7", "z", "z2", "fin", "tool", "wobj", "l", "V100", "\u{e9}"] {
            assert!(predefined(name).is_none(), "{name}");
        }
    }
}
