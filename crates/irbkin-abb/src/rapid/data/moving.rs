//! The instructions that move and are read: how they move, and the order of their required
//! arguments.

use self::Role::{Others, Speed, Target, Tool, Zone};
use super::moves::MoveKind::{self, MoveAbsJ, MoveC, MoveExtJ, MoveJ, MoveL};

/// The meaning of a required argument.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// The target; of a circle, the point on it and the target.
    Target,
    Speed,
    Zone,
    Tool,
    /// Any number of arguments of a process: signals, trigger data, seams.
    Others,
}

/// Required arguments in order; at most one of them is `Others`.
pub(super) type Layout = &'static [Role];

pub(super) const PLAIN: Layout = &[Target, Speed, Zone, Tool];
/// Without a tool: external axes only.
pub(super) const EXTERNAL: Layout = &[Target, Speed, Zone];
/// An action at the target follows the tool.
pub(super) const THEN: Layout = &[Target, Speed, Zone, Tool, Others];
/// A process follows the speed.
pub(super) const ALONG: Layout = &[Target, Speed, Others, Zone, Tool];
/// A process follows the speed, and the target is met.
pub(super) const STOPS: Layout = &[Target, Speed, Others, Tool];
/// A signal, and the datum that gets the place where it came.
pub(super) const SEARCH: Layout = &[Others, Target, Speed, Tool];
pub(super) const SEARCH_EXTERNAL: Layout = &[Others, Target, Speed];
/// A process comes first.
pub(super) const AFTER: Layout = &[Others, Target, Speed, Zone, Tool];

pub(crate) struct MoveInstruction {
    pub(crate) name: &'static str,
    pub(crate) way: MoveKind,
    pub(super) layout: Layout,
}

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
    /// Whether every controller has it and no routine may take its name: it has its own arguments
    /// and no others.
    pub(crate) fn is_basic(&self) -> bool {
        MoveKind::named(self.name).is_some()
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
