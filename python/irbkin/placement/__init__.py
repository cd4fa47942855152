"""Where a robot should stand: the base from which it reaches targets with the largest margin.

>>> import irbkin
>>> from irbkin.placement import Region, best_base
>>> robot = irbkin.Robot("IRB 2600-12/1.65")
>>> down = irbkin.pose([1.2, 0.3, 0.5], euler_zyx=[0, 3.1, 0])
>>> found = best_base(robot, [down], Region(x=(-0.5, 0.5), y=(-0.5, 0.5)), steps=5)
>>> found.reachable
1.0
>>> len(robot.with_base(found.base).ik(down).within_limits()) > 0
True
"""

from irbkin._grids import BaseGrid, Placement, Region
from irbkin.placement._search import best_base

__all__ = ["BaseGrid", "Placement", "Region", "best_base"]
