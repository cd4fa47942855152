"""The parameters of an arm: names, nominal values, and which of them are fitted first."""

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot

# As `Robot.with_corrections` orders them.
FRAME = ("x", "y", "z", "rx", "ry", "rz")
ROW = ("alpha", "a", "d", "theta", "beta")
LENGTHS = frozenset({"x", "y", "z", "a", "d"})

# |sin alpha| up to which neighboring axes count as parallel [1]: the offsets d of both axes then
# move the tool in the same direction to a part of this, and beta takes the place of one of them.
PARALLEL_SIN = 0.1


def names(dof: int) -> list[str]:
    """The name of each parameter, in the order of `Robot.with_corrections`."""
    rows = [f"{parameter} {row}" for row in range(1, dof + 1) for parameter in ROW]
    return [*(f"base {each}" for each in FRAME), *rows, *(f"tool {each}" for each in FRAME)]


def unit(name: str) -> str:
    return "m" if LENGTHS.intersection(name.split()) else "rad"


def nominal(robot: Robot) -> Floats:
    """The value of each parameter without corrections."""
    rows = np.column_stack([robot.mdh, np.zeros(robot.dof)])
    return np.asarray(np.r_[np.zeros(len(FRAME)), rows.ravel(), np.zeros(len(FRAME))])


def of_table(dof: int) -> list[str]:
    return names(dof)[len(FRAME) : -len(FRAME)]


def ends(indices: list[int], dof: int) -> list[int]:
    """The parameters of base and tool among some."""
    table = range(len(FRAME), len(FRAME) + len(ROW) * dof)
    return [index for index in indices if index not in table]


def tiers(robot: Robot, fit: frozenset[str]) -> list[list[int]]:
    """Indices of the parameters to choose from, those first that are to be preferred.

    Parameters that are named come first, then base and tool, then the table: a joint offset that
    does what a turn of the tool does is left out, and not the turn.
    """
    all_names = names(robot.dof)
    named = [index for index, name in enumerate(all_names) if name in fit]
    groups = [[it for it in tier if it not in named] for tier in _groups(robot, fit)]
    return [named + groups[0], *groups[1:]]


def _groups(robot: Robot, fit: frozenset[str]) -> list[list[int]]:
    """As `tiers`, of base, table and tool."""
    dof = robot.dof
    frame, width = len(FRAME), len(ROW)
    ends = list(range(frame)) if "base" in fit else []
    if "tool" in fit:
        ends += range(frame + width * dof, 2 * frame + width * dof)
    if "table" not in fit:
        return [ends]
    first, second = [], []
    for row, alpha in enumerate(robot.mdh[:, 0]):
        alpha_, a, d, theta, beta = range(frame + width * row, frame + width * (row + 1))
        parallel = abs(np.sin(alpha)) <= PARALLEL_SIN
        first += [alpha_, a, theta, beta if parallel else d]
        second.append(d if parallel else beta)
    return [ends, first, second]
