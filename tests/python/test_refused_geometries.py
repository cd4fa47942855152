"""Geometries that have no closed form: the refusal names the axes and the figure."""

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOG, GOFA_ROWS_MM_DEG, ur_rows
from reference import fk, reach


def changed(row, column, value):
    """The table of an IRB 2600 with one number changed."""
    rows = ABB["IRB 2600-12/1.65"].rows.copy()
    rows[row, column] += value
    return rows


DEG = np.deg2rad(1)
REFUSED = {
    "axes 1 and 2 must be at right angles, they are 10.000000 deg off": changed(1, 0, 10 * DEG),
    "axes 2 and 3 must be parallel, they are 1.000000 deg off": changed(2, 0, DEG),
    "axes 3 and 4 must be at right angles, they are 0.500000 deg off": changed(3, 0, -0.5 * DEG),
    "axes 4 and 5 must be at right angles, they are 2.000000 deg off": changed(4, 0, 2 * DEG),
    "axes 5 and 6 must be at right angles, they are 45.000000 deg off": changed(5, 0, 45 * DEG),
    "axes 4 and 5 must meet, they pass 5.000000 mm apart": changed(4, 1, 0.005),
    "axes 5 and 6 must meet, they pass 10.000000 mm apart": changed(5, 1, -0.01),
    "axes 4 and 6 must meet, they pass 7.000000 mm apart": changed(4, 2, 0.007),
}


@pytest.mark.parametrize("message", REFUSED)
def test_a_refusal_names_the_axes_and_the_figure(message):
    with pytest.raises(irbkin.InvalidModelError) as refused:
        irbkin.Robot.from_mdh(REFUSED[message])
    assert message in str(refused.value)
    assert str(refused.value).count("axes") == 1
    assert str(refused.value).startswith("no closed-form inverse kinematics for this arm")


def test_a_refusal_names_every_condition():
    rows = changed(2, 0, DEG)
    rows[5, 1] = 0.01
    with pytest.raises(
        irbkin.InvalidModelError, match=r"axes 2 and 3 must be parallel.*; axes 5 and 6 must meet"
    ):
        irbkin.Robot.from_mdh(rows)


def gofa_rows():
    rows = np.array(GOFA_ROWS_MM_DEG, dtype=float)
    return np.column_stack([np.deg2rad(rows[:, 0]), rows[:, 1:3] / 1e3, np.deg2rad(rows[:, 3])])


def tilted_ur5e():
    rows = ur_rows("ur5e")
    rows[2, 0] += np.deg2rad(1)
    return rows


# Arms that engineers have and that are of other forms: (how to build, what is said).
OTHERS = {
    "GoFa": (
        lambda **more: irbkin.Robot.from_mdh(gofa_rows(), **more),
        r"axes 5 and 6 must meet, they pass 80\.000000 mm apart",
    ),
    "UR5e with axis 4 tilted": (
        lambda **more: irbkin.Robot.from_sdh(tilted_ur5e(), **more),
        r"for three parallel axes, axes 3 and 4 must be parallel, they are 1\.000000 deg off",
    ),
}
SOLVES = {
    "ik": lambda robot, pose: robot.ik(pose),
    "ik_batch": lambda robot, pose: robot.ik_batch(pose),
    "ik_nearest": lambda robot, pose: robot.ik_nearest(pose, np.zeros(robot.dof)),
    "check_pose": lambda robot, pose: robot.check_pose(pose),
}


@pytest.mark.parametrize("name", OTHERS)
def test_an_arm_without_closed_form_is_accepted_on_request(name):
    build, words = OTHERS[name]
    with pytest.raises(irbkin.InvalidModelError, match=words):
        build()
    robot = build(closed_form=False, name="mine")
    assert (robot.structure, robot.name, robot.dof) == ("unknown", "mine", 6)
    assert robot.fk(np.zeros(6)).shape == (4, 4)
    assert robot.jacobian(np.zeros(6)).shape == (6, 6)


@pytest.mark.parametrize("solve", SOLVES.values(), ids=SOLVES)
@pytest.mark.parametrize("name", OTHERS)
def test_every_solve_of_an_arm_without_closed_form_reports_the_reason(name, solve):
    build, words = OTHERS[name]
    robot = build(closed_form=False)
    with pytest.raises(irbkin.InvalidModelError, match=words):
        solve(robot, robot.fk(np.zeros(6)))


@pytest.mark.parametrize("solve", SOLVES.values(), ids=SOLVES)
def test_a_seven_axis_arm_says_that_it_has_no_closed_form(solve):
    rows = CATALOG["Panda"].rows + 1e-3
    robot = irbkin.Robot.from_mdh(rows)
    with pytest.raises(
        irbkin.InvalidModelError,
        match=r"spherical shoulder and an offset elbow, axes 1 and 2 must be at right angles, "
        r"they are 0\.057296 deg",
    ):
        solve(robot, robot.fk(np.zeros(7)))


def test_closed_form_false_keeps_the_closed_form_of_an_arm_that_has_one():
    robot = irbkin.Robot.from_mdh(ABB["IRB 140-6/0.81"].rows, closed_form=False)
    assert robot.structure == "spherical wrist"
    assert len(robot.ik(robot.fk([0.1] * 6))) == 8


@pytest.mark.parametrize(("off", "taken"), [(5e-10, True), (2e-9, False)])
def test_a_table_in_text_is_made_exact(off, taken):
    rows = changed(5, 1, off)
    rows[2, 0] += off
    if taken:
        robot = irbkin.Robot.from_mdh(rows)
        q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
        assert max(solution.residual for solution in robot.ik(robot.fk(q))) <= 1e-14
        assert np.abs(robot.fk(q) - fk(rows, q)).max() <= 2 * off * reach(rows)
    else:
        with pytest.raises(irbkin.InvalidModelError, match="axes 5 and 6 must meet"):
            irbkin.Robot.from_mdh(rows)


@pytest.mark.parametrize("row", [2, 3], ids=["upper arm", "forearm"])
def test_a_link_without_length_is_refused(row):
    rows = ABB["IRB 140-6/0.81"].rows.copy()
    rows[row, 1:3] = 0
    with pytest.raises(
        irbkin.InvalidModelError, match=r"(upper arm|forearm) .*is 0 m, it must be at least 1e-6 m"
    ):
        irbkin.Robot.from_mdh(rows)
