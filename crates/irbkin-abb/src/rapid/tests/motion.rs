//! Speeds, zones and what sets how moves are made.

use std::format;
use std::string::ToString;
use std::vec::Vec;

use super::*;
use crate::rapid::{CirPathMode, MotionSettings, Move, SingArea, SpeedData, ZoneData};

const DATA: &str = "CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];";

fn moves(text: &str) -> Vec<Move> {
    let module = read(&format!("MODULE M\n{DATA}\n{text}\nENDMODULE"));
    again(&module, &[]);
    module.moves().to_vec()
}

/// The speed of the tool [mm/s] and the radius of the zone [mm] of a move.
fn pace(step: &Move) -> (f64, f64) {
    (step.speed.value.clone().unwrap().v_tcp_mm_s, step.zone.value.clone().unwrap().pzone_tcp_mm)
}

#[test]
fn speeds_and_zones_are_those_of_rapid_or_of_the_module() {
    let moves = moves(
        "CONST speeddata vOwn:=[123,45,6,7]; CONST zonedata zOwn:=[FALSE,12,18,18,1.8,18,1.8];
         CONST speeddata v100:=[99,500,5000,1000]; CONST speeddata vHalf:=[v200.v_tcp/2,1,2,3];
         PROC main()
         MoveL p,v200,z10,tool0; MoveL p,V7000,FINE,tool0; MoveL p,vmax,z0,tool0;
         MoveL p,vOwn,zOwn,tool0; MoveL p,v100,z200,tool0; MoveL p,vHalf,z1,tool0;
         MoveL p,[1,2,3,4],[TRUE,0,0,0,0,0,0],tool0;
         ENDPROC",
    );
    let found: Vec<_> = moves.iter().map(pace).collect();
    let wanted = [
        (200.0, 10.0),
        (7000.0, 0.0),
        (10_000.0, 0.3),
        (123.0, 12.0),
        (99.0, 200.0),
        (100.0, 1.0),
        (1.0, 0.0),
    ];
    assert_eq!(found, wanted);
    let fine: Vec<_> = moves.iter().map(|step| step.zone.value.clone().unwrap().finep).collect();
    assert_eq!(fine, [false, true, false, false, false, false, true]);
    let z50 = ZoneData {
        finep: false,
        pzone_tcp_mm: 50.0,
        pzone_ori_mm: 75.0,
        pzone_eax_mm: 75.0,
        zone_ori_deg: 7.5,
        zone_leax_mm: 75.0,
        zone_reax_deg: 7.5,
    };
    let again = read(&format!("CONST zonedata z:=z50; CONST zonedata w:={z50};"));
    assert_eq!(single(&again, "z"), Value::ZoneData(z50));
    assert_eq!(single(&again, "z"), single(&again, "w"));
}

#[test]
fn a_module_of_the_context_may_declare_them_too() {
    let other = read("MODULE Other CONST speeddata v50:=[51,500,5000,1000]; ENDMODULE");
    let module = parse(
        &format!("MODULE M {DATA} PROC main() MoveL p,v50,z1,tool0; ENDPROC ENDMODULE"),
        &[&other],
    );
    assert_eq!(pace(&module.unwrap().moves()[0]), (51.0, 1.0));
}

#[test]
fn options_replace_parts_of_the_speed_and_of_the_zone() {
    let moves = moves(
        "PROC go(num n \\num T)
         MoveL p,v200\\V:=2*30,z10\\Z:=7,tool0; MoveJ p,v200\\T:=5,fine\\Inpos:=inpos20,tool0;
         MoveL p,v200\\T?T,z10\\Z?Z,tool0; MoveL p,v200\\V:=n,z10\\Z,tool0;
         MoveL p,vUnknown,z10,tool0; MoveL p,vUnknown\\V:=5,z10,tool0;
         ENDPROC",
    );
    assert_eq!(pace(&moves[0]), (60.0, 7.0));
    assert_eq!(moves[0].zone.value.clone().unwrap().pzone_ori_mm, 15.0);
    assert_eq!((moves[0].time.as_deref(), moves[1].time.as_deref()), (None, Some(&Ok(5.0))));
    let optional = "it depends on whether an optional argument is there";
    assert_eq!(words(&moves[2].time.clone().unwrap()), optional);
    assert_eq!(words(&moves[2].zone.value), optional);
    assert_eq!(words(&moves[3].speed.value), "refers to n, a parameter of go");
    assert_eq!(words(&moves[3].zone.value), "it is not finished");
    for step in &moves[4..] {
        assert_eq!(words(&step.speed.value), "refers to vUnknown, which is not in this module");
    }
}

#[test]
fn a_speed_that_is_assigned_is_not_known_where_the_program_moves() {
    let moves = moves(
        "VAR speeddata v:=[10,500,5000,1000];
         PROC main() v:=v100; v.v_tcp:=5; MoveL p,v,z1,tool0; ENDPROC",
    );
    assert_eq!(words(&moves[0].speed.value), "refers to v, which line 4 assigns");
}

#[test]
fn another_type_is_no_speed_and_no_zone() {
    let of = |arguments: &str| fault(&format!("MoveL *,{arguments},tool0;"));
    assert_eq!(of("100,z1"), "line 1, column 9: MoveL speed is a number, it must be speeddata");
    assert_eq!(
        of("v100,v100"),
        "line 1, column 14: MoveL zone is v100, of type speeddata, it must be zonedata"
    );
    assert_eq!(
        fault("CONST zonedata z:=[0,1,1,1,1,1,1];"),
        "line 1, column 20: zonedata z: finep is a number, it must be TRUE or FALSE"
    );
}

#[test]
fn instructions_set_how_the_moves_after_them_are_made() {
    let step = "MoveL p,v1,z1,tool0;";
    let text = format!(
        "PROC main()
         {step} ConfL\\Off; confj \\OFF ; SingArea \\Wrist; CirPathMode\\CirPointOri; {step}
         ConfL\\On; ConfJ; SingArea\\LockAxis4; CirPathMode \\Wrist45; {step}
         SingArea; CirPathMode\\ObjectFrame; {step}
         ENDPROC
         PROC other() {step} ENDPROC"
    );
    let settings = |conf, sing_area, cir_path_mode| MotionSettings {
        conf_l: conf,
        conf_j: conf,
        sing_area,
        cir_path_mode,
    };
    let found: Vec<_> = moves(&text).iter().map(|step| step.settings).collect();
    let wanted = [
        MotionSettings::default(),
        settings(false, SingArea::Wrist, CirPathMode::CirPointOri),
        settings(true, SingArea::LockAxis4, CirPathMode::Wrist45),
        settings(true, SingArea::Off, CirPathMode::ObjectFrame),
        MotionSettings::default(),
    ];
    assert_eq!(found, wanted);
    let module = read(&text);
    assert!(module.skipped().is_empty(), "{:?}", module.skipped());
    assert!(module.to_string().contains("\n    confj \\OFF ;\n"), "{module}");
}

#[test]
fn what_is_not_as_rapid_has_it_sets_nothing() {
    let module = read(&format!(
        "PROC main() ConfL\\Of; SingArea \\Wrist?w; ConfJ Off; ConfL:=1; MoveL *,v1,z1,tool0; \
         ENDPROC {DATA}"
    ));
    assert_eq!(module.moves()[0].settings, MotionSettings::default());
    assert_eq!(
        not_read(&module),
        [
            "ConfL is not an instruction that is read",
            "SingArea is not an instruction that is read",
            "ConfJ is not an instruction that is read",
            "ConfL is assigned a value, which is not followed",
        ]
    );
    let speed = SpeedData {
        v_tcp_mm_s: 1.0,
        v_ori_deg_s: 500.0,
        v_leax_mm_s: 5000.0,
        v_reax_deg_s: 1000.0,
    };
    assert_eq!(speed.to_string(), "[1,500,5000,1000]");
}
