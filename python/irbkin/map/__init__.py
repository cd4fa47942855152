"""Maps of reach and dexterity; docs/guide/recipes.md has one of many processes.

>>> import irbkin, irbkin.map
>>> robot = irbkin.Robot("IRB 2600-12/1.65")
>>> spread = irbkin.map.orientations(20)
>>> found = irbkin.map.reach(robot, [0.6, 0.9], 0.0, [0.5, 1.0], spread)
>>> found.share.shape
(2, 1, 2)
"""

from irbkin._grids import ReachMap
from irbkin.map._reach import orientations, reach
from irbkin.map._store import load

__all__ = ["ReachMap", "load", "orientations", "reach"]
