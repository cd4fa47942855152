"""What pictures of plans, placements and maps show."""

import irbkin
import numpy as np
import pytest
from irbkin import placement, plot
from pictures import MAP, PLACED, PLAN, REGION, ROBOT, SEAM, curves, shaded


def test_a_plan_shows_tool_joints_and_velocities_as_parts_of_their_limits():
    angle, joints, velocities = plot.plan(ROBOT, PLAN).axes
    np.testing.assert_allclose(angle.lines[0].get_ydata(), np.degrees(PLAN.tool_angle))
    low, high = ROBOT.limits.T
    for joint, line in enumerate(curves(joints)):
        wanted = 100 * (PLAN.q[:, joint] - low[joint]) / (high - low)[joint]
        np.testing.assert_allclose(line.get_ydata(), wanted, atol=1e-9)
    rows = np.array([line.get_ydata() for line in curves(velocities)])
    # At the fastest even pace one joint reaches its limit.
    assert rows.max() == pytest.approx(100.0)
    assert shaded(joints)[0][1] == 0.0
    assert shaded(joints)[1][0] == 100.0
    times = np.linspace(0, 2 * PLAN.bottleneck, len(PLAN.q))
    *_, velocities = plot.plan(ROBOT, PLAN, times=times).axes
    assert max(line.get_ydata().max() for line in curves(velocities)) == pytest.approx(50.0)
    assert velocities.get_xlabel() == "time [s]"


def test_a_plan_with_breaks_has_gaps_and_without_a_tool_angle_no_panel():
    broken = SEAM.copy()
    broken[8:11, 2, 3] += 3.0
    with pytest.raises(irbkin.PathError) as caught:
        ROBOT.plan(broken)
    figure = plot.plan(ROBOT, caught.value.plan)
    assert len(figure.axes) == 2
    assert np.isnan(curves(figure.axes[0])[0].get_ydata()[8:11]).all()
    spans = [patch for patch in figure.axes[0].patches if patch.get_x() == 7]
    assert spans[0].get_width() == 4
    assert len(plot.plan(ROBOT, ROBOT.plan(SEAM[:1])).axes) == 2
    with pytest.raises(TypeError, match="plan must be a Plan, got ndarray"):
        plot.plan(ROBOT, PLAN.q)
    with pytest.raises(irbkin.InvalidMotionError, match=r"times\[1\] is 0.0 s"):
        plot.plan(ROBOT, PLAN, times=np.zeros(21))


def test_a_cell_of_a_placement_is_the_best_over_the_other_coordinates():
    figure = plot.placement(PLACED, SEAM)
    gray, colored = figure.axes[0].collections[:2]
    margin = np.fmax.reduce(PLACED.grid.margin[:, :, 0], axis=-1)
    shown = colored.get_array().reshape(margin.T.shape)
    np.testing.assert_allclose(shown.filled(np.nan), margin.T)
    share = PLACED.grid.reachable[:, :, 0].max(axis=-1)
    np.testing.assert_allclose(
        gray.get_array().reshape(share.T.shape).filled(-1.0),
        np.where(np.isnan(margin), share, -1.0).T,
    )
    assert np.isnan(margin).any()
    assert np.isfinite(margin).any()
    targets, base = figure.axes[0].lines
    np.testing.assert_allclose(targets.get_xydata(), SEAM[:, :2, 3])
    np.testing.assert_allclose(base.get_xydata(), [PLACED.base[:2, 3]])


def test_a_placement_is_drawn_across_any_two_coordinates_in_the_frame_of_its_region():
    frame = irbkin.pose([1, 2, 0.3], euler_zyx=[0.4, 0.1, 0])
    moved = placement.best_base(ROBOT, frame @ SEAM, REGION, steps=5, refine=False, frame=frame)
    axes = plot.placement(moved, frame @ SEAM).axes[0]
    np.testing.assert_allclose(axes.lines[0].get_xydata(), SEAM[:, :2, 3], atol=1e-12)
    base = np.linalg.inv(frame) @ moved.base
    np.testing.assert_allclose(axes.lines[1].get_xydata(), [base[:2, 3]])
    axes = plot.placement(moved, across=("turn", "x")).axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("turn [deg]", "x [m]")
    colored = axes.collections[1].get_array()
    wanted = np.fmax.reduce(np.fmax.reduce(moved.grid.margin, axis=2), axis=1)
    np.testing.assert_allclose(colored.reshape(5, 5).filled(np.nan), wanted)
    with pytest.raises(ValueError, match="two of"):
        plot.placement(moved, across=("x", "x"))
    with pytest.raises(TypeError, match="must be a Placement, got NoneType"):
        plot.placement(None)


@pytest.mark.parametrize(
    ("quantity", "values"),
    [
        ("share", 100 * MAP.share),
        ("solutions", MAP.solutions / 6),
        ("margin", MAP.margin),
        ("singularities", MAP.singularities),
    ],
)
def test_a_slice_of_a_map_has_its_numbers(quantity, values):
    values = np.where(MAP.reached > 0, values, np.nan)
    for across, at, wanted in [
        (("x", "z"), None, values[:, 2].T),
        (("z", "x"), -0.9, values[:, 0]),
        (("y", "x"), 5.0, values[:, :, 3]),
    ]:
        axes = plot.reach_map(MAP, quantity, across=across, at=at).axes[0]
        shown = axes.collections[0].get_array().filled(np.nan)
        np.testing.assert_allclose(shown.reshape(wanted.shape), wanted)
        assert axes.get_xlabel() == f"{across[0]} [m]"
    assert np.isfinite(values).any()
    assert np.isnan(values).any()


def test_what_is_no_slice_is_named():
    for arguments, error, words in [
        ((None,), TypeError, "must be a ReachMap, got NoneType"),
        ((MAP, "reach"), ValueError, "quantity must be one of"),
        ((MAP, "share", ("x", "w")), ValueError, "across must be two of"),
    ]:
        found, *rest = arguments
        options = dict(zip(("quantity", "across"), rest, strict=False))
        with pytest.raises(error, match=words):
            plot.reach_map(found, **options)
