"""Plans along paths of poses."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from irbkin._equality import by_value

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


class PlanBreak(NamedTuple):
    """A part of a path that the joints cannot follow."""

    leave: int | None
    """The last pose before it; None where the path begins with it."""
    enter: int | None
    """The first pose after it; None where the path ends with it."""


class StrandEnd(NamedTuple):
    """Where and why a branch of a path ends."""

    slot: int
    """Its slot."""
    pose_index: int
    """The first pose that it does not reach."""
    reason: str
    """The reason in a sentence."""


@by_value
class Plan(NamedTuple):
    """The best joint path along a path of poses."""

    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (m, n); NaN where a plan with breaks has none."""
    tool_angle: npt.NDArray[np.float64]
    """The angle that the tool is turned by at each pose [rad], shape (m,), without jumps of a full
    turn; zeros without a free rotation.
    """
    slot: npt.NDArray[np.int64]
    """The slot of the branch at each pose, shape (m,); -1 where there is none."""
    external: npt.NDArray[np.float64]
    """Values of the external axes of `carrier` at each pose [m, rad], shape (m, k); NaN where a
    plan with breaks has none.
    """
    tolerance: npt.NDArray[np.float64]
    """What is used of `tolerance` at each pose, shape (m, t): of a cone the tilts about the two
    axes that the tool does not point in [rad], of an offset the shift [m].
    """
    cost: float
    """Weighted sum of the squares of all joint steps, with what being near limits and
    singularities costs [rad^2].
    """
    bottleneck: float
    """The largest velocity of a joint as a part of its limit. Without `times`, the time [s] that
    the path takes at least if its poses are equally far apart in time.
    """
    breaks: tuple[PlanBreak, ...]
    """Where the joints cannot follow: empty, but of the plan of a `PathError`."""
    certified: bool
    """Whether every step, apart from breaks, was shown to be continuous between its two poses."""

    def __repr__(self) -> str:
        count = len(self.breaks)
        breaks = "no breaks" if count == 0 else "1 break" if count == 1 else f"{count} breaks"
        proof = "certified" if self.certified else "not certified"
        return (
            f"Plan({len(self.q)} poses, cost {self.cost:.6g}, bottleneck {self.bottleneck:.6g}, "
            f"{breaks}, {proof})"
        )
