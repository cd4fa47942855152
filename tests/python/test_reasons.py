"""Why there is no solution, or no closed form: reach, shortfall, and the sentences that say so."""

import pickle
import re

import numpy as np
import pytest
from arms import ABB, CATALOG, ur_rows
from general_arms import TABLES
from irbkin import InvalidModelError, Reach, Robot, UnreachableError
from reference import move, turn

ROBOT = Robot("IRB 2600-12/1.65")
Q = np.deg2rad([10, -20, 30, 40, 50, 60])
FAR = move(9, 0, 0)
# Axis 1 is 10 deg or -170 deg in every solution: 3.1 deg outside.
NARROW = ROBOT.with_limits(np.deg2rad([[13.1, 20], *[[-180, 180]] * 5]))


def at_reach(name, by, *, folded=False):
    """A pose whose wrist center is `by` beyond the stretched or the folded arm, flange forward."""
    a1, elbow, height, upper, forearm, flange = ABB[name].lengths
    k = np.hypot(elbow, forearm)
    r = (abs(upper - k) if folded else upper + k) + by
    x, z = a1 + r * np.cos(0.3) + flange, height + r * np.sin(0.3)
    return move(x, 0, z) @ turn("y", np.pi / 2)


# An arm that does not reach behind axis 1 what is too near before it.
NEAR = next(name for name, arm in ABB.items() if arm.lengths[0] == 0)


@pytest.mark.parametrize(
    ("robot", "T", "words"),
    [
        (ROBOT, ROBOT.fk(Q), "8 solutions, "),
        (ROBOT, at_reach(ROBOT.name, 0.012), "wrist center 12.0 mm beyond reach"),
        (ROBOT, at_reach(ROBOT.name, 2e-6), "wrist center 2.0e-3 mm beyond reach"),
        (NARROW, ROBOT.fk(Q), "no solution inside the limits (8 outside); nearest: J1 by 3.1 deg"),
        (
            Robot(NEAR),
            at_reach(NEAR, -1e-3, folded=True),
            "wrist center 1.0 mm too near to be reached",
        ),
        (Robot.from_mdh(TABLES["random 0"]), FAR, "out of reach: no closed form; 0 real roots"),
    ],
)
def test_a_sentence_is_the_reason_of_every_function(robot, T, words):
    solutions = robot.ik(T)
    assert words in solutions.explain()
    assert pickle.loads(pickle.dumps(solutions)).explain() == solutions.explain()
    check = robot.check_pose(T)
    assert check.reason == solutions.explain()
    assert check.reachable is (len(solutions) > 0)
    assert check.within_limits is (len(solutions.within_limits()) > 0)
    if not check.within_limits:
        for call in (solutions.nearest, solutions.least_motion, lambda q: robot.ik_nearest(T, q)):
            with pytest.raises(UnreachableError, match=re.escape(words)):
                call(Q)


def test_reach_and_shortfall_are_known_but_where_a_pose_has_no_roots():
    for robot in (ROBOT, Robot("GoFa 5")):
        solutions = robot.ik(FAR)
        assert (solutions.reach, solutions.q.shape) == (Reach.TOO_FAR, (0, 6))
        assert 7.0 < solutions.shortfall < 9.0
        with pytest.raises(IndexError, match=r"solution 0 of 0: .* mm beyond reach"):
            solutions[0]
    solutions = Robot.from_mdh(TABLES["random 0"]).ik(FAR)
    assert (solutions.reach, solutions.certified) == (Reach.NO_ROOTS, True)
    assert np.isnan(solutions.shortfall)


def test_a_pose_at_a_limit_is_inside():
    """Rounding puts no target that was taught at the stop outside."""
    for off, inside in ((0.5e-9, True), (2e-9, False)):
        q = np.array([0.3, ROBOT.limits[1, 1] + off, 0.2, 0.4, 0.5, 0.6])
        found = min(ROBOT.ik(ROBOT.fk(q)), key=lambda solution: np.abs(solution.q - q).max())
        assert found.is_within_limits is inside


@pytest.mark.parametrize("name", ["GoFa 5", "IRB 2600-12/1.65", "UR5e", "IRB 14050", "Panda"])
def test_how_far_a_joint_is_outside_is_counted_at_its_best_turn(name):
    robot = Robot(name)
    limits = np.full((robot.dof, 2), [-np.pi, np.pi])
    limits[0] = np.radians([-150, -149.9])
    arm = robot.with_limits(limits)
    for q in np.random.default_rng(4).uniform(-1.2, 1.2, (12, robot.dof)):
        q[0] = np.radians(175)
        solutions = arm.ik(arm.fk(q), *q[6:])
        # Every joint but the first has a full turn.
        off = (solutions.q[:, 0] - limits[0].mean() + np.pi) % (2 * np.pi) - np.pi
        least = np.degrees(np.abs(off).min()) - 0.05
        count = f"no solution inside the limits ({len(solutions)} outside)"
        words = f"{count}; nearest: J1 by {least:.1f} deg"
        assert solutions.explain() == words


def test_a_seven_axis_arm_without_a_closed_form_says_how_near_it_gets():
    robot = Robot("IRB 14050")
    T = robot.fk(np.zeros(7))
    T[0, 3] += 5.0
    words = "no solution found, which is not certain: no closed form"
    reason = robot.check_pose(T).reason
    nearest = float(re.match(f"{words}; nearest approach (.+) mm", reason)[1])
    q = np.random.default_rng(3).uniform(*robot.limits.T, (20000, 7))
    away = np.linalg.norm(robot.fk(q)[:, :3, 3] - T[:3, 3], axis=-1).min() * 1e3
    assert away - 300 < nearest < away + 100
    for call in (
        lambda: robot.ik_nearest(T, np.zeros(7)),
        lambda: robot.ik_configured(T, (0, 0, 0, 0), arm_angle=0.1),
    ):
        with pytest.raises(UnreachableError, match=words):
            call()
    solutions = robot.locked({3: 0.1}).ik(T)
    assert "nearest approach" in solutions.explain()
    assert pickle.loads(pickle.dumps(solutions)).explain() == solutions.explain()


UR5E, IRB, PANDA = ur_rows("ur5e"), ABB[ROBOT.name].rows, CATALOG["Panda"].rows


def changed(row, column, by):
    """The table of an IRB 2600 with one number changed."""
    rows = IRB.copy()
    rows[row, column] += by
    return rows


WRIST = "for a spherical wrist on an ortho-parallel base, axes "
# What a table has in place of a closed form: how it is built, its rows, the end of the words.
MISSING = {
    "an angle": (
        Robot.from_mdh,
        changed(3, 0, np.pi / 180),
        f"{WRIST}3 and 4 must be at right angles, they are 1.000000 deg off",
    ),
    "a distance": (
        Robot.from_mdh,
        changed(5, 1, 0.01),
        "axes 5 and 6 must meet, they pass 10.000000 mm apart",
    ),
    "seven axes": (
        Robot.from_mdh,
        PANDA + 1e-3,
        "for a spherical shoulder and an offset elbow, axes 1 and 2 must be at right angles, they "
        "are 0.057296 deg off",
    ),
    "standard as modified": (
        Robot.from_mdh,
        UR5E,
        "; as a standard table it has three parallel axes: use from_sdh",
    ),
    "modified as standard": (
        Robot.from_sdh,
        Robot.from_sdh(UR5E).mdh,
        "; as a modified table it has three parallel axes: use from_mdh",
    ),
    "theta, d, a, alpha of the other convention": (
        Robot.from_mdh,
        UR5E[:, [3, 2, 1, 0]],
        "; with its columns as theta, d, a, alpha, as a standard table it has three parallel axes: "
        "reorder them to alpha, a, d, theta and use from_sdh",
    ),
    "1.5708": (
        Robot.from_sdh,
        np.round(UR5E, 4),
        " (write the angles with all their digits, which moves the tool by up to 3.3e-6 m); "
        "snap=1e-5 would take it",
    ),
}


@pytest.mark.parametrize(("build", "rows", "words"), MISSING.values(), ids=MISSING)
def test_a_table_without_a_closed_form_says_what_is_missing(build, rows, words):
    try:
        robot = build(rows)
        said = str(robot)
        assert robot.structure in ("general", "offset wrist")
    except InvalidModelError as refused:
        # In another reading, the joints of some tables are not independent.
        said = str(refused)
    assert words in said


@pytest.mark.parametrize(("off", "is_exact"), [(5e-10, True), (2e-9, False)])
def test_a_table_in_text_is_made_exact(off, is_exact):
    robot = Robot.from_mdh(changed(5, 1, off))
    assert (robot.structure == "spherical wrist") is is_exact


def test_axes_as_far_off_as_can_be_are_called_what_they_are():
    rows = Robot("Panda").mdh.copy()
    rows[3, 0] = 0.0
    words = str(Robot.from_mdh(rows))
    assert words.endswith("axes 3 and 4 must be at right angles, they are parallel"), words
    rows[3, 0] = 1e-3
    words = str(Robot.from_mdh(rows))
    assert "axes 3 and 4 must be at right angles, they are 89.942704 deg off" in words
