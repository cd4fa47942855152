"""Draw the pictures of the eight slots: the solutions of one pose of an IRB 2600 and of a UR3.

Run without arguments: it writes the SVG files next to itself and prints their names. It needs
`irbkin[plot]`. The same irbkin and matplotlib give the same files.
"""

from pathlib import Path

import irbkin
import matplotlib as mpl
from irbkin import plot
from singularities import STYLE

HERE = Path(__file__).parent


def picture(
    name: str,
    robot: irbkin.Robot,
    q: list[float],
    words: tuple[tuple[str, str], ...],
    title: str = "{}: ",
) -> None:
    """Write the eight slots of the pose of `q` to `name`.

    `title` takes the number of a slot; the words for its bits follow.
    """
    figure = plot.solutions(robot, robot.fk(q))
    for slot, axes in enumerate(figure.axes):
        bits = [word[bool(slot & bit)] for word, bit in zip(words, (4, 2, 1), strict=True)]
        axes.set_title(title.format(slot) + ", ".join(bits), fontsize=8)
    figure.savefig(HERE / name, metadata={"Date": None, "Creator": None})
    print(HERE / name)


def main() -> None:
    """Draw both pictures."""
    with mpl.rc_context(STYLE):
        picture(
            "slots_abb.svg",
            irbkin.Robot("IRB 2600-12/1.65"),
            [0.5, -0.1, 0.35, 0.9, 1.0, 0.2],
            (("front of 1", "behind 1"), ("front of arm", "behind arm"), ("q5 > 0", "q5 < 0")),
            "cfx {}\n",
        )
        picture(
            "slots_three_parallel.svg",
            irbkin.Robot("UR3"),
            [0.4, -1.9, 1.5, -0.6, 1.1, 0.3],
            (("left", "right"), ("q3 > 0", "q3 < 0"), ("q5 > 0", "q5 < 0")),
        )


if __name__ == "__main__":
    main()
