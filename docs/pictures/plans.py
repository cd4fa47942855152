"""Draw the plan of the weld of example 10.

Run without arguments. It needs `irbkin[plot]`.
"""

import importlib.util
from typing import Any

import irbkin
import matplotlib as mpl
from drawing import HERE, STYLE, save
from irbkin import plot

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
TORCH = ROBOT.with_tool(irbkin.pose([0.05, 0, 0.35]))


def example() -> Any:
    """The module of example 10."""
    path = HERE.parents[1] / "examples" / "10_plan_a_weld.py"
    spec = importlib.util.spec_from_file_location("plan_a_weld", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def main() -> None:
    """Draw the picture."""
    with mpl.rc_context(STYLE):
        save(plot.plan(TORCH, TORCH.plan(example().seam(), rotation=36)), "plan_weld")


if __name__ == "__main__":
    main()
