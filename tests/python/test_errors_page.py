"""The messages of Python's arguments in docs/errors.md are those that are raised. With
IRBKIN_WRITE=1 (`make errors`) the table is written.
"""

import os
from pathlib import Path

import irbkin
import irbkin.map
import numpy as np
from irbkin import Robot, paths, placement, plot, rapid, ros, trajectory

PAGE = Path(__file__).parents[2] / "docs" / "errors.md"
START = "<!-- python: written by make errors -->\n"
END = "<!-- end -->"
SIX = Robot("IRB 2600-12/1.65")
SEVEN = Robot("Panda")
SEED = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])
POSE = SIX.fk(SEED)
LINE = paths.line(POSE, SIX.fk(SEED + 0.1), steps=5)
PLAN = SIX.plan(LINE)
NAMES = {
    "irbkin": irbkin,
    "POSES": np.random.default_rng(1).uniform(-1, 1, (30, 6)),
    "rapid": rapid,
    "ros": ros,
    "plot": plot,
    "trajectory": trajectory,
    "placement": placement,
    "Region": placement.Region,
    "line": LINE,
    "plan": PLAN,
    "broken": PLAN._replace(q=np.full((5, 6), np.nan)),
    "tracked": PLAN._replace(external=np.zeros((5, 1))),
    "eye": np.eye(3),
    "move": trajectory.joint(SEED, -SEED),
    "limits": {"max_velocity": 2.0, "max_acceleration": 8.0, "max_jerk": 60.0},
    "np": np,
    "robot": SIX,
    "panda": SEVEN,
    "T": POSE,
    "seed": SEED,
    "many": np.array([POSE] * 5),
    "target": rapid.parse("[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"),
    "tool": rapid.parse("[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]"),
    "masked": np.ma.masked_array(POSE, mask=np.eye(4)),
}
# A call that is refused, and what to do.
CALLS = [
    ("robot.ik(T, seed)", "`robot.ik_nearest(T, seed)`"),
    ("panda.ik(T, seed)", "give `q7`, or take `ik_nearest`"),
    ("panda.ik(T)", "give `q7`, or take `ik_nearest`"),
    ("robot.ik(many)", "`robot.ik_batch(many)`"),
    ("robot.ik(target)", "`robot.ik(target.matrix())`"),
    ("robot.with_tool(tool)", "`robot.with_tool(tool.tframe.matrix())`"),
    ("robot.ik([target, target])", "`np.array([each.matrix() for each in targets])`"),
    ("robot.ik(None)", "give a pose"),
    ("robot.fk(['a'] * 6)", "give numbers"),
    ("robot.fk(np.zeros(5))", "give as many angles as joints"),
    ("robot.ik_nearest(many, np.zeros((3, 6)))", "one seed, or one for each pose"),
    ("robot.follow(T, seed)", "give a path, shape (m, 4, 4)"),
    ("panda.follow(many, np.zeros(7))", "do what it says"),
    ("panda.ik_batch(many, np.zeros(3))", "one angle, or one for each pose"),
    ("robot.ik_configured(T, [0, 0, 0])", "four numbers"),
    ("robot.ik_configured(T, [0, 0, 0.5, 0])", "whole numbers"),
    ("robot.ik_configured(T, [0] * 4, fallback='near')", "`fallback='nearest'`"),
    ("robot.ik_configured(T, [0] * 4, fallback='nearest')", "give the seed"),
    ("robot.ik_configured(T, [0] * 4, seed=seed)", "give `fallback='nearest'` too"),
    ("robot.ik(masked)", "fill the element, or leave the pose out"),
    ("robot.fk(seed, out=np.zeros(16))", "`np.empty((4, 4))`"),
    ("robot.fk(seed, out=[])", "give an array"),
    ("robot.jacobian(seed, frame='world')", '"base" or "tool"'),
    ("robot.follow(many, seed, singularity_mode='jump')", "one of the four"),
    ("robot.ik_batch(many, threads=-1)", "0 for one per core"),
    ("irbkin.Robot.from_mdh(np.zeros((6, 3)))", "rows of alpha, a, d, theta"),
    ("robot.with_limits(np.zeros((2, 6)))", "transpose them"),
    ("irbkin.catalog(reach=1400)", "give meters"),
    ("irbkin.catalog(reach='far')", "a number or a pair"),
    ("irbkin.catalog(reach=-1)", "0 or more"),
    ("irbkin.catalog(reach=(2, 1))", "(least, most)"),
    ("robot.with_limits([[-1e4, 1e4]] * 6).ik(T).turns()", "give limits, or inf for none"),
    ("rapid.parse('hello world')", "give RAPID text"),
    ("rapid.parse('pick.mod')", "`rapid.load('pick.mod')`"),
    ("rapid.dump(True)", "give a record or a module"),
    (
        "trajectory.joint(seed, -seed, end_velocity=[1.0] * 6, max_velocity=2.0)",
        "`trajectory.state_to_state`, or give `duration`",
    ),
    ("trajectory.state_to_state(seed, [0.0], **limits)", "as many angles as the start has"),
    ("trajectory.state_to_state(seed, [np.nan] * 6, **limits)", "repair it"),
    (
        "trajectory.state_to_state(seed, -seed, end_velocity=[9.0] * 6, **limits)",
        "a state inside the limits",
    ),
    ("plot.trajectory(seed)", "give a `Trajectory`, of `trajectory.joint` for instance"),
    ("plot.trajectory(move, robot=panda)", "the robot of the motion"),
    ("plot.trajectory(move, max_velocity=-1)", "give a positive limit"),
    ("plot.trajectory(move, limits=[[1, -1]] * 6)", "lower, then upper"),
    ("plot.path(T)", "give many poses, shape (m, 4, 4)"),
    ("plot.path(many, frames=-1)", "0 for none"),
    ("plot.singularity(robot, seed)", "give many joint vectors, shape (m, n)"),
    ("plot.reach(robot, [0, 0, -1])", "give a rotation matrix"),
    ("plot.reach(robot, np.eye(3), steps=1)", "two cells or more"),
    ("plot.plan(robot, seed)", "give a `Plan`, of `robot.plan`"),
    ("plot.plan(robot, plan, times=np.zeros(5))", "those that `plan` was given"),
    ("plot.placement(None)", "give a `Placement`, of `placement.best_base`"),
    ("plot.reach_map(None)", "give a `ReachMap`, of `irbkin.map.reach`"),
    ("robot.plan_batch(line)", "a list of paths"),
    ("robot.plan_batch([line], times=[[0, 1]] * 2)", "one array for each path"),
    ("robot.plan_batch([line], start=np.zeros((2, 6)))", "one start, or one for each path"),
    ("rapid.plan_targets(robot, broken)", "plan what lies between its breaks"),
    ("rapid.plan_targets(robot, tracked)", "give `carrier`, or `extax`"),
    ("rapid.plan_targets(robot, plan, extax=np.zeros(3))", "one row for each pose"),
    ("rapid.plan_module(robot, plan, speed='v17')", "`rapid.SpeedData(17)`"),
    ("placement.best_base(robot, line, Region(x=(1, 0)))", "(lower, upper)"),
    ("placement.best_base(robot, line, Region(turn=(-180, 180)))", "give radians"),
    ("placement.best_base(robot, line, Region(x='far'))", "a number or a pair"),
    ("placement.best_base(robot, line, Region(), steps=0)", "1 or more"),
    ("placement.best_base(robot, line, Region(), frame=eye)", "a pose, shape (4, 4)"),
    ("placement.best_base(panda, line, Region())", "an arm of six joints"),
    ("irbkin.map.reach(robot, [0, np.nan], 0, 0, eye)", "give finite positions"),
    ("irbkin.map.reach(robot, 0, 0, 0, -eye)", "give rotation matrices"),
    ("irbkin.map.reach(robot, 0, 0, 0, eye, output='a.csv')", "a name that ends with .npz"),
    ("irbkin.map.orientations(0)", "1 or more"),
    ("robot.with_corrections(np.zeros(30))", "one number for each parameter"),
    ("robot.with_nominal(panda)", "the arm that was calibrated"),
    ("irbkin.calibrate(robot, np.degrees(POSES), robot.fk(POSES))", "`np.radians(q)`"),
    (
        "irbkin.calibrate(robot, POSES, 1e3 * robot.fk(POSES)[:, :3, 3])",
        "divide the positions by 1000",
    ),
    ("irbkin.calibrate(robot, POSES, robot.fk(POSES)[:-1])", "one measurement for each row of q"),
    ("irbkin.calibrate(robot, POSES[:5], robot.fk(POSES[:5]))", "measure more, or fit less"),
    ("irbkin.calibrate(robot, POSES[[0] * 30], robot.fk(POSES[[0] * 30]))", "do what it says"),
    (
        "irbkin.calibrate(robot, POSES * [1, 1, 0, 1, 1, 1], robot.fk(POSES))",
        "move every joint, or fit less",
    ),
    ("irbkin.calibrate(robot, POSES[::-1], robot.fk(POSES))", "do what it asks"),
    ("irbkin.calibrate(robot, POSES, robot.fk(POSES), fit=())", "one or more of the three"),
    ("irbkin.calibrate(robot, POSES, robot.fk(POSES), loss='lp')", "one of those"),
    ("irbkin.calibrate(robot, POSES, robot.fk(POSES), position_std=0)", "give meters above zero"),
    ("irbkin.calibrate(robot, POSES, robot.fk(POSES), folds=1)", "give 0, or 2 and more"),
    ("ros.kinematics_of({})", "set the parameter of the node"),
    ("ros.kinematics_of({'robot': 'UR5', 'start': 'zero'})", "give numbers"),
    ("ros.kinematics_of({'robot_description': robot.to_urdf()})", "name them"),
    ("ros.Kinematics(robot, joint_names=['a'])", "as many names as joints"),
]


def row(call, remedy):
    try:
        eval(call, dict(NAMES))
    except Exception as error:
        message = str(error.args[0]).replace("|", "\\|").replace("\n", " ")
        return f"| `{call}` | {type(error).__name__} | `{message}` | {remedy} |\n"
    raise AssertionError(f"{call} is not refused")


def test_the_page_has_the_messages_of_arguments_as_they_are_raised():
    page = PAGE.read_text(encoding="utf-8")
    before, rest = page.split(START)
    after = rest.split(END, 1)[1]
    table = "| call | error | message | what to do |\n|---|---|---|---|\n"
    table += "".join(row(call, remedy) for call, remedy in CALLS)
    made = f"{before}{START}\n{table}\n{END}{after}"
    if os.environ.get("IRBKIN_WRITE") == "1":
        PAGE.write_text(made, encoding="utf-8")
    assert made == PAGE.read_text(encoding="utf-8"), "docs/errors.md: make errors writes it"
