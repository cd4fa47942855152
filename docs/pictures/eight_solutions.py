"""Make the picture of the README: the eight solutions of one pose of an IRB 2600, as skeletons.

Run without arguments. It needs `irbkin[plot]`.
"""

import irbkin
import matplotlib as mpl
from drawing import HERE, STYLE, save
from irbkin import plot

FACING = ("facing the target", "reaching over backward")
ELBOW = ("elbow up", "elbow down")


def main() -> None:
    """Write the picture."""
    robot = irbkin.Robot("IRB 2600-12/1.65")
    T = irbkin.pose([0.85, 0.32, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
    with mpl.rc_context(STYLE):
        figure = plot.solutions(robot, T)
        for slot, axes in enumerate(figure.axes):
            elbow = ELBOW[bool(slot & 2) != bool(slot & 4)]
            words = f"slot {slot}: {elbow}, J5 {'<' if slot & 1 else '>'} 0\n{FACING[slot >> 2]}"
            axes.set_title(words, fontsize=9)
        save(figure, "eight_solutions", HERE)


if __name__ == "__main__":
    main()
