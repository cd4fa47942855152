"""The tables in tests/data, and how exact their text is."""

import csv
from pathlib import Path

import numpy as np
from reference import pose_of

DATA = Path(__file__).parent.parent / "data"

XYZ = ("x_mm", "y_mm", "z_mm")
RAX = tuple(f"rax_{axis}" for axis in range(1, 7))


def read(name):
    """Rows of a table as dictionaries of text."""
    with (DATA / name).open(encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def numbers(row, fields):
    """Some fields of a row."""
    return np.array([float(row[field]) for field in fields])


def half_digit(row, fields):
    """Half a unit in the last digit of the least exact of some fields: how far its text may be from
    the truth.

    An integer is taken as exact: the sources chose it.
    """
    decimals = [len(row[field].partition(".")[2]) for field in fields]
    return max((0.5 * 10.0**-count for count in decimals if count), default=0.0)


def pose_mm(row, xyz=XYZ, wxyz=("q1_w", "q2_x", "q3_y", "q4_z")):
    """The pose of a row [m]."""
    return pose_of(numbers(row, xyz) / 1e3, numbers(row, wxyz))


def matrix(row):
    """The pose of a row that has a matrix in meters."""
    pose = np.eye(4)
    pose[:3, :3] = numbers(row, [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]).reshape(3, 3)
    pose[:3, 3] = numbers(row, ("x_m", "y_m", "z_m"))
    return pose
