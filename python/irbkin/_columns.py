"""Answers as columns by name, and a trajectory as a file and as a message: what the `to_` methods
of the extension's classes return.
"""

from collections.abc import Sequence
from os import PathLike
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin._core import (
    CatalogEntry,
    FollowResult,
    IkBatch,
    Plan,
    Solutions,
    TargetTable,
    Trajectory,
)
from irbkin._files import write_columns
from irbkin.errors import InvalidJointsError

Columns = dict[str, npt.NDArray[Any]]

CONFDATA = ("cf1", "cf4", "cf6", "cfx")
NANOSECONDS = 1_000_000_000


def numbered(name: str, rows: Floats) -> Columns:
    """The columns of an array, shape (m, n), numbered from 1."""
    return {f"{name}{number}": column.copy() for number, column in enumerate(rows.T, 1)}


def has_flag(status: npt.NDArray[np.uint8], flag: int) -> npt.NDArray[np.bool_]:
    """Where a flag of `irbkin.Status` is set."""
    return np.asarray((np.asarray(status) & flag) != 0)


def of_solutions(solutions: Solutions, has_confdata: bool) -> Columns:
    columns = {
        "slot": np.array([one.slot for one in solutions], dtype=np.int64),
        **numbered("q", solutions.q),
        "within_limits": np.array([one.is_within_limits for one in solutions], dtype=np.bool_),
        "singularities": np.array([one.singularities for one in solutions], dtype=np.uint8),
    }
    if has_confdata:
        each = [one.configuration for one in solutions]
        for name in CONFDATA:
            columns[name] = np.array([getattr(one, name) for one in each], dtype=np.int32)
    return columns


def of_ik_batch(batch: IkBatch) -> Columns:
    status = np.asarray(batch.status)
    slots = status.shape[-1]
    poses = int(np.prod(status.shape[:-1]))
    return {
        "pose": np.repeat(np.arange(poses), slots),
        "slot": np.tile(np.arange(slots), poses),
        "found": batch.found.ravel(),
        "within_limits": batch.within_limits.ravel(),
        "status": status.flatten(),
        **numbered("q", batch.q.reshape(poses * slots, batch.q.shape[-1])),
    }


def of_follow_result(result: FollowResult) -> Columns:
    error = np.asarray(result.orientation_error)
    length = error.shape[-1]
    paths = int(np.prod(error.shape[:-1]))
    return {
        "path": np.repeat(np.arange(paths), length),
        "pose": np.tile(np.arange(length), paths),
        **numbered("q", result.q.reshape(paths * length, result.q.shape[-1])),
        "orientation_error": error.flatten(),
    }


def of_plan(plan: Plan) -> Columns:
    return {
        **numbered("q", plan.q),
        "tool_angle": plan.tool_angle.copy(),
        "slot": plan.slot.copy(),
        **numbered("external", plan.external),
        **numbered("tolerance", plan.tolerance),
        **{name: plan.T[:, axis, 3].copy() for axis, name in enumerate("xyz")},
    }


def of_targets(table: TargetTable) -> dict[str, Any]:
    return {
        "kind": list(table.kinds),
        "name": list(table.names),
        "line": table.lines.copy(),
        **numbered("q", table.q),
        **{name: getattr(table.configuration, name).copy() for name in CONFDATA},
        "wrist": table.wrist.copy(),
        "elbow": table.elbow.copy(),
        "shoulder": table.shoulder.copy(),
        "finding": [None if it is None else it.message for it in table.findings],
    }


def of_catalog_entry(entry: CatalogEntry) -> dict[str, Any]:
    names = ("name", "maker", "dof", "payload", "reach", "is_coupled", "sources")
    return {name: getattr(entry, name) for name in names}


def of_trajectory(trajectory: Trajectory) -> Columns:
    return {
        "t": trajectory.t.copy(),
        **numbered("q", trajectory.q),
        **numbered("dq", trajectory.dq),
        **numbered("ddq", trajectory.ddq),
    }


def write_csv(answer: Any, path_or_file: str | PathLike[str] | IO[str]) -> None:
    write_columns(answer.to_dict(), path_or_file)


def of_joint_trajectory(
    trajectory: Trajectory, joint_names: Sequence[str] | None
) -> dict[str, Any]:
    dof = trajectory.dof
    numbered = [f"joint_{joint + 1}" for joint in range(dof)]
    names = joint_names if joint_names is not None else trajectory._joint_names or numbered
    if len(names) != dof:
        raise InvalidJointsError(f"joint_names has {len(names)} names, the motion has {dof} joints")
    rows = zip(trajectory.t, trajectory.q, trajectory.dq, trajectory.ddq, strict=True)
    return {
        "joint_names": list(names),
        "points": [
            {
                "positions": q.tolist(),
                "velocities": dq.tolist(),
                "accelerations": ddq.tolist(),
                "time_from_start": _time(t),
            }
            for t, q, dq, ddq in rows
        ],
    }


def _time(t: float) -> dict[str, int]:
    sec, nanosec = divmod(round(t * NANOSECONDS), NANOSECONDS)
    return {"sec": sec, "nanosec": nanosec}
