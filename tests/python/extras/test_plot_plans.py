"""What pictures of plans show."""

import irbkin
import numpy as np
import pytest
from irbkin import plot
from pictures import PLAN, ROBOT, SEAM, curves, shaded


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
