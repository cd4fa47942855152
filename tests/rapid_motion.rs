//! Routines as one motion: paths, corners, speeds and limits hold; what is wrong is found.

use std::fmt::Write as _;

use crate::common::Rng;
use irbkin::nalgebra::Vector3;
use irbkin::{Pose, PoseDifference, Robot, pose};
use irbkin_abb::rapid::{
    Finding, JointTarget, Module, MotionOptions, NOT_THERE, RobTarget, RoutineMotion, ToolData,
    WobjData, calc_rob_t, motion, parse,
};

const TOOL: &str = "[TRUE,[[30,-20,180],[0.8,0,0.6,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]";
const WOBJ: &str = "[FALSE,TRUE,\"\",[[700,-200,300],[0.8,0,0,0.6]],[[10,20,30],[1,0,0,0]]]";

fn robot() -> Robot<6> {
    Robot::named("IRB 2600-12/1.65").unwrap()
}

/// Moves of a routine with a tool and a work object.
fn module(moves: &str) -> Module {
    let text = format!(
        "MODULE M\nPERS tooldata t:={TOOL}; PERS wobjdata w:={WOBJ};\nPROC main()\n{moves}\n\
         ENDPROC\nENDMODULE"
    );
    parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn moved(moves: &str, options: &MotionOptions) -> RoutineMotion {
    motion(&robot(), &[&module(moves)], None, options)
        .unwrap_or_else(|error| panic!("{error}\n{moves}"))
}

fn tool() -> ToolData {
    let Some(irbkin_abb::rapid::Content::Single(irbkin_abb::rapid::Value::ToolData(tool))) =
        module("").find("t").map(|datum| datum.content.clone())
    else {
        panic!()
    };
    tool
}

fn wobj() -> WobjData {
    let Some(irbkin_abb::rapid::Content::Single(irbkin_abb::rapid::Value::WobjData(wobj))) =
        module("").find("w").map(|datum| datum.content.clone())
    else {
        panic!()
    };
    wobj
}

/// The tool in the work object at joints [rad].
fn target(q: &[f64; 6]) -> RobTarget {
    let joints = JointTarget { robax_deg: q.map(f64::to_degrees), extax: [NOT_THERE; 6] };
    calc_rob_t(&robot(), &joints, Some(&tool()), Some(&wobj())).unwrap()
}

/// The same in meters.
fn tool_pose(q: &[f64; 6]) -> Pose {
    let target = target(q);
    pose::from_wxyz(target.trans_mm.map(|mm| mm * 1e-3), target.rot).unwrap()
}

/// A target by its pose [m] and the configuration of another one.
fn with_pose(pose: &Pose, like: &RobTarget) -> RobTarget {
    let (xyz, rot) = pose::to_wxyz(pose);
    RobTarget { trans_mm: xyz.map(|m| m * 1e3), rot, ..*like }
}

fn joints(q: &[f64; 6]) -> String {
    JointTarget { robax_deg: q.map(f64::to_degrees), extax: [NOT_THERE; 6] }.to_string()
}

fn names(findings: &[Finding]) -> Vec<&'static str> {
    findings.iter().map(|finding| finding.code.name()).collect()
}

/// Joints away from singularities and limits.
fn regular(rng: &mut Rng) -> [f64; 6] {
    [
        rng.between(-0.4, 0.4),
        rng.between(-0.3, 0.3),
        rng.between(-0.2, 0.3),
        rng.between(-0.5, 0.5),
        rng.between(0.6, 1.2),
        rng.between(-0.5, 0.5),
    ]
}

/// A random whole number below a count.
fn below(rng: &mut Rng, count: u64) -> usize {
    usize::try_from(rng.bits() % count).unwrap()
}

/// A random program of all kinds of moves.
fn program(rng: &mut Rng) -> String {
    let mut text =
        format!("MoveAbsJ {},v1000,z10,t\\WObj:=w;\nConfL\\Off;\n", joints(&regular(rng)));
    for _ in 0..8 {
        let speed = ["v20", "v200", "v1000", "vmax", "[300,20,1,1]"][below(rng, 5)];
        let zone = ["fine", "z1", "z20", "z100"][below(rng, 4)];
        let time = if below(rng, 4) == 0 { "\\T:=1.5" } else { "" };
        let end = format!("{speed}{time},{zone},t\\WObj:=w;");
        let (to, via) = (target(&regular(rng)), target(&regular(rng)));
        match below(rng, 5) {
            0 => writeln!(text, "MoveAbsJ {},{end}", joints(&regular(rng))),
            1 => writeln!(text, "MoveJ {to},{end}"),
            2 => writeln!(text, "MoveC {via},{to},{end}"),
            _ => writeln!(text, "MoveL {to},{end}"),
        }
        .unwrap();
    }
    text
}

#[test]
fn no_joint_exceeds_its_limits_and_samples_are_in_order() {
    let (mut rng, robot) = (Rng::new(51), robot());
    let velocity = *robot.max_velocity().unwrap();
    let (mut accelerated, mut arcs) = (0, 0);
    for round in 0..60 {
        let text = program(&mut rng);
        let acceleration = (round % 2 == 0).then_some([6.0; 6]);
        let options = MotionOptions { max_acceleration: acceleration, ..MotionOptions::default() };
        let made = moved(&text, &options);
        arcs += made.moves.iter().filter(|step| step.kind.name() == "MoveC").count();
        for (joint, peaks) in made.trajectory.peaks().iter().enumerate() {
            assert!(peaks.velocity <= velocity[joint] * (1.0 + 1e-9), "{text}");
            if acceleration.is_some() {
                accelerated += 1;
                assert!(peaks.acceleration <= 6.0 * (1.0 + 1e-9), "{text}");
            }
        }
        assert_eq!(made.t.len(), made.q.len());
        assert_eq!(made.t.len(), made.move_index.len());
        assert!(made.t.windows(2).all(|t| t[1] > t[0]) && made.move_index.is_sorted());
        assert_eq!(made.t[0], 0.0);
        assert_eq!(*made.t.last().unwrap(), made.trajectory.duration());
        assert!(made.q.iter().all(|q| robot.limits().contains(q)), "{text}");
        // The trajectory passes the samples.
        let rows = made.q.len() * 6;
        let [mut q, mut dq, mut ddq] = [(); 3].map(|()| vec![0.0; rows]);
        made.trajectory.sample(&made.t, &mut q, &mut dq, &mut ddq).unwrap();
        for (found, wanted) in q.iter().zip(made.q.as_flattened()) {
            assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
        }
        for (step, next) in made.moves.iter().zip(&made.moves[1..]) {
            assert_eq!(step.end, next.start);
        }
        for step in &made.moves {
            assert!(step.end >= step.start && step.q.is_some());
        }
    }
    assert!(accelerated > 100 && arcs > 20, "{accelerated} {arcs}");
}

#[test]
fn a_line_is_straight_in_the_work_object_at_its_speed() {
    let mut rng = Rng::new(52);
    let mut slowed = 0;
    for _ in 0..100 {
        let (start, end) = (regular(&mut rng), target(&regular(&mut rng)));
        let text = format!(
            "MoveAbsJ {},v1000,fine,t\\WObj:=w;\nConfL\\Off;\nMoveL {end},v100,fine,t\\WObj:=w;",
            joints(&start)
        );
        let made = moved(&text, &MotionOptions::default());
        if !made.moves[1].as_programmed {
            continue;
        }
        let (from, to) = (tool_pose(&start), tool_pose(made.q.last().unwrap()));
        let way = to.translation.vector - from.translation.vector;
        for q in &made.q {
            let at = tool_pose(q).translation.vector - from.translation.vector;
            assert!((at - way * (at.dot(&way) / way.norm_squared())).norm() < 1e-12);
        }
        let wanted = pose::from_wxyz(end.trans_mm.map(|mm| mm * 1e-3), end.rot).unwrap();
        assert!(PoseDifference::between(&to, &wanted).largest() < 1e-12);
        // 100 mm/s and 500 deg/s, whichever takes longer.
        let angle = PoseDifference::between(&from, &to).rotation;
        let programmed = (way.norm() / 0.1).max(angle / 500_f64.to_radians());
        if names(&made.findings).contains(&"joint-too-fast") {
            slowed += 1;
            assert!(made.trajectory.duration() > programmed);
        } else {
            assert!((made.trajectory.duration() - programmed).abs() < 1e-9 * programmed);
        }
        assert!((made.moves[1].length - way.norm()).abs() < 1e-12);
    }
    assert!(slowed < 50, "{slowed}");
}

/// A target that is moved by millimeters in the work object.
fn shifted(base: &RobTarget, by: [f64; 3]) -> RobTarget {
    let mut target = *base;
    for (position, by) in target.trans_mm.iter_mut().zip(by) {
        *position += by;
    }
    target
}

/// Three lines around two corners with a zone, from joints in the middle of the arm's reach.
fn corners(zone: &str, settings: &str) -> (String, RobTarget) {
    let q = [0.1, 0.1, 0.1, 0.2, 0.9, -0.3];
    let base = target(&q);
    let [a, b, c] =
        [[120.0, 0.0, 0.0], [120.0, 80.0, 0.0], [200.0, 140.0, 60.0]].map(|by| shifted(&base, by));
    let end = "t\\WObj:=w";
    let text = format!(
        "MoveAbsJ {},v1000,fine,{end};\nConfL\\Off;{settings}\nMoveL {a},v100,{zone},{end};\n\
         MoveL {b},v100,{zone},{end};\nMoveL {c},v100,fine,{end};",
        joints(&q)
    );
    (text, base)
}

#[test]
fn a_zone_is_passed_at_the_distance_of_a_parabola() {
    let (text, base) = corners("z20", "");
    let made = moved(&text, &MotionOptions { step: 1e-3, ..MotionOptions::default() });
    assert!(made.findings.is_empty(), "{:?}", made.findings);
    let corner = Vector3::from(shifted(&base, [120.0, 0.0, 0.0]).trans_mm) * 1e-3;
    let halfway = made.move_index.iter().rposition(|index| *index == 1).unwrap();
    let near = |q: &[f64; 6]| (tool_pose(q).translation.vector - corner).norm();
    // r / 2 sin(90 deg / 2)
    assert!((near(&made.q[halfway]) - 0.01 * 0.5_f64.sqrt()).abs() < 1e-12);
    let nearest = made.q.iter().map(near).fold(f64::INFINITY, f64::min);
    assert!((nearest - near(&made.q[halfway])).abs() < 1e-12);
    // The target itself is solved, too.
    assert!(near(&made.moves[1].q.unwrap()) < 1e-12);
    // Outside the zones the lines are met.
    let start = Vector3::from(base.trans_mm) * 1e-3;
    for (q, index) in made.q.iter().zip(&made.move_index) {
        let at = tool_pose(q).translation.vector;
        if *index <= 1 && (at - corner).norm() > 0.02 {
            assert!((at - start).cross(&(corner - start).normalize()).norm() < 1e-12);
        }
    }
    let (fine, _) = corners("fine", "");
    let fine = moved(&fine, &MotionOptions::default());
    assert!(fine.trajectory.duration() > made.trajectory.duration());
    let [_, met, ..] = &fine.moves[..] else { panic!() };
    let last = fine.move_index.iter().rposition(|index| *index == 1).unwrap();
    assert_eq!(fine.q[last], met.q.unwrap());
}

#[test]
fn a_corner_of_joint_moves_is_rounded_inside_its_zone() {
    let (a, b, c) = (
        [0.1, 0.1, 0.1, 0.2, 0.9, -0.3],
        [0.5, 0.0, 0.2, 0.1, 0.8, 0.0],
        [0.2, 0.3, 0.0, 0.4, 1.0, 0.3],
    );
    let end = "t\\WObj:=w";
    let text = |last: &str| {
        format!(
            "MoveAbsJ {},v1000,fine,{end}; MoveAbsJ {},v1000,z50,{end};\nConfL\\Off;\n{last}",
            joints(&a),
            joints(&b)
        )
    };
    for last in [
        format!("MoveAbsJ {},v1000,fine,{end};", joints(&c)),
        format!("MoveJ {},v1000,fine,{end};", target(&c)),
        format!("MoveL {},v1000,fine,{end};", target(&c)),
    ] {
        let made = moved(&text(&last), &MotionOptions::default());
        let corner = tool_pose(&b).translation.vector;
        let near = |q: &[f64; 6]| (tool_pose(q).translation.vector - corner).norm();
        let nearest = made.q.iter().map(near).fold(f64::INFINITY, f64::min);
        assert!(0.005 < nearest && nearest < 0.025, "{nearest}");
        assert_eq!(made.moves[1].q, Some(b.map(f64::to_degrees).map(f64::to_radians)));
        let off = |q: &[f64; 6]| {
            let part = (q[0] - a[0]) / (b[0] - a[0]);
            q.iter()
                .zip(a.iter().zip(&b))
                .map(|(q, (a, b))| (q - a - part * (b - a)).abs())
                .fold(0.0, f64::max)
        };
        for (q, index) in made.q.iter().zip(&made.move_index) {
            assert!(*index > 1 || near(q) < 0.051 || off(q) < 1e-12, "{last}");
        }
        let rested = moved(
            &text(&last),
            &MotionOptions { max_acceleration: Some([8.0; 6]), ..MotionOptions::default() },
        );
        assert!(rested.trajectory.duration() > made.trajectory.duration());
    }
}

#[test]
fn arcs_turn_the_tool_as_cir_path_mode_says() {
    let q = [0.1, 0.1, 0.1, 0.2, 0.9, -0.3];
    let base = target(&q);
    let pose = tool_pose(&q);
    let turned = |by: [f64; 3], turn: [f64; 3]| {
        let mut turned = pose;
        turned.translation.vector += Vector3::from(by);
        turned.rotation *= irbkin::nalgebra::Rotation3::new(turn.into());
        turned
    };
    let (via, end) =
        (turned([0.1, 0.1, 0.0], [0.0, 0.2, 0.0]), turned([0.2, 0.0, 0.0], [0.3, 0.0, 0.1]));
    let modes = ["PathFrame", "ObjectFrame", "CirPointOri"];
    let passed = modes.map(|mode| {
        let text = format!(
            "MoveAbsJ {},v1000,fine,t\\WObj:=w;\nConfL\\Off; CirPathMode\\{mode};\n\
             MoveC {},{},v50,fine,t\\WObj:=w;",
            joints(&q),
            with_pose(&via, &base),
            with_pose(&end, &base)
        );
        let made = moved(&text, &MotionOptions { step: 1e-3, ..MotionOptions::default() });
        assert!(made.moves[1].as_programmed, "{:?}", made.findings);
        let last = tool_pose(made.q.last().unwrap());
        assert!(PoseDifference::between(&last, &end).largest() < 1e-9);
        // A half circle of 100 mm about (0.1, 0, 0).
        let center = pose.translation.vector + Vector3::new(0.1, 0.0, 0.0);
        for q in &made.q {
            let radius = (tool_pose(q).translation.vector - center).norm();
            assert!((radius - 0.1).abs() < 1e-12, "{radius}");
        }
        assert!((made.trajectory.duration() - 0.1 * std::f64::consts::PI / 0.05).abs() < 1e-2);
        let near = |q: &[f64; 6]| PoseDifference::between(&tool_pose(q), &via).position;
        let at = made.q.iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap();
        PoseDifference::between(&tool_pose(at), &via).rotation
    });
    assert!(passed[2] < 0.01 && passed[0] > 0.05 && passed[1] > 0.05, "{passed:?}");
    assert!((passed[0] - passed[1]).abs() > 0.01, "{passed:?}");
}

#[test]
fn the_robot_rests_where_it_stops_and_nowhere_else() {
    for (zone, rests) in [("z20", false), ("fine", true)] {
        let (text, _) = corners(zone, "");
        let made = moved(
            &text,
            &MotionOptions { max_acceleration: Some([6.0; 6]), ..MotionOptions::default() },
        );
        let rows = made.q.len() * 6;
        let [mut q, mut dq, mut ddq] = [(); 3].map(|()| vec![0.0; rows]);
        made.trajectory.sample(&made.t, &mut q, &mut dq, &mut ddq).unwrap();
        let speed = |sample: usize| {
            dq[6 * sample..][..6].iter().fold(0.0, |most: f64, speed| most.max(speed.abs()))
        };
        let corner = made.move_index.iter().rposition(|index| *index == 1).unwrap();
        assert_eq!(speed(corner) < 1e-9, rests, "{zone} {}", speed(corner));
        assert!(speed(0) < 1e-9 && speed(made.q.len() - 1) < 1e-9);
        // The tool keeps to 100 mm/s between the samples of the path.
        for (times, q) in made.t.windows(2).zip(made.q.windows(2)) {
            let way =
                (tool_pose(&q[1]).translation.vector - tool_pose(&q[0]).translation.vector).norm();
            assert!(way <= 0.1 * (times[1] - times[0]) * (1.0 + 1e-6));
        }
    }
}
