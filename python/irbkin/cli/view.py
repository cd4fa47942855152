"""`irbkin view`: an arm, a program or a scene as a page in the browser."""

from __future__ import annotations

import argparse
import os
import tempfile
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, read_robot
from irbkin.cli.errors import FINE, CommandError
from irbkin.cli.scenes import INPUTS, add_scene, is_scene, read_scene

if TYPE_CHECKING:
    from irbkin.scene import Scene

HELP = f"""The page is one file that needs no network: drag the tool, jog the joints, see every
solution, play the program.
{INPUTS} Without -o the page is written to a temporary file and opened. --live serves
a window of viser in its place, until Ctrl-C: pip install 'irbkin[viewer]'."""
EXAMPLES = """  irbkin view "IRB 2600-12/1.65"
  irbkin view "IRB 2600-12/1.65" program.mod --cell cell.toml
  irbkin view arm.urdf --joints 0 20 10 0 40 0 -o arm.html
  irbkin view scene.json"""
ENDINGS = (".html", ".htm", ".json")


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add_scene(parser)
    add = parser.add
    add("-o", "--output", metavar="FILE", help="write the page (.html), or the scene (.json)")
    add("--live", action="store_true", help="serve a window, until Ctrl-C")
    add("--port", type=int, default=8080, metavar="PORT", help="of --live: 8080")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    output: str | None = arguments.output
    if output is not None and not output.lower().endswith(ENDINGS):
        raise CommandError(f"--output: {output} must end in .html or .json")
    scene = read_scene(arguments)
    if arguments.live:
        return _serve(scene, arguments)
    try:
        if output is not None:
            scene.save(output)
            return FINE
        folder = tempfile.mkdtemp(prefix="irbkin-")
        path = os.path.join(folder, "irbkin.html")
        scene.save(path)
    except FileNotFoundError as error:
        raise CommandError(str(error)) from None
    import webbrowser

    print(path)
    webbrowser.open(f"file://{path}")
    return FINE


def _serve(scene: Scene, arguments: argparse.Namespace) -> int:
    """Serve a window until the command is interrupted."""
    import time

    from irbkin.viewer import Viewer

    robot = None if is_scene(arguments) else read_robot(arguments)
    print(Viewer(scene, robot, port=arguments.port).url, flush=True)
    while True:
        time.sleep(1.0)
