//! What a kernel in lanes must not change: an answer does not depend on the place of the row, on
//! its neighbors, on the number of threads, on whether it was solved alone, nor, except for
//! rounding without fused multiplication and addition, on the instruction set.

/// Laws that force instruction sets in the whole process, so that no other test may run beside them.
macro_rules! alone {
    ($on:ident: $($law:ident,)*) => {
        $on!($(#[ignore = "run by itself: cargo test -p irbkin-tests -- --ignored"] $law,)*);
    };
}

mod coupled;
mod nearest;
mod subjects;

use std::array;
use std::fs::OpenOptions;
use std::io::{Write, stderr};

use crate::common::sets::on_each_set;
use crate::common::{Rng, apart};
use crate::structures::{Structure, Subject, on_every_structure, on_structures_of_ordinals};
use irbkin::batch::Batch;
use irbkin::{InstructionSet, JacobianFrame, Pose, Robot, Singularity, Status, pose};
use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Vector3};
use subjects::{PoseRow, Row, joint_rows, rows, subjects};

alone!(on_every_structure:
    the_rows_are_of_every_kind,
    batch_equals_single_bit_for_bit,
    a_row_does_not_depend_on_its_neighbors,
    threads_change_no_bit,
    an_invalid_row_is_flagged_and_the_others_are_solved,
    avx2_and_avx512_agree_to_the_bit,
    baseline_agrees_to_rounding,
    poses_of_many_turns_are_those_of_the_table,
);

alone!(on_structures_of_ordinals:
    batch_equals_single_bit_for_bit,
    a_row_does_not_depend_on_its_neighbors,
    an_invalid_row_is_flagged_and_the_others_are_solved,
    avx2_and_avx512_agree_to_the_bit,
    poses_of_many_turns_are_those_of_the_table,
);

/// Not a multiple of any lane count; every kind of row in every lane.
const ROWS: usize = 24 * 18 + 5;

const FRAMES: [JacobianFrame; 2] = [JacobianFrame::Base, JacobianFrame::Tool];

/// The slots of a row.
type AnswerRow<const N: usize> = Vec<[f64; N]>;

/// The slots and their status of each row.
#[derive(Clone, Debug)]
struct Answers<const N: usize> {
    q: Vec<AnswerRow<N>>,
    status: Vec<Vec<u8>>,
}

impl<const N: usize> Answers<N> {
    fn in_a_batch(subject: &Subject<N>, rows: &[Row<N>], threads: usize) -> Self {
        let slots = subject.robot.slot_count();
        let mut q = vec![[7.0; N]; slots * rows.len()];
        let mut status = vec![255; slots * rows.len()];
        let (poses, joints): (Vec<PoseRow>, Vec<[f64; N]>) = rows.iter().copied().unzip();
        let (poses, flat) = (poses.as_flattened(), q.as_flattened_mut());
        (subject.calls.ik_rows)(&subject.robot, poses, &joints, flat, &mut status, threads)
            .unwrap();
        Self {
            q: q.chunks(slots).map(<[_]>::to_vec).collect(),
            status: status.chunks(slots).map(<[_]>::to_vec).collect(),
        }
    }

    fn one_by_one(subject: &Subject<N>, rows: &[Row<N>]) -> Self {
        let (q, status) = rows.iter().map(|row| alone(subject, row)).unzip();
        Self { q, status }
    }

    #[track_caller]
    fn assert_same(&self, other: &Self, what: &str) {
        assert_eq!(self.q.len(), other.q.len(), "{what}");
        for (i, ((a, b), (flags, others))) in
            self.q.iter().zip(&other.q).zip(self.status.iter().zip(&other.status)).enumerate()
        {
            assert_eq!(flags, others, "{what}, row {i}");
            let is_same = same_bits(a.as_flattened(), b.as_flattened());
            assert!(is_same, "{what}, row {i}:\n{a:?}\n{b:?}");
        }
    }
}

/// The answer to one row, as in a batch.
fn alone<const N: usize>(subject: &Subject<N>, (row, joints): &Row<N>) -> (AnswerRow<N>, Vec<u8>) {
    let slots = subject.robot.slot_count();
    let mut q = vec![[f64::NAN; N]; slots];
    let solve = |pose| (subject.calls.ik)(&subject.robot, &pose, joints);
    let Ok(solutions) = pose::from_rows(row).and_then(solve) else {
        return (q, vec![Status::INVALID.bits(); slots]);
    };
    for solution in &solutions {
        q[solution.slot.index()] = solution.q;
    }
    (q, solutions.status().iter().map(Status::bits).collect())
}

/// Every NaN equals every other: their bits have no meaning.
fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()))
}

fn fk_of<const N: usize>(robot: &Robot<N>, q: &[[f64; N]]) -> Vec<PoseRow> {
    let mut poses = vec![[7.0; 16]; q.len()];
    Batch::new(None).fk(robot, q.as_flattened(), poses.as_flattened_mut()).unwrap();
    poses
}

fn jacobians_of<const N: usize>(
    robot: &Robot<N>,
    q: &[[f64; N]],
    frame: JacobianFrame,
) -> Vec<[[f64; N]; 6]> {
    let mut jacobians = vec![[[7.0; N]; 6]; q.len()];
    Batch::new(None)
        .jacobian(robot, q.as_flattened(), frame, jacobians.as_flattened_mut().as_flattened_mut())
        .unwrap();
    jacobians
}

fn figures_of<const N: usize>(robot: &Robot<N>, q: &[[f64; N]]) -> Vec<[f64; 2]> {
    let mut records = vec![None; q.len()];
    Batch::new(None).singularity(robot, q.as_flattened(), &mut records).unwrap();
    records
        .into_iter()
        .map(|record| record.map_or([f64::NAN; 2], |record| figures(&record)))
        .collect()
}

fn figures(record: &Singularity) -> [f64; 2] {
    [record.min_singular_value, record.manipulability]
}

fn is_finite(row: &[f64]) -> bool {
    row.iter().all(|number| number.is_finite())
}

fn the_rows_are_of_every_kind<const N: usize>(structure: &Structure<N>) {
    let mut halves = 0;
    for subject in subjects(structure) {
        let answers = Answers::in_a_batch(&subject, &rows(&subject, ROWS), 1);
        let has = |kind: Status| {
            answers
                .status
                .iter()
                .flatten()
                .any(|flags| Status::from_bits_retain(*flags).contains(kind))
        };
        // Closed forms are always certain.
        let unasked = Status::WITHIN_LIMITS | Status::UNCERTIFIED;
        assert!(
            Status::all().iter().filter(|kind| !unasked.contains(*kind)).all(has),
            "{}",
            subject.name
        );
        let full = answers
            .status
            .iter()
            .filter(|row| row.iter().all(|flags| flags & Status::FOUND.bits() != 0))
            .count();
        let none = answers.status.iter().filter(|row| row.iter().all(|flags| *flags == 0)).count();
        assert!(full > ROWS / 4 && none > 10, "{}: {full} full, {none} out of reach", subject.name);
        let empty = |row: &[u8]| row.iter().map(|flags| usize::from(*flags == 0)).sum::<usize>();
        halves += answers.status.iter().filter(|row| 2 * empty(row) == row.len()).count();
    }
    // Without a shoulder offset both shoulders reach or none does.
    assert!(halves > 100, "{halves} with one shoulder");
}

fn batch_equals_single_bit_for_bit<const N: usize>(structure: &Structure<N>) {
    on_each_set(|set| {
        for subject in &subjects(structure) {
            let what = format!("{}, {}", subject.name, set.name());
            let rows = rows(subject, ROWS);
            Answers::in_a_batch(subject, &rows, 1)
                .assert_same(&Answers::one_by_one(subject, &rows), &what);
            forward_in_a_batch_equals_single(&subject.robot, &what);
        }
    });
}

fn forward_in_a_batch_equals_single<const N: usize>(robot: &Robot<N>, what: &str) {
    let joints = joint_rows::<N>(77 * 3 + 5);
    for (q, pose) in joints.iter().zip(fk_of(robot, &joints)) {
        let wanted = if is_finite(q) { pose::to_rows(&robot.fk(q)) } else { [f64::NAN; 16] };
        assert!(same_bits(&pose, &wanted), "{what}, fk of {q:?}:\n{pose:?}\n{wanted:?}");
    }
    for frame in FRAMES {
        for (q, found) in joints.iter().zip(jacobians_of(robot, &joints, frame)) {
            let single = robot.jacobian(q, frame);
            let wanted: [[f64; N]; 6] = array::from_fn(|i| {
                array::from_fn(|j| if is_finite(q) { single[(i, j)] } else { f64::NAN })
            });
            assert!(
                same_bits(found.as_flattened(), wanted.as_flattened()),
                "{what}, {frame:?} Jacobian of {q:?}"
            );
        }
    }
    for (q, found) in joints.iter().zip(figures_of(robot, &joints)) {
        let wanted = if is_finite(q) { figures(&robot.singularity(q)) } else { [f64::NAN; 2] };
        assert!(same_bits(&found, &wanted), "{what}, singular values of {q:?}");
    }
}

fn a_row_does_not_depend_on_its_neighbors<const N: usize>(structure: &Structure<N>) {
    on_each_set(|set| {
        for subject in &subjects(structure) {
            let what = format!("{}, {}", subject.name, set.name());
            let rows = rows(subject, ROWS);
            let whole = Answers::in_a_batch(subject, &rows, 1);
            let part = |first: usize, past: usize| Answers {
                q: whole.q[first..past].to_vec(),
                status: whole.status[first..past].to_vec(),
            };
            for cut in 0..=17 {
                for (first, past) in
                    [(0, cut), (cut, ROWS), (100 + 3 * cut, 100 + 4 * cut), (cut, 2 * cut)]
                {
                    Answers::in_a_batch(subject, &rows[first..past], 1)
                        .assert_same(&part(first, past), &what);
                }
            }
            let order = shuffled(ROWS);
            let mixed: Vec<_> = order.iter().map(|i| rows[*i]).collect();
            let wanted = Answers {
                q: order.iter().map(|i| whole.q[*i].clone()).collect(),
                status: order.iter().map(|i| whole.status[*i].clone()).collect(),
            };
            Answers::in_a_batch(subject, &mixed, 1).assert_same(&wanted, &what);
        }
        let robot = &structure.subjects[0].robot;
        forward_rows_do_not_depend_on_their_neighbors(robot, set);
    });
}

fn forward_rows_do_not_depend_on_their_neighbors<const N: usize>(
    robot: &Robot<N>,
    set: InstructionSet,
) {
    let joints = joint_rows::<N>(ROWS);
    let (poses, jacobians) =
        (fk_of(robot, &joints), jacobians_of(robot, &joints, JacobianFrame::Tool));
    let figures = figures_of(robot, &joints);
    for cut in 0..=17 {
        for (first, past) in [(0, cut), (cut, ROWS), (cut, 2 * cut), (100 + 3 * cut, 100 + 4 * cut)]
        {
            let q = &joints[first..past];
            assert!(
                same_bits(fk_of(robot, q).as_flattened(), poses[first..past].as_flattened()),
                "{first}..{past}, {}",
                set.name()
            );
            assert!(
                same_bits(figures_of(robot, q).as_flattened(), figures[first..past].as_flattened()),
                "{first}..{past}, {}",
                set.name()
            );
            let found = jacobians_of(robot, q, JacobianFrame::Tool);
            let wanted = jacobians[first..past].as_flattened().as_flattened();
            assert!(
                same_bits(found.as_flattened().as_flattened(), wanted),
                "{first}..{past}, {}",
                set.name()
            );
        }
    }
}

/// The numbers below `count` in random order.
fn shuffled(count: usize) -> Vec<usize> {
    let mut rng = Rng::new(3);
    let mut order: Vec<_> = (0..count).map(|i| (rng.unit(), i)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.into_iter().map(|(_, i)| i).collect()
}

/// With one core, no pool of threads is made, and there is nothing to compare.
fn threads_change_no_bit<const N: usize>(structure: &Structure<N>) {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    if cores < 2 {
        skip(&format!("threads_change_no_bit, {}", structure.name), "one core: no pool is made");
        return;
    }
    on_each_set(|set| {
        for subject in subjects(structure).iter().step_by(4) {
            // Enough for four threads, with an incomplete last part.
            let rows: Vec<_> = rows(subject, ROWS).into_iter().cycle().take(17_001).collect();
            let whole = Answers::in_a_batch(subject, &rows, 1);
            for threads in [2, 3, 4, 0] {
                Answers::in_a_batch(subject, &rows, threads)
                    .assert_same(&whole, &format!("{}, {}", subject.name, set.name()));
            }
        }
    });
}

type Spoil = fn(&mut PoseRow);

fn an_invalid_row_is_flagged_and_the_others_are_solved<const N: usize>(structure: &Structure<N>) {
    let spoils: [(&str, Spoil); 6] = [
        ("not a number", |row| row[6] = f64::NAN),
        ("infinite", |row| row[3] = f64::INFINITY),
        ("mirrored", |row| [row[0], row[4], row[8]] = [-row[0], -row[4], -row[8]]),
        ("sheared", |row| row[1] += 3e-5),
        ("scaled", |row| [row[0], row[4], row[8]] = [2.0 * row[0], 2.0 * row[4], 2.0 * row[8]]),
        ("last row", |row| row[15] = 1.0 + 1e-8),
    ];
    for subject in &structure.subjects[..2] {
        let rows: Vec<_> = rows(subject, 24 * 2).into_iter().step_by(2).take(19).collect();
        an_invalid_row_leaves_alone(subject, &rows, &spoils);
    }
}

fn an_invalid_row_leaves_alone<const N: usize>(
    subject: &Subject<N>,
    rows: &[Row<N>],
    spoils: &[(&str, Spoil)],
) {
    on_each_set(|set| {
        let whole = Answers::in_a_batch(subject, rows, 1);
        assert!(whole.status.iter().flatten().all(|flags| *flags != Status::INVALID.bits()));
        let slots = subject.robot.slot_count();
        for (name, spoil) in spoils {
            for place in 0..rows.len() {
                let (mut spoiled, mut wanted) = (rows.to_vec(), whole.clone());
                spoil(&mut spoiled[place].0);
                (wanted.q[place], wanted.status[place]) =
                    (vec![[f64::NAN; N]; slots], vec![Status::INVALID.bits(); slots]);
                Answers::in_a_batch(subject, &spoiled, 1)
                    .assert_same(&wanted, &format!("{name}, {}", set.name()));
            }
        }
    });
}

/// The answers of every set for an arm.
struct OnEachSet<const N: usize> {
    set: InstructionSet,
    answers: Answers<N>,
    poses: Vec<PoseRow>,
    jacobians: Vec<[[f64; N]; 6]>,
    figures: Vec<[f64; 2]>,
}

fn solved_on_each_set<const N: usize>(subject: &Subject<N>, rows: &[Row<N>]) -> Vec<OnEachSet<N>> {
    let joints = joint_rows::<N>(ROWS);
    let mut solved = Vec::new();
    on_each_set(|set| {
        solved.push(OnEachSet {
            set,
            answers: Answers::in_a_batch(subject, rows, 1),
            poses: fk_of(&subject.robot, &joints),
            jacobians: jacobians_of(&subject.robot, &joints, JacobianFrame::Tool),
            figures: figures_of(&subject.robot, &joints),
        });
    });
    solved
}

fn avx2_and_avx512_agree_to_the_bit<const N: usize>(structure: &Structure<N>) {
    if !InstructionSet::available().any(|set| set == InstructionSet::Avx512) {
        let names: Vec<_> = InstructionSet::available().map(InstructionSet::name).collect();
        let test = format!("avx2_and_avx512_agree_to_the_bit, {}", structure.name);
        skip(&test, &format!("this processor has only {names:?}"));
        return;
    }
    for subject in &subjects(structure) {
        let solved = solved_on_each_set(subject, &rows(subject, ROWS));
        let [_, narrow, wide] = &solved[..] else { unreachable!("AVX-512 comes after AVX2") };
        assert_eq!((narrow.set, wide.set), (InstructionSet::Avx2, InstructionSet::Avx512));
        narrow.answers.assert_same(&wide.answers, &subject.name);
        assert!(
            same_bits(narrow.poses.as_flattened(), wide.poses.as_flattened()),
            "{}",
            subject.name
        );
        assert!(
            same_bits(
                narrow.jacobians.as_flattened().as_flattened(),
                wide.jacobians.as_flattened().as_flattened()
            ),
            "{}",
            subject.name
        );
        assert!(
            same_bits(narrow.figures.as_flattened(), wide.figures.as_flattened()),
            "{}",
            subject.name
        );
    }
}

fn baseline_agrees_to_rounding<const N: usize>(structure: &Structure<N>) {
    let mut worst: f64 = 0.0;
    for subject in &subjects(structure) {
        let solved = solved_on_each_set(subject, &rows(subject, ROWS));
        let [baseline, others @ ..] = &solved[..] else {
            unreachable!("every processor has the baseline")
        };
        for other in others {
            worst = worst.max(rounding_between(subject, &baseline.answers, &other.answers));
            // A frame is the product of eight, each element of which is a sum of three products: 24
            // roundings either way, and as many for the Jacobian's cross product and rotation into
            // the tool frame.
            let bound = 2.0 * 48.0 * f64::EPSILON * (1.0 + subject.reach());
            let numbers = |solved: &OnEachSet<N>| {
                [solved.poses.as_flattened(), solved.jacobians.as_flattened().as_flattened()]
                    .concat()
            };
            for (a, b) in numbers(baseline).iter().zip(numbers(other)) {
                assert!(
                    (a - b).abs() <= bound || (a.is_nan() && b.is_nan()),
                    "{}: {a} and {b}",
                    subject.name
                );
            }
        }
    }
    println!("farthest apart away from singularities: {worst:.1e} rad");
}

/// The largest difference of the joints away from singularities; there the slots have the same
/// status.
///
/// A solve closes to 3e-15 of the reach and 1e-14 rad, so two solves differ by at most twice that
/// over the least singular value. If that is below 1e-12 rad, the pose is away from singularities.
fn rounding_between<const N: usize>(
    subject: &Subject<N>,
    ours: &Answers<N>,
    theirs: &Answers<N>,
) -> f64 {
    let mut worst: f64 = 0.0;
    let mut compared = 0;
    for (i, (a, b)) in ours.q.iter().zip(&theirs.q).enumerate() {
        for (slot, (a, b)) in a.iter().zip(b).enumerate() {
            assert_eq!(ours.status[i][slot], theirs.status[i][slot], "{}, row {i}", subject.name);
            let closed = 2.0 * (3e-15 * subject.reach()).hypot(1e-14);
            if !is_finite(a) || closed / subject.least_singular_value(a) > 1e-12 {
                continue;
            }
            compared += 1;
            // Half a turn is +pi or, with another last bit, -pi.
            let apart = apart(a, b);
            assert!(apart <= 1e-12, "{}, row {i}, slot {slot}: {a:?} and {b:?}", subject.name);
            worst = worst.max(apart);
        }
    }
    assert!(compared > ROWS, "{}: {compared} slots away from singularities", subject.name);
    worst
}

fn poses_of_many_turns_are_those_of_the_table<const N: usize>(structure: &Structure<N>) {
    on_each_set(|set| {
        for Subject { name, robot, .. } in &subjects(structure) {
            table_poses(robot, &format!("{name}, {}", set.name()));
        }
    });
}

fn table_poses<const N: usize>(robot: &Robot<N>, what: &str) {
    let joints: Vec<[f64; N]> = joint_rows(200).into_iter().filter(|q| is_finite(q)).collect();
    let mdh = robot.mdh();
    let lengths: f64 = mdh.rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
    let ends = robot.base().translation.vector.norm()
        + robot.tool().translation.vector.norm()
        + mdh.flange.translation.vector.norm();
    for (q, row) in joints.iter().zip(fk_of(robot, &joints)) {
        let mut wanted: Pose = robot.base() * mdh.base;
        for (row, angle) in mdh.rows.iter().zip(q) {
            // The two rotations about z in sequence: their sum would lose digits of an angle of
            // many turns.
            let along = Translation3::new(row.a, 0.0, row.d) * Rotation3::identity();
            let [x, z, q] = [
                (Vector3::x_axis(), row.alpha),
                (Vector3::z_axis(), row.theta),
                (Vector3::z_axis(), *angle),
            ]
            .map(|(axis, angle)| {
                IsometryMatrix3::from_parts(
                    Translation3::identity(),
                    Rotation3::from_axis_angle(&axis, angle),
                )
            });
            wanted = wanted * x * along * z * q;
        }
        wanted = wanted * mdh.flange * robot.tool();
        // Ten products either way, each element of which is a sum of three products.
        let bound = 2.0 * 30.0 * f64::EPSILON * (1.0 + lengths + ends);
        for (a, b) in row.iter().zip(pose::to_rows(&wanted)) {
            assert!((a - b).abs() <= bound, "{what}, fk of {q:?}: {a} and {b}");
        }
    }
}

/// Reports a test as skipped, past the harness's capture, and in the file that `IRBKIN_SKIPPED`
/// names, from which `make test` prints and counts them. The caller returns.
pub fn skip(test: &str, reason: &str) {
    let line = format!("skipped: {test}: {reason}\n");
    stderr().write_all(line.as_bytes()).unwrap();
    if let Ok(path) = std::env::var("IRBKIN_SKIPPED") {
        let mut file = OpenOptions::new().create(true).append(true).open(path).unwrap();
        file.write_all(line.as_bytes()).unwrap();
    }
}
