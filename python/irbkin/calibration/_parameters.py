"""The parameters of an arm: names, nominal values, which of them are fitted first, and which the
measurements determine: by a QR decomposition with column pivoting, tier by tier.

Reference: Golub and Van Loan, Matrix Computations, 2013, section 5.4; for arms Khalil, Gautier and
Enguehard, Identifiable Parameters and Optimum Configurations for Robots Calibration, 1991.
"""

from collections.abc import Sequence

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
# Part of a column that is not a combination of those chosen, above which it is chosen [1]: less,
# and its standard error is ten thousand times as large as of a parameter by itself.
DETERMINED = 1e-4
# The bound where it can only be rounding: of poses all over the joint space.
INDEPENDENT = 1e-7
# Most parameters that a reason names, and their least part of the largest.
PARTNERS, PARTNER = 3, 0.2


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


def table(dof: int) -> range:
    """The parameters of the table, which are between those of base and tool."""
    return range(len(FRAME), len(FRAME) + len(ROW) * dof)


def tiers(robot: Robot, fit: frozenset[str]) -> list[list[int]]:
    """Indices of the parameters to choose from, those first that are to be preferred.

    Parameters that are named come first, then base and tool, then the table: a joint offset that
    does what a turn of the tool does is left out, and not the turn.
    """
    frame, width, dof = len(FRAME), len(ROW), robot.dof
    ends = list(range(frame)) if "base" in fit else []
    if "tool" in fit:
        ends += range(frame + width * dof, 2 * frame + width * dof)
    first, second = [], []
    for row, alpha in enumerate(robot.mdh[:, 0] if "table" in fit else ()):
        alpha_, a, d, theta, beta = range(frame + width * row, frame + width * (row + 1))
        parallel = abs(np.sin(alpha)) <= PARALLEL_SIN
        first += [alpha_, a, theta, beta if parallel else d]
        second.append(d if parallel else beta)
    named = [index for index, name in enumerate(names(dof)) if name in fit]
    rest = [[it for it in tier if it not in named] for tier in (ends, first, second)]
    return [named + rest[0], *rest[1:]]


def chosen(jacobian: Floats, tiers: Sequence[Sequence[int]], least: float) -> list[int]:
    """Indices of independent columns of a weighted Jacobian, shape (k, p), earlier tiers first;
    `least` is the part of a column that must be independent.
    """
    from scipy.linalg import qr  # type: ignore[import-untyped]

    scaled = _unit_columns(jacobian)
    basis = np.zeros((len(jacobian), 0))
    found: list[int] = []
    for tier in filter(None, tiers):
        parts = scaled[:, tier]
        # Twice: once leaves rounding of the removed part.
        for _ in range(2):
            parts = parts - basis @ (basis.T @ parts)
        q, r, order = qr(parts, mode="economic", pivoting=True)
        # The diagonal falls.
        count = np.count_nonzero(np.abs(np.diag(r)) > least)
        basis = np.column_stack([basis, q[:, :count]])
        found += [tier[at] for at in order[:count]]
    return sorted(found)


def reason(
    jacobian: Floats, everywhere: Floats, kept: Sequence[int], index: int, names: Sequence[str]
) -> str:
    """Why the parameter `index` is left out: by the weighted Jacobians of the measurements and of
    poses all over the joint space, and the columns that are kept.
    """
    if not np.any(everywhere[:, index]):
        return "which does not move what was measured"
    if not np.any(jacobian[:, index]):
        return "which does not move what was measured at these poses"
    structural, off = _combination(everywhere, kept, index)
    if off <= INDEPENDENT:
        return f"which moves the tool as {_listed(structural, kept, names)} in every pose"
    partners, _ = _combination(jacobian, kept, index)
    return (
        f"which these poses do not separate from {_listed(partners, kept, names)}: "
        "measure at poses that differ more"
    )


def _unit_columns(jacobian: Floats) -> Floats:
    """The columns scaled to one; those that are zero stay so."""
    sizes = np.linalg.norm(jacobian, axis=0)
    return jacobian / np.where(sizes > 0.0, sizes, 1.0)


def condition(jacobian: Floats) -> float:
    values = np.linalg.svd(_unit_columns(jacobian), compute_uv=False)
    return float(values[0] / values[-1])


def _combination(jacobian: Floats, kept: Sequence[int], index: int) -> tuple[Floats, float]:
    """The combination of kept columns nearest to another one, and its distance."""
    scaled = _unit_columns(jacobian)
    solved = np.linalg.lstsq(scaled[:, kept], scaled[:, index], rcond=None)
    factors = np.asarray(solved[0], dtype=np.float64)
    return factors, float(np.linalg.norm(scaled[:, kept] @ factors - scaled[:, index]))


def _listed(factors: Floats, kept: Sequence[int], names: Sequence[str]) -> str:
    sizes = np.abs(factors)
    order = [i for i in np.argsort(-sizes, kind="stable") if sizes[i] >= PARTNER * sizes.max()]
    words = [names[kept[i]] for i in order[:PARTNERS]]
    if len(order) > PARTNERS:
        return f"{', '.join(words)} and others"
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
