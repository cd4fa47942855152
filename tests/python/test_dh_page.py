"""What docs/dh.md says of standard and modified tables, and every figure that it prints."""

import re
from pathlib import Path

import irbkin
import numpy as np
import pytest
import roboticstoolbox
import spatialmath
from arms import ABB, KUKA_KR6, PANDA, ur_rows
from reference import (
    UNIT,
    apart,
    fk,
    fk_sdh,
    frames,
    jacobian,
    link,
    move,
    reach,
    rotation_apart,
    rounding,
    turn,
)
from tables import about, columns, down, mdh_frames, rigid, sdh_frames, up

PAGE = (Path(__file__).parents[2] / "docs" / "dh.md").read_text()
PROSE = " ".join(PAGE.split())
Q = np.array([0.3, -0.5, 0.2, -1.8, 0.4, 1.6, 0.7])
UR3 = ur_rows("ur3")
IRB = "IRB 2600-12/1.65"
ANGULAR_FIRST = [3, 4, 5, 0, 1, 2]
PANDA_SDH, UR3_MDH = up(PANDA.rows), down(UR3)


def table(corner):
    """Cells of the page's table whose first heading is `corner`, without the headings."""
    lines = PAGE[PAGE.index(f"| {corner} |") :].split("\n\n")[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def numbers(cell):
    return [float(number) for number in cell.split(",")]


def in_mm_deg(rows):
    return np.column_stack([np.rad2deg(rows[:, 0]), 1e3 * rows[:, 1:3]])


def off(found, wanted):
    """Position [mm] and orientation [deg] by which a pose is off."""
    return 1e3 * np.linalg.norm(found[:3, 3] - wanted[:3, 3]), np.rad2deg(
        rotation_apart(found, wanted)
    )


def arms():
    """Random tables of seven joints, with a joint vector."""
    rng = np.random.default_rng(11)
    return zip(rng.uniform(-1, 1, (20, 7, 4)), rng.uniform(-3, 3, (20, 7)), strict=True)


def close(found, wanted, size):
    np.testing.assert_allclose(found, wanted, rtol=0, atol=rounding(size))


def test_the_tables_of_the_page_are_those_of_one_arm():
    modified, standard, near, far = (
        [numbers(row[i]) for row in table("panda")] for i in (1, 2, 3, 4)
    )
    np.testing.assert_allclose(modified, in_mm_deg(PANDA.rows), rtol=8 * UNIT)
    np.testing.assert_allclose(standard, in_mm_deg(PANDA_SDH), rtol=8 * UNIT)
    bound = 1e3 * rounding(reach(PANDA.rows))
    np.testing.assert_allclose(
        near, 1e3 * mdh_frames(PANDA.rows, np.zeros(7))[1:, :3, 3], rtol=0, atol=bound
    )
    np.testing.assert_allclose(
        far, 1e3 * sdh_frames(PANDA_SDH, np.zeros(7))[1:, :3, 3], rtol=0, atol=bound
    )
    standard, modified = ([numbers(row[i]) for row in table("ur3")] for i in (1, 2))
    np.testing.assert_allclose(standard, in_mm_deg(UR3), rtol=8 * UNIT)
    np.testing.assert_allclose(modified, in_mm_deg(UR3_MDH), rtol=8 * UNIT)
    for sdh, mdh in ((PANDA_SDH, PANDA.rows), (UR3, UR3_MDH)):
        close(fk_sdh(sdh, Q[: len(sdh)]), fk(mdh, Q[: len(mdh)]), reach(mdh))


def test_the_shift_of_rows_leaves_a_base_or_a_flange():
    for rows, q in arms():
        close(rigid(*rows[0, :2]) @ fk_sdh(up(rows), q), fk(rows, q), reach(rows))
        close(fk(down(rows), q) @ rigid(*rows[-1, :2]), fk_sdh(rows, q), reach(rows))
        robot = irbkin.Robot.from_sdh(rows)
        np.testing.assert_allclose(robot.mdh, down(rows), rtol=0, atol=8 * UNIT)
        np.testing.assert_allclose(robot.flange, rigid(*rows[-1, :2]), rtol=0, atol=8 * UNIT)
    kuka = irbkin.Robot.from_opw(**KUKA_KR6)
    np.testing.assert_array_equal(kuka.mdh[0, :2], [np.pi, 0])  # z down: the page's base


def test_turning_and_shifting_commute_within_a_row():
    for rows, _ in arms():
        for alpha, a, d, theta in rows:
            close(rigid(alpha, a), move(a, 0, 0) @ turn("x", alpha), 1)
            close(about(d, theta), turn("z", theta) @ move(0, 0, d), 1)


@pytest.mark.parametrize(
    ("frames_of", "index"), [(sdh_frames, -1), (mdh_frames, 0)], ids=["standard", "modified"]
)
def test_standard_frames_sit_at_the_far_end_and_modified_ones_at_the_near(frames_of, index):
    for rows, q in arms():
        still = frames_of(rows, q)
        for joint in range(1, 8):
            turned = frames_of(rows, q + 0.4 * np.eye(7)[joint - 1])
            # Frame i is fixed to link i: the first that moves is that of the joint.
            np.testing.assert_array_equal(turned[:joint], still[:joint])
            assert np.abs(turned[joint] - still[joint]).max() > 0.01
            # The link takes along two points of z of frame `joint + index`, and leaves them where
            # they were: the axis.
            points = still[joint + index] @ [[0, 0], [0, 0], [0, 1], [1, 1]]
            close(turned[joint] @ np.linalg.solve(still[joint], points), points, 4 * reach(rows))


def test_frames_of_one_table_follow_from_those_of_the_other():
    for sdh, q in arms():
        standard, modified = sdh_frames(sdh, q), irbkin.Robot.from_sdh(sdh).link_frames(q)
        close(modified[:-1], mdh_frames(down(sdh), q)[1:], reach(sdh))
        for i, (alpha, a, d, theta) in enumerate(sdh):
            close(modified[i] @ rigid(alpha, a), standard[i + 1], reach(sdh))
            close(standard[i] @ about(d, theta + q[i]), modified[i], reach(sdh))


def test_a_table_read_wrongly_looks_right_at_zero():
    for rows, _ in arms():
        rows[:, 3] = 0
        close(fk(rows, np.zeros(7))[:3, :3], fk_sdh(rows, np.zeros(7))[:3, :3], 1)
    mm_at_zero, deg_at_zero, mm, deg = (row[1:] for row in table("read wrongly"))
    cases = [(fk, PANDA_SDH, fk_sdh), (fk_sdh, PANDA.rows, fk), (fk, UR3, fk_sdh)]
    for i, (read, rows, right) in enumerate(cases):
        zero, q = np.zeros(len(rows)), Q[: len(rows)]
        found = [*off(read(rows, zero), right(rows, zero)), *off(read(rows, q), right(rows, q))]
        assert [f"{figure:.1f}" for figure in found] == [
            mm_at_zero[i],
            deg_at_zero[i],
            mm[i],
            deg[i],
        ]


@pytest.mark.parametrize("name", ABB)
def test_irbkin_refuses_the_mixed_tables_of_abb(name):
    printed = " ".join(re.search(r"both with `(axes 1[^`]*)`", PAGE).group(1).split())
    rows = ABB[name].rows
    for make, mixed in ((irbkin.Robot.from_mdh, up(rows)), (irbkin.Robot.from_sdh, rows)):
        with pytest.raises(irbkin.InvalidModelError, match=re.escape(printed)):
            make(mixed)


def test_parallel_axes_share_their_d():
    shift = UR3[3, 2]
    assert (
        re.search(r"frames 2 and 3 move along the axis by ([\d.]+) mm", PROSE).group(1)
        == f"{1e3 * shift:.2f}"
    )
    for rows, frames_of, pose in ((UR3, sdh_frames, fk_sdh), (UR3_MDH, mdh_frames, fk)):
        moved = rows.copy()
        moved[[1, 3], 2] += shift, -shift
        close(pose(moved, Q[:6]), pose(rows, Q[:6]), reach(moved))
        way = frames_of(moved, Q[:6])[:, :3, 3] - frames_of(rows, Q[:6])[:, :3, 3]
        close(np.linalg.norm(way, axis=1), [0, 0, shift, shift, 0, 0, 0], reach(moved))
    for rows, q in arms():
        rows[3, 0] = np.pi  # axes 3 and 4 of a modified table are parallel and head opposite ways
        moved = rows.copy()
        moved[[2, 3], 2] += shift
        close(fk(moved, q), fk(rows, q), reach(moved))


def test_ik_does_not_depend_on_how_parallel_axes_share_their_d():
    rows = ABB[IRB].rows.copy()
    rows[[1, 2], 2] = 0.3, -0.3
    robot, moved = irbkin.Robot(IRB), irbkin.Robot.from_mdh(rows)
    here = robot.ik(robot.fk(Q[:6])).q_by_slot
    sigma = robot.singularity(here).min_singular_value.min()
    assert np.isfinite(here).all()
    difference = apart(moved.ik(robot.fk(Q[:6])).q_by_slot, here)
    assert difference.max() <= 2 * rounding(reach(rows)) * (1 + reach(rows)) / sigma


def test_a_link_with_two_joints_has_two_standard_rows_and_one_modified():
    torso = table("torso")
    for _, *cells in torso:
        (x, y, z), (alpha, a, d, theta), row, child = map(numbers, cells)
        standard = about(d, np.deg2rad(theta)) @ rigid(np.deg2rad(alpha), a)
        alpha, a, d, theta = row
        modified = link(np.deg2rad(alpha), a, d, np.deg2rad(theta)) @ rigid(
            np.deg2rad(child[0]), child[1]
        )
        for axis in (standard, modified):
            close(axis[:3, 2], [1, 0, 0], 1)
            close(axis[:3, 3], [x, y, z], 1e4)
    (_, _, left, of_left, _), (_, _, right, of_right, _) = torso
    assert left != right
    assert of_left == of_right


def test_a_further_child_needs_a_turn_and_a_shift_before_its_row():
    """Any axis, seen from a frame that suits another one, by its common normal with z."""
    rng = np.random.default_rng(14)
    for point, along in rng.uniform(-1, 1, (20, 2, 3)):
        along = along / np.linalg.norm(along)
        sine = np.hypot(*along[:2])
        normal = np.array([-along[1], along[0], 0]) / sine
        foot = point - along * (along[:2] @ point[:2]) / sine**2
        gamma, alpha = np.arctan2(normal[1], normal[0]), np.arctan2(sine, along[2])
        child = about(foot[2], gamma) @ rigid(alpha, normal @ foot)
        close(child[:3, 2], along, 1 / sine)
        close(np.cross(child[:3, 3] - point, along), 0, 1 / sine**2)


def test_the_jacobian_index_trap():
    modified, standard = mdh_frames(PANDA.rows, Q), sdh_frames(PANDA_SDH, Q)
    by_differences = jacobian(lambda q: fk(PANDA.rows, q), Q)
    bound = 2 * reach(PANDA.rows)
    right = columns(modified[1:], modified[-1])
    for found in (right, columns(standard[:-1], standard[-1]), irbkin.Robot("Panda").jacobian(Q)):
        close(found, by_differences, bound)
    before, behind = columns(modified[:-1], modified[-1]), columns(standard[1:], standard[-1])
    close(before[:, 1:], right[:, :-1], bound)
    close(behind[:, :-1], right[:, 1:], bound)
    for wrong, (_, linear, angular, column) in zip(
        (before, behind), table("wrong index"), strict=True
    ):
        error = np.abs(wrong - right)
        assert (f"{error[:3].max():.3f}", f"{error[3:].max():.3f}") == (linear, angular)
        unseen = np.flatnonzero(error.max(axis=0) < rounding(bound)) + 1
        assert [int(column)] == list(unseen)


def test_parallel_axes_hide_the_trap_from_the_angular_rows():
    poses = sdh_frames(UR3, Q[:6])
    error = np.abs(columns(poses[1:], poses[-1]) - columns(poses[:-1], poses[-1]))[:, 1:3]
    close(error[3:], 0, 1)
    assert f"{error[:3].max():.3f}" == re.search(r"by up to ([\d.]+) m/rad", PROSE).group(1)
    assert error[:3].max(axis=0).min() > 0.2


@pytest.mark.parametrize(
    ("kind", "make", "rows", "tables"),
    [
        (roboticstoolbox.RevoluteMDH, irbkin.Robot.from_mdh, PANDA.rows, mdh_frames),
        (roboticstoolbox.RevoluteDH, irbkin.Robot.from_sdh, PANDA_SDH, sdh_frames),
        (roboticstoolbox.RevoluteMDH, irbkin.Robot.from_mdh, UR3_MDH, mdh_frames),
        (roboticstoolbox.RevoluteDH, irbkin.Robot.from_sdh, UR3, sdh_frames),
    ],
    ids=["Panda, modified", "Panda, standard", "UR3, modified", "UR3, standard"],
)
def test_the_toolbox_has_the_same_frames_and_jacobian(kind, make, rows, tables):
    links = [kind(alpha=alpha, a=a, d=d, offset=theta) for alpha, a, d, theta in rows]
    tool = move(0.1, -0.2, 0.3) @ turn("x", 0.7)
    chain = roboticstoolbox.DHRobot(links)
    robot = make(rows)
    for q in np.random.default_rng(13).uniform(-3, 3, (20, len(rows))):
        close(np.array([pose.A for pose in chain.fkine_all(q)]), tables(rows, q), reach(rows))
        close(robot.jacobian(q), chain.jacob0(q), 2 * (reach(rows) + 1))
    chain.tool = spatialmath.SE3(tool, check=False)
    close(
        robot.with_tool(tool).jacobian(Q[: len(rows)]),
        chain.jacob0(Q[: len(rows)]),
        2 * (reach(rows) + 2),
    )


def test_linear_rows_come_first_and_the_swap_undoes_itself():
    found = irbkin.Robot("Panda").jacobian(Q)
    axes = frames(PANDA.rows, Q)[:, :3, 2].T
    close(found[3:], axes, reach(PANDA.rows))
    close(found[ANGULAR_FIRST][:3], axes, reach(PANDA.rows))
    np.testing.assert_array_equal(found[ANGULAR_FIRST][ANGULAR_FIRST], found)
    assert f"J[{ANGULAR_FIRST}]" in PAGE


def test_the_joints_of_the_page_are_those_of_the_tests():
    assert f"q = np.array({Q.tolist()})" in PAGE
