"""Denavit-Hartenberg tables in both conventions, without irbkin: conversion, frames, columns of the
Jacobian.
"""

import numpy as np
from reference import frames, move, turn


def up(mdh):
    """Standard rows of modified ones, without the base that is left over."""
    return np.column_stack([np.append(mdh[1:, :2], [[0, 0]], axis=0), mdh[:, 2:]])


def down(sdh):
    """Modified rows of standard ones, without the flange that is left over."""
    return np.column_stack([np.append([[0, 0]], sdh[:-1, :2], axis=0), sdh[:, 2:]])


def rigid(alpha, a):
    """X: from one axis to the next."""
    return turn("x", alpha) @ move(a, 0, 0)


def about(d, theta):
    """Z: along and about the axis of a joint."""
    return move(0, 0, d) @ turn("z", theta)


def sdh_frames(rows, q):
    """Frames 0 .. n of a standard table."""
    poses = [np.eye(4)]
    for (alpha, a, d, theta), angle in zip(rows, q, strict=True):
        poses.append(poses[-1] @ about(d, theta + angle) @ rigid(alpha, a))
    return np.array(poses)


def mdh_frames(rows, q):
    """Frames 0 .. n of a modified table."""
    return np.concatenate([[np.eye(4)], frames(rows, q)])


def columns(axes, end):
    """Jacobian of the point of `end`, its joints turning about the z axes of `axes`."""
    return np.array([np.r_[np.cross(f[:3, 2], end[:3, 3] - f[:3, 3]), f[:3, 2]] for f in axes]).T
