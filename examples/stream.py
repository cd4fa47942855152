"""Set points for ABB's EGM, all on this machine: a guard, a server, and a model of a controller
whose link loses datagrams and is cut off for a while. This is no safety function.
"""

import math
import subprocess
import sys

import irbkin
import numpy as np
import numpy.typing as npt
from irbkin.body import Shape
from irbkin.stream import Guard, egm

Floats = npt.NDArray[np.float64]
ARM = "IRB 2600-12/1.65"
START: Floats = np.radians([0, 20, 0, 0, 40, 0])
SIDEWAYS: Floats = np.radians([30, 0, 0, 0, 0, 0])


def main() -> None:
    robot = irbkin.Robot(ARM)
    post = Shape.cylinder(0.05, 1.0, irbkin.pose([0.75, 0.8, 0.5]))
    guard = Guard(
        robot,
        cycle=egm.CYCLE,
        start=START,
        max_acceleration=10,
        max_jerk=100,
        cell=irbkin.Cell({"post": post}),
        on_violation="limit",
    )
    state = ""

    def swing(feedback: egm.Feedback) -> Floats:
        nonlocal state
        step = feedback.step
        if step.state != state:
            state = step.state
            why = "" if state == "following" else f": {step.reason}"
            print(f"{feedback.t:6.2f} s  guard {state}{why}")
        # In the sixth second the reference leads into the post.
        wide = 2.0 if feedback.t > 6.0 else 1.0
        return START + wide * SIDEWAYS * (1 - math.cos(2 * feedback.t)) / 2

    with egm.Server(guard, port=0) as server:
        where = ["--port", str(server.address[1]), "--joints", *map(str, np.degrees(START))]
        link = ["--loss", "0.1", "--late", "0.05", "--cut", "3", "3.15", "--seed", "1"]
        command = [sys.executable, "-m", "irbkin", "egm-sim", ARM, "--seconds", "12"]
        with subprocess.Popen([*command, *where, *link]) as controller:
            counted = server.run(swing, seconds=10)
            controller.wait(timeout=30)
    for name, value in counted._asdict().items():
        print(f"{name:>9} {value}")


if __name__ == "__main__":
    main()
