"""Representations of answers of the extension, and the table of a robot."""

from functools import singledispatch

import numpy as np

from irbkin._core import FollowResult, IkBatch, Plan, Robot, Singularity, catalog, catalog_entry
from irbkin._words import counted, singularities

MOST_LINES = 8
"""Breaks of an answer that are listed."""
FOUND, WITHIN_LIMITS, INVALID = 1, 2, 64
"""Flags of `irbkin.Status`."""


@singledispatch
def of_record(record: object) -> str | None:
    """The representation of a record that is an answer; None of another one."""
    return None


@of_record.register
def of_ik_batch(batch: IkBatch) -> str:
    status = np.asarray(batch.status)
    flags = np.bitwise_or.reduce(status.reshape(-1, status.shape[-1]), axis=1)
    inside, found = (int(np.count_nonzero(flags & it)) for it in (WITHIN_LIMITS, FOUND))
    invalid = int(np.count_nonzero(flags & INVALID))
    none = len(flags) - found - invalid
    words = (
        f"{inside:,} with a solution inside limits, {found - inside:,} outside, {none:,} without"
    )
    words += f", {invalid:,} invalid" if invalid else ""
    return f"<IkBatch: {_poses(status.shape[:-1])}, {status.shape[-1]} slots: {words}>"


@of_record.register
def of_plan(plan: Plan) -> str:
    parts = [_poses((len(plan.q),)), f"{plan.q.shape[1]} joints"]
    axes = np.shape(plan.external)[1]
    parts += [f"{axes} external"] if axes else []
    parts += ["certified"] if plan.certified else ["not certified"]
    parts += [f"bottleneck {plan.bottleneck:.4g}", f"cost {plan.cost:.4g} rad^2"]
    gaps = [f"between poses {it.leave} and {it.enter}" for it in plan.breaks]
    return _with_breaks(f"<Plan: {', '.join(parts)}", gaps)


@of_record.register
def of_follow_result(result: FollowResult) -> str:
    q, error = np.asarray(result.q), np.asarray(result.orientation_error)
    is_met = ~np.isnan(error)
    head = f"<FollowResult: {_poses(error.shape)}, {q.shape[-1]} joints, {is_met.sum():,} met"
    if is_met.any() and error[is_met].max() > 1e-6:
        head += f", the tool turned off by up to {np.degrees(error[is_met].max()):.3g} deg"
    gaps = [f"{f'path {it.path}, ' if it.path else ''}{it.reason}" for it in result.breaks]
    return _with_breaks(head, gaps)


@of_record.register
def of_singularity(at: Singularity) -> str:
    """The distances, and the singularities that they are near; of many how many are near one."""
    near = np.asarray(at.near())
    if near.ndim:
        words = f"{counted(near.size, 'joint vector')}, {np.count_nonzero(near & 28):,} near one"
    else:
        wrist, elbow, shoulder = np.degrees(at.wrist), np.degrees(at.elbow), 1e3 * at.shoulder
        words = f"wrist {wrist:.3g} deg, elbow {elbow:.3g} deg, shoulder {shoulder:.3g} mm, "
        words = "" if np.isnan(wrist) else words
        words += f"least singular value {at.min_singular_value:.3g}, "
        words += singularities(at.kinds, int(near)) or "near none"
    return f"<Singularity: {words}>"


def _poses(shape: tuple[int, ...]) -> str:
    sizes = " x ".join(f"{size:,}" for size in shape[:-1])
    return (f"{sizes} x " if sizes else "") + counted(shape[-1] if shape else 1, "pose")


def _with_breaks(head: str, gaps: list[str]) -> str:
    more = [f"{len(gaps) - MOST_LINES} more"] if len(gaps) > MOST_LINES else []
    count = counted(len(gaps), "break") if gaps else "no break"
    return "\n".join([f"{head}, {count}", *gaps[:MOST_LINES], *more]) + ">"


def facts_of(robot: Robot) -> list[str]:
    words = [f"{robot.dof} joints", robot.structure or "general"]
    if robot.name in catalog():
        entry = catalog_entry(robot.name)
        words += [f"reach {entry.reach:g} m"] if entry.reach else []
        words += [f"payload {entry.payload:g} kg"] if entry.payload else []
    for name, frame in (("tool", robot.tool), ("base", robot.base)):
        if not np.array_equal(frame, np.eye(4)):
            place = ", ".join(f"{1e3 * it:.1f}" for it in frame[:3, 3])
            words.append(f"{name} at ({place}) mm")
    return words


def joints_of(robot: Robot) -> tuple[list[str], list[list[str]]]:
    """The table of the joints: modified Denavit-Hartenberg parameters, limits, speeds."""
    alpha, a, d, theta = robot.mdh.T
    numbers = {
        "alpha [deg]": np.degrees(alpha),
        "a [mm]": 1e3 * a,
        "d [mm]": 1e3 * d,
        "theta [deg]": np.degrees(theta),
        "from [deg]": np.degrees(robot.limits[:, 0]),
        "to [deg]": np.degrees(robot.limits[:, 1]),
    }
    if robot.max_velocity is not None:
        numbers["speed [deg/s]"] = np.degrees(robot.max_velocity)
    # Adding 0 takes the sign of -0 away.
    rows = [[name, *(f"{it + 0.0:g}" for it in row.round(3))] for name, row in numbers.items()]
    return ["", *(f"J{joint + 1}" for joint in range(robot.dof))], rows


def of_robot(robot: Robot) -> str:
    """Return the text that `print(robot)` shows below the robot's name."""
    head, rows = joints_of(robot)
    widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    lines = (
        "  ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])])
        for row in (head, *rows)
    )
    return "\n".join([", ".join(facts_of(robot)), *lines])
