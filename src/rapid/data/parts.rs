//! Values and their components: one table for reading, writing and component access.

use core::fmt;

use alloc::string::String;

use super::literals::{write_number, write_text};
use super::records::{
    JointTarget, LoadData, RapidPose, RobTarget, SpeedData, ToolData, WobjData, ZoneData,
};
use crate::report::Configuration;

/// Most components of a type: those of zonedata.
const MOST_COMPONENTS: usize = 7;

/// Components with their names, in order.
type Components<P> = [Option<(&'static str, P)>; MOST_COMPONENTS];

fn in_order<P, const N: usize>(components: [(&'static str, P); N]) -> Components<P> {
    let mut components = components.into_iter();
    core::array::from_fn(|_| components.next())
}

/// Defines the table, for parts that are read and for parts that are written.
macro_rules! parts {
    ($(#[$documentation:meta])* $Part:ident $(, $mutable:ident)?) => {
        $(#[$documentation])*
        pub(crate) enum $Part<'v> {
            Num(&'v $($mutable)? f64),
            /// A number of confdata.
            Whole(&'v $($mutable)? i32),
            Bool(&'v $($mutable)? bool),
            Text(&'v $($mutable)? String),
            Pos(&'v $($mutable)? [f64; 3]),
            Orient(&'v $($mutable)? [f64; 4]),
            ConfData(&'v $($mutable)? Configuration),
            ExtJoint(&'v $($mutable)? [f64; 6]),
            RobJoint(&'v $($mutable)? [f64; 6]),
            Pose(&'v $($mutable)? RapidPose),
            LoadData(&'v $($mutable)? LoadData),
            RobTarget(&'v $($mutable)? RobTarget),
            JointTarget(&'v $($mutable)? JointTarget),
            ToolData(&'v $($mutable)? ToolData),
            WobjData(&'v $($mutable)? WobjData),
            SpeedData(&'v $($mutable)? SpeedData),
            ZoneData(&'v $($mutable)? ZoneData),
        }

        impl<'v> $Part<'v> {
            /// Its type in RAPID.
            pub(crate) fn type_name(&self) -> &'static str {
                match self {
                    Self::Num(_) | Self::Whole(_) => "num",
                    Self::Bool(_) => "bool",
                    Self::Text(_) => "string",
                    Self::Pos(_) => "pos",
                    Self::Orient(_) => "orient",
                    Self::ConfData(_) => "confdata",
                    Self::ExtJoint(_) => "extjoint",
                    Self::RobJoint(_) => "robjoint",
                    Self::Pose(_) => "pose",
                    Self::LoadData(_) => "loaddata",
                    Self::RobTarget(_) => "robtarget",
                    Self::JointTarget(_) => "jointtarget",
                    Self::ToolData(_) => "tooldata",
                    Self::WobjData(_) => "wobjdata",
                    Self::SpeedData(_) => "speeddata",
                    Self::ZoneData(_) => "zonedata",
                }
            }

            /// Its components; none for an atomic type.
            pub(crate) fn components(self) -> Components<$Part<'v>> {
                use $Part::{
                    Bool, ConfData, ExtJoint, Num, Orient, Pos, Pose, RobJoint, Text, Whole,
                };
                match self {
                    Num(_) | Whole(_) | Bool(_) | Text(_) => in_order([]),
                    Pos([x, y, z]) => in_order([("x", Num(x)), ("y", Num(y)), ("z", Num(z))]),
                    Orient([w, x, y, z]) => {
                        in_order([("q1", Num(w)), ("q2", Num(x)), ("q3", Num(y)), ("q4", Num(z))])
                    }
                    ConfData(Configuration { cf1, cf4, cf6, cfx }) => in_order([
                        ("cf1", Whole(cf1)),
                        ("cf4", Whole(cf4)),
                        ("cf6", Whole(cf6)),
                        ("cfx", Whole(cfx)),
                    ]),
                    ExtJoint([a, b, c, d, e, f]) => in_order([
                        ("eax_a", Num(a)),
                        ("eax_b", Num(b)),
                        ("eax_c", Num(c)),
                        ("eax_d", Num(d)),
                        ("eax_e", Num(e)),
                        ("eax_f", Num(f)),
                    ]),
                    RobJoint([q1, q2, q3, q4, q5, q6]) => in_order([
                        ("rax_1", Num(q1)),
                        ("rax_2", Num(q2)),
                        ("rax_3", Num(q3)),
                        ("rax_4", Num(q4)),
                        ("rax_5", Num(q5)),
                        ("rax_6", Num(q6)),
                    ]),
                    Pose(RapidPose { trans_mm, rot }) => {
                        in_order([("trans", Pos(trans_mm)), ("rot", Orient(rot))])
                    }
                    Self::LoadData(LoadData { mass_kg, cog_mm, aom, inertia: [ix, iy, iz] }) => {
                        in_order([
                            ("mass", Num(mass_kg)),
                            ("cog", Pos(cog_mm)),
                            ("aom", Orient(aom)),
                            ("ix", Num(ix)),
                            ("iy", Num(iy)),
                            ("iz", Num(iz)),
                        ])
                    }
                    Self::RobTarget(RobTarget { trans_mm, rot, robconf, extax }) => in_order([
                        ("trans", Pos(trans_mm)),
                        ("rot", Orient(rot)),
                        ("robconf", ConfData(robconf)),
                        ("extax", ExtJoint(extax)),
                    ]),
                    Self::JointTarget(JointTarget { robax_deg, extax }) => {
                        in_order([("robax", RobJoint(robax_deg)), ("extax", ExtJoint(extax))])
                    }
                    Self::ToolData(ToolData { robhold, tframe, tload }) => in_order([
                        ("robhold", Bool(robhold)),
                        ("tframe", Pose(tframe)),
                        ("tload", Self::LoadData(tload)),
                    ]),
                    Self::WobjData(WobjData { robhold, ufprog, ufmec, uframe, oframe }) => {
                        in_order([
                            ("robhold", Bool(robhold)),
                            ("ufprog", Bool(ufprog)),
                            ("ufmec", Text(ufmec)),
                            ("uframe", Pose(uframe)),
                            ("oframe", Pose(oframe)),
                        ])
                    }
                    Self::SpeedData(SpeedData {
                        v_tcp_mm_s,
                        v_ori_deg_s,
                        v_leax_mm_s,
                        v_reax_deg_s,
                    }) => in_order([
                        ("v_tcp", Num(v_tcp_mm_s)),
                        ("v_ori", Num(v_ori_deg_s)),
                        ("v_leax", Num(v_leax_mm_s)),
                        ("v_reax", Num(v_reax_deg_s)),
                    ]),
                    Self::ZoneData(zone) => in_order([
                        ("finep", Bool(&$($mutable)? zone.finep)),
                        ("pzone_tcp", Num(&$($mutable)? zone.pzone_tcp_mm)),
                        ("pzone_ori", Num(&$($mutable)? zone.pzone_ori_mm)),
                        ("pzone_eax", Num(&$($mutable)? zone.pzone_eax_mm)),
                        ("zone_ori", Num(&$($mutable)? zone.zone_ori_deg)),
                        ("zone_leax", Num(&$($mutable)? zone.zone_leax_mm)),
                        ("zone_reax", Num(&$($mutable)? zone.zone_reax_deg)),
                    ]),
                }
            }
        }
    };
}

parts!(
    /// A value or a component of one.
    #[derive(Clone, Copy, Debug)]
    Part
);

parts!(
    /// A value or a component of one, to be read from a text.
    #[derive(Debug)]
    PartMut,
    mut
);

impl<'v> Part<'v> {
    /// The component with a name, in any case.
    pub(crate) fn component(self, wanted: &str) -> Option<Part<'v>> {
        let mut components = self.components().into_iter().flatten();
        components.find(|(name, _)| name.eq_ignore_ascii_case(wanted)).map(|(_, part)| part)
    }

    /// Whether all of its numbers are finite.
    pub(crate) fn is_finite(self) -> bool {
        match self {
            Part::Num(number) => number.is_finite(),
            _ => self.components().into_iter().flatten().all(|(_, part)| part.is_finite()),
        }
    }

    /// Write it as RAPID does, without blanks.
    pub(crate) fn write(self, f: &mut impl fmt::Write) -> fmt::Result {
        match self {
            Part::Num(number) => return write_number(f, *number),
            Part::Whole(number) => return write_number(f, f64::from(*number)),
            Part::Bool(is) => return f.write_str(if *is { "TRUE" } else { "FALSE" }),
            Part::Text(text) => return write_text(f, text),
            _ => {}
        }
        for (i, (_, part)) in self.components().into_iter().flatten().enumerate() {
            f.write_char(if i == 0 { '[' } else { ',' })?;
            part.write(f)?;
        }
        f.write_char(']')
    }
}

impl PartMut<'_> {
    /// What is expected there, for a message.
    pub(crate) fn wanted(&self) -> &'static str {
        match self {
            PartMut::Num(_) | PartMut::Whole(_) => "a number",
            PartMut::Bool(_) => "TRUE or FALSE",
            PartMut::Text(_) => "a string",
            _ => self.type_name(),
        }
    }

    /// Copy a part of the same type; returns whether the types match.
    pub(crate) fn assign(self, from: Part<'_>) -> bool {
        match (self, from) {
            (PartMut::Num(to), Part::Num(from)) => to.clone_from(from),
            (PartMut::Whole(to), Part::Whole(from)) => to.clone_from(from),
            (PartMut::Bool(to), Part::Bool(from)) => to.clone_from(from),
            (PartMut::Text(to), Part::Text(from)) => to.clone_from(from),
            (PartMut::Pos(to), Part::Pos(from)) => to.clone_from(from),
            (PartMut::Orient(to), Part::Orient(from)) => to.clone_from(from),
            (PartMut::ConfData(to), Part::ConfData(from)) => to.clone_from(from),
            (PartMut::ExtJoint(to), Part::ExtJoint(from))
            | (PartMut::RobJoint(to), Part::RobJoint(from)) => to.clone_from(from),
            (PartMut::Pose(to), Part::Pose(from)) => to.clone_from(from),
            (PartMut::LoadData(to), Part::LoadData(from)) => to.clone_from(from),
            (PartMut::RobTarget(to), Part::RobTarget(from)) => to.clone_from(from),
            (PartMut::JointTarget(to), Part::JointTarget(from)) => to.clone_from(from),
            (PartMut::ToolData(to), Part::ToolData(from)) => to.clone_from(from),
            (PartMut::WobjData(to), Part::WobjData(from)) => to.clone_from(from),
            (PartMut::SpeedData(to), Part::SpeedData(from)) => to.clone_from(from),
            (PartMut::ZoneData(to), Part::ZoneData(from)) => to.clone_from(from),
            _ => return false,
        }
        true
    }
}
