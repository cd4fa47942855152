"""RAPID of a plan: its robtargets, and a module that moves through them."""

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from irbkin import Robot, _core
from irbkin._arrays import Floats, as_array
from irbkin._core import (
    NOT_THERE,
    JointTarget,
    Module,
    Pose,
    RobTarget,
    SpeedData,
    ToolData,
    Trajectory,
    WobjData,
    ZoneData,
)
from irbkin.errors import RapidError
from irbkin.freedom import Positioner, Track
from irbkin.records import Plan

MOST_EXTERNAL = 6


def plan_targets(
    robot: Robot,
    plan: Plan,
    tool: ToolData | None = None,
    wobj: WobjData | None = None,
    *,
    extax: npt.ArrayLike | None = None,
    carrier: Track | Positioner | Sequence[Track | Positioner] | None = None,
) -> list[RobTarget]:
    """Return the robtargets of a plan: each pose with the tool rotation that was found, and the
    confdata of its joints.

    At a wrist singularity a robtarget does not determine q4 and q6: `JointTarget.of(q)` of such a
    row does.

    Args:
        robot: The arm of the plan. Work objects are given in the world, in which its base is.
        plan: The answer of `robot.plan`, without breaks.
        tool: The tool; by default the robot's own.
        wobj: The work object; by default the world.
        extax: External axes at each pose [deg or mm], shape (m, k), k up to 6.
        carrier: The carrier of the plan, if it has external axes: then their values fill `extax`,
            in mm of a track and in deg of a positioner, and the targets are in the world, or on the
            work object as it is with all positioners at zero. In the cell the track is coordinated
            with the base, and the work object is moved by the positioner (`ufprog` FALSE).

    Returns:
        One robtarget for each of the m poses. `calc_joint_t` gives the joints of the plan again.

    Raises:
        RapidError: The plan has breaks, or external axes that neither `extax` nor `carrier` gives.
        InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa of the
            catalog.
    """
    if not isinstance(plan, Plan):
        raise TypeError(f"plan must be a Plan, as of robot.plan, got {type(plan).__name__}")
    q = as_array(plan.q, "plan.q", (None, 6), RapidError)
    for index in np.flatnonzero(~np.isfinite(q).all(axis=1)):
        raise RapidError(f"plan.q[{index}] has no joint angles: a plan with breaks has no targets")
    carriers = _carriers(plan, carrier)
    if carriers and extax is None:
        units = [1e3 if isinstance(one, Track) else np.degrees(1.0) for one in carriers]
        extax = plan.external * units
    axes = _external(np.shape(plan.external)[1], len(q), extax)
    targets = [
        _core.calc_rob_t(robot._carried(carriers, values), JointTarget.of(row, more), tool, wobj)
        for row, more, values in zip(q.tolist(), axes.tolist(), plan.external.tolist(), strict=True)
    ]
    # Of a quaternion and its negative, the one nearer to the target before.
    for number, own in enumerate(targets[1:], 1):
        if np.dot(targets[number - 1].rot, own.rot) < 0:
            targets[number] = own._replace(rot=tuple(0.0 - part for part in own.rot))
    return targets


def plan_module(
    robot: Robot,
    plan: Plan | Trajectory,
    name: str = "Planned",
    *,
    tool: ToolData | None = None,
    wobj: WobjData | None = None,
    extax: npt.ArrayLike | None = None,
    carrier: Track | Positioner | Sequence[Track | Positioner] | None = None,
    speed: str | SpeedData = "v100",
    zone: str | ZoneData = "z1",
) -> Module:
    r"""Return a module that moves along a plan in `main`: MoveJ to its first pose, then MoveL.

    `dump` writes it, `calc_moves` gives the joints of the plan again, `motion` times it. Targets
    have the digits of a controller: 0.001 mm, quaternions 1e-7, external axes 1e-6. The moves are
    followed as a controller follows them before they are returned.

    Of a motion as of `robot.go` it is a MoveAbsJ to each sample, between which the joints move
    evenly: `cell.check_path` proves that its samples are near enough to one another.

    Args:
        robot: The arm of the plan.
        plan: The answer of `robot.plan`, without breaks, or a `Trajectory` of six joints.
        name: Name of the module.
        tool: The tool, declared as tPlan; by default the robot's own.
        wobj: The work object, declared as wPlan; without it the moves have no \WObj.
        extax: As for `plan_targets`.
        carrier: As for `plan_targets`.
        speed: Speed of the moves, as RAPID writes it, or data.
        zone: Zone of the moves between the first and the last, which are fine points.

    Returns:
        The module: the targets are p1 to pm.

    Raises:
        RapidError: As `plan_targets`; a name, speed or zone that RAPID does not read; moves that do
            not arrive with the joints of the plan.
        InvalidModelError: As `plan_targets`.
    """
    targets: Sequence[RobTarget | JointTarget]
    if isinstance(plan, _core.Trajectory):
        q = as_array(plan.q, "plan.q", (None, 6), RapidError)
        axes = _external(0, len(q), extax)
        targets = [JointTarget.of(*both) for both in zip(q.tolist(), axes.tolist(), strict=True)]
    else:
        targets = [
            target._replace(
                trans_mm=np.round(target.trans_mm, 3),
                rot=np.round(target.rot, 7),
                extax=np.round(target.extax, 6),
            )
            for target in plan_targets(robot, plan, tool, wobj, extax=extax, carrier=carrier)
        ]
    data: Mapping[str, ToolData | WobjData | RobTarget | JointTarget] = {
        "tPlan": ToolData(tframe=Pose.of(robot.tool)) if tool is None else tool,
        **({} if wobj is None else {"wPlan": wobj}),
        **{f"p{number}": target for number, target in enumerate(targets, 1)},
    }
    frames = "tPlan" if wobj is None else r"tPlan\WObj:=wPlan"
    speed, zone = (
        value if isinstance(value, str) else _core.dump(value) for value in (speed, zone)
    )
    moves = []
    for number in range(1, len(targets) + 1):
        kind = "MoveJ" if number == 1 else "MoveL"
        if isinstance(plan, _core.Trajectory):
            kind = "MoveAbsJ"
        end = "fine" if number in (1, len(targets)) else zone
        moves.append(f"        {kind} p{number},{speed},{end},{frames};")
    declared = _core.dump(dict(data), name).rstrip().removesuffix("ENDMODULE").rstrip()
    lines = [declared, "", "    PROC main()", *moves, "    ENDPROC", "ENDMODULE", ""]
    module = _core.parse_module("\n".join(lines))
    for move in module.moves:
        for argument in (move.speed_data, move.zone_data):
            if argument.value is None:
                raise RapidError(
                    f"{argument.text} is no speed or zone of RAPID's own ({argument.reason}): "
                    f"pass SpeedData or ZoneData"
                )
    if len(module.moves) != len(targets):
        raise RapidError(
            f"speed {speed!r} and zone {zone!r} make no move: {module.skipped[0].what}"
        )
    for found in _core.check(robot, module):
        if found.severity == "error" and found.code[0] in "CR":
            raise RapidError(
                f"a controller would not move as planned: {found.message}; plan with more poses "
                "around it, or with another rotation"
            )
    return module


def _carriers(
    plan: Plan, carrier: Track | Positioner | Sequence[Track | Positioner] | None
) -> list[Track | Positioner]:
    if carrier is None:
        return []
    carriers = [carrier] if isinstance(carrier, (Track, Positioner)) else list(carrier)
    planned = np.shape(plan.external)[1]
    if len(carriers) != planned:
        raise RapidError(f"carrier has {len(carriers)} axes, plan.external has {planned}")
    return carriers


def _external(planned: int, count: int, extax: npt.ArrayLike | None) -> Floats:
    """Return the six external axes of each pose, 9e9 for an axis that does not exist."""
    axes = np.full((count, MOST_EXTERNAL), NOT_THERE)
    if extax is None:
        if planned:
            raise RapidError(
                f"plan.external has {planned} axes in rad or m: pass the carrier of the plan, or "
                f"extax, in deg or mm"
            )
        return axes
    given = np.asarray(extax, dtype=np.float64)
    is_fit = given.ndim == 2 and len(given) == count
    if not is_fit or not max(planned, 1) <= given.shape[1] <= MOST_EXTERNAL:
        raise RapidError(
            f"extax must have shape ({count}, k), k from {planned or 1} to {MOST_EXTERNAL}, "
            f"got {given.shape}"
        )
    axes[:, : given.shape[1]] = given
    return axes
