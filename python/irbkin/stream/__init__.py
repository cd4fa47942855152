"""Set points for a control loop, within bounds and with a proven way to stop.

This is no safety function.

>>> import irbkin
>>> from irbkin.stream import Guard
>>> robot = irbkin.Robot("IRB 2600-12/1.65")
>>> start = [0, 0, 0, 0, 0.5, 0]
>>> guard = Guard(robot, cycle=0.004, start=start, max_acceleration=8, max_jerk=60)
>>> guard.step([1e-6, 0, 0, 0, 0.5, 0]).accepted
True
>>> guard.step([1, 0, 0, 0, 0.5, 0]).reason
'joint 1 would need a velocity of 249.9998 rad/s, its bound is 3.0543 rad/s'
"""

from irbkin._core import Guard, Step

__all__ = ["Guard", "Step"]
