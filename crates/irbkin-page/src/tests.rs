//! Laws of the answers: they agree with the crate, and nothing panics.

use crate::Page;
use crate::robot::Arms;
use irbkin::pose;
use irbkin_motion::Arm;
use serde_json::{Value, json};

const YUMI: &str = "IRB 14000-0.5/0.5 (left)";
/// Names of arms of each structure, and joint angles [rad] that are at no singularity.
const ARMS: [(&str, usize); 6] = [
    ("IRB 2600-12/1.65", 6),
    ("IRB 2400-16/1.55", 6),
    ("UR5e", 6),
    ("CRB 15000-5/0.95", 6),
    ("Panda", 7),
    (YUMI, 7),
];
const Q: [f64; 7] = [0.3, -0.4, 0.2, -0.9, 0.6, 0.7, 0.5];

const MODULE: &str = "MODULE Weld
    CONST robtarget p10:=[[900,0,1000],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveJ p10,v500,fine,tool0;
        MoveL Offs(p10,0,0,-150),v100,fine,tool0;
    ENDPROC
ENDMODULE";

fn asked(page: &mut Page, request: &Value) -> Value {
    serde_json::from_str(&page.answer(&request.to_string())).unwrap()
}

fn granted(page: &mut Page, request: &Value) -> Value {
    let mut answer = asked(page, request);
    assert!(answer["error"].is_null(), "{request}: {answer}");
    answer["ok"].take()
}

fn refused(page: &mut Page, request: &Value) -> String {
    let answer = asked(page, request);
    answer["error"].as_str().unwrap_or_else(|| panic!("{request}: {answer}")).to_owned()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect()
}

fn with_arm(name: &str) -> Page {
    let mut page = Page::default();
    granted(&mut page, &json!({"do": "robot", "name": name}));
    page
}

#[track_caller]
fn assert_near(one: &[f64], other: &[f64]) {
    assert_eq!(one.len(), other.len());
    assert!(one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-12), "{one:?} {other:?}");
}

#[test]
fn the_fixed_transforms_of_a_robot_give_its_frames() {
    for (name, dof) in ARMS {
        let mut page = Page::default();
        let tool = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0].map(f64::from);
        let request = json!({"do": "robot", "name": name, "tool": tool, "base_pose": tool});
        let arm = granted(&mut page, &request);
        let posture = granted(&mut page, &json!({"do": "fk", "q": Q[..dof]}));
        let read = |rows: &Value| {
            let rows: Vec<_> = [numbers(rows), vec![0.0, 0.0, 0.0, 1.0]].concat();
            pose::from_rows(&rows.try_into().unwrap()).unwrap()
        };
        let mut frame = read(&arm["base"]);
        let mut q = Q;
        q[2] -= arm["coupling"].as_f64().unwrap() * q[1];
        for joint in 0..dof {
            let turn = pose::from_euler_zyx([0.0; 3], [q[joint], 0.0, 0.0]).unwrap();
            frame = frame * read(&arm["links"][joint]) * turn;
            assert_near(&pose::to_rows(&frame)[..12], &numbers(&posture["frames"][joint]));
        }
        frame = frame * read(&arm["flange"]) * read(&arm["tool"]);
        assert_near(&pose::to_rows(&frame)[..12], &numbers(&posture["tool"]));
        assert_eq!(arm["body"]["links"].as_array().unwrap().len(), dof + 2);
    }
}

#[test]
fn every_solution_closes_and_the_seed_is_the_nearest() {
    for (name, dof) in ARMS {
        let mut page = with_arm(name);
        let q = &Q[..dof];
        let reached = granted(&mut page, &json!({"do": "fk", "q": q}));
        let mut request = json!({"do": "ik", "T": reached["tool"], "seed": q, "collide": true});
        if dof == 7 {
            request["q7"] = json!(q[6]);
        }
        let found = granted(&mut page, &request);
        let solutions = found["solutions"].as_array().unwrap();
        assert!(!solutions.is_empty());
        for solution in solutions {
            let again = granted(&mut page, &json!({"do": "fk", "q": solution["q"]}));
            let (tool, wanted) = (numbers(&again["tool"]), numbers(&reached["tool"]));
            assert!(tool.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-9));
            assert!(solution["collides"].is_boolean());
        }
        let index = usize::try_from(found["nearest"]["index"].as_u64().unwrap()).unwrap();
        assert!(index < solutions.len());
        let nearest = numbers(&found["nearest"]["q"]);
        assert!(nearest.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-7), "{name} {nearest:?}");
    }
}

#[test]
fn out_of_reach_has_a_reason() {
    for (name, dof) in ARMS {
        let mut page = with_arm(name);
        let mut pose = granted(&mut page, &json!({"do": "fk", "q": Q[..dof]}))["tool"].take();
        pose[3] = json!(11.0);
        let found = granted(&mut page, &json!({"do": "ik", "T": pose, "seed": Q[..dof]}));
        assert!(found["reason"].is_string() && found["nearest"].is_null());
    }
}

#[test]
fn a_cell_is_kept_and_a_contact_is_named() {
    let mut page = with_arm("IRB 2600-12/1.65");
    let pose = granted(&mut page, &json!({"do": "fk", "q": Q[..6]}))["tool"].take();
    let center = [&pose[3], &pose[7], &pose[11]];
    let ball = json!({"name": "ball", "shape": "sphere", "radius": 0.1, "center": center});
    granted(&mut page, &json!({"do": "cell", "obstacles": [ball]}));
    let posture = granted(&mut page, &json!({"do": "fk", "q": Q[..6], "collide": true}));
    let contact = &posture["contact"];
    assert_eq!((&contact["collides"], &contact["near"]), (&json!(true), &json!("ball")));
    assert!(contact["depth"].as_f64().unwrap() > 0.05);
    let far =
        json!({"name": "far", "shape": "capsule", "a": [9, 0, 0], "b": [9, 1, 0], "radius": 0.1});
    let tube =
        json!({"name": "tube", "shape": "cylinder", "radius": 0.1, "length": 1, "pose": pose});
    granted(&mut page, &json!({"do": "cell", "obstacles": [far]}));
    let posture = granted(&mut page, &json!({"do": "fk", "q": Q[..6], "collide": true}));
    assert_eq!(posture["contact"]["collides"], false);
    granted(&mut page, &json!({"do": "cell", "obstacles": [tube], "margin": 0.01}));
}

#[test]
fn targets_mean_poses_or_joints() {
    let mut page = with_arm("IRB 2600-12/1.65");
    let text = "CONST robtarget p10:=[[900,0,1000],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];";
    let meant = granted(&mut page, &json!({"do": "ik_target", "robtarget": text}));
    assert_eq!((&meant["name"], &meant["confdata"]), (&json!("p10"), &json!([0, 0, 0, 0])));
    assert_eq!(numbers(&meant["T"])[3], 0.9);
    assert_eq!(meant["extax"], json!([null, null, null, null, null, null]));
    let text = "[[0,10,20,0,30,-180],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let meant = granted(&mut page, &json!({"do": "ik_target", "robtarget": text}));
    assert_eq!(numbers(&meant["q"])[1], 10_f64.to_radians());
    let words = refused(&mut page, &json!({"do": "ik_target", "robtarget": "[1,2,3]"}));
    assert!(words.contains("[1,2,3]"), "{words}");
    let words = refused(&mut page, &json!({"do": "ik_target", "robtarget": "VAR num n:=1;"}));
    assert!(words.contains("a num, it must be a robtarget"), "{words}");
    // A robot in its work object meets a target with its arm angle as one in the world does.
    let seven = "[[325.00229,483.78301,864.45859],[0.511069,-0.225138,0.668941,0.490549],\
                 [0,1,0,4],[-70.63875,9E9,9E9,9E9,9E9,9E9]]";
    let placed = json!([0, -1, 0, 0.3, 1, 0, 0, -0.2, 0, 0, 1, 0.1]);
    let mut page = with_arm(YUMI);
    let wanted = granted(&mut page, &json!({"do": "ik_target", "robtarget": seven}));
    granted(&mut page, &json!({"do": "robot", "name": YUMI, "base_pose": placed}));
    let target = json!({"do": "ik_target", "robtarget": seven, "wobj": placed});
    let found = granted(&mut page, &target);
    assert_eq!(numbers(&wanted["q"]).len(), 7, "{wanted}");
    let pairs = numbers(&found["q"]).into_iter().zip(numbers(&wanted["q"]));
    assert!(pairs.into_iter().all(|(one, other)| (one - other).abs() < 1e-9), "{found} {wanted}");
    // Axis 7 is not there.
    let mut page = with_arm(YUMI);
    let words = refused(&mut page, &json!({"do": "ik_target", "robtarget": text}));
    assert!(words.starts_with("joint 3 of the jointtarget is 9e9 deg"), "{words}");
}

#[test]
fn tools_and_work_objects_mean_frames() {
    let mut page = with_arm("IRB 2600-12/1.65");
    let load = "[1,[0,0,50],[1,0,0,0],0,0,0]";
    let tool = format!("PERS tooldata tGun:=[TRUE,[[0,10,180],[1,0,0,0]],{load}];");
    let wobj = r#"[FALSE,TRUE,"",[[500,0,0],[0,0,0,1]],[[0,100,0],[1,0,0,0]]]"#;
    let meant = granted(&mut page, &json!({"do": "ik_target", "robtarget": tool}));
    assert_eq!((&meant["kind"], &meant["name"]), (&json!("tooldata"), &json!("tGun")));
    assert_eq!(numbers(&meant["T"])[7], 0.01);
    let meant = granted(&mut page, &json!({"do": "ik_target", "robtarget": wobj}));
    assert_eq!((&meant["kind"], &meant["name"]), (&json!("wobjdata"), &json!(null)));
    assert_eq!(numbers(&meant["T"])[7], -0.1);
    for (text, words) in [
        (tool.replace("TRUE", "FALSE"), "robhold of the tooldata is FALSE"),
        (wobj.replace("TRUE", "FALSE"), "the work object moves"),
    ] {
        let refused = refused(&mut page, &json!({"do": "ik_target", "robtarget": text}));
        assert!(refused.contains(words), "{refused}");
    }
}

#[test]
fn an_arm_gets_as_far_as_it_reaches_towards_a_pose() {
    for (name, dof) in ARMS {
        let mut page = with_arm(name);
        let robot = granted(&mut page, &json!({"do": "fk", "q": Q[..dof]}));
        let mut far = numbers(&robot["tool"]);
        let from = far[3];
        far[3] += 5.0;
        let found = granted(&mut page, &json!({"do": "ik", "T": far, "seed": Q[..dof]}));
        assert!(found["nearest"].is_null());
        let q = numbers(&found["towards"]);
        let reached = numbers(&granted(&mut page, &json!({"do": "fk", "q": q}))["tool"]);
        assert!(reached[3] > from, "{name} {reached:?}");
        assert!(
            reached.iter().zip(&far).enumerate().all(|(i, (a, b))| i == 3 || (a - b).abs() < 1e-6)
        );
        far[3] = reached[3] + 5.0 / 1000.0;
        let further = granted(&mut page, &json!({"do": "ik", "T": far, "seed": q}));
        let jumps = || {
            let pairs = numbers(&further["nearest"]["q"]).into_iter().zip(q.iter());
            pairs.into_iter().any(|(one, other)| (one - other).abs() >= 1.0)
        };
        assert!(further["nearest"].is_null() || jumps(), "{name} {further}");
    }
}

#[test]
fn a_finding_has_what_corrects_it() {
    let mut page = with_arm("IRB 2600-12/1.65");
    let modules = json!([{"text": MODULE.replace("[0,0,0,0]", "[1,0,0,0]")}]);
    let checked = granted(&mut page, &json!({"do": "check", "modules": modules}));
    let edits: Vec<_> = checked["findings"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|it| it["edits"].get(0))
        .collect();
    let text = modules[0]["text"].as_str().unwrap();
    let at = |name: &str| usize::try_from(edits[0][name].as_u64().unwrap()).unwrap();
    assert_eq!(&text[at("begin")..at("end")], "1", "{edits:?}");
    assert_eq!(edits[0]["text"], "0");
}

#[test]
fn a_program_is_checked_and_played() {
    let mut page = with_arm("IRB 2600-12/1.65");
    let words = refused(&mut page, &json!({"do": "motion"}));
    assert!(words.starts_with("there is no program"));
    let modules = json!([{"text": MODULE}]);
    let checked = granted(&mut page, &json!({"do": "check", "modules": modules, "collide": true}));
    assert_eq!(checked["procedures"], json!([{"module": 0, "name": "main"}]));
    let moves = checked["moves"].as_array().unwrap();
    assert_eq!(moves.len(), 2);
    assert_eq!(moves[1]["instruction"], "MoveL");
    assert_eq!(moves[1]["target"], "Offs(p10,0,0,-150)");
    assert!(moves.iter().all(|it| it["q"].is_array() && it["unchecked"].is_null()));
    let motion = granted(&mut page, &json!({"do": "motion", "routine": "main"}));
    let samples = motion["t"].as_array().unwrap().len();
    assert_eq!(numbers(&motion["q"]).len(), 6 * samples);
    assert_eq!(motion["move_index"].as_array().unwrap().len(), samples);
    assert_eq!(motion["thinned"], false);
    let words = refused(&mut page, &json!({"do": "motion", "routine": "weld"}));
    assert!(words.contains("weld"), "{words}");
    let broken = json!({"do": "check", "modules": [{"text": "MODULE A MoveL; ENDMODULE"}]});
    let faults = granted(&mut page, &broken)["faults"].take();
    assert!(faults.as_array().is_some_and(|faults| !faults.is_empty()));
}

#[test]
fn modules_are_read_together_and_the_tool_is_on_the_way() {
    let mut page = with_arm("IRB 2600-12/1.65");
    let data = "MODULE Data PERS tooldata tGun:=[TRUE,[[0,0,200],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]; \
                PERS robtarget p10:=[[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]; ENDMODULE";
    let moves = "MODULE Moves PROC weld() MoveJ p10,v100,fine,tGun; \
                 MoveL Offs(p10,0,100,0),v100,fine,tGun; ENDPROC ENDMODULE";
    let modules = json!([{"text": data}, {"text": moves}]);
    let checked = granted(&mut page, &json!({"do": "check", "modules": modules}));
    assert_eq!(checked["procedures"], json!([{"module": 1, "name": "weld"}]));
    assert!(
        checked["moves"]
            .as_array()
            .unwrap()
            .iter()
            .all(|it| it["module"] == 1 && it["q"].is_array())
    );
    let motion = granted(&mut page, &json!({"do": "motion", "module": 1, "routine": "weld"}));
    assert!(motion["moves"].as_array().unwrap().iter().all(|it| it["module"] == 1));
    let way = numbers(&motion["way"]);
    let (first, last) = (&way[..3], &way[way.len() - 3..]);
    for (found, wanted) in first.iter().chain(last).zip([0.9, 0.0, 0.9, 0.9, 0.1, 0.9]) {
        assert!((found - wanted).abs() < 1e-12, "{way:?}");
    }
    for (module, words) in [(2, "module is 2, it must be 0 to 1"), (0, "weld")] {
        let found =
            refused(&mut page, &json!({"do": "motion", "module": module, "routine": "weld"}));
        assert!(found.contains(words), "{found}");
    }
    let none = refused(&mut page, &json!({"do": "check", "modules": []}));
    assert_eq!(none, "modules has 0 items, it must have at least one");
}

#[test]
fn a_urdf_is_read() {
    let mut page = Page::default();
    let robot: Arm<6> = Arm::named("UR5e").unwrap();
    let text = robot.to_urdf();
    let arm = granted(&mut page, &json!({"do": "robot", "urdf": text}));
    assert_eq!(arm["structure"], "three parallel axes");
    let posture = granted(&mut page, &json!({"do": "fk", "q": Q[..6]}));
    let rows = pose::to_rows(&robot.fk(&Q[..6].try_into().unwrap()));
    assert!(rows.iter().zip(numbers(&posture["tool"])).all(|(a, b)| (a - b).abs() < 1e-9));
    let words = refused(&mut page, &json!({"do": "robot", "urdf": text, "tip": "hand"}));
    assert!(words.contains("hand"), "{words}");
}

#[test]
fn every_request_names_the_wrong_field() {
    let mut page = Page::default();
    let words = refused(&mut page, &json!({"do": "fk", "q": Q[..6]}));
    assert!(words.starts_with("there is no robot"));
    granted(&mut page, &json!({"do": "robot", "name": "irb 2600 12/1.65"}));
    let mirrored = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0];
    for (request, begins) in [
        (json!([]), "a request must be an object"),
        (json!({}), "do is missing"),
        (json!({"do": 3}), "do is a number, it must be a text"),
        (json!({"do": "robot"}), "name is missing"),
        (
            json!({"do": "robot", "name": "UR5e", "tool": [1]}),
            "tool has 1 numbers, it must have 12",
        ),
        (json!({"do": "robot", "name": "UR5e", "tool": mirrored}), "tool: "),
        (json!({"do": "ik", "T": 3}), "T is a number, it must be a list of 12 numbers"),
        (json!({"do": "ik", "T": mirrored}), "T: "),
        (json!({"do": "ik"}), "T is missing: it must be 12 numbers"),
        (json!({"do": "fk", "q": Q[..6], "collide": 1}), "collide is a number"),
        (json!({"do": "fk", "q": [0, 0, 0, 0, null, 0]}), "q[4] is null, it must be a number"),
        (json!({"do": "cell", "obstacles": [3]}), "obstacles[0] is a number, it must be an object"),
        (
            json!({"do": "cell", "obstacles": [{"name": "a", "shape": "sphere", "radius": -1,
                "center": [0, 0, 0]}]}),
            "obstacles[0]: ",
        ),
        (json!({"do": "cell", "obstacles": vec![json!({}); 1001]}), "obstacles has 1001 items"),
    ] {
        let words = refused(&mut page, &request);
        assert!(words.starts_with(begins), "{words}, expected {begins}");
    }
    let mut page = with_arm("Panda");
    let pose = granted(&mut page, &json!({"do": "fk", "q": Q}))["tool"].take();
    let words = refused(&mut page, &json!({"do": "ik", "T": pose}));
    assert!(words.starts_with("q7 is missing, and so is seed"));
    let words = refused(&mut page, &json!({"do": "ik", "T": pose, "q7": 1e6}));
    assert_eq!(words, "q7 = 1e6, it must be at most 1e5");
}

#[test]
fn the_catalog_has_every_arm_and_each_is_drawn() {
    let mut page = Page::default();
    let catalog = granted(&mut page, &json!({"do": "catalog"}));
    let arms = catalog["arms"].as_array().unwrap();
    assert_eq!(arms.len(), irbkin::catalog().count());
    for arm in arms {
        let drawn = granted(&mut page, &json!({"do": "robot", "name": arm["name"]}));
        assert_eq!([&drawn["name"], &drawn["dof"]], [&arm["name"], &arm["dof"]]);
        assert!(drawn["body"].is_object());
    }
}

#[test]
fn hulls_are_those_of_the_body_with_faces_of_their_points() {
    let mut page = Page::default();
    for name in ["UR5e", "Panda", "IRB 140-6/0.81"] {
        let drawn = granted(&mut page, &json!({"do": "robot", "name": name}));
        let robot = irbkin_motion::AnyArm::named(name).unwrap();
        let body = irbkin::on!(Arms::from(robot), robot => robot.body().cloned());
        let wanted = body.as_ref().map_or(&[][..], |body| body.hulls());
        let hulls = drawn["body"]["hulls"].as_array().unwrap();
        assert_eq!(hulls.len(), wanted.len());
        for (hull, wanted) in hulls.iter().zip(wanted) {
            assert_eq!(hull["link"], json!(wanted.link));
            assert_eq!(hull["faces"], json!(wanted.hull.faces()));
            // The reader of this test rounds the last digit.
            let points = hull["points"].as_array().unwrap();
            assert_eq!(points.len(), wanted.hull.points().count());
            let pairs = points.iter().zip(wanted.hull.points());
            let pairs = pairs.flat_map(|(found, wanted)| numbers(found).into_iter().zip(wanted));
            assert!(pairs.into_iter().all(|(found, wanted)| (found - wanted).abs() < 1e-15));
            assert!((hull["radius"].as_f64().unwrap() - wanted.hull.radius()).abs() < 1e-15);
        }
    }
}
