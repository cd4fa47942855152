"""Draw the eight slots of a UR3: the solutions of one pose.

Run without arguments. It needs `irbkin[plot]`.
"""

import irbkin
import matplotlib as mpl
from drawing import STYLE, save
from irbkin import plot

WORDS = ("left", "right"), ("q3 > 0", "q3 < 0"), ("q5 > 0", "q5 < 0")


def main() -> None:
    """Draw the picture."""
    robot = irbkin.Robot("UR3")
    with mpl.rc_context(STYLE):
        figure = plot.solutions(robot, robot.fk([0.4, -1.9, 1.5, -0.6, 1.1, 0.3]))
        for slot, axes in enumerate(figure.axes):
            bits = [word[bool(slot & bit)] for word, bit in zip(WORDS, (4, 2, 1), strict=True)]
            axes.set_title(f"{slot}: " + ", ".join(bits), fontsize=8)
        save(figure, "slots_three_parallel")


if __name__ == "__main__":
    main()
