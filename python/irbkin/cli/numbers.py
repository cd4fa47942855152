"""Numbers typed as arguments: finite, and within bounds in the units of the command."""

import math
from argparse import ArgumentTypeError

from irbkin.cli.data import is_data

MOST_ANGLE = math.degrees(1e5)
"""The largest angle of a joint that the library takes [deg]."""
TOO_LARGE = f"is too large: its size must be at most {MOST_ANGLE:.0f} deg (remove whole turns)"


def number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or "_" in text:
        raise ArgumentTypeError(f"{text.strip()!r} is not a finite number")
    return value


def number_or_data(text: str) -> float | str:
    return text if is_data(text) else number(text)


def positive(text: str) -> float:
    value = number(text)
    if value <= 0.0:
        raise ArgumentTypeError(f"{value:g} must be positive")
    return value


def angle(text: str) -> float:
    value = number(text)
    if abs(value) > MOST_ANGLE:
        raise ArgumentTypeError(f"{value:g} deg {TOO_LARGE}")
    return value


def confdata(text: str) -> int:
    """A whole number of 32 bits, as confdata has."""
    try:
        value = int(text)
    except ValueError:
        raise ArgumentTypeError(f"{text.strip()!r} is not a whole number") from None
    if not abs(value) < 2**31:
        raise ArgumentTypeError(f"{value} is not a number of a confdata")
    return value
