"""Spheres and planes that the tool touches, and where they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from irbkin._arrays import as_array
from irbkin.calibration._measurements import check_finite
from irbkin.errors import CalibrationError, InvalidJointsError, InvalidPoseError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from irbkin._arrays import Floats
    from irbkin._core import Robot

AXES = "xyz"
# Least number of contacts for each number of the place of a body [1].
LEAST_CONTACTS = {"sphere": 4, "plane": 3}
# Least scatter of contacts with a plane across their longest line [m], and of contacts with a
# sphere across their plane, as a part of the distance [1]: above the errors of an arm.
LEAST_WIDTH, LEAST_THICKNESS = 5e-3, 0.05


class SphereContact(NamedTuple):
    """Contacts with a sphere, or readings of a ball bar: tool center points at one distance from a
    center.
    """

    q: npt.ArrayLike
    """Joint angles at each contact [rad], shape (m, n)."""
    distance: float
    """Distance of the tool center point from the center [m]: the radii of the sphere and of the
    probe's ball together, or the length of the ball bar.
    """
    center: npt.ArrayLike | None = None
    """The center in the base [m], shape (3,), where it is known; it is fitted otherwise."""


class PlaneContact(NamedTuple):
    """Contacts with a plane, such as a face of a cube; the plane is fitted."""

    q: npt.ArrayLike
    """Joint angles at each contact [rad], shape (m, n)."""


@dataclass(frozen=True)
class Body:
    """A sphere or a plane: its contacts, and its place as far as it is not fitted."""

    rows: slice
    distance: float | None
    """Of a sphere; None of a plane."""
    origin: Floats
    """A center that is near, or a point near the plane."""
    axes: Floats
    """Of a plane: two directions in it and its normal, rows; of a sphere x, y, z."""
    numbers: slice
    """Its place in the corrections: of a center, or of a normal's tilts and the plane's offset."""

    def errors(self, points: Floats, place: Floats) -> tuple[Floats, Floats, Floats]:
        """How far points are off it [m], shape (m,), the directions in which they are, (m, 3), and
        the derivatives by the place, (m, k).
        """
        if self.distance is not None:
            center = self.origin + place if len(place) else self.origin
            off = points - center
            lengths = np.linalg.norm(off, axis=1)
            directions = off / lengths[:, None]
            return lengths - self.distance, directions, -directions[:, : len(place)]
        tilted = self.axes[2] + place[:2] @ self.axes[:2]
        length = float(np.linalg.norm(tilted))
        normal, off = tilted / length, points - self.origin
        tilts = (self.axes[:2] - np.outer(self.axes[:2] @ normal, normal)) / length
        by_place = np.column_stack([off @ tilts.T, -np.ones(len(points))])
        return off @ normal - place[2], np.tile(normal, (len(points), 1)), by_place


def read_bodies(
    robot: Robot, contacts: Sequence[SphereContact | PlaneContact], count: int
) -> tuple[Floats, tuple[Body, ...], list[str]]:
    """The joint angles of all contacts, the bodies, and the names of the numbers of their places,
    which follow `count` other ones.

    Raises:
        InvalidJointsError, InvalidPoseError: A wrong shape, or a number that is not finite.
        CalibrationError: No contacts, too few of a body, or a distance that is not positive.
    """
    bodies: list[Body] = []
    joints: list[Floats] = []
    names: list[str] = []
    start = 0
    for index, contact in enumerate(contacts):
        if not isinstance(contact, (SphereContact, PlaneContact)):
            raise TypeError(f"contacts[{index}] must be a SphereContact or a PlaneContact")
        name = f"contacts[{index}].q"
        q = as_array(contact.q, name, (None, robot.dof), InvalidJointsError)
        check_finite(q, name, InvalidJointsError)
        kind = "sphere" if isinstance(contact, SphereContact) else "plane"
        is_known = isinstance(contact, SphereContact) and contact.center is not None
        if len(q) < (least := 1 if is_known else LEAST_CONTACTS[kind]):
            raise CalibrationError(f"{name} has {len(q)} rows, a {kind} needs {least} at least")
        points = robot.fk(q)[:, :3, 3]
        first = count + len(names)
        if not is_known:
            parts = AXES if kind == "sphere" else ("tilt u", "tilt v", "offset")
            names += [f"{kind} {index} {part}" for part in parts]
        rows, numbers = slice(start, start + len(q)), slice(first, count + len(names))
        bodies.append(_body(contact, index, points, rows, numbers))
        joints.append(q)
        start += len(q)
    if not bodies:
        raise CalibrationError("contacts is empty: give a SphereContact or a PlaneContact")
    return np.concatenate(joints), tuple(bodies), names


def _body(
    contact: SphereContact | PlaneContact, index: int, points: Floats, rows: slice, numbers: slice
) -> Body:
    middle = points.mean(axis=0)
    _, sizes, axes = np.linalg.svd(points - middle)
    spread = sizes / np.sqrt(len(points))
    if isinstance(contact, PlaneContact):
        if spread[1] < LEAST_WIDTH:
            raise CalibrationError(
                f"contacts[{index}] are {spread[1]:.2g} m off one line (rms), at least "
                f"{LEAST_WIDTH:g} m are needed to see their plane: touch it all over"
            )
        return Body(rows, None, middle, axes, numbers)
    distance = float(contact.distance)
    if not (distance > 0.0 and np.isfinite(distance)):
        raise CalibrationError(f"contacts[{index}].distance is {distance} m, it must be positive")
    if contact.center is not None:
        name = f"contacts[{index}].center"
        center = as_array(contact.center, name, (3,), InvalidPoseError)
        check_finite(center, name, InvalidPoseError)
        return Body(rows, distance, center, np.eye(3), numbers)
    if spread[2] < LEAST_THICKNESS * min(distance, spread[0]):
        raise CalibrationError(
            f"contacts[{index}] are {spread[2]:.2g} m off one plane (rms), at least "
            f"{LEAST_THICKNESS:g} of the distance are needed to see their center: touch the sphere "
            "on more than one circle, from all sides"
        )
    # |p|^2 = 2 p c + k, linear in c and k.
    shifted = points - middle
    system = np.column_stack([2.0 * shifted, np.ones(len(points))])
    solved = np.linalg.lstsq(system, np.sum(np.square(shifted), axis=1), rcond=None)[0]
    return Body(rows, distance, middle + solved[:3], np.eye(3), numbers)
