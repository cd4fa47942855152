"""What Hypothesis draws: arms with joint vectors, poses, rotations."""

from dataclasses import dataclass
from functools import cache

import irbkin
import numpy as np
from arms import ABB, KUKA_KR6, LATERAL
from hypothesis import strategies as st
from reference import fk, fk_opw, pose_of, reach, reach_opw


@dataclass(frozen=True)
class Subject:
    """A robot of irbkin, its forward kinematics in NumPy, a bound of its reach [m], q5 of its
    straight wrist.
    """

    robot: irbkin.Robot
    fk: object
    reach: float
    straight: float = 0.0


@cache
def subjects():
    """The ABB arms of the catalog and two of other makes, whose joints have signs and offsets, by
    name.
    """
    found = {
        name: Subject(irbkin.Robot(name), lambda q, rows=arm.rows: fk(rows, q), reach(arm.rows))
        for name, arm in ABB.items()
    }
    for name, opw in {"KUKA KR 6 R700": KUKA_KR6, "lateral offset": LATERAL}.items():
        robot = irbkin.Robot.from_opw(**opw, limits=[[-2 * np.pi, 2 * np.pi]] * 6, name=name)
        found[name] = Subject(
            robot,
            lambda q, opw=opw: fk_opw(opw, q),
            reach_opw(opw),
            opw["signs"][4] * opw["offsets"][4],
        )
    return found


def numbers(low, high, count):
    """A vector of floats of ordinary size: nothing is drawn between 0 and 1e-12."""
    floats = st.floats(low, high).map(lambda x: 0.0 if abs(x) < 1e-12 else x)
    return st.lists(floats, min_size=count, max_size=count).map(np.array)


def joints(robot):
    """Joint vectors inside the limits, the limits themselves among them."""
    low, high = robot.limits.T
    return numbers(0, 1, robot.dof).map(lambda parts: low + parts * (high - low))


@st.composite
def subjects_with_joints(draw):
    """(Subject, joint vector inside its limits)."""
    subject = subjects()[draw(st.sampled_from(sorted(subjects())))]
    return subject, draw(joints(subject.robot))


def quaternions():
    """Unit quaternions, also with elements that are exactly zero."""
    return (
        numbers(-1, 1, 4)
        .filter(lambda q: np.linalg.norm(q) > 0.1)
        .map(lambda q: q / np.linalg.norm(q))
    )


def poses(size=3.0):
    """Poses with any orientation."""
    return st.builds(pose_of, numbers(-size, size, 3), quaternions())
