"""Make the picture of the README: the eight solutions of one pose of an IRB 2600.

Run without arguments.
"""

import re
import tempfile
from pathlib import Path

import irbkin
from irbkin.scene import Posture, Scene, arm_of

TARGET = Path(__file__).parent / "eight_solutions.svg"
FACING = ("facing the target", "reaching over backward")
ELBOW = ("elbow up", "elbow down")
SIZE, BELOW, COLUMNS = 200, 44, 4
"""Width and height of a panel, height of the words below it [px], and panels in a row."""
COLORS = "text{fill:#333333}@media (prefers-color-scheme:dark){text{fill:#e6e9ef}}"


def content(scene: Scene) -> str:
    """Return the elements of the picture of a scene."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.svg"
        scene.save(file)
        return re.sub("^<svg[^>]*>|</svg>$", "", file.read_text())


def panel(robot: irbkin.Robot, solutions: irbkin.Solutions, solution: irbkin.Solution) -> str:
    """Return a solution before the others, with words below it, in its place."""
    slot = solution.slot
    elbow = ELBOW[bool(slot & 2) != bool(slot & 4)]
    sign = "&lt;" if slot & 1 else "&gt;"
    limits = "inside limits" if solution.is_within_limits else "outside limits"
    words = [f"slot {slot}: {elbow}, J5 {sign} 0", FACING[slot >> 2], limits]
    lines = "".join(
        f'<text x="{SIZE // 2}" y="{SIZE + 12 * line}">{text}</text>'
        for line, text in enumerate(words, 1)
    )
    left = SIZE * (slot % COLUMNS)
    top = (SIZE + BELOW) * (slot // COLUMNS)
    postures = [Posture(tuple(it.q.tolist()), is_ghost=it.slot != slot) for it in solutions]
    drawn = content(Scene(arms=(arm_of(robot, postures),)))
    return f'<g transform="translate({left} {top})">{drawn}{lines}</g>'


def main() -> None:
    """Write the picture."""
    robot = irbkin.Robot("IRB 2600-12/1.65")
    T = irbkin.pose([0.85, 0.32, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
    solutions = robot.ik(T)
    panels = [panel(robot, solutions, solution) for solution in solutions]
    width = COLUMNS * SIZE
    height = len(panels) // COLUMNS * (SIZE + BELOW)
    TARGET.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
        'font-family="DejaVu Sans, Verdana, sans-serif" font-size="10" text-anchor="middle">\n'
        f"<style>{COLORS}</style>\n" + "\n".join(panels) + "\n</svg>\n"
    )


if __name__ == "__main__":
    main()
