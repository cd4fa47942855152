"""Serve the page to a browser of this machine, until Ctrl-C: drag the tool, jog the joints, see
every solution, play the program. ROBOT may be a scene (.json) of irbkin.scene, too. FILE is a RAPID
module: its main routine, or the only one that moves, is played with its lines and findings. With -o
a file is written in its place: a page (.html), which draws and plays (and solves, where irbkin was
built with the engine of such files), a picture (.svg), or the scene (.json).

Examples:
  irbkin view "IRB 2600-12/1.65"
  irbkin view "IRB 2600-12/1.65" program.mod --cell cell.toml
  irbkin view scene.json -o scene.html
"""

import argparse
import os
import time
import webbrowser
from dataclasses import replace

from irbkin import Cell, scene
from irbkin.cli.arguments import Parser, joints, read_robot
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.rapid import motion_of, parsed
from irbkin.scene import Scene


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    add = parser.add
    add("file", metavar="FILE", nargs="?", help="a RAPID module (.mod, .sys, .prg)")
    add("--routine", metavar="NAME", help="the routine: main, or the only one that moves")
    parser.add_joints("joints", "joint angles [deg]")
    parser.add_cell()
    words = "write the page (.html), a picture (.svg), or the scene (.json)"
    add("-o", "--output", metavar="FILE", help=words)
    add("--port", type=int, default=0, metavar="PORT", help="of 127.0.0.1: a free one")
    add("--no-browser", action="store_true", help="print the address, and open no browser")


def run(arguments: argparse.Namespace) -> int:
    output: str | None = arguments.output
    own = _scene(arguments)
    if output is None:
        return _serve(own, arguments.port, arguments.no_browser)
    try:
        own.save(output)
    except ValueError as error:
        raise CommandError(f"--output: {error}") from None
    return FINE


def _scene(arguments: argparse.Namespace) -> Scene:
    if arguments.robot.lower().endswith(".json"):
        try:
            return scene.Scene.load(arguments.robot)
        except ValueError as error:
            raise CommandError(f"{arguments.robot}: {error}") from None
    robot = read_robot(arguments)
    if arguments.file:
        module = parsed(arguments.file)
        made = motion_of(robot, arguments, module)
        own = scene.of(made, robot, title=os.path.basename(arguments.file))
        (arm,) = own.arms
        assert arm.motion is not None
        motion = replace(arm.motion, source=module.source)
        own = replace(own, arms=(replace(arm, motion=motion),))
    else:
        own = scene.of(robot, q=joints(arguments.joints, "--joints", robot.dof))
    return own if arguments.cell is None else own + scene.of(Cell.load(arguments.cell))


def _serve(own: Scene, port: int, is_quiet: bool) -> int:
    try:
        view = scene.serve(own, port=port)
    except (OSError, OverflowError) as error:
        raise CommandError(f"--port: {getattr(error, 'strerror', None) or error}") from None
    with view:
        is_open = not is_quiet and webbrowser.open(view.url)
        print(view.url if is_open or is_quiet else f"{view.url}\nopen it in a browser", flush=True)
        while True:
            time.sleep(1.0)
