"""What a user's own code has in types: mypy reads this file, nothing runs it."""

from collections.abc import Iterable, Mapping, Sequence

import irbkin
import irbkin.map
import numpy as np
import numpy.typing as npt
from irbkin import placement, rapid


def answers(robot: irbkin.Robot, T: npt.NDArray[np.float64]) -> None:
    s: Iterable[irbkin.Solution] = robot.ik(T)
    first: irbkin.Solution = robot.ik(T)[0]
    some: tuple[irbkin.Solution, ...] = robot.ik(T)[:2]
    angles: Iterable[float] = first
    angle: float = first[0]
    degrees: npt.NDArray[np.float64] = first.q_deg
    print(s, some, angles, angle, degrees, first in s, {first})


def records(robot: irbkin.Robot, q: Sequence[float], many: npt.NDArray[np.float64]) -> None:
    quarter: int = robot.configuration(q).cf1
    distance: float = robot.singularity(q).wrist
    kinds: irbkin.SingularityKind = robot.singularity(q).kinds
    target = rapid.RobTarget((600.0, 0.0, 800.0), robconf=robot.configuration(q))
    batch = robot.configuration(many)
    if isinstance(batch, irbkin.records.ConfigurationBatch):
        quarters: npt.NDArray[np.int32] = batch.cf1
        print(quarters)
    path = robot.follow(robot.fk(many), q, singularity_mode=irbkin.SingularityMode.WRIST)
    same = robot.follow(robot.fk(many), q, singularity_mode="wrist")
    reasons: set[irbkin.records.BreakReason] = {broken.kind for broken in path.breaks}
    print(quarter, distance, kinds, target, same, reasons)


def plans(robot: irbkin.Robot, paths: Sequence[npt.NDArray[np.float64]]) -> None:
    planned: list[irbkin.Plan] = [robot.plan(path, rotation=36) for path in paths]
    targets: list[rapid.RobTarget] = rapid.plan_targets(robot, planned[0])
    text: str = rapid.dump(rapid.plan_module(robot, planned[0], speed=rapid.SpeedData(12.0)))
    room: npt.NDArray[np.float64] = robot.margin(planned[0].q).limits
    region = placement.Region(x=(-1.0, 1.0), turn=0.3)
    found: placement.Placement = placement.best_base(robot, paths[0], region, steps=(5, 1, 1, 1))
    spread = irbkin.map.orientations(20)
    share: npt.NDArray[np.float64] = irbkin.map.reach(robot, [0.5], 0.0, [1.0], spread).share
    print(targets, text, room, found.reason, share)


def names(module: rapid.Module) -> None:
    data: Mapping[str, object] = module
    payload: float | None = irbkin.catalog_entry("UR5e").payload
    print(len(data), data.get("p10"), payload)


def motions(robot: irbkin.Robot, plan: irbkin.Plan, T: npt.NDArray[np.float64]) -> None:
    timed: irbkin.trajectory.Trajectory = irbkin.trajectory.retime(plan.q, robot.max_velocity, 8.0)
    steady = irbkin.trajectory.at_tool_speed(plan.q, T, 0.1, robot.max_velocity)
    print(timed.duration, steady.duration)
