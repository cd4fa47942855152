"""Numbers typed as arguments: finite, and within bounds in the units of the command."""

from __future__ import annotations

import math
from argparse import ArgumentTypeError
from collections.abc import Callable, Sequence

from irbkin.cli.errors import CommandError

MOST_ANGLE = math.degrees(1e5)
"""The largest angle of a joint that the library takes [deg]."""
MOST_TURN = 360.0
"""The largest Euler angle that the library takes [deg]."""
LEAST_LENGTH = 5.0
"""Coordinates that are all below it may be in meters [mm]."""
_TOO_LARGE = f"is too large: its size must be at most {MOST_ANGLE:.0f} deg (remove whole turns)"


def number(text: str) -> float:
    """A finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or "_" in text:
        raise ArgumentTypeError(f"{text.strip()!r} is not a finite number")
    return value


def positive(text: str) -> float:
    """A finite number above zero."""
    value = number(text)
    if value <= 0.0:
        raise ArgumentTypeError(f"{value:g} must be positive")
    return value


def angle(text: str) -> float:
    """An angle of a joint [deg]."""
    value = number(text)
    if abs(value) > MOST_ANGLE:
        raise ArgumentTypeError(f"{value:g} deg {_TOO_LARGE}")
    return value


def check_joints(angles: Sequence[float], name: str) -> None:
    """Refuse angles [deg] of joints that the library does not take."""
    for joint, value in enumerate(angles, 1):
        if abs(value) > MOST_ANGLE:
            raise CommandError(f"{name}: joint {joint} at {value:g} deg {_TOO_LARGE}")


def check_euler(angles: Sequence[float], name: str) -> None:
    """Refuse Euler angles rz, ry, rx [deg] that the library does not take."""
    for axis, value in zip(("rz", "ry", "rx"), angles, strict=True):
        if abs(value) > MOST_TURN:
            raise CommandError(
                f"{name}: {axis} is {value:g} deg, its size must be at most {MOST_TURN:g} deg"
            )


def check_millimeters(lengths: Sequence[float], name: str, least: float = LEAST_LENGTH) -> None:
    """Refuse lengths [mm] that are in meters: not all zero, and all of them below `least`."""
    if 0.0 < max(abs(length) for length in lengths) < least:
        raise CommandError(
            f"{name}: {' '.join(f'{length:g}' for length in lengths)} mm is below {least:g} mm "
            "(are these meters? millimeters are wanted; in a file, name the columns x_m, y_m, z_m "
            "or x_mm, y_mm, z_mm)"
        )


def whole(text: str) -> int:
    """A whole number."""
    try:
        return int(text)
    except ValueError:
        raise ArgumentTypeError(f"{text.strip()!r} is not a whole number") from None


def confdata(text: str) -> int:
    """A whole number of 32 bits, as confdata has."""
    value = whole(text)
    if abs(value) >= 2**31:
        raise ArgumentTypeError(f"{value} is not a number of a confdata")
    return value


def count(least: int, most: int) -> Callable[[str], int]:
    """Whole numbers between two bounds."""

    def read(text: str) -> int:
        value = whole(text)
        if not least <= value <= most:
            raise ArgumentTypeError(f"{value} must be {least} to {most}")
        return value

    return read


def joint_and_angle(text: str) -> tuple[int, float]:
    """A joint of a seven-axis arm, from 1, and its angle [deg]."""
    joint, equals, value = text.partition("=")
    if not equals:
        raise ArgumentTypeError(f"{text.strip()!r} must be a joint and its angle [deg], as 3=11.5")
    return count(1, 7)(joint), angle(value)
