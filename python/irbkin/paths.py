"""Paths of the tool: lines, arcs, polylines with rounded corners and splines, as poses.

>>> import irbkin
>>> from irbkin import paths
>>> start, end = irbkin.pose([0.8, -0.2, 0.6]), irbkin.pose([0.8, 0.2, 0.6])
>>> paths.line(start, end, steps=5)[:, 1, 3].round(3)
array([-0.2, -0.1,  0. ,  0.1,  0.2])
"""

from irbkin._core import arc, line, polyline
from irbkin._core import path_spline as spline

__all__ = ["arc", "line", "polyline", "spline"]
