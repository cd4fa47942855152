"""The shapes of arms and obstacles: what `Robot.body` and `Cell` are made of."""

from __future__ import annotations

from irbkin._core import Body, Shape

__all__ = ["Body", "Shape"]
