"""What makes one plan better than another: order, weights, costs of limits and singularities."""

import irbkin
import numpy as np
import pytest
from test_plan import ROBOT, weld

SEAM = weld(60)
WEIGHTS = np.array([1, 2, 0.5, 1, 3, 0.2])


def cost(robot, q, times, weights=1.0, limit_cost=0.0, singularity_cost=0.0):
    """Eq. 4 of docs/guide/plan.md, summed over the steps of a path."""
    dt = np.diff(times)
    lower, upper = robot.limits.T
    limits = np.abs(q[1:] - (lower + upper) / 2) / ((upper - lower) / 2)
    at = robot.singularity(q[1:])
    links = np.abs(robot.mdh[1:4, 1:3]).sum()
    apart = np.array([at.wrist / (np.pi / 2), at.elbow / (np.pi / 2), at.shoulder / (links / 2)])
    near = limit_cost * (limits**2).sum(axis=1)
    near = near + singularity_cost * ((1 - np.minimum(apart, 1)) ** 2).sum(axis=0)
    return float((weights * np.diff(q, axis=0) ** 2).sum() + (near * dt**2).sum())


@pytest.mark.parametrize("order", ["bottleneck", "sum"])
@pytest.mark.parametrize("costs", [{}, {"limit_cost": 50.0}, {"singularity_cost": 20.0}])
def test_the_cost_is_that_of_the_joints(order, costs):
    plan = ROBOT.plan(SEAM, rotation=12, weights=WEIGHTS, order=order, **costs)
    times = np.linspace(0, 1, len(SEAM))
    assert plan.cost == pytest.approx(cost(ROBOT, plan.q, times, WEIGHTS, **costs), rel=1e-9)
    rates = np.abs(np.diff(plan.q, axis=0)) / ROBOT.max_velocity / np.diff(times)[:, None]
    assert plan.bottleneck == pytest.approx(rates.max(), rel=1e-9)
    assert plan.certified


def test_a_cost_of_limits_takes_the_turn_in_the_middle():
    """Joint 6 has three turns: with the cost, the one farthest from its limits is taken."""
    q = np.linspace([0.2, 0.1, 0.3, 0.4, 0.8, -5.5], [0.3, 0.2, 0.3, 0.5, 0.9, -5.0], 20)
    T = ROBOT.fk(q)
    plan = ROBOT.plan(T, start=None, order="sum", limit_cost=1e3)
    turns = ROBOT.limits[5]
    middle = turns.mean()
    others = plan.q[:, 5][:, None] + 2 * np.pi * np.arange(-1, 2)
    inside = ((others >= turns[0]) & (others <= turns[1])).all(axis=0)
    worst = np.abs(others - middle).max(axis=0)[inside]
    assert inside.sum() > 1
    assert np.abs(plan.q[:, 5] - middle).max() == worst.min()
    held = ROBOT.plan(T, start=q[0], order="sum", limit_cost=1e3)
    assert np.allclose(held.q, q)


def test_costs_hold_for_closed_paths():
    costs = {"rotation": 12, "order": "sum", "limit_cost": 5.0, "singularity_cost": 5.0}
    closed = ROBOT.plan(SEAM, closed=True, **costs)
    assert np.array_equal(closed.q[0], closed.q[-1])
    # The tool angles of both are smoothed until a round gains less than 1e-5.
    assert closed.cost >= ROBOT.plan(SEAM, **costs).cost * (1 - 1e-5)


@pytest.mark.parametrize("field", ["limit_cost", "singularity_cost"])
@pytest.mark.parametrize("value", [-1.0, np.nan, np.inf])
def test_a_bad_cost_is_named(field, value):
    with pytest.raises(irbkin.InvalidMotionError, match=f"^{field} must be finite and not neg"):
        ROBOT.plan(SEAM, **{field: value})


def test_another_order_is_named():
    with pytest.raises(ValueError, match='order must be "bottleneck" or "sum", got "time"'):
        ROBOT.plan(SEAM, order="time")


def test_an_offset_wrist_stays_away_from_its_singularities_if_these_cost():
    robot = irbkin.Robot("CRB 15000-5/0.95")
    gained = []
    for y in (0.1, 0.2, 0.3):
        ends = [irbkin.pose([0.5, side * y, 0.4], euler_zyx=[0, 2.9, 0]) for side in (-1, 1)]
        path = irbkin.paths.line(*ends, steps=21)
        plain, apart = (
            robot.plan(path, rotation=24, singularity_cost=cost, order="sum") for cost in (0, 50)
        )
        least = [np.mean(robot.margin(plan.q).singularities) for plan in (plain, apart)]
        assert least[1] >= least[0] - 1e-9
        gained.append(least[1] - least[0])
    assert max(gained) > 0.05
    assert np.isnan(irbkin.Robot("IRB 14050").margin(np.full(7, 0.3)).singularities)
