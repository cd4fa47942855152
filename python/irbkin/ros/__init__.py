"""Answers of a ROS node, without ROS: the nodes of ROS 1 and ROS 2 in `ros/` share it.

`Kinematics` reads requests and fills responses of the services of `irbkin_interfaces`: objects with
these attributes, of ROS 1, of ROS 2, or plain structures as in tests.

>>> from types import SimpleNamespace as Structure
>>> import irbkin, irbkin.ros
>>> node = irbkin.ros.Kinematics(irbkin.Robot("IRB 1600-6/1.45"))
>>> beyond = Structure(
...     position=Structure(x=3.0, y=0.0, z=0.5), orientation=Structure(x=0.0, y=0.0, z=0.0, w=1.0)
... )
>>> node.check_pose(Structure(pose=beyond), Structure()).reason
'wrist center 1550.5 mm beyond reach'
"""

from irbkin.ros.answers import Kinematics
from irbkin.ros.messages import IkSolutions, read_pose, read_solutions, write_pose
from irbkin.ros.parameters import PARAMETERS, Parameter, kinematics_of, service_prefix

__all__ = [
    "PARAMETERS",
    "IkSolutions",
    "Kinematics",
    "Parameter",
    "kinematics_of",
    "read_pose",
    "read_solutions",
    "service_prefix",
    "write_pose",
]
