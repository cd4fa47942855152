"""What tests of pictures draw, and what they read out of figures."""

import irbkin
from irbkin import paths

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
SEAM = paths.line(*(irbkin.pose([0.9, y, 0.7], euler_zyx=[0, 2.8, 0]) for y in (-1, 1)), steps=21)
PLAN = ROBOT.plan(SEAM, rotation=12)


def curves(axes):
    """The curves of axes: lines of more than two points, limits are lines of two."""
    return [line for line in axes.lines if len(line.get_xdata()) > 2]


def shaded(axes):
    """From where to where axes are shaded, from the bottom up."""
    from matplotlib.patches import Rectangle

    patches = [patch for patch in axes.patches if isinstance(patch, Rectangle)]
    return sorted((patch.get_y(), patch.get_y() + patch.get_height()) for patch in patches)
