"""What the pictures of `irbkin.plot` show: data, labels, limits; and what they refuse."""

import subprocess
import sys

import irbkin
import matplotlib as mpl
import numpy as np
import pytest
from irbkin import plot, trajectory
from matplotlib.figure import Figure
from pictures import PLAN, curves, shaded

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
T = irbkin.pose([0.85, 0.32, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
START, END = np.radians([[0, 0, 0, 0, 90, 0], [90, -10, 40, 10, 60, 60]])
LIMITS = {"max_velocity": ROBOT.max_velocity, "max_acceleration": 8.0}
MOVE = trajectory.joint(START, END, profile="trapezoid", **LIMITS)


def every_picture():
    """A picture of each function."""
    q = MOVE.q
    return {
        "trajectory": plot.trajectory(MOVE),
        "singularity": plot.singularity(ROBOT, q),
        "plan": plot.plan(ROBOT, PLAN),
    }


def test_every_function_returns_a_figure_and_leaves_no_state(tmp_path):
    before = dict(mpl.rcParams)
    pictures = every_picture()
    assert set(pictures) == set(plot.__all__)
    for name, figure in pictures.items():
        assert isinstance(figure, Figure), name
        figure.savefig(tmp_path / f"{name}.svg")
        assert (tmp_path / f"{name}.svg").stat().st_size > 1000
    assert dict(mpl.rcParams) == before


def test_pyplot_is_not_imported_and_irbkin_does_not_import_matplotlib():
    code = """
import sys, irbkin, irbkin.trajectory
assert "matplotlib" not in sys.modules
import numpy as np
move = irbkin.trajectory.joint(np.zeros(6), np.ones(6))
robot = irbkin.Robot("IRB 2600-12/1.65")
irbkin.plot.trajectory(move)
irbkin.plot.singularity(robot, move.q)
assert "matplotlib.pyplot" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_without_matplotlib_the_error_names_the_extra(monkeypatch):
    for name in [name for name in sys.modules if name.startswith("irbkin.plot")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr(irbkin, "plot", raising=False)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    needed = r"^irbkin\.plot needs .* pip install 'irbkin\[plot\]'$"
    with pytest.raises(AttributeError, match=needed):
        _ = irbkin.plot
    # The rest of the package does not need it.
    namespace = {}
    exec("from irbkin import *", namespace)
    assert "plot" not in namespace
    assert "trajectory" in namespace


def test_a_picture_shows_itself_in_a_notebook():
    text = plot.trajectory(MOVE)._repr_svg_()
    assert text.startswith("<svg")
    assert text.count("<path") > 40


def test_a_motion_is_drawn_in_degrees_over_seconds():
    figure = plot.trajectory(MOVE)
    assert [axes.get_title() for axes in figure.axes] == ["position", "velocity", "acceleration"]
    units = ["deg", "deg/s", "deg/s²"]
    for axes, unit, name in zip(figure.axes, units, ("q", "dq", "ddq"), strict=True):
        assert axes.get_xlabel() == "time [s]"
        assert axes.get_ylabel().endswith(f"[{unit}]")
        lines = curves(axes)
        assert [line.get_label() for line in lines] == ["J1", "J2", "J3", "J4", "J5", "J6"]
        for joint, line in enumerate(lines):
            drawn = getattr(MOVE.sample(line.get_xdata()), name)[:, joint]
            np.testing.assert_allclose(line.get_ydata(), np.degrees(drawn), rtol=0, atol=1e-9)
        assert len({line.get_color() for line in lines}) == 6
        # Black and white tells them apart as well.
        assert len({str(line.get_linestyle()) + str(line._dash_pattern) for line in lines}) == 6
        assert not shaded(axes)
    assert [text.get_text() for text in figure.legends[0].get_texts()][-1] == "J6"


def test_both_sides_of_a_jump_of_the_acceleration_are_drawn():
    line = curves(plot.trajectory(MOVE).axes[2])[0]
    t, y = line.get_data()
    for knot in MOVE.knots[1:-1]:
        before, after = y[t < knot][-1], y[t >= knot][0]
        exact = np.degrees(MOVE.sample([np.nextafter(knot, 0), knot]).ddq[:, 0])
        np.testing.assert_allclose([before, after], exact, rtol=0, atol=1e-9)


def test_what_is_beyond_a_limit_is_shaded():
    figure = plot.trajectory(MOVE, robot=ROBOT, max_acceleration=8.0)
    assert len(figure.axes) == 18
    grid = np.reshape(figure.axes, (6, 3))
    for joint, (position, velocity, acceleration) in enumerate(grid):
        speed, rate = np.degrees([ROBOT.max_velocity[joint], 8.0])
        bounds = [np.degrees(ROBOT.limits[joint]), [-speed, speed], [-rate, rate]]
        for axes, (lower, upper) in zip((position, velocity, acceleration), bounds, strict=True):
            bottom, top = axes.get_ylim()
            assert bottom < lower < upper < top
            wanted = [(bottom, lower), (upper, top)]
            np.testing.assert_allclose(shaded(axes), wanted, rtol=1e-12)
            assert axes.get_ylabel().startswith(f"J{joint + 1} [")
            assert len(curves(axes)) == 1


def test_limits_that_are_given_come_before_those_of_the_robot():
    limits = np.column_stack([ROBOT.limits[:, 0], np.full(6, 2.0)])
    grid = np.reshape(plot.trajectory(MOVE, robot=ROBOT, limits=limits).axes, (6, 3))
    assert all(abs(shaded(axes)[1][0] - np.degrees(2.0)) < 1e-9 for axes in grid[:, 0])
    assert not any(shaded(axes) for axes in grid[:, 2])
    # An infinite limit is none.
    open_ends = np.column_stack([np.full(6, -np.inf), np.full(6, 2.0)])
    grid = np.reshape(plot.trajectory(MOVE, limits=open_ends).axes, (6, 3))
    assert all(len(shaded(axes)) == 1 for axes in grid[:, 0])


def test_a_still_motion_is_drawn():
    still = trajectory.joint([1.0], [1.0], max_velocity=1.0, max_acceleration=1.0)
    figure = plot.trajectory(still, max_velocity=1.0)
    assert set(figure.axes[0].lines[0].get_ydata()) == {np.degrees(1.0)}


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"limits": np.zeros((5, 2))}, r"limits must have shape \(6, 2\), got \(5, 2\)"),
        ({"limits": np.tile([1.0, -1.0], (6, 1))}, r"limits\[0\] must be lower <= upper"),
        ({"limits": np.full((6, 2), np.nan)}, r"limits\[0\] must be lower <= upper, got nan"),
        ({"max_velocity": -1.0}, r"max_velocity\[0\] is -1\.0, it must be positive"),
        ({"max_velocity": [1.0, 2.0]}, r"max_velocity must have shape \(6,\), got \(2,\)"),
        ({"max_acceleration": "fast"}, r"max_acceleration must have shape \(\), got what is no"),
        ({"max_acceleration": [np.nan] * 6}, r"max_acceleration\[0\] is nan"),
        ({"robot": irbkin.Robot("Panda")}, "robot has 7 joints, motion has 6"),
    ],
)
def test_limits_that_do_not_fit_are_named(options, words):
    with pytest.raises(irbkin.InvalidMotionError, match=words):
        plot.trajectory(MOVE, **options)


def test_what_is_no_trajectory_is_named():
    with pytest.raises(TypeError, match="motion must be a Trajectory, got ndarray"):
        plot.trajectory(MOVE.q)


def test_distances_from_singularities_are_those_of_the_robot():
    q = np.linspace([0.3, 0.2, 0.1, 0.7, -0.4, 0.1], [0.3, 0.2, 0.1, 0.7, 0.4, 0.1], 41)
    figure = plot.singularity(ROBOT, q)
    at = ROBOT.singularity(q)
    wanted = {
        "wrist [deg]": np.degrees(at.wrist),
        "elbow [deg]": np.degrees(at.elbow),
        "shoulder [mm]": 1e3 * at.shoulder,
        "smallest singular value [m or 1]": at.min_singular_value,
        "manipulability [m³]": at.manipulability,
    }
    labels = [axes.get_ylabel().replace("\n", " ") for axes in figure.axes]
    assert labels == list(wanted)
    for axes, curve in zip(figure.axes, wanted.values(), strict=True):
        np.testing.assert_allclose(axes.lines[0].get_ydata(), curve, rtol=1e-15)
        # J5 is zero at the middle: a cross.
        np.testing.assert_array_equal(axes.lines[1].get_xdata(), [20])
        assert axes.get_ylim()[0] == 0.0
    assert figure.axes[-1].get_xlabel() == "row of q"
    timed = plot.singularity(ROBOT, MOVE.q, t=MOVE.t)
    assert timed.axes[-1].get_xlabel() == "time [s]"
    np.testing.assert_array_equal(timed.axes[0].lines[0].get_xdata(), MOVE.t)


def test_gaps_of_a_followed_path_are_gaps():
    q = MOVE.q.copy()
    q[3] = np.nan
    for axes in plot.singularity(ROBOT, q).axes:
        assert np.flatnonzero(np.isnan(axes.lines[0].get_ydata())).tolist() == [3]


def test_joints_that_do_not_fit_are_named():
    with pytest.raises(
        irbkin.InvalidJointsError, match=r"q must have shape \(m, 6\), got \(4, 7\)"
    ):
        plot.singularity(ROBOT, np.zeros((4, 7)))
    with pytest.raises(irbkin.InvalidJointsError, match=r"t must have shape \(4,\), got \(3,\)"):
        plot.singularity(ROBOT, np.zeros((4, 6)), t=np.zeros(3))


def test_a_figure_that_is_given_is_drawn_into():
    figure = Figure(layout="constrained")
    left, right = figure.subfigures(1, 2)
    assert plot.trajectory(MOVE, figure=left) is figure
    assert plot.singularity(ROBOT, MOVE.q, figure=right) is figure
    assert (len(left.axes), len(right.axes)) == (3, 5)


def test_a_name_is_no_robot():
    for call in (
        lambda name: plot.trajectory(MOVE, robot=name),
        lambda name: plot.singularity(name, MOVE.q),
    ):
        with pytest.raises(TypeError, match="robot must be a Robot, got str"):
            call("IRB 2600-12/1.65")
