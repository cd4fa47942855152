"""Scenes of calibrations: the arm where it was measured, and residuals as vectors."""

import numpy as np
import numpy.typing as npt

from irbkin import Robot
from irbkin._arrays import Floats, evenly
from irbkin.calibration import Calibration, HandEye
from irbkin.scene._arms import arm_of, rows
from irbkin.scene._data import Arm, Cloud, Frame, Mark, Path, Posture, Scene

Calibrated = Calibration | HandEye
MOST_POSTURES, MOST_VECTORS = 8, 500
"""Postures and vectors of a scene: more are thinned."""
SCALES = (10000, 5000, 2000, 1000, 500, 200, 100, 50, 20, 10, 5, 2, 1)
"""Lengths at which residuals are drawn, relative to their own [1]."""
LONGEST = 0.2
"""Length at most at which the largest residual is drawn, if it is not longer [m]."""


def of_calibration(thing: Calibrated, robot: Robot | None, q: npt.ArrayLike | None) -> Scene:
    """Return the scene of a calibration.

    Args:
        thing: The calibration.
        robot: The arm of a `HandEye`; a `Calibration` has its own.
        q: Joint angles at which it was measured [rad], shape (n,) or (m, n); the arm is drawn if
            they are known.

    Raises:
        TypeError: `q` without `robot`, or a `HandEye` of moves without both.
    """
    is_move = isinstance(thing, HandEye) and thing.y is None
    if robot is None and q is not None:
        raise TypeError(f"robot is missing: q is given, but a {type(thing).__name__} has no arm")
    if is_move and q is None:
        raise TypeError("robot and q are missing: X of A X = X B has its place on the hand")
    if isinstance(thing, Calibration):
        robot, q = thing.robot, thing.q
    arms: tuple[Arm, ...] = ()
    at = None
    if robot is not None and q is not None:
        angles = np.atleast_2d(np.asarray(q, dtype=float))
        at = robot.fk(angles)[0]
        # A link of a calibrated table may have its frame kilometers away: axes that are almost
        # parallel have their common normal there.
        drawn = thing.nominal if isinstance(thing, Calibration) else robot
        # Some postures, all but the first as ghosts.
        kept = evenly(len(angles), MOST_POSTURES).tolist()
        postures = (Posture(rows(angles[it]), f"measurement {it}", it > 0) for it in kept)
        arms = (arm_of(drawn, postures),)
    own = Scene(arms=arms, frames=tuple(_frames(thing, at)))
    # Both sides of A X = X B are moves: they have no place.
    return own if is_move else own + _residuals(thing.measured, thing.fitted)


def _frames(thing: Calibrated, at: Floats | None) -> list[Frame]:
    """The frames that were found; those on the arm are at its first posture."""
    found: list[tuple[str, Floats | None]] = []
    if isinstance(thing, Calibration):
        found = [("base", thing.robot.base), ("tool", at)]
    else:
        found = [("X", None if at is None else at @ thing.x), ("Y", thing.y)]
    return [Frame(name, rows(pose)) for name, pose in found if pose is not None]


def _residuals(measured: Floats, fitted: Floats) -> Scene:
    """Points, colored by how far off they are, and a vector from each to the fitted one."""
    off = fitted - measured
    error = np.linalg.norm(off, axis=1)
    worst = int(error.argmax())
    scale = next((it for it in SCALES if it * error[worst] <= LONGEST), 1)
    kept = evenly(len(error), MOST_VECTORS).tolist()
    paths = tuple(
        Path(f"residual {it} x {scale}", rows([measured[it], measured[it] + scale * off[it]]))
        for it in kept
    )
    cloud = Cloud("measured", rows(measured), rows(1e3 * error), "residual [mm]")
    words = (
        f"largest residual: {1e3 * error[worst]:.3g} mm, measurement {worst}; vectors are drawn "
        f"{scale} times as long"
    )
    return Scene(paths=paths, clouds=(cloud,), marks=(Mark(rows(measured[worst]), words),))
