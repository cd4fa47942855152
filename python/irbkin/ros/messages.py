"""Messages of ROS as far as irbkin reads and writes them: any object with these attributes.

Messages of ROS 1 (`geometry_msgs.msg.Pose` of genpy) and of ROS 2 (of rosidl) fit, as does a plain
structure with the same fields. Numbers of a sequence arrive as a tuple, a list, an `array.array`
or, of `uint8[]` in ROS 1, as `bytes`.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin._core import pose, to_xyz_wxyz

# A message, or a request or response of a service of irbkin_interfaces: its fields are in the .msg
# and .srv files, which Python's types do not know.
Message = Any


class IkSolutions(NamedTuple):
    """The solutions in the response of an IK service."""

    q: Floats
    """Joint angles [rad], shape (k, n), inside the limits or not."""
    slot: npt.NDArray[np.uint8]
    """Slot of each, shape (k,)."""
    status: npt.NDArray[np.uint8]
    """`irbkin.Status` of each, shape (k,)."""


def read_pose(message: Message) -> Floats:
    """Return the homogeneous matrix of a `geometry_msgs/Pose`, shape (4, 4).

    Raises:
        InvalidPoseError: A number is not finite, or the quaternion's norm is not one.
    """
    p, o = message.position, message.orientation
    return pose([p.x, p.y, p.z], xyzw=[o.x, o.y, o.z, o.w])


def read_poses(messages: Sequence[Message]) -> Floats:
    """As `read_pose` of many, shape (m, 4, 4); an error has the index of the first."""
    p = [[m.position.x, m.position.y, m.position.z] for m in messages]
    o = [[m.orientation.x, m.orientation.y, m.orientation.z, m.orientation.w] for m in messages]
    return pose(p, xyzw=o) if p else np.empty((0, 4, 4))


def write_pose(T: npt.ArrayLike, message: Message) -> None:
    """Write a homogeneous matrix into a `geometry_msgs/Pose`."""
    xyz, wxyz = to_xyz_wxyz(T)
    p, o = message.position, message.orientation
    p.x, p.y, p.z = xyz.tolist()
    o.w, o.x, o.y, o.z = wxyz.tolist()


def read_solutions(response: Message) -> IkSolutions:
    """Return the solutions of the response of an IK service, of ROS 1 or ROS 2, as arrays.

    Args:
        response: `irbkin_interfaces/IK` response: its `joints`, `slots` and `statuses`.

    Raises:
        ValueError: The lengths do not fit together.
    """
    joints: Sequence[float] = response.joints
    # `bytes` in ROS 1, `array.array` in ROS 2; both give integers when iterated.
    fields = response.slots, response.statuses
    slots, statuses = (np.frombuffer(bytes(field), dtype=np.uint8) for field in fields)
    if len(slots) != len(statuses) or (len(joints) % len(slots) if len(slots) else len(joints)):
        raise ValueError(
            f"response has {len(joints)} joints, {len(slots)} slots and {len(statuses)} statuses: "
            "there must be one slot, one status and as many joints as the arm has a solution"
        )
    q = np.asarray(joints, dtype=np.float64).reshape(len(slots), -1 if len(slots) else 0)
    return IkSolutions(q, slots, statuses)
