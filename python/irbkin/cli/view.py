"""The page is one file that needs no network: drag the tool, jog the joints, see every solution,
play the program. ROBOT may be a scene (.json) of irbkin.scene, too. FILE is a RAPID module: its
main routine, or the only one that moves, is played with its lines and findings. Without -o the page
is written to a temporary file and opened; where irbkin was built without its engine (make page), a
picture. --live serves a window of viser in its place: pip install 'irbkin[viewer]'.

Examples:
  irbkin view "IRB 2600-12/1.65"
  irbkin view "IRB 2600-12/1.65" program.mod --cell cell.toml
  irbkin view scene.json
"""

import argparse
import os
import tempfile
import time
import webbrowser
from dataclasses import replace

from irbkin import Robot, scene
from irbkin.cli.arguments import Parser, joints, read_cell, read_robot
from irbkin.cli.errors import FINE, CommandError, complain
from irbkin.cli.rapid import motion_of, parsed
from irbkin.scene import Scene

ENDINGS = (".html", ".htm", ".json", ".svg")


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    add = parser.add
    add("file", metavar="FILE", nargs="?", help="a RAPID module (.mod, .sys, .prg)")
    add("--routine", metavar="NAME", help="the routine: main, or the only one that moves")
    parser.add_joints("joints", "joint angles [deg]")
    parser.add_cell()
    words = "write the page (.html), a picture (.svg), or the scene (.json)"
    add("-o", "--output", metavar="FILE", help=words)
    add("--live", action="store_true", help="serve a window, until Ctrl-C")
    add("--port", type=int, default=8080, metavar="PORT", help="of --live: 8080")


def run(arguments: argparse.Namespace) -> int:
    output: str | None = arguments.output
    if output is not None and not output.lower().endswith(ENDINGS):
        raise CommandError(f"--output: {output} must end in .html or .json, or in .svg")
    own, robot = _scene(arguments)
    if arguments.live:
        return _serve(own, robot, arguments.port)
    try:
        path = output or os.path.join(tempfile.mkdtemp(prefix="irbkin-"), "irbkin.html")
        try:
            own.save(path)
        except FileNotFoundError as error:
            if output is not None or error.filename:
                raise
            path = path.replace(".html", ".svg")
            own.save(path)
            complain(f"{error}: this is the picture")
    except (FileNotFoundError, ValueError) as error:
        raise CommandError(str(error)) from None
    if output is not None:
        return FINE
    print(path)
    webbrowser.open(f"file://{path}")
    return FINE


def _scene(arguments: argparse.Namespace) -> tuple[Scene, Robot | None]:
    """Return the scene that the arguments name, and its robot; none if it is a file."""
    if arguments.robot.lower().endswith(".json"):
        try:
            return scene.Scene.load(arguments.robot), None
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
    cell = read_cell(arguments)
    return own if cell is None else own + scene.of(cell), robot


def _serve(own: Scene, robot: Robot | None, port: int) -> int:
    """Serve a window until the command is interrupted."""
    from irbkin.viewer import Viewer

    print(Viewer(own, robot, port=port).url, flush=True)
    while True:
        time.sleep(1.0)
