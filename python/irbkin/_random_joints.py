"""Random joint vectors inside the limits of a robot."""

import math
import operator

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot
from irbkin.errors import InvalidModelError

# Rounds in which joint vectors outside the limits of a linkage are drawn anew: even if these leave
# 1 % of the range of axes 2 and 3, all but one of 20,000 are found.
MOST_ROUNDS = 1000


def draw(
    robot: Robot, limits: Floats, n: int | None, rng: np.random.Generator | int | None
) -> Floats:
    """Draw joint vectors inside limits [rad], shape (dof, 2), and inside the linkage's; over a full
    turn of a joint that can turn without end.
    """
    generator = np.random.default_rng(rng)
    turn = 2.0 * math.pi
    lowest, highest = limits.T
    from_below = np.where(np.isfinite(highest), highest - turn, -math.pi)
    from_above = np.where(np.isfinite(lowest), lowest + turn, math.pi)
    lower = np.where(np.isfinite(lowest), lowest, from_below)
    upper = np.where(np.isfinite(highest), highest, from_above)
    count = 1 if n is None else operator.index(n)
    q = generator.uniform(lower, upper, (count, robot.dof))
    if robot.linkage_limits is not None:
        for _ in range(MOST_ROUNDS):
            outside = np.flatnonzero(robot.margin(q).limits < 0.0)
            if not outside.size:
                break
            q[outside] = generator.uniform(lower, upper, (outside.size, robot.dof))
        else:
            raise InvalidModelError("the limits of joints 2 and 3 leave the linkage no room")
    return q[0] if n is None else q
