//! RAPID's own data: tool0, wobj0, load0, speeds and zones.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::paths::zone::PREDEFINED as ZONES;
use crate::rapid::data::data_type::DataType;
use crate::rapid::data::parts::Part;
use crate::rapid::data::records::{LoadData, SpeedData, ToolData, WobjData, ZoneData};

static TOOL0: ToolData = ToolData::TOOL0;
static WOBJ0: WobjData = WobjData::WOBJ0;
static LOAD0: LoadData = LoadData::LOAD0;

/// The speeds by the digits of their names, with that of the tool center point [mm/s]. A controller
/// has a vmax of its own robot; here it is more than any robot reaches.
/// Source: the speeddata table of the RAPID reference manual.
const SPEEDS: [(&str, f64); 26] = [
    ("5", 5.0),
    ("10", 10.0),
    ("20", 20.0),
    ("30", 30.0),
    ("40", 40.0),
    ("50", 50.0),
    ("60", 60.0),
    ("80", 80.0),
    ("100", 100.0),
    ("150", 150.0),
    ("200", 200.0),
    ("300", 300.0),
    ("400", 400.0),
    ("500", 500.0),
    ("600", 600.0),
    ("800", 800.0),
    ("1000", 1000.0),
    ("1500", 1500.0),
    ("2000", 2000.0),
    ("2500", 2500.0),
    ("3000", 3000.0),
    ("4000", 4000.0),
    ("5000", 5000.0),
    ("6000", 6000.0),
    ("7000", 7000.0),
    ("max", 10_000.0),
];

static SPEED_DATA: [SpeedData; SPEEDS.len()] = {
    let mut data = [speed(0.0); SPEEDS.len()];
    let mut i = 0;
    while i < data.len() {
        data[i] = speed(SPEEDS[i].1);
        i += 1;
    }
    data
};

const fn speed(v_tcp_mm_s: f64) -> SpeedData {
    SpeedData { v_tcp_mm_s, v_ori_deg_s: 500.0, v_leax_mm_s: 5000.0, v_reax_deg_s: 1000.0 }
}

static ZONE_DATA: [ZoneData; ZONES.len()] = {
    let mut data = [zone(0); ZONES.len()];
    let mut i = 0;
    while i < data.len() {
        data[i] = zone(i);
        i += 1;
    }
    data
};

/// External axes have the numbers of the reorientation. The first one is `fine`.
const fn zone(index: usize) -> ZoneData {
    let (_, tcp, ori, degrees) = ZONES[index];
    ZoneData {
        finep: index == 0,
        pzone_tcp_mm: tcp,
        pzone_ori_mm: ori,
        pzone_eax_mm: ori,
        zone_ori_deg: degrees,
        zone_leax_mm: ori,
        zone_reax_deg: degrees,
    }
}

/// The names of RAPID's own data of a type.
pub(crate) fn predefined_names(data_type: DataType) -> Vec<String> {
    match data_type {
        DataType::ToolData => Vec::from(["tool0".to_string()]),
        DataType::WobjData => Vec::from(["wobj0".to_string()]),
        DataType::LoadData => Vec::from(["load0".to_string()]),
        DataType::SpeedData => SPEEDS.iter().map(|(digits, _)| format!("v{digits}")).collect(),
        DataType::ZoneData => ZONES.iter().map(|(name, ..)| (*name).to_string()).collect(),
        _ => Vec::new(),
    }
}

/// The datum of RAPID's own with a name in lower case.
pub(crate) fn predefined(lower: &str) -> Option<Part<'static>> {
    match lower.as_bytes().first()? {
        b't' if lower == "tool0" => Some(Part::ToolData(&TOOL0)),
        b'w' if lower == "wobj0" => Some(Part::WobjData(&WOBJ0)),
        b'l' if lower == "load0" => Some(Part::LoadData(&LOAD0)),
        b'v' => {
            let digits = &lower[1..];
            let place = SPEEDS.iter().position(|(name, _)| *name == digits)?;
            SPEED_DATA.get(place).map(Part::SpeedData)
        }
        b'f' | b'z' => {
            let place = ZONES.iter().position(|(name, ..)| *name == lower)?;
            ZONE_DATA.get(place).map(Part::ZoneData)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_and_zones_have_the_numbers_of_their_names() {
        for (name, millimeters) in &SPEEDS[..25] {
            assert_eq!(name.parse(), Ok(*millimeters));
            let Some(Part::SpeedData(speed)) = predefined(&format!("v{name}")) else { panic!() };
            assert_eq!((speed.v_tcp_mm_s, speed.v_ori_deg_s), (*millimeters, 500.0));
        }
        for (name, millimeters, ..) in &ZONES[2..] {
            assert_eq!(name[1..].parse(), Ok(*millimeters));
            let Some(Part::ZoneData(zone)) = predefined(name) else { panic!() };
            assert_eq!((zone.finep, zone.pzone_tcp_mm), (false, *millimeters));
        }
        let Some(Part::ZoneData(fine)) = predefined("fine") else { panic!() };
        assert!(fine.finep);
        for name in ["", "v", "v7", "z", "z2", "fin", "tool", "wobj", "l", "V100", "\u{e9}"] {
            assert!(predefined(name).is_none(), "{name}");
        }
    }
}
