"""Draw the pictures of plans, placements and maps in docs/guide: the weld of example 10, the bases
that were tried for a table of parts, and slices of a map.

Run without arguments. It needs `irbkin[plot]`.
"""

import importlib.util
from typing import Any

import irbkin
import irbkin.map
import matplotlib as mpl
import numpy as np
from drawing import HERE, STYLE, save
from irbkin import placement, plot
from numpy.typing import NDArray

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
TORCH = ROBOT.with_tool(irbkin.pose([0.05, 0, 0.35]))


def weld() -> None:
    """The plan of example 10, the torch free to turn."""
    path = HERE.parents[1] / "examples" / "10_plan_a_weld.py"
    spec = importlib.util.spec_from_file_location("plan_a_weld", path)
    assert spec is not None
    assert spec.loader is not None
    example: Any = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    save(plot.plan(TORCH, TORCH.plan(example.seam(), rotation=36)), "plan_weld")


def parts() -> NDArray[np.float64]:
    """Places of a table, the tool straight down."""
    down = np.diag([1.0, -1.0, -1.0])
    places = [(x, y, 0.4) for x in (1.0, 1.2, 1.4, 1.6) for y in (-0.5, 0.0, 0.5)]
    return np.array([irbkin.pose(place, rotation=down) for place in places])


def base() -> None:
    """Where the arm should stand at the table."""
    region = placement.Region(x=(-0.6, 1.0), y=(-1.0, 1.0), z=(0.0, 0.5))
    found = placement.best_base(TORCH, parts(), region, steps=(33, 41, 3, 1))
    save(plot.placement(found, parts()), "placement_base")


def reach() -> None:
    """Slices of a map through axis 1."""
    axis, height = np.linspace(-1.9, 1.9, 76), np.linspace(-0.8, 2.2, 60)
    found = irbkin.map.reach(ROBOT, axis, 0.0, height, irbkin.map.orientations(100, 4), threads=0)
    save(plot.reach_map(found), "map_share")
    save(plot.reach_map(found, "solutions"), "map_solutions")


def main() -> None:
    """Draw all pictures."""
    with mpl.rc_context(STYLE):
        for picture in (weld, base, reach):
            picture()


if __name__ == "__main__":
    main()
