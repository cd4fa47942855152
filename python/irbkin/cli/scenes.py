"""Scenes of arguments: an arm at joint angles, a RAPID module that plays, a file of a scene."""

from __future__ import annotations

import argparse
import os
from dataclasses import replace
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, joints, read_cell, read_robot
from irbkin.cli.errors import CommandError
from irbkin.cli.numbers import number

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.scene import Scene

INPUTS = """ROBOT is a name of the catalog, a .urdf, or a scene (.json) that irbkin.scene wrote.
FILE is a RAPID module: its main routine, or the only one that moves, is played with its lines and
findings."""


def add_scene(parser: Parser) -> None:
    """The arguments that `read_scene` reads."""
    parser.add_robot()
    add = parser.add
    add("file", metavar="FILE", nargs="?", help="a RAPID module (.mod, .sys, .prg)")
    add("--routine", metavar="NAME", help="the routine: main, or the only one that moves")
    add("--joints", nargs="+", type=number, metavar="Q", help="joint angles [deg]")
    parser.add_cell()


def is_scene(arguments: argparse.Namespace) -> bool:
    """Whether the first argument is a file of a scene."""
    return bool(arguments.robot.lower().endswith(".json"))


def read_scene(arguments: argparse.Namespace) -> Scene:
    """Return the scene of the robot, the module or the file that the arguments name."""
    from irbkin import scene

    if is_scene(arguments):
        try:
            return scene.Scene.load(arguments.robot)
        except ValueError as error:
            raise CommandError(f"{arguments.robot}: {error}") from None
    robot = read_robot(arguments)
    own = _of_module(robot, arguments) if arguments.file else _of_arm(robot, arguments)
    cell = read_cell(arguments)
    return own if cell is None else own + scene.of(cell)


def _of_arm(robot: Robot, arguments: argparse.Namespace) -> Scene:
    from irbkin import scene

    return scene.of(robot, q=joints(arguments.joints, "--joints", robot.dof))


def _of_module(robot: Robot, arguments: argparse.Namespace) -> Scene:
    from irbkin import rapid, scene
    from irbkin.cli.files import shown
    from irbkin.errors import RapidError

    try:
        module = rapid.load(arguments.file)
        made = rapid.motion(robot, module, arguments.routine)
    except RapidError as error:
        raise CommandError(f"{shown(arguments.file)}: {error}") from None
    own = scene.of(made, robot, title=os.path.basename(arguments.file))
    (arm,) = own.arms
    assert arm.motion is not None
    return replace(own, arms=(replace(arm, motion=replace(arm.motion, source=module.source)),))
