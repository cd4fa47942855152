"""Requests of the page and what irbkin in Python answers: expected.py FILE.

One arm of each structure; tests/page/wasm.mjs compares. An expected object has the fields that are
compared, the answer may have more.
"""

import json
import math
import sys
from pathlib import Path
from typing import Any

import irbkin
import numpy as np
from irbkin import rapid
from irbkin._core import check_codes, check_program
from irbkin.body import Shape

Case = dict[str, Any]

ARMS = [
    "IRB 2600-12/1.65",
    "IRB 2400-16/1.55",
    "UR5e",
    "Panda",
    "CRB 15000-5/0.95",
    "IRB 14000-0.5/0.5 (left)",
]
EXAMPLE = Path(__file__).parents[2] / "examples" / "pick_and_place.mod"
TOOL = np.array([[0.0, 0, 1, 0.05], [0, 1, 0, 0], [-1, 0, 0, 0.12], [0, 0, 0, 1]])
BASE = np.array([[0.0, -1, 0, 0.3], [1, 0, 0, -0.2], [0, 0, 1, 0.7], [0, 0, 0, 1]])
WORDS = {irbkin.Status.WRIST: "wrist", irbkin.Status.ELBOW: "elbow"}
# A robot without a closed form: its last three axes do not meet.
GENERAL = [
    [0.0, 0.0, 0.4, 0.0],
    [-math.pi / 2, 0.1, 0.0, -math.pi / 2],
    [0.0, 0.5, 0.05, 0.0],
    [-math.pi / 2, 0.12, 0.45, 0.0],
    [math.pi / 2, 0.03, 0.1, 0.0],
    [-math.pi / 2, 0.04, 0.09, 0.0],
]


def numbers(array: Any) -> Any:
    """Nested lists, `None` for a number that does not exist."""
    if np.ndim(array) > 0:
        return [numbers(item) for item in array]
    return float(array) if math.isfinite(array) else None


def pose(T: np.ndarray) -> list[float]:
    """The first three rows of a pose."""
    return numbers(T[:3].ravel())


def confdata(robot: irbkin.Robot, q: np.ndarray) -> list[int] | None:
    try:
        return list(robot.configuration(q))
    except irbkin.IrbkinError:
        return None


def arm_angle(robot: irbkin.Robot, q: np.ndarray) -> float | None:
    try:
        return numbers(robot.arm_angle(q))
    except irbkin.IrbkinError:
        return None


def middle(robot: irbkin.Robot) -> np.ndarray:
    """Joint angles at 0.6 of each range: at no singularity."""
    lower, upper = np.array(robot.limits).T
    q = lower + 0.6 * (upper - lower)
    return np.clip(q, -1.1, 1.1) + np.arange(robot.dof) * 0.05


def of_robot(robot: irbkin.Robot, placed: irbkin.Robot, request: Case) -> Case:
    fields = {
        "name": robot.name,
        "dof": robot.dof,
        "structure": robot.structure,
        "limits": numbers(np.array(robot.limits)),
        "max_velocity": None if robot.max_velocity is None else numbers(robot.max_velocity),
        "base": pose(placed.base),
        "tool": pose(placed.tool),
    }
    return {"request": {"do": "robot", **request}, "ok": fields}


def of_fk(robot: irbkin.Robot, q: np.ndarray, cell: irbkin.Cell) -> Case:
    frames, singular = robot.link_frames(q), robot.singularity(q)
    nearest = cell.distance(robot, q)
    known = {"wrist": singular.wrist, "elbow": singular.elbow, "shoulder": singular.shoulder}
    ok = {
        "tool": pose(robot.fk(q)),
        "frames": [pose(frame) for frame in frames[:-1]],
        "confdata": confdata(robot, q),
        "arm_angle": arm_angle(robot, q),
        "margin": {
            "limits": numbers(robot.margin(q).limits),
            "singularities": numbers(robot.margin(q).singularities),
        },
        "singular": {name: numbers(value) for name, value in known.items()},
        "contact": {
            "collides": bool(cell.collides(robot, q)),
            "distance": numbers(nearest.distance),
            "near": nearest.pair[0][1],
        },
    }
    if math.isnan(singular.wrist):
        ok["singular"] = None
    return {"request": {"do": "fk", "q": numbers(q), "collide": True}, "ok": ok}


def of_ik(robot: irbkin.Robot, q: np.ndarray, cell: irbkin.Cell, given: bool) -> Case:
    """All solutions of the pose at `q`; of seven joints, with q7 given or along the redundancy."""
    T, seed = robot.fk(q), q + 0.03
    request = {"do": "ik", "T": pose(T), "seed": numbers(seed), "collide": True}
    if robot.dof == 7 and given:
        solutions = robot.ik(T, q7=q[6])
        nearest = solutions.nearest(seed)
        request["q7"] = float(q[6])
    elif robot.dof == 7:
        nearest = robot.ik_nearest(T, seed)
        solutions = robot.ik(T, q7=nearest[6])
    else:
        solutions, nearest = robot.ik(T), robot.ik_nearest(T, seed)
    each = [
        {
            "q": numbers(it.q),
            "slot": it.slot,
            "within_limits": it.is_within_limits,
            "confdata": confdata(robot, it.q),
            "collides": bool(cell.collides(robot, it.q)),
            "margin": {"limits": numbers(robot.margin(it.q).limits)},
        }
        for it in solutions
    ]
    ok = {
        "solutions": each,
        "certified": solutions.certified,
        "reason": None,
        "outcome": solutions.explain(),
        "nearest": {"q": numbers(np.asarray(nearest))},
    }
    return {"request": request, "ok": ok}


def of_singular(robot: irbkin.Robot, q: np.ndarray) -> Case:
    """A pose at the wrist singularity leaves joint 4 free."""
    q = q.copy()
    q[4] = 0.0
    T = robot.fk(q)
    each = []
    for it in robot.ik(T):
        words = [word for bit, word in WORDS.items() if it.singularities & bit]
        each.append({"q": numbers(it.q), "singularities": words})
    return {"request": {"do": "ik", "T": pose(T)}, "ok": {"solutions": each}}


def unreachable(robot: irbkin.Robot) -> Case:
    """A pose ten meters away has no solutions, and a reason."""
    T = np.eye(4)
    T[0, 3] = 10.0
    reason = robot.ik(T).explain()
    request = {"do": "ik", "T": pose(T)}
    return {"request": request, "ok": {"solutions": [], "reason": reason, "nearest": None}}


def of_target(robot: irbkin.Robot, q: np.ndarray) -> list[Case]:
    joints = rapid.JointTarget(np.degrees(q[[0, 1, 3, 4, 5, 6]] if len(q) == 7 else q))
    if len(q) == 7:
        joints = rapid.JointTarget(joints.robax_deg, [math.degrees(q[2]), *[9e9] * 5])
    target = rapid.calc_rob_t(robot, joints)
    again = rapid.calc_joint_t(robot, target)
    back = list(again.robax_deg)
    if len(q) == 7:
        back.insert(2, again.extax[0])
    ok = {
        "kind": "robtarget",
        "T": pose(robot.fk(q)),
        "confdata": list(target.robconf),
        "q": numbers(np.radians(back)),
        "reason": None,
    }
    declared = f"CONST robtarget p1:={rapid.dump(target)};"
    of_joints = {"kind": "jointtarget", "T": pose(robot.fk(q)), "q": numbers(q)}
    return [
        {"request": {"do": "ik_target", "robtarget": rapid.dump(target)}, "ok": ok},
        {"request": {"do": "ik_target", "robtarget": declared}, "ok": {**ok, "name": "p1"}},
        {"request": {"do": "ik_target", "robtarget": rapid.dump(joints)}, "ok": of_joints},
    ]


def of_program(robot: irbkin.Robot, text: str) -> list[Case]:
    module = rapid.parse(text)
    motion = rapid.motion(robot, module)
    # Of all codes, also those that are shown only if selected.
    codes = [code for code, *_ in check_codes()]
    checked = check_program(robot, [module], codes=codes)
    moves = [
        {
            "line": it.line,
            "target": it.target,
            "q": None if it.q is None else numbers(it.q),
            "confdata": None if it.confdata is None else list(it.confdata),
        }
        for it in checked.moves
    ]
    found = [
        {"code": it.code, "line": it.line, "column": it.column, "message": it.message}
        for it in checked.findings
    ]
    flange = robot.with_tool(np.eye(4)).fk(motion.q)
    tools = np.array([motion.moves[index].tool for index in motion.move_index])
    played = {
        "t": numbers(motion.t),
        "q": numbers(motion.q.ravel()),
        "way": numbers((flange @ tools)[:, :3, 3].ravel()),
        "move_index": [int(index) for index in motion.move_index],
        "samples": len(motion.t),
        "thinned": False,
    }
    request = {"do": "check", "modules": [{"text": text}]}
    return [
        {"request": request, "ok": {"moves": moves, "findings": found}},
        {"request": {"do": "motion"}, "ok": played},
    ]


def of_arm(robot: irbkin.Robot, request: Case) -> list[Case]:
    q = middle(robot)
    placed = robot.with_tool(TOOL).with_base(BASE)
    tool, base = pose(TOOL), pose(BASE)
    size = {"size": [0.4, 0.5, 0.6], "pose": pose(np.eye(4))}
    table = Shape.box(size["size"])
    ball = Shape.sphere(0.2, [1.2, 0.4, 0.3])
    floor = Shape.half_space([0, 0, 1], [0, 0, -0.1])
    cell = irbkin.Cell({"table": table, "ball": ball, "floor": floor}, margin=0.01)
    obstacles = [
        {"name": "table", "shape": "box", **size},
        {"name": "ball", "shape": "sphere", "radius": 0.2, "center": [1.2, 0.4, 0.3]},
        {"name": "floor", "shape": "half_space", "normal": [0, 0, 1], "point": [0, 0, -0.1]},
    ]
    names = {"names": ["table", "ball", "floor"], "margin": 0.01}
    cases = [
        of_robot(robot, placed, {**request, "tool": tool, "base_pose": base}),
        {"request": {"do": "cell", "obstacles": obstacles, "margin": 0.01}, "ok": names},
        of_fk(placed, q, cell),
        of_ik(placed, q, cell, True),
    ]
    if robot.dof == 7:
        cases.append(of_ik(placed, q, cell, False))
    else:
        cases += [unreachable(placed), of_singular(placed, q)]
    if confdata(robot, q) is not None:
        cases += of_target(placed, q)
    return cases


def main() -> None:
    cases = []
    for name in ARMS:
        cases += of_arm(irbkin.Robot(name), {"name": name})
    general = irbkin.Robot.from_mdh(GENERAL).with_limits(np.tile([-2.9, 2.9], (6, 1)))
    text = general.to_urdf()
    read = irbkin.Robot.from_urdf(text)
    cases += of_arm(read.with_body(read.approximate_body()), {"urdf": text})
    robot = irbkin.Robot("IRB 2600-12/1.65")
    cases.append(of_robot(robot, robot, {"name": robot.name}))
    cases += of_program(robot, EXAMPLE.read_text())
    Path(sys.argv[1]).write_text(json.dumps(cases))


if __name__ == "__main__":
    main()
