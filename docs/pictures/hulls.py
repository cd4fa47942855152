"""Draw six arms as the hulls of their links, and as the capsules that are compared first.

Run without arguments. It needs `irbkin[plot]`. A PNG: with all edges it would be 300 kB as an SVG.
"""

import irbkin
import matplotlib as mpl
import numpy as np
from drawing import HERE, STYLE
from irbkin import plot
from irbkin.plot._picture import Picture
from PIL import Image

DRAWN = {
    "IRB 2600-12/1.65": (20, 10, 10, 20, 50, 0),
    "IRB 6700-200/2.6": (20, 0, 10, 0, 45, 0),
    "UR5e": (20, -80, 90, -100, -90, 0),
    "CRX-10iA": (20, 10, 20, 0, -60, 0),
    "CRB 15000-5/0.95": (20, 10, 10, 0, 70, 0),
    "Panda": (20, 30, 0, -90, 0, 130, 45),
}
"""Joint angles [deg]."""
GRAY = "#808b9a"
"""Words that are read on light and on dark pages."""


def main() -> None:
    """Draw the picture."""
    with mpl.rc_context(STYLE):
        figure = Picture(figsize=(9.6, 3.9), layout="constrained")
        rows = figure.subfigures(2, len(DRAWN))
        for above, below, (name, q) in zip(*rows, DRAWN.items(), strict=True):
            robot = irbkin.Robot(name)
            for part, capsules in ((above, False), (below, True)):
                plot.arm(robot, np.radians(q), frames=False, capsules=capsules, figure=part)
            above.axes[0].set_title(name, color=GRAY, fontsize=10)
            below.axes[0].set_title("")
        target = HERE / "hulls.png"
        figure.savefig(target, dpi=140, transparent=True, metadata={"Software": None})
    Image.open(target).quantize(192).save(target, optimize=True)
    print(f"{target}: {target.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
