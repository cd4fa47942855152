"""At and next to singularities: every branch in its slot, declared, nothing twice
(docs/accuracy.md).
"""

import irbkin
import numpy as np
import pytest
from arms import ABB, LATERAL
from irbkin import SingularityKind, Status
from reference import apart
from strategies import subjects

FOUND, MERGED = int(Status.FOUND), int(Status.MERGED)
RNG_SEED = 11
TRIALS = 20


def free(name):
    """The arm without limits: a singularity may stand outside them."""
    return irbkin.Robot(name).with_limits([[-np.inf, np.inf]] * 6)


def angle_at_elbow(name, off, folded):
    """Axis 3 where the arm is stretched or folded, and `off` from there [rad]."""
    _, elbow, _, _, forearm, _ = ABB[name].lengths
    return np.arctan2(elbow, forearm) - np.pi / 2 + off + np.pi * folded


def ordinary(rng):
    """A joint vector away from the singularities, its wrist center well in front of axis 1."""
    return rng.uniform([-3, -0.1, -0.7, -3, 0.3, -3], [3, 1, 0.7, 3, 1.5, 3])


def at_shoulder(name, off, rng):
    """A joint vector with the wrist center `off` [m] in front of axis 1, away from the other
    singularities.
    """
    a1, elbow, _, upper, forearm, _ = ABB[name].lengths
    while True:
        q = ordinary(rng)
        q[1] = rng.uniform(-1, 1)
        cosine = (off - a1 - upper * np.sin(q[1])) / np.hypot(elbow, forearm)
        if abs(cosine) < 0.99:
            q[2] = np.arctan2(elbow, forearm) - np.arccos(cosine) - q[1]
            if abs(np.sin(q[2] - angle_at_elbow(name, 0.0, False))) > 0.1:
                return q


def check_closed(solutions, reach):
    assert len(solutions) > 0
    for solution in solutions:
        assert solution.residual <= max(1e-14, 3e-15 * reach)
    # No two of them are the same pose of the arm.
    for i, solution in enumerate(solutions):
        assert all(apart(solution.q, other.q) > 1e-9 for other in list(solutions)[i + 1 :])


def check_generating(robot, solutions, q):
    """The vector that made the pose is found as exactly as the rounding of the pose allows."""
    sigma = robot.singularity(q).min_singular_value
    assert apart(solutions.q, q).min() <= max(
        1e-9, 1e-14 * (1 + subjects()[robot.name].reach) / sigma
    )


def elbow_bound(name, off, folded):
    """How far axes 2 and 3 of the elbow that is kept may be from those that made the pose [rad].

    r^2 = c^2 + k^2 +- 2 c k cos(e) makes of the rounding dr of the wrist's distance r an e = sqrt(2
    dr r / (c k)). An elbow that bends by e turns the upper arm by up to e k / r. The two branches
    that are one differ by twice `off`.
    """
    _, elbow, _, upper, forearm, _ = ABB[name].lengths
    k = np.hypot(elbow, forearm)
    r = abs(upper - k) if folded else upper + k
    rounding = 1e-15 * (1 + subjects()[name].reach)
    return (2 * abs(off) + np.sqrt(2 * rounding * r / (upper * k))) * (1 + k / r)


@pytest.mark.parametrize("straight", [0.0, np.pi])
@pytest.mark.parametrize("off", [1e-4, 1e-7, 1e-8, 2e-9, -2e-9, 1e-9, 0.0])
@pytest.mark.parametrize("name", ABB)
def test_wrist_branches(name, off, straight):
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        q = ordinary(rng)
        q[4] = straight + off
        solutions = robot.ik(robot.fk(q))
        check_closed(solutions, subjects()[name].reach)
        arm = [solution for solution in solutions if apart(solution.q[:3], q[:3]) < 1e-6]
        if abs(off) >= 2e-9:
            check_generating(robot, solutions, q)
            assert [SingularityKind.WRIST in solution.singularities for solution in arm] == [
                False,
                False,
            ]
            assert not (solutions.status & MERGED).any()
            continue
        (solution,) = arm
        assert solution.singularities == SingularityKind.WRIST
        assert solutions.status[solution.slot ^ 1] == Status.MERGED | Status.WRIST
        if off == 0:
            # Only the sum or the difference of axes 4 and 6 is determined: q4 = 0 is the
            # representative.
            together = q[3] + q[5] if straight == 0 else q[5] - q[3]
            assert apart(solution.q, [*q[:3], 0, straight, together]) <= 1e-9
        elsewhere = [other for other in solutions if other.slot // 2 != solution.slot // 2]
        assert all(SingularityKind.WRIST not in other.singularities for other in elsewhere)


@pytest.mark.parametrize("folded", [False, True])
@pytest.mark.parametrize("off", [1e-4, -1e-4, 1e-6, -1e-6, 1e-9, -1e-9, 0.0])
@pytest.mark.parametrize("name", ABB)
def test_elbow_branches(name, off, folded):
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        q = ordinary(rng)
        q[2] = angle_at_elbow(name, off, folded)
        solutions = robot.ik(robot.fk(q))
        check_closed(solutions, subjects()[name].reach)
        arm = [solution for solution in solutions if apart(solution.q[:1], q[:1]) < 1e-6]
        first = 4 * (arm[0].slot >= 4)
        if abs(off) >= 1e-6:
            check_generating(robot, solutions, q)
            assert [solution.slot - first for solution in arm] == [0, 1, 2, 3]
            assert all(SingularityKind.ELBOW not in solution.singularities for solution in arm)
            continue
        assert apart(solutions.q[:, :3], q[:3]).min() <= elbow_bound(name, off, folded)
        assert [solution.singularities for solution in arm] == [
            SingularityKind.ELBOW,
            SingularityKind.ELBOW,
        ]
        assert {(solution.slot - first) // 2 for solution in arm} == {0}
        assert (solutions.status[first + 2 : first + 4] == Status.MERGED | Status.ELBOW).all()


@pytest.mark.parametrize("off", [1e-4, -1e-4, 1e-7, -1e-7, 2e-9, -2e-9, 1e-9, 0.0])
@pytest.mark.parametrize("name", ABB)
def test_shoulder_branches(name, off):
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        q = at_shoulder(name, off, rng)
        solutions = robot.ik(robot.fk(q))
        check_closed(solutions, subjects()[name].reach)
        if abs(off) >= 2e-9:
            check_generating(robot, solutions, q)
            assert (solutions.status & FOUND).all()
            assert all(
                SingularityKind.SHOULDER not in solution.singularities for solution in solutions
            )
            continue
        assert [solution.slot for solution in solutions] == [0, 1, 2, 3]
        assert all(solution.singularities == SingularityKind.SHOULDER for solution in solutions)
        assert (solutions.status[4:] == Status.MERGED | Status.SHOULDER).all()
        if off == 0:
            assert (solutions.q[:, 0] == 0).all()
        else:
            check_generating(robot, solutions, q)


@pytest.mark.parametrize(("off", "count"), [(0.0, 4), (1e-6, 8), (-1e-6, 8)])
def test_shoulder_branches_with_a_lateral_offset(off, count):
    """The wrist center comes no nearer to axis 1 than b; there the two shoulders are one, and q1 is
    determined.
    """
    subject = subjects()["lateral offset"]
    a1, a2, upper, forearm = (LATERAL[length] for length in ("a1", "a2", "c2", "c3"))
    robot, rng = subject.robot, np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        t2 = rng.uniform(-0.5, 0.5)
        # x = a1 + c2 sin t2 + hypot(a2, c3) sin(t2 + t3 + atan2(a2, c3))
        sine = (off - a1 - upper * np.sin(t2)) / np.hypot(a2, forearm)
        t3 = np.arcsin(sine) - np.arctan2(a2, forearm) - t2
        theta = np.array(
            [
                rng.uniform(-3, 3),
                t2,
                t3,
                rng.uniform(-3, 3),
                rng.uniform(0.3, 1.5),
                rng.uniform(-3, 3),
            ]
        )
        q = np.array(LATERAL["signs"]) * (theta + LATERAL["offsets"])
        assert robot.singularity(q).shoulder == pytest.approx(abs(off), abs=1e-15)
        solutions = robot.ik(robot.fk(q))
        check_closed(solutions, subject.reach)
        assert len(solutions) == count
        # x^2 = rho^2 - b^2: the rounding of rho makes sqrt(2 b drho) of x, and x / b of q1.
        if off == 0:
            assert all(solution.singularities == SingularityKind.SHOULDER for solution in solutions)
            assert (
                apart(solutions.q[:, :1], q[:1]).min()
                <= np.sqrt(2 * LATERAL["b"] * 1e-15 * (1 + subject.reach)) / LATERAL["b"]
            )
        else:
            check_generating(robot, solutions, q)


@pytest.mark.parametrize("name", ABB)
def test_a_free_axis_1_carries_the_generating_arm_to_any_angle(name):
    """At the shoulder singularity the given vector, turned to q1 = 0, is one of the
    representatives of the self-motion.
    """
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    q = at_shoulder(name, 0.0, rng)
    solutions = robot.ik(robot.fk(q))
    # Turning axis 1 alone leaves the wrist center: some representative has the same arm, or its
    # mirror behind axis 1.
    same = apart(solutions.q[:, 1:3], q[1:3]).min()
    turned = robot.ik_nearest(robot.fk(q), seed=q)
    assert same <= 1e-9
    assert apart(turned, q) <= 1e-9


def test_all_three_at_once_leave_one_solution():
    """An upright straight arm: nothing but its height and the sum of q1, q4 and q6 is
    determined.
    """
    robot = irbkin.Robot.from_opw(a1=0, a2=0, b=0, c1=0.4, c2=0.3, c3=0.3, c4=0.1)
    solutions = robot.ik(robot.fk([0.4, 0, 0, 0.3, 0, 0.2]))
    every = SingularityKind.WRIST | SingularityKind.ELBOW | SingularityKind.SHOULDER
    assert [(solution.slot, solution.singularities) for solution in solutions] == [(0, every)]
    assert (solutions.status[1:] & MERGED).all()
    for slot, met_at in ((1, Status.WRIST), (2, Status.ELBOW), (4, Status.SHOULDER)):
        assert solutions.status[slot] & met_at
    assert apart(solutions.q, [0, 0, 0, 0, 0, 0.9]).max() <= elbow_bound(
        "IRB 1200-5/0.9", 0.0, False
    )


@pytest.mark.parametrize(
    ("off", "folded"), [(0.0, False), (0.0, True), (3e-8, False), (-3e-8, False)]
)
@pytest.mark.parametrize("name", ABB)
def test_wrist_and_elbow_at_once_are_both_declared(name, off, folded):
    """An elbow that counts as straight leaves the forearm open by as much as it was bent, and axis
    5 with it.
    """
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        q = ordinary(rng)
        q[2], q[4] = angle_at_elbow(name, off, folded), 0.0
        pose = robot.fk(q)
        solutions = robot.ik(pose)
        check_closed(solutions, subjects()[name].reach)
        (solution,) = [solution for solution in solutions if apart(solution.q[:1], q[:1]) < 1e-6]
        assert solution.singularities == SingularityKind.WRIST | SingularityKind.ELBOW
        if off == 0:
            assert apart(robot.ik_nearest(pose, seed=q), q) <= elbow_bound(name, off, folded)


@pytest.mark.parametrize("beyond", [0.5e-9, 0.95e-9])
@pytest.mark.parametrize("name", ABB)
def test_a_pose_beyond_reach_within_the_tolerance_gets_the_stretched_arm(name, beyond):
    robot = free(name)
    q = np.array([0.4, 0.9, angle_at_elbow(name, 0.0, False), 0.3, 0.8, 0.2])
    pose = robot.fk(q)
    a1, _, height, *_ = ABB[name].lengths
    shoulder = np.array([a1 * np.cos(q[0]), a1 * np.sin(q[0]), height])
    wrist = pose[:3, 3] - ABB[name].lengths[5] * pose[:3, 2]
    pose[:3, 3] += beyond * (wrist - shoulder) / np.linalg.norm(wrist - shoulder)
    solutions = robot.ik(pose)
    assert apart(solutions.q, q).min() <= 1e-8
    assert all(
        SingularityKind.ELBOW in solution.singularities
        for solution in solutions
        if solution.slot < 4
    )
    assert min(solution.residual for solution in solutions) == pytest.approx(beyond, rel=1e-3)
