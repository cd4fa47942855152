"""What is certified is complete, where arms and poses are all but degenerate."""

import itertools
import os

import irbkin
import numpy as np
import pytest


def apart(found: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """The largest difference of a joint [rad], of the nearest slot of each row."""
    off = np.abs((found - wanted[:, None] + np.pi) % (2 * np.pi) - np.pi).max(-1)
    return np.where(np.isnan(off), 9, off).min(-1)


def certified(batch: irbkin.IkBatch) -> np.ndarray:
    return ((batch.status & irbkin.Status.UNCERTIFIED) == 0).all(-1)


@pytest.mark.parametrize("angle", [90, 89.99, 89, -89])
def test_a_given_joint_that_makes_axes_parallel_or_nearly_so(angle):
    yumi = irbkin.Robot("IRB 14050")
    q = np.random.default_rng(4).uniform(-np.pi, np.pi, (1000, 7))
    q[:, 3] = np.radians(angle)
    found = yumi.locked({4: q[0, 3]}).ik_batch(yumi.fk(q))
    # Next to a fold rounding moves a solution by its root.
    assert (apart(found.q, q) < 1e-3).all()
    assert np.median(apart(found.q, q)) < 1e-9
    assert certified(found).mean() > 0.95


@pytest.mark.parametrize("angle", [3e-7, 5e-7, 1e-6])
def test_axes_that_are_nearly_one_line(angle):
    rows = [
        [0, 0, 0.1, 0],
        [1.1, 0.2, -0.1, 0.3],
        [-0.7, 0.3, 0.2, 0.1],
        [angle, angle / 10, 0.1, 0],
        [0.9, -0.2, 0.3, 0.4],
        [-1.2, 0.1, 0.15, -0.2],
    ]
    arm = irbkin.Robot.from_mdh(rows)
    q = np.random.default_rng(0).uniform(-2, 2, (500, 6))
    found = arm.ik_batch(arm.fk(q))
    # Every joint vector is next to a singularity.
    assert not certified(found).any()
    assert (apart(found.q, q) < 1e-2).mean() > 0.95


# Tables by alpha [deg], a [m], d [m] and theta [deg], and joint vectors [deg] at which two
# directions are singular.
SINGULAR_TWICE = [
    (
        [180, 45, 0, 180, 45, -90],
        [0.3, 0, 0.25, 0.5, 0.1, 0.1],
        [0.25, 0, 0.5, 0.4, 0, 0.5],
        [180, 0, 0, 90, 0, 0],
        [-90, -90, 180, 0, 180, 90],
    ),
    (
        [90, 180, 45, 180, 45, 180],
        [0, 0.5, 0, 0.5, 0.5, 0.25],
        [0.1, 0, 0.4, 0, 0.5, 0.25],
        [-90, 0, 180, -90, 0, -90],
        [180, -90, 90, 180, 90, -90],
    ),
    (
        [-45, 90, 180, 90, 90, 0],
        [0, 0.3, 0.3, 0.5, 0.5, 0.25],
        [0.4, 0.1, 0.5, 0.1, 0, 0],
        [0, 0, -90, 0, 0, 45],
        [-57.9385, 80.3581, 180, 180, 90, -90],
    ),
]


@pytest.mark.parametrize("case", SINGULAR_TWICE)
def test_a_pose_that_is_singular_in_two_directions_has_an_answer(case):
    alpha, a, d, theta, q = case
    arm = irbkin.Robot.from_mdh(np.column_stack([np.radians(alpha), a, d, np.radians(theta)]))
    pose = arm.fk(np.radians(q))
    found = arm.ik(pose)
    assert len(found) > 0
    assert not found.certified
    assert max(solution.residual for solution in found) < 1e-13 * (
        np.abs(a).sum() + np.abs(d).sum()
    )
    assert found[0].singularities


@pytest.mark.parametrize("name", ["CRX-10iA", "CRX-10iA/L"])
def test_no_pose_at_which_two_directions_are_free_is_certified(name):
    """A walk along one of them does not show what the other leads to."""
    arm = irbkin.Robot(name)
    quarters = np.array(list(itertools.product(range(-1, 3), repeat=4))) * np.pi / 2
    q = np.column_stack([np.full(len(quarters), 0.3), quarters, np.full(len(quarters), 0.4)])
    q = q[np.linalg.svd(arm.jacobian(q), compute_uv=False)[:, 4] < 1e-9]
    assert len(q) > 40
    for pose in arm.fk(q):
        found = arm.ik(pose)
        assert len(found) > 0
        assert not found.certified
        assert "not certified" in str(found.explain())


@pytest.mark.parametrize("name", ["GoFa 5", "GoFa 10", "GoFa 12", "xArm6"])
def test_axes_4_and_6_parallel_to_axis_1_and_a_pose_in_single_precision(name):
    """Three solutions merge there; rounding of the pose leaves one or three of them."""
    arm = irbkin.Robot(name)
    rng = np.random.default_rng(2)
    q = rng.uniform(-1, 1, (300, 6))
    # Forearm and hand point straight down, or up: a posture of picking, and the xArm6's zero.
    q[:, 1] += 0.5
    q[:, 2] = -q[:, 1] if name == "xArm6" else np.pi / 2 - q[:, 1]
    q[:, 3:5] = 0
    found = arm.ik_batch(arm.fk(q).astype(np.float32))
    # Rounding moves a solution by its cube root.
    assert apart(found.q, q).max() < 0.03


def folds(arm: irbkin.Robot, low: np.ndarray, joint: int, step: np.ndarray | float) -> np.ndarray:
    """Where det J = 0, to rounding, between joint vectors and those with a joint a step ahead."""

    def determinant(q):
        return np.linalg.det(arm.jacobian(q))

    high = low.copy()
    high[:, joint] += step
    between = determinant(low) * determinant(high) < 0
    low, high = low[between], high[between]
    sign = determinant(low)
    for _ in range(60):
        middle = (low + high) / 2
        same = (determinant(middle) * sign > 0)[:, None]
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low


@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "GoFa 5"])
def test_calibrated_arms_at_a_fold(name):
    rng = np.random.default_rng(1)
    arm = irbkin.Robot(name).with_corrections(rng.normal(0, 5e-4, 42))
    q = folds(arm, rng.uniform(-np.pi, np.pi, (1500, 6)), 2, 1.0)
    found = arm.ik_batch(arm.fk(q))
    assert len(q) > 400
    assert not (certified(found) & (apart(found.q, q) > 1e-2)).any()
    assert (apart(found.q, q) < 1e-2).mean() > 0.99


def test_calibrated_arms_at_a_fold_with_a_wrist_that_is_nearly_straight():
    for seed in range(4):
        rng = np.random.default_rng(seed)
        corrections = np.zeros(42)
        corrections[6:-6] = rng.uniform(-5e-4, 5e-4, 30)
        arm = irbkin.Robot("IRB 2600-12/1.65").with_corrections(corrections)
        low = rng.uniform(-3, 3, (4000, 6))
        low[:, 4] = rng.uniform(-0.02, 0.02, 4000)
        q = folds(arm, low, 3, rng.uniform(0.2, 1.0, 4000))
        found = arm.ik_batch(arm.fk(q))
        assert not (certified(found) & (apart(found.q, q) > 1e-2)).any()
        assert (apart(found.q, q) < 1e-2).mean() > 0.99


@pytest.mark.parametrize("name", ["GoFa 5", "CRX-10iA/L", "xArm6"])
def test_where_many_solutions_merge_there_is_one(name):
    arm = irbkin.Robot(name)
    heaps = poses = 0
    for rest in itertools.product(range(-1, 3), repeat=4):
        q = np.array([0, *rest, 0]) * np.pi / 2
        found = arm.ik(arm.fk(q)).q
        off = np.abs((found[:, None] - found + np.pi) % (2 * np.pi) - np.pi).max(-1)
        near = (off + 9 * np.eye(len(found))) < 1e-2
        poses += 1
        # Of three, some are two that rounding parts.
        heaps += (near.sum(-1) > 2).any()
        assert not ((off + 9 * np.eye(len(found))) < 1e-6).any(), rest
    assert heaps <= poses // 50, f"{heaps} of {poses}"


def test_what_vanishing_determinants_hide_is_found():
    half = np.pi / 2
    rows = [
        [0, 0, 0, -half],
        [0, 0.2, 0, 0],
        [half, 0.4, -0.15, -2 * half],
        [-2 * half, 0.4, 0.3, 0],
        [-half, 0, 0.3, -2 * half],
        [-half, 0.4, -0.15, -half],
    ]
    arm = irbkin.Robot.from_mdh(rows)
    q = np.array([*itertools.product(range(-1, 3), repeat=5)]) * half
    q = np.insert(q, 0, 0.0, axis=1)
    regular = np.linalg.svd(arm.jacobian(q))[1].min(-1) > 1e-3
    found = arm.ik_batch(arm.fk(q))
    assert regular.sum() > 100
    assert not certified(found).all()
    assert (apart(found.q, q)[regular] < 1e-9).all()
    pose = arm.fk(np.radians([0, -90, -180, 0, -90, 90]))
    assert arm.check_pose(pose).reachable


RIGHT = ([0, 90, -90], [0], 90)
OBLIQUE = ([0, 0, 90, -90, 90, -90, 180, 45, -45, 30, 60], [0, 0, 0, 90, -90, 180, 45], 45)


@pytest.mark.parametrize(("alphas", "thetas", "step"), [RIGHT, OBLIQUE], ids=["right", "oblique"])
def test_random_tables_with_angles_that_are_round(alphas, thetas, step):
    rng = np.random.default_rng(12)
    tables = int(os.environ.get("TABLES", "60"))
    poses = complete = lost = empty = 0
    for _ in range(tables):
        alpha, theta = (np.radians(rng.choice(some, 6)) for some in (alphas, thetas))
        lengths = rng.choice([0, 0, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5], (6, 2))
        try:
            arm = irbkin.Robot.from_mdh(np.c_[alpha, lengths, theta])
        except irbkin.InvalidModelError:
            continue
        if arm.structure not in ("general", "offset wrist"):
            # A closed form certifies its self-motions, too.
            continue
        q = np.radians(rng.integers(-180 // step, 180 // step, (100, 6)) * float(step))
        # Half of them with a joint or two that are anywhere.
        anywhere = rng.random((100, 6)) < 0.3 * (np.arange(100) % 2)[:, None]
        q = np.where(anywhere, rng.uniform(-np.pi, np.pi, (100, 6)), q)
        pose = arm.fk(q)
        # Half of them a rounding off.
        pose[:50, :3, 3] += rng.normal(0, 1e-16, (50, 3))
        found = arm.ik_batch(pose)
        is_certified = certified(found)
        poses += len(q)
        complete += is_certified.sum()
        # Where several merge, rounding moves them by a root of itself.
        lost += (is_certified & (apart(found.q, q) > 2e-2)).sum()
        empty += np.isnan(found.q).all((-1, -2)).sum()
    print(f"{poses} poses, {complete} certified, {lost} of them without their joint vector")
    print(f"{empty} without an answer")
    assert poses > 20 * tables
    assert empty < 1e-3 * poses
    assert complete > 0.5 * poses
    assert lost == 0


# Alpha [deg], a, d [m], theta [deg]; joints [deg].
TWO_TO_A_ROOT = [
    (
        [-90, -45, 180, 90, 90, 0],
        [0.5, 0, 0.1, 0.3, 0.3, 0.25],
        [0.5, 0, 0.4, 0.5, 0.1, 0],
        [45, 180, 45, 45, 0, 0],
        [45, -180, -135, 90, 135, -90],
    ),
    (
        [0, 0, 90, 90, 0, 45],
        [0.5, 0.5, 0, 0, 0.1, 0],
        [0.25, 0.25, 0.25, 0.5, 0, 0.25],
        [0, 0, 0, 0, 0, -90],
        [0, -180, -45, -45, 135, -180],
    ),
    (
        [90, 180, -45, 90, -90, 45],
        [0.25, 0.25, 0, 0.5, 0, 0],
        [0.4, 0.4, 0.5, 0.25, 0.25, 0.4],
        [90, 45, 0, 45, 180, 0],
        [0, 0, 90, -135, -90, -135],
    ),
    (
        [90, 0, 90, 45, 90, 45],
        [0, 0.5, 0, 0.5, 0.3, 0],
        [0, 0.5, 0.1, 0, 0, 0.5],
        [-90, 180, -90, 90, 0, 0],
        [180, 45, 45, 180, -45, 45],
    ),
    (
        [-90, 180, 90, -90, 0, -90],
        [0, 0.5, 0, 0, 0.25, 0.1],
        [0.1, 0.4, 0.1, 0.1, 0.25, 0.1],
        [-90, 90, 90, 180, 90, 90],
        [-90, 180, 0, 90, -90, 90],
    ),
]


@pytest.mark.parametrize(("alpha", "a", "d", "theta", "q"), TWO_TO_A_ROOT)
def test_poses_that_give_two_solutions_to_a_root_of_a_split(alpha, a, d, theta, q):
    arm = irbkin.Robot.from_mdh(np.c_[np.radians(alpha), a, d, np.radians(theta)])
    assert arm.structure == "general"
    pose = np.repeat(arm.fk(np.radians(q))[None], 50, axis=0)
    pose[1:, :3, 3] += np.random.default_rng(0).normal(0, 1e-16, (49, 3))
    found = arm.ik_batch(pose)
    assert (apart(found.q, np.radians([q])) < 1e-9).all()
    counts = (~np.isnan(found.q[..., 0])).sum(-1)
    assert len({*counts[certified(found)]}) <= 1, counts


def test_axes_that_meet_in_two_points_three_by_three():
    """Axes 2, 3, 4 and 4, 5, 6: some splits have two solutions to a root."""
    degrees = [
        [-45, 0.2, 0.25, 0],
        [0, 0.2, 0.4, 0],
        [-45, 0, 0, 90],
        [-90, 0, 0.3, 90],
        [55, 0, 0, 0],
        [-70, 0, 0.3, 90],
    ]
    arm = irbkin.Robot.from_mdh(np.array(degrees) * [np.pi / 180, 1, 1, np.pi / 180])
    q = np.random.default_rng(1).uniform(-np.pi, np.pi, (500, 6))
    found = arm.ik_batch(arm.fk(q))
    assert (apart(found.q, q) < 1e-6).all()
    # The roots of the other splits are double.
    assert certified(found).mean() > 0.2


@pytest.mark.parametrize(("row", "off"), [(4, 1e-6), (4, 1e-3), (5, 1e-3)])
def test_a_wrist_that_is_straight_and_nearly_spherical(row, off):
    half = np.pi / 2
    rows = np.array(
        [
            [0, 0, 0.1525, 0],
            [-half, 0, 0.0345, -half],
            [0, 0.62, 0, half],
            [half, 0, 0.559, 0],
            [-half, 0, 0, 0],
            [half, 0, 0.121, 0],
        ]
    )
    rows[row, 0] += off
    arm = irbkin.Robot.from_mdh(rows)
    assert arm.structure == "offset wrist"
    q = np.random.default_rng(1).uniform(-np.pi, np.pi, (1000, 6))
    found = arm.ik_batch(arm.fk(q))
    assert certified(found).mean() > 0.9
    assert (apart(found.q, q) < 1e-6).all()
    q[:, 4] = 0
    found = arm.ik_batch(arm.fk(q))
    assert not (certified(found) & (apart(found.q, q) > 1e-2)).any()
    assert (apart(found.q, q) < 1e-2).all()
