"""Curves of motions, with matplotlib: `pip install 'irbkin[plot]'`. Arms are drawn by
`irbkin.scene`.

Each function returns a `matplotlib.figure.Figure` that a notebook shows as its last line, and
`.show()` in a window; none touches pyplot before. Angles are in degrees, as engineers read them,
lengths in meters. `figure=` takes a figure to draw into, of `pyplot.figure()` for instance, or a
subfigure.

>>> import irbkin.plot
>>> move = irbkin.trajectory.joint([0, 0], [1, -2], duration=2.0)
>>> figure = irbkin.plot.trajectory(move, max_velocity=2.5)
>>> figure.axes[1].get_title()
'velocity'
"""

try:
    import matplotlib as _matplotlib  # noqa: F401
except ImportError as _missing:
    raise ImportError(
        "irbkin.plot needs matplotlib: pip install 'irbkin[plot]'", name="matplotlib"
    ) from _missing

from irbkin.plot._joint_motion import trajectory
from irbkin.plot._plan import plan
from irbkin.plot._singularity import singularity
from irbkin.plot._tool_path import path

__all__ = ["path", "plan", "singularity", "trajectory"]
