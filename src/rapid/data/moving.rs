//! The instructions that move and are read: how they move, and the order of their required
//! arguments.

use self::Role::{Others, Speed, Target, Tool, Zone};
use super::moves::MoveKind::{self, MoveAbsJ, MoveC, MoveExtJ, MoveJ, MoveL};

/// The meaning of a required argument.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    /// The target; of a circle, the point on it and the target.
    Target,
    Speed,
    Zone,
    Tool,
    /// Any number of arguments of a process: signals, trigger data, seams.
    Others,
}

/// Required arguments in order; at most one of them is `Others`.
type Layout = &'static [Role];

const PLAIN: Layout = &[Target, Speed, Zone, Tool];
/// Without a tool: external axes only.
const EXTERNAL: Layout = &[Target, Speed, Zone];
/// An action at the target follows the tool.
const THEN: Layout = &[Target, Speed, Zone, Tool, Others];
/// A process follows the speed.
const ALONG: Layout = &[Target, Speed, Others, Zone, Tool];
/// A process follows the speed, and the target is met.
const STOPS: Layout = &[Target, Speed, Others, Tool];
/// A signal, and the datum that gets the place where it came.
const SEARCH: Layout = &[Others, Target, Speed, Tool];
const SEARCH_EXTERNAL: Layout = &[Others, Target, Speed];
/// A process comes first.
const AFTER: Layout = &[Others, Target, Speed, Zone, Tool];

/// An instruction that moves and is read.
pub(crate) struct MoveInstruction {
    /// Its name in RAPID.
    pub(crate) name: &'static str,
    /// How it moves.
    pub(crate) way: MoveKind,
    layout: Layout,
}

const fn line(name: &'static str, way: MoveKind, layout: Layout) -> MoveInstruction {
    MoveInstruction { name, way, layout }
}

/// Sources: the RAPID reference manual; the application manuals of arc and spot welding,
/// dispensing, painting, Continuous Application Platform, Externally Guided Motion and force
/// control.
#[rustfmt::skip]
static INSTRUCTIONS: &[MoveInstruction] = &[
    line("MoveJ", MoveJ, PLAIN),
    line("MoveL", MoveL, PLAIN),
    line("MoveC", MoveC, PLAIN),
    line("MoveAbsJ", MoveAbsJ, PLAIN),
    line("MoveExtJ", MoveExtJ, EXTERNAL),
    line("MoveJDO", MoveJ, THEN),
    line("MoveLDO", MoveL, THEN),
    line("MoveCDO", MoveC, THEN),
    line("MoveJAO", MoveJ, THEN),
    line("MoveLAO", MoveL, THEN),
    line("MoveCAO", MoveC, THEN),
    line("MoveJGO", MoveJ, THEN),
    line("MoveLGO", MoveL, THEN),
    line("MoveCGO", MoveC, THEN),
    line("MoveJSync", MoveJ, THEN),
    line("MoveLSync", MoveL, THEN),
    line("MoveCSync", MoveC, THEN),
    line("TriggJ", MoveJ, ALONG),
    line("TriggL", MoveL, ALONG),
    line("TriggC", MoveC, ALONG),
    line("TriggAbsJ", MoveAbsJ, ALONG),
    line("TriggJIOs", MoveJ, PLAIN),
    line("TriggLIOs", MoveL, PLAIN),
    line("SearchL", MoveL, SEARCH),
    line("SearchC", MoveC, SEARCH),
    line("SearchExtJ", MoveExtJ, SEARCH_EXTERNAL),
    line("ArcL", MoveL, ALONG),
    line("ArcLStart", MoveL, ALONG),
    line("ArcLEnd", MoveL, ALONG),
    line("ArcC", MoveC, ALONG),
    line("ArcCStart", MoveC, ALONG),
    line("ArcCEnd", MoveC, ALONG),
    line("ArcL1", MoveL, ALONG),
    line("ArcL1Start", MoveL, ALONG),
    line("ArcL1End", MoveL, ALONG),
    line("ArcC1", MoveC, ALONG),
    line("ArcC1Start", MoveC, ALONG),
    line("ArcC1End", MoveC, ALONG),
    line("ArcL2", MoveL, ALONG),
    line("ArcL2Start", MoveL, ALONG),
    line("ArcL2End", MoveL, ALONG),
    line("ArcC2", MoveC, ALONG),
    line("ArcC2Start", MoveC, ALONG),
    line("ArcC2End", MoveC, ALONG),
    line("ArcCalcL", MoveL, ALONG),
    line("ArcCalcLStart", MoveL, ALONG),
    line("ArcCalcLEnd", MoveL, ALONG),
    line("ArcCalcC", MoveC, ALONG),
    line("ArcCalcCEnd", MoveC, ALONG),
    line("ArcAdaptL", MoveL, ALONG),
    line("ArcAdaptLStart", MoveL, ALONG),
    line("ArcAdaptLEnd", MoveL, ALONG),
    line("ArcAdaptC", MoveC, ALONG),
    line("ArcAdaptCEnd", MoveC, ALONG),
    line("ArcMoveExtJ", MoveExtJ, EXTERNAL),
    line("SpotJ", MoveJ, STOPS),
    line("SpotL", MoveL, STOPS),
    line("SpotMJ", MoveJ, STOPS),
    line("SpotML", MoveL, STOPS),
    line("CalibJ", MoveJ, STOPS),
    line("CalibL", MoveL, STOPS),
    line("MeasureWearL", MoveL, STOPS),
    line("NutJ", MoveJ, STOPS),
    line("NutL", MoveL, STOPS),
    line("StudL", MoveL, STOPS),
    line("DaProcMJ", MoveJ, ALONG),
    line("DaProcML", MoveL, ALONG),
    line("DispL", MoveL, ALONG),
    line("DispC", MoveC, ALONG),
    line("GlueL", MoveL, ALONG),
    line("GlueC", MoveC, ALONG),
    line("PaintL", MoveL, ALONG),
    line("PaintC", MoveC, ALONG),
    line("CapL", MoveL, ALONG),
    line("CapC", MoveC, ALONG),
    line("ContactL", MoveL, STOPS),
    line("CSSDeactMoveL", MoveL, STOPS),
    line("EGMMoveL", MoveL, AFTER),
    line("EGMMoveC", MoveC, AFTER),
    line("FCPress1LStart", MoveL, ALONG),
    line("FCPressL", MoveL, ALONG),
    line("FCPressC", MoveC, ALONG),
    line("FCPressEnd", MoveL, STOPS),
];

/// The places of the required arguments of a move among them, ascending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Places {
    pub(crate) via: Option<usize>,
    pub(crate) target: usize,
    pub(crate) speed: usize,
    pub(crate) zone: Option<usize>,
    pub(crate) tool: Option<usize>,
}

impl MoveInstruction {
    /// The instruction of a name, in any case.
    pub(crate) fn named(name: &str) -> Option<&'static Self> {
        INSTRUCTIONS.iter().find(|it| it.name.eq_ignore_ascii_case(name))
    }

    /// The names of all instructions that only some controllers have.
    pub(crate) fn optional_names() -> impl Iterator<Item = &'static str> {
        INSTRUCTIONS.iter().filter(|it| !it.is_basic()).map(|it| it.name)
    }

    /// Whether every controller has it and no routine may take its name: it has its own arguments
    /// and no others.
    pub(crate) fn is_basic(&self) -> bool {
        self.name == self.way.name()
    }

    /// How many required arguments it must have, besides the ones of a process.
    pub(crate) fn arguments(&self) -> usize {
        let own = self.layout.iter().filter(|role| **role != Others).count();
        own + usize::from(self.way == MoveC)
    }

    /// The places among `count` required arguments, by their order; `None` for another number.
    fn ordered(&self, count: usize) -> Option<Places> {
        let others = count.checked_sub(self.arguments())?;
        if others > 0 && !self.layout.contains(&Others) {
            return None;
        }
        let mut places = Places { via: None, target: 0, speed: 0, zone: None, tool: None };
        let mut next = 0;
        for role in self.layout {
            match role {
                Target if self.way == MoveC => {
                    (places.via, places.target) = (Some(next), next + 1);
                    next += 1;
                }
                Target => places.target = next,
                Speed => places.speed = next,
                Zone => places.zone = Some(next),
                Tool => places.tool = Some(next),
                Others => {}
            }
            next += if *role == Others { others } else { 1 };
        }
        Some(places)
    }

    /// The places of the arguments with these types, which are `None` where they are unknown.
    ///
    /// The order determines them, unless a type contradicts it: then the speed, the tool and the
    /// zone are found by their types, and the target precedes the speed. `None` if the arguments
    /// are of another instruction.
    pub(crate) fn places(&self, types: &[Option<&str>]) -> Option<Places> {
        let target = match self.way {
            MoveAbsJ | MoveExtJ => "jointtarget",
            MoveJ | MoveL | MoveC => "robtarget",
        };
        let may_be = |place: usize, of: &str| {
            types.get(place).is_some_and(|it| it.is_none_or(|known| known == of))
        };
        let fits = |places: &Places| {
            may_be(places.target, target)
                && places.via.is_none_or(|via| may_be(via, target))
                && may_be(places.speed, "speeddata")
                && places.zone.is_none_or(|zone| may_be(zone, "zonedata"))
                && places.tool.is_none_or(|tool| may_be(tool, "tooldata"))
        };
        let find = |of: &str| types.iter().position(|known| *known == Some(of));
        let zone = |speed, tool| find("zonedata").filter(|zone| (speed..tool).contains(zone));
        if let Some(mut places) = self.ordered(types.len()).filter(fits) {
            if let (None, Some(tool)) = (places.zone, places.tool) {
                places.zone = zone(places.speed, tool);
            }
            return Some(places);
        }
        let (speed, tool) = (find("speeddata")?, find("tooldata")?);
        let arc = usize::from(self.way == MoveC);
        let places = Places {
            via: if arc > 0 { speed.checked_sub(2) } else { None },
            target: speed.checked_sub(1)?,
            speed,
            zone: zone(speed, tool),
            tool: Some(tool),
        };
        (speed > arc && speed < tool && fits(&places)).then_some(places)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(name: &str, types: &[&str]) -> Option<Places> {
        let types: std::vec::Vec<_> =
            types.iter().map(|it| Some(*it).filter(|it| *it != "?")).collect();
        MoveInstruction::named(name).unwrap().places(&types)
    }

    #[test]
    fn arguments_are_found_by_their_order() {
        let plain = Places { via: None, target: 0, speed: 1, zone: Some(2), tool: Some(3) };
        assert_eq!(places("MoveL", &["?"; 4]), Some(plain));
        assert_eq!(places("movelDO", &["?"; 6]), Some(plain));
        assert_eq!(places("MoveL", &["?"; 5]), None);
        assert_eq!(places("MoveC", &["?"; 4]), None);
        let search = Places { via: Some(2), target: 3, speed: 4, zone: None, tool: Some(5) };
        assert_eq!(places("SearchC", &["?"; 6]), Some(search));
        let seam = Places { via: None, target: 0, speed: 1, zone: Some(4), tool: Some(5) };
        assert_eq!(places("ArcLStart", &["?"; 6]), Some(seam));
        let external = Places { via: None, target: 0, speed: 1, zone: Some(2), tool: None };
        assert_eq!(places("MoveExtJ", &["?"; 3]), Some(external));
    }

    #[test]
    fn arguments_that_contradict_the_order_are_found_by_their_types() {
        let spot = ["robtarget", "speeddata", "?", "zonedata", "?", "tooldata"];
        let found = Places { via: None, target: 0, speed: 1, zone: Some(3), tool: Some(5) };
        assert_eq!(places("SpotL", &spot), Some(found));
        let late = ["num", "robtarget", "speeddata", "zonedata", "tooldata"];
        let found = Places { via: None, target: 1, speed: 2, zone: Some(3), tool: Some(4) };
        assert_eq!(places("ArcL", &late), Some(found));
        assert_eq!(places("ArcL", &["num", "speeddata", "zonedata", "tooldata"]), None);
        assert_eq!(places("TriggAbsJ", &["robtarget", "?", "?", "?", "?"]), None);
    }
}
