"""Scenes of what irbkin answers."""

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats, evenly
from irbkin._core import Cell, Robot, RoutineMotion, Solutions, Trajectory
from irbkin.calibration import Calibration, HandEye
from irbkin.map import ReachMap
from irbkin.rapid import Finding
from irbkin.records import FollowResult, Plan
from irbkin.scene._arms import arm_of, motion_of, rest, rows
from irbkin.scene._data import Arm, Cloud, Frame, Mark, Motion, Obstacle, Path, Posture, Scene

Calibrated = Calibration | HandEye
MOST_POSTURES, MOST_VECTORS = 8, 500
"""Postures and vectors of a scene: more are thinned."""
SCALES = (10000, 5000, 2000, 1000, 500, 200, 100, 50, 20, 10, 5, 2, 1)
"""Lengths at which residuals are drawn, relative to their own [1]."""
LONGEST = 0.2
"""Length at most at which the largest residual is drawn, if it is not longer [m]."""
MOST_POINTS = 500
"""Points of a path, and positions of a map in thousands: more are thinned."""
AT_JOINTS = Robot, Cell, ReachMap, HandEye
"""What is drawn with an arm at joint angles that are given."""
OWN_JOINTS = Solutions, Trajectory, Plan, FollowResult, RoutineMotion, Calibration
EACH = 0.02
"""Time from one pose of a path without times to the next [s]."""


def of(
    thing: Any, robot: Robot | None = None, *, q: npt.ArrayLike | None = None, title: str = ""
) -> Scene:
    """Return the scene of something that irbkin answers.

    Args:
        thing: A Robot; Solutions (the first is drawn, the others are ghosts), a Trajectory, Plan or
            FollowResult, a `rapid.RoutineMotion` with its findings, a Cell, a `ReachMap`, what the
            functions of `irbkin.calibration` return; or a sequence of these.
        robot: The arm of anything but a Robot and a Calibration; of a cell and a map it may be
            left out.
        q: Joint angles of a Robot, of `robot` in a cell or a map, or at which `robot` was measured
            [rad], shape (n,) or (k, n): several are drawn.
        title: Words above the scene; the robot's name when not given.

    Raises:
        TypeError: Something else, `robot` is missing, or `q` of a thing that has its own.
    """
    # Records are tuples, too.
    if isinstance(thing, list | tuple) and not isinstance(thing, (*AT_JOINTS, *OWN_JOINTS)):
        whole = Scene(title)
        for it in thing:
            whole += of(it, robot, q=q if isinstance(it, AT_JOINTS) else None)
        return whole
    scene = _scene(thing, robot, q)
    name = scene.arms[0].name if scene.arms else ""
    return Scene(title or name) + scene


def _scene(thing: Any, robot: Robot | None, q: npt.ArrayLike | None) -> Scene:
    if isinstance(thing, Scene):
        return thing
    if not isinstance(thing, (*AT_JOINTS, *OWN_JOINTS)):
        raise TypeError(
            "thing must be a Robot, Solutions, Trajectory, Plan, FollowResult, RoutineMotion, "
            f"Cell, ReachMap or a calibration, got {type(thing).__name__}"
        )
    if q is not None and isinstance(thing, OWN_JOINTS):
        raise TypeError(f"q is given, but a {type(thing).__name__} has its own joint angles")
    if isinstance(thing, Robot):
        return _of_robot(thing, q)
    if isinstance(thing, Calibrated):
        return _of_calibration(thing, robot, q)
    if isinstance(thing, Cell | ReachMap):
        own = _of_map(thing) if isinstance(thing, ReachMap) else _of_cell(thing)
        return own if robot is None else own + _of_robot(robot, q)
    if robot is None:
        raise TypeError(f"robot is missing: a {type(thing).__name__} does not know its arm")
    if isinstance(thing, Solutions):
        return _of_solutions(robot, thing)
    if isinstance(thing, RoutineMotion):
        return _of_routine(robot, thing)
    if isinstance(thing, Trajectory):
        return _of_motion(robot, motion_of(thing.t, thing.q))
    reached = np.asarray(thing.q)[np.isfinite(thing.q).all(axis=1)]
    return _of_motion(robot, motion_of(EACH * np.arange(len(reached)), reached))


def _of_robot(robot: Robot, q: npt.ArrayLike | None) -> Scene:
    angles = np.atleast_2d(rest(robot) if q is None else np.asarray(q, dtype=float))
    # A wrong shape is refused by `fk`.
    robot.fk(angles)
    return Scene(arms=(arm_of(robot, [Posture(it) for it in rows(angles)]),))


def _of_cell(cell: Cell) -> Scene:
    return Scene(obstacles=tuple(Obstacle(name, it.data()) for name, it in cell.obstacles.items()))


def _of_solutions(robot: Robot, solutions: Solutions) -> Scene:
    postures = [
        Posture(rows(it.q), f"slot {it.slot}", is_ghost=index > 0)
        for index, it in enumerate(solutions)
    ]
    frames = (Frame("pose", rows(robot.fk(solutions[0].q))),) if len(solutions) else ()
    return Scene(arms=(arm_of(robot, postures),), frames=frames)


def _of_motion(robot: Robot, motion: Motion) -> Scene:
    poses = robot.fk(np.array(motion.q).reshape(-1, robot.dof))
    return Scene(arms=(arm_of(robot, motion=motion),), paths=_way(poses))


def _way(poses: Floats) -> tuple[Path, ...]:
    points = poses[evenly(len(poses), MOST_POINTS), :3, 3]
    return (Path("tool", rows(points)),) if len(points) else ()


def _of_routine(robot: Robot, made: RoutineMotion) -> Scene:
    motion = replace(motion_of(made.t, made.q, made.lines), routine=made.routine or "")
    # The program has its own tools.
    tools = np.array([it.tool for it in made.moves])[np.asarray(made.move_index)]
    poses = robot.with_tool(np.eye(4)).fk(made.q) @ tools
    marks = tuple(_mark(made, poses, it) for it in made.findings)
    return Scene(arms=(arm_of(robot, motion=motion),), paths=_way(poses), marks=marks)


def _mark(made: RoutineMotion, poses: Floats, finding: Finding) -> Mark:
    before = np.flatnonzero(np.asarray(made.move_index) <= finding.move_index)
    sample = int(before[-1]) if len(before) else 0
    text = f"{finding.code} {finding.message}"
    place = f"line {finding.line}"
    return Mark(rows(poses[sample, :3, 3]), text, finding.severity, place)


def _of_map(found: ReachMap) -> Scene:
    places = np.stack(np.meshgrid(found.x, found.y, found.z, indexing="ij"), axis=-1)
    is_reached = found.reached > 0
    points, values = places[is_reached], found.share[is_reached]
    step = max(1, len(points) // (1000 * MOST_POINTS // 10))
    cloud = Cloud("reach", rows(points[::step]), rows(values[::step]), "share of orientations")
    return Scene(clouds=(cloud,))


def _of_calibration(thing: Calibrated, robot: Robot | None, q: npt.ArrayLike | None) -> Scene:
    """A calibration with the arm where it was measured, if that is known."""
    if robot is None and q is not None:
        raise TypeError(f"robot is missing: q is given, but a {type(thing).__name__} has no arm")
    if isinstance(thing, Calibration):
        robot, q = thing.robot, thing.q
    arms: tuple[Arm, ...] = ()
    at = None
    if robot is not None and q is not None:
        angles = np.atleast_2d(np.asarray(q, dtype=float))
        at = robot.fk(angles)[0]
        # A link of a calibrated table may have its frame kilometers away: axes that are almost
        # parallel have their common normal there.
        drawn = thing.nominal if isinstance(thing, Calibration) else robot
        # Some postures, all but the first as ghosts.
        kept = evenly(len(angles), MOST_POSTURES).tolist()
        postures = (Posture(rows(angles[it]), f"measurement {it}", it > 0) for it in kept)
        arms = (arm_of(drawn, postures),)
    own = Scene(arms=arms, frames=tuple(_frames(thing, at)))
    return own + _residuals(thing.measured, thing.fitted)


def _frames(thing: Calibrated, at: Floats | None) -> list[Frame]:
    found: list[tuple[str, Floats | None]] = []
    if isinstance(thing, Calibration):
        found = [("base", thing.robot.base), ("tool", at)]
    else:
        found = [("X", None if at is None else at @ thing.x), ("Y", thing.y)]
    return [Frame(name, rows(pose)) for name, pose in found if pose is not None]


def _residuals(measured: Floats, fitted: Floats) -> Scene:
    off = fitted - measured
    error = np.linalg.norm(off, axis=1)
    worst = int(error.argmax())
    scale = next((it for it in SCALES if it * error[worst] <= LONGEST), 1)
    kept = evenly(len(error), MOST_VECTORS).tolist()
    paths = tuple(
        Path(f"residual {it} x {scale}", rows([measured[it], measured[it] + scale * off[it]]))
        for it in kept
    )
    cloud = Cloud("measured", rows(measured), rows(1e3 * error), "residual [mm]")
    words = (
        f"largest residual: {1e3 * error[worst]:.3g} mm, measurement {worst}; vectors are drawn "
        f"{scale} times as long"
    )
    return Scene(paths=paths, clouds=(cloud,), marks=(Mark(rows(measured[worst]), words),))
