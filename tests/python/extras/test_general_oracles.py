"""All solutions of arms without a closed form against solvers that share no formula with irbkin:
Newton's method from two hundred seeds, crx-kinematics and ssik.
"""

import contextlib
import io
import os

import irbkin
import numpy as np
import pytest
from general_arms import (
    TABLES,
    apart,
    distinct,
    fk,
    least_singular_value,
    missing,
    multi_start_newton,
    residual,
)
from reference import link

# `make evidence SUITE=general` asks for more.
POSES = int(os.environ.get("IRBKIN_POSES", "40"))
# A solution found by another solver to this [m, 1] counts; and is the same as one of irbkin's if
# they differ by no more than what that moves the joints.
CLOSES = 1e-9
# Least singular value above which a solution is one by itself, not on or next to a fold or a
# self-motion [m, 1]: there two programs may count differently, and irbkin flags.
ISOLATED = 1e-4


def structured(rows, kind, count):
    """Joint vectors of a kind."""
    rng = np.random.default_rng(5)
    q = rng.uniform(-np.pi, np.pi, (count, 6))
    if kind == "q4 = 0":
        q[:, 3] = 0.0
    elif kind == "q5 = 0":
        q[:, 4] = 0.0
    elif kind == "q4 next to 0":
        q[:, 3] = 10.0 ** rng.uniform(-12, -3, count)
    elif kind == "multiples of 45 deg":
        q = rng.integers(-3, 5, (count, 6)) * np.pi / 4
    elif kind == "next to a fold":
        q = np.array([next_to_a_fold(rows, each) for each in q])
    return q


def next_to_a_fold(rows, q):
    """The joints with joint 3 turned until the determinant of the Jacobian changes its sign, to
    1e-5 rad; as they are where it does not.
    """
    turned = np.repeat(q[None], 181, axis=0)
    turned[:, 2] = np.linspace(-np.pi, np.pi, 181)

    def signs(joints):
        return np.sign(np.linalg.det(missing(rows, joints, np.eye(4))[1]))

    changes = np.flatnonzero(np.diff(signs(turned)))
    if not len(changes):
        return q
    low, high = turned[changes[0]], turned[changes[0] + 1]
    while apart(low, high) > 1e-5:
        middle = (low + high) / 2
        if signs(middle[None])[0] == signs(low[None])[0]:
            low = middle
        else:
            high = middle
    return low


KINDS = ("random", "q4 = 0", "q4 next to 0", "q5 = 0", "multiples of 45 deg", "next to a fold")


class Count:
    """What two solvers disagree about, over the poses of a kind."""

    def __init__(self, rows):
        self.rows, self.found, self.only_ours, self.lost, self.flagged = rows, 0, 0, [], 0

    def compare(self, robot, q, others):
        """One pose, made from q: irbkin's solutions and those of others."""
        pose = fk(self.rows, q)
        solutions = robot.ik(pose)
        ours = np.asarray(solutions.q).reshape(-1, 6)
        # Whatever is returned meets the pose.
        if len(ours):
            assert residual(self.rows, ours, pose).max() < CLOSES
            assert len(distinct(ours, 1e-9)) == len(ours)
        wanted = np.vstack([q, *(each for each in others if len(each))])
        wanted = wanted[residual(self.rows, wanted, pose) <= CLOSES]
        least = least_singular_value(self.rows, wanted)
        wanted, least = wanted[least > ISOLATED], least[least > ISOLATED]
        for each, singular in zip(wanted, least, strict=True):
            near = 4 * CLOSES / singular
            if len(ours) and apart(ours, each).min() <= near:
                self.found += 1
            elif solutions.certified:
                self.lost.append((q.tolist(), each.tolist(), float(singular)))
            else:
                self.flagged += 1

    def check(self, kind):
        """A certified answer lacks nothing. Random poses are all found; of structured ones, which
        have self-motions and folds among them, what is missing is flagged.
        """
        assert not self.lost, f"{len(self.lost)} lost, the first {self.lost[0]}"
        assert self.flagged == 0 if kind == "random" else self.flagged < self.found, self.flagged
        assert self.found > 0


@pytest.fixture(params=TABLES, scope="module")
def arm(request):
    rows = TABLES[request.param]
    return request.param, rows, irbkin.Robot.from_mdh(rows)


@pytest.mark.parametrize("kind", KINDS)
def test_what_newton_finds_from_many_seeds_is_found(arm, kind):
    _, rows, robot = arm
    count, rng = Count(rows), np.random.default_rng(7)
    joints = structured(rows, kind, POSES // 2)
    for q in joints:
        count.compare(robot, q, [multi_start_newton(rows, fk(rows, q), rng=rng)])
    count.check(kind)


@pytest.mark.parametrize("kind", KINDS)
def test_what_crx_kinematics_finds_is_found(kind):
    crx = pytest.importorskip("crx_kinematics")
    rows, peer = TABLES["CRX-10iA/L"], crx.Crx.crx10ial()
    robot = irbkin.Robot.from_mdh(rows)
    count = Count(rows)
    for q in structured(rows, kind, 3 * POSES):
        target = fk(rows, q)
        target[:3, 3] = 1e3 * (target[:3, 3] - [0.0, 0.0, rows[0, 2]])
        j1, j2, j3, j4, j5, j6 = np.asarray(peer.ik(target), dtype=float).reshape(-1, 6).T
        # J3 counts from the floor, J4 and J6 the other way round.
        found = np.deg2rad(np.column_stack([j1, j2, -j3 - j2, 180.0 - j4, j5, -j6]))
        count.compare(robot, q, [found])
    count.check(kind)


@pytest.mark.parametrize("name", ["CRX-10iA", "CRX-10iA/L"])
def test_poses_of_a_pendant_are_of_the_world_at_axis_2(name):
    """As the guide gives it for FANUC's; crx-kinematics has joints and poses of the controller."""
    crx = pytest.importorskip("crx_kinematics").Crx
    peer = crx.crx10ial() if name.endswith("L") else crx.crx10ia()
    pendant = irbkin.Robot(name).coupled().with_base(irbkin.pose([0, 0, -0.245]))
    for q in pendant.random(200, 1):
        shown = np.reshape(peer.fk(np.degrees(q)), (4, 4))
        shown[:3, 3] /= 1e3
        np.testing.assert_allclose(shown, pendant.fk(q), rtol=0, atol=1e-14)


@pytest.fixture(scope="module")
def by_ssik(arm, tmp_path_factory):
    """ssik's answers for the arm; its preparation takes a minute."""
    import ssik

    _, rows, _ = arm
    with contextlib.redirect_stdout(io.StringIO()):
        built = ssik.Manipulator.from_transforms([*(link(*row) for row in rows), np.eye(4)])
    return lambda pose: [each.q for each in built.solve(pose, respect_limits=False)]


@pytest.mark.evidence
@pytest.mark.parametrize("kind", KINDS)
def test_what_ssik_finds_is_found(arm, by_ssik, kind):
    _, rows, robot = arm
    count = Count(rows)
    joints = structured(rows, kind, POSES // 4)
    for q in joints:
        found = np.array(by_ssik(fk(rows, q)), dtype=float).reshape(-1, 6)
        count.compare(robot, q, [found])
    count.check(kind)
