"""Names of other packages: each raises an AttributeError that has irbkin's name for it."""

from typing import NoReturn

from irbkin._core import Robot

OF_ROBOT = {
    "ik": "ikine inverse ComputeIk SolveIK_All",
    "ik_nearest": "ikine_LM inverse_kinematics SolveIK",
    "fk": "fkine forward forward_kinematics ComputeFk SolveFK",
    "jacobian": "jacob0",
    "singularity": "manipulability",
    "configuration": "JointsConfig",
    "limits": "joint_limits qlim JointLimits",
    "dof": "n",
    "random": "random_q",
    "with_tool": "set_tool setPoseTool",
    "with_base": "set_base setPoseFrame",
    "with_limits": "set_limits",
    "irbkin.paths.line and follow": "MoveL",
    "irbkin.Cell.collides": "iscollided Collisions",
    "irbkin.scene.of(robot).view": "plot teach",
    "irbkin.rapid.check": "Update",
    "irbkin.rapid.calc_rob_t": "CalcRobT",
    "irbkin.rapid.calc_joint_t": "CalcJointT",
}
OF_PACKAGE = {
    "Robot": "models Item",
    "Robot.from_urdf": "from_urdf load_urdf Chain",
    "Robot.from_sdh": "DHRobot",
    "catalog": "list_robots robots",
    "paths.line": "ctraj",
    "trajectory.joint": "jtraj",
    "rapid.ToolData": "tooldata",
    "rapid.WobjData": "wobjdata",
}


def by_other(names: dict[str, str]) -> dict[str, str]:
    """Return irbkin's names, each by the names of other packages."""
    return {other: own for own, others in names.items() for other in others.split()}


def _raising(other: str, own: str) -> property:
    def missing(robot: Robot) -> NoReturn:
        raise AttributeError(f"Robot has no attribute '{other}': use {own}")

    return property(missing, doc=f"Another package's name: use `{own}`.")


def add_to_robot() -> None:
    """Let Robot raise for the names of other packages, which its `dir` does not have.

    They are properties: with a `__getattr__`, each call of a robot would take 0.1 us more.
    """
    others = by_other(OF_ROBOT)
    for other, own in others.items():
        setattr(Robot, other, _raising(other, own))

    def names(robot: Robot) -> list[str]:
        return [name for name in object.__dir__(robot) if name not in others]

    Robot.__dir__ = names  # type: ignore[method-assign, assignment]
