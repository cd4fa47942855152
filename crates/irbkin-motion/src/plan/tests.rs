//! The search against exhaustive ones, and plans against what they promise.

use std::vec::Vec;

use core::f64::consts::{PI, TAU};

use super::best::JointPath;
use super::certificate::Between;
use super::exhaustive::{Turned, edge, exhaustive, turned};
use super::freedom::Freedom;
use super::graph::{Grid, Layer, Node, Values};
use super::joints::{NodeCost, PlannedJoints, TurnStates};
use super::ladder::{Ends, Ladder};
use super::nodes::PlannedArm;
use super::planner::Planner;
use super::robot::{freedoms, waypoints};
use super::work::Work;
use super::{ExternalAxis, PlanError, PlanOptions, PlanOrder, ToolAxis, ToolRotation};
use crate::arm::Arm;
use crate::paths::Turn;
use crate::rng::Rng;
use irbkin::internal::{largest, steps};
use irbkin::pose::from_euler_zyx as pose_from_euler_zyx;
use irbkin::{Interrupt, JointLimits, Pose, Robot};

fn below(rng: &mut Rng, count: usize) -> usize {
    usize::try_from(rng.bits() % u64::try_from(count).unwrap()).unwrap()
}

/// Layers with random joint angles: nothing of them is geometry.
fn random_layers(rng: &mut Rng, joints: &PlannedJoints, freedom: &Freedom) -> (Grid, Vec<Layer>) {
    let slots = if below(rng, 8) == 0 { 9 } else { 1 + below(rng, 2) };
    let mut grid = freedom.grid(slots);
    if let Some(axis) = freedom.rotation() {
        grid.steps[axis] = 0.1;
    }
    let (start, end) = (Pose::identity(), pose_from_euler_zyx([0.0; 3], [3.0, 0.0, 0.0]).unwrap());
    let (mut layers, mut time) = (Vec::new(), 0.0);
    for index in 0..2 + below(rng, 3) {
        time += 0.1;
        let mut layer = Layer::new(start, time, Some(index), &grid);
        layer.first[0] = rng.between(-0.1, 0.1);
        // So large a turn that no window is narrower than all tool angles.
        layer.turn = Some(Turn::new(&start.rotation, &end.rotation, None, 0).unwrap());
        for (cell, slot) in
            (0..grid.cells).flat_map(|cell| (0..slots).map(move |slot| (cell, slot)))
        {
            // Of many slots few have nodes: an exhaustive search has to end.
            if below(rng, 6) > 0 && (slots < 9 || below(rng, 5) == 0) {
                let q = core::array::from_fn(|joint| {
                    let [lower, upper] = joints.limits(joint);
                    joints.first_turn(joint, rng.between(lower, upper))
                });
                layer.put(&grid, Node { slot, cell }, Some(q));
            }
        }
        if index > 0 {
            let node =
                |rng: &mut Rng| Node { slot: below(rng, slots), cell: below(rng, grid.cells) };
            let pair = |rng: &mut Rng| [node(rng), node(rng)].map(|node| grid.number(node));
            for _ in 0..below(rng, 3) {
                let refused = pair(rng);
                layer.refused.push(refused);
                let crossing = pair(rng);
                if grid.node(crossing[0]).slot != grid.node(crossing[1]).slot {
                    layer.crossings.push(crossing);
                }
            }
        }
        layers.push(layer);
    }
    (grid, layers)
}

/// An arm whose joints 4 and 6 have several turns.
fn wide(rng: &mut Rng) -> Arm<6> {
    let robot: Arm<6> = Arm::named("IRB 2600-12/1.65").unwrap();
    let turns = rng.between(3.2, 7.0);
    let limits = JointLimits::new([
        [-2.0, 2.0],
        [-1.0, 1.5],
        [-2.0, 1.0],
        [-turns, turns],
        [-2.0, 2.0],
        [-4.0, 7.5],
    ]);
    robot.map(|robot| Ok(robot.with_limits(limits.unwrap()))).unwrap()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * (1.0 + b.abs())
}

#[test]
fn the_best_path_is_that_of_an_exhaustive_search() {
    let (mut rng, mut whole) = (Rng::new(7), 0);
    for case in 0..10_000 {
        let robot = wide(&mut rng);
        let weights = core::array::from_fn(|_| rng.between(0.1, 2.0));
        let joints = PlannedJoints::of(&robot, weights);
        let freedom = random_freedom(&mut rng);
        let (grid, layers) = random_layers(&mut rng, &joints, &freedom);
        let speed = if case % 3 == 0 { rng.between(2.0, 12.0) } else { f64::INFINITY };
        let (order, node_cost) = random_costs(&mut rng, &robot);
        let ladder = Ladder {
            grid,
            joints: &joints,
            freedom: &freedom,
            layers: &layers,
            speed,
            expected: (below(&mut rng, 2) == 0).then(|| rng.between(0.0, 20.0)),
            ends: Ends::default(),
            whole: false,
            order,
            node_cost,
            interrupt: Interrupt::none(),
        };
        let (count, bottleneck, squares) = exhaustive(&ladder, |_, _| true);
        let Some(best) = ladder.best_path(0, &mut TurnStates::default()).unwrap() else {
            assert_eq!(count, 0, "case {case}");
            continue;
        };
        assert_eq!(best.nodes.len(), count, "case {case}");
        assert!(
            close(best.bottleneck, bottleneck),
            "case {case}: {} {bottleneck}",
            best.bottleneck
        );
        assert!(close(best.squares, squares), "case {case}: {} {squares}", best.squares);
        assert_is_a_path(&ladder, &best);
        whole += usize::from(count == layers.len());
    }
    assert!(whole > 3_000, "{whole} whole paths");
}

/// An order of costs and, in half of the cases, costs of being near limits and singularities.
fn random_costs<'a>(rng: &mut Rng, robot: &'a Robot<6>) -> (PlanOrder, Option<NodeCost<'a>>) {
    let order = if below(rng, 2) == 0 { PlanOrder::Bottleneck } else { PlanOrder::Sum };
    let mut cost = || if below(rng, 4) == 0 { rng.between(0.0, 1e4) } else { 0.0 };
    let node_cost = NodeCost::new(robot, cost(), cost());
    (order, node_cost)
}

/// A track with a few values or none, and a few tool angles or none, all around or not.
fn random_freedom(rng: &mut Rng) -> Freedom {
    let steps = below(rng, 4);
    let external: Vec<_> = (steps > 1)
        .then(|| {
            let track = ExternalAxis::track([1.0, 0.0, 0.0], 0.0, 1.0, steps).unwrap();
            let velocity = rng.between(0.2, 20.0);
            let weight = rng.between(0.0, 2.0);
            track.with_max_velocity(velocity).and_then(|axis| axis.with_weight(weight)).unwrap()
        })
        .into_iter()
        .collect();
    let count = 1 + below(rng, if steps > 1 { 2 } else { 3 });
    let upper = if below(rng, 2) == 0 { PI } else { 0.0 };
    let rotation = ToolRotation::new(count, -PI, upper, ToolAxis::Z).ok();
    Freedom::new(&external, None, rotation)
}

#[test]
fn the_best_closed_path_is_that_of_an_exhaustive_search() {
    let (mut rng, mut whole) = (Rng::new(8), 0);
    for case in 0..4_000 {
        let robot = wide(&mut rng);
        let joints = PlannedJoints::of(&robot, core::array::from_fn(|_| rng.between(0.1, 2.0)));
        let freedom = random_freedom(&mut rng);
        let (grid, mut layers) = random_layers(&mut rng, &joints, &freedom);
        let (first, rest) = layers.split_first_mut().unwrap();
        let last = rest.last_mut().unwrap();
        last.q = first.q.clone();
        last.first = first.first;
        let (order, node_cost) = random_costs(&mut rng, &robot);
        let ladder = Ladder {
            grid,
            joints: &joints,
            freedom: &freedom,
            layers: &layers,
            speed: f64::INFINITY,
            expected: (below(&mut rng, 2) == 0).then(|| rng.between(0.0, 20.0)),
            ends: Ends { closed: true, ..Ends::default() },
            whole: true,
            order,
            node_cost,
            interrupt: Interrupt::none(),
        };
        let is_closed = |first: &Turned, last: &Turned| {
            first.number == last.number && largest(&steps(&first.q, &last.q)) < 1e-9
        };
        let (count, bottleneck, squares) = exhaustive(&ladder, is_closed);
        let best = ladder.best_closed_path(&mut TurnStates::default()).unwrap();
        assert_eq!(best.is_some(), count == layers.len(), "case {case}");
        let Some(best) = best else { continue };
        assert!(
            close(best.bottleneck, bottleneck),
            "case {case}: {} {bottleneck}",
            best.bottleneck
        );
        assert!(close(best.squares, squares), "case {case}: {} {squares}", best.squares);
        assert_is_a_path(&ladder, &best);
        whole += 1;
    }
    assert!(whole > 1_000, "{whole} closed paths");
}

/// The joint angles belong to the nodes, are inside the limits, and cost what the joint path says.
fn assert_is_a_path(ladder: &Ladder<'_>, best: &JointPath) {
    let (mut most, mut squares) = (0.0_f64, 0.0);
    for (step, (node, q)) in best.nodes.iter().zip(&best.q).enumerate() {
        let own = ladder.layers[step].joints(&ladder.grid, *node).unwrap();
        for joint in 0..6 {
            let turns = (q[joint] - own[joint]) / TAU;
            assert!((turns - turns.round()).abs() < 1e-9);
        }
        assert!(ladder.joints.contain(q));
        if step > 0 {
            let turned = |node: &Node, q: [f64; 6]| Turned {
                number: ladder.grid.number(*node),
                node: *node,
                q,
            };
            let from = turned(&best.nodes[step - 1], best.q[step - 1]);
            let (own_most, own) = edge(ladder, step, &from, &turned(node, *q)).unwrap();
            (most, squares) = (most.max(own_most), squares + own);
        }
    }
    assert!(close(most, best.bottleneck) && close(squares, best.squares));
}

/// A short random path of an arm.
pub(super) fn random_path(robot: &Robot<6>, rng: &mut Rng, count: usize, size: f64) -> Vec<Pose> {
    let limits = robot.limits().to_array();
    let mut q: [f64; 6] = core::array::from_fn(|joint| {
        let [lower, upper] = limits[joint];
        rng.between(lower.max(-PI), upper.min(PI))
    });
    let step: [f64; 6] = core::array::from_fn(|_| rng.between(-size, size));
    let mut path = Vec::new();
    for _ in 0..count {
        path.push(robot.fk(&q));
        q = core::array::from_fn(|joint| q[joint] + step[joint]);
    }
    path
}

/// An arm whose nodes cost nothing.
fn arm<'a>(
    robot: &'a Robot<6>,
    joints: &'a PlannedJoints,
    freedom: &'a Freedom,
    work: &'a Work,
) -> PlannedArm<'a> {
    let (node_cost, interrupt, first_slot) = (None, Interrupt::none(), None);
    PlannedArm { robot, joints, freedom, node_cost, interrupt, work, first_slot }
}

#[test]
fn no_wider_window_and_no_more_turns_find_a_better_path() {
    let (mut rng, mut whole) = (Rng::new(11), 0);
    for case in 0..60 {
        let robot: Arm<6> = Arm::named("IRB 2600-12/1.65").unwrap();
        let path = random_path(&robot, &mut rng, 4, 0.15);
        let rotation = Some(ToolRotation::full(24).unwrap());
        let joints = PlannedJoints::of(&robot, [1.0; 6]);
        let (order, limit_cost, singularity_cost) = match case % 3 {
            0 => (PlanOrder::Bottleneck, 0.0, 0.0),
            1 => (PlanOrder::Sum, 0.0, 0.0),
            _ => (PlanOrder::Sum, 3.0, 2.0),
        };
        let options =
            PlanOptions { rotation, order, limit_cost, singularity_cost, ..PlanOptions::default() };
        let [freedom, _] = freedoms(&options);
        let node_cost = NodeCost::new(&robot, limit_cost, singularity_cost);
        let work = Work::default();
        let arm = PlannedArm { node_cost, ..arm(&robot, &joints, &freedom, &work) };
        let planner = Planner::new(arm, &waypoints(&path, &options), &options, &[None; 2]).unwrap();
        let ladder = planner.ladder();
        // All pairs, layer by layer.
        let layers: Vec<_> = ladder.layers.iter().map(|layer| turned(&ladder, layer)).collect();
        let mut costs = std::vec![0.0; layers[0].len()];
        for layer in 1..layers.len() {
            costs = layers[layer]
                .iter()
                .map(|to| {
                    let all = layers[layer - 1].iter().zip(&costs).filter_map(|(from, cost)| {
                        let (most, squares) = edge(&ladder, layer, from, to)?;
                        Some(match order {
                            PlanOrder::Bottleneck => most.max(*cost),
                            PlanOrder::Sum => squares + cost,
                        })
                    });
                    all.fold(f64::INFINITY, f64::min)
                })
                .collect();
        }
        let least = costs.into_iter().fold(f64::INFINITY, f64::min);
        let best = ladder.best_path(0, &mut planner.states.clone()).unwrap().unwrap();
        assert_eq!(best.nodes.len() == 4, least.is_finite(), "case {case}");
        if least.is_finite() {
            assert!(close(best.cost(order).0, least), "case {case}: {best:?} {least}");
            whole += 1;
        }
    }
    assert!(whole >= 30, "{whole} whole paths");
}

/// The steps of a joint path that are not continuous.
fn discontinuities(
    arm: &PlannedArm<'_>,
    planner: &Planner<'_>,
    best: &JointPath,
) -> Vec<(usize, Between)> {
    let mut steps = arm.followed(&planner.grid, &planner.layers, (&best.nodes, &best.q));
    steps.retain(|(_, between)| *between != Between::Continuous);
    steps
}

#[test]
fn a_step_through_a_flip_is_no_continuous_one() {
    // At q5 = 0 the tool is met with q4 = 0 and with q4 = 180 deg: a flip between them is a jump.
    let robot: Arm<6> = Arm::named("IRB 2600-12/1.65").unwrap();
    let joints = PlannedJoints::of(&robot, [1.0; 6]);
    let options = PlanOptions::default();
    let [freedom, _] = freedoms(&options);
    let work = Work::default();
    let arm = arm(&robot, &joints, &freedom, &work);
    let path: Vec<Pose> = [0.01, -0.01].map(|q5| robot.fk(&[0.2, 0.1, 0.3, 0.0, q5, 0.4])).to_vec();
    let mut planner = Planner::new(arm, &waypoints(&path, &options), &options, &[None; 2]).unwrap();
    // Of the branches only the two that differ by the wrist: others have no singularity there.
    for slot in 2..planner.grid.slots {
        let node = Node { slot, cell: 0 };
        planner.layers.iter_mut().for_each(|layer| layer.put(&planner.grid, node, None));
    }
    let best = planner.ladder().best_path(0, &mut TurnStates::default()).unwrap().unwrap();
    assert!(best.bottleneck < 0.1, "the path through the singularity: {}", best.bottleneck);
    let open = discontinuities(&arm, &planner, &best);
    assert!(open.is_empty());
    // Without the crossing, a flip is all that is left, and it is seen.
    planner.layers[1].crossings.clear();
    let best = planner.ladder().best_path(0, &mut TurnStates::default()).unwrap().unwrap();
    assert!(best.q[0].iter().zip(&best.q[1]).any(|(a, b)| (a - b).abs() > 3.0));
    let open = discontinuities(&arm, &planner, &best);
    assert!(matches!(open[..], [(1, Between::Jump | Between::Elsewhere)]), "{open:?}");
}

#[test]
fn plans_meet_their_poses_and_their_options() {
    let mut rng = Rng::new(3);
    for name in ["IRB 2600-12/1.65", "UR5e", "IRB 2400-10/1.55", "IRB 6640-130/3.2"] {
        let robot: Arm<6> = Arm::named(name).unwrap();
        for case in 0..40 {
            let path = random_path(&robot, &mut rng, 12, 0.03);
            let rotation = match case % 3 {
                0 => None,
                1 => Some(ToolRotation::full(12).unwrap()),
                _ => Some(ToolRotation::new(5, -0.2, 0.3, ToolAxis::X).unwrap()),
            };
            let options = PlanOptions { rotation, ..PlanOptions::default() };
            let plan = match robot.plan(&path, &options) {
                Ok(plan) => plan,
                Err(PlanError::NoPlan(gap)) => {
                    assert!(!gap.ends.is_empty() && !gap.plan.breaks.is_empty(), "{gap:?}");
                    gap.plan
                }
                Err(error) => panic!("{name}: {error}"),
            };
            let [freedom, _] = freedoms(&options);
            for (index, q) in plan.q.iter().enumerate() {
                let Some(q) = q else { continue };
                let mut values = Values::default();
                values[0] = plan.tool_angle[index];
                let pose = freedom.tool(&path[index], &values);
                assert!(robot.residual(q, &pose).largest() < 1e-9, "{name} {case} {index}");
                assert!(robot.limits().contains(q));
            }
        }
    }
}
