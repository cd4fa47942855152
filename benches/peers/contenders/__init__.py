"""Who is compared: for each package a function that builds, for an arm, what the package can do
with it.

A function imports its package, so that one that is missing is noticed there, and returns nothing
for an arm that the package does not serve.
"""

from __future__ import annotations

from collections.abc import Callable

from ..arms import Arm
from .contender import Contender
from .dynamics import dynibo, pinocchio
from .motion import roboticstoolbox, ruckig, toppra
from .one_arm import crx_kinematics, frankik, ur_analytic_ik
from .opw import py_opw_kinematics, spherical_wrist
from .own import irbkin
from .subproblems import eaik, ik_geo, py_ikgeo_kinematics, ssik

Builder = Callable[[Arm], list[Contender]]

OWN = "irbkin"
# By the name of the distribution; irbkin is the first of every row.
BUILDERS: dict[str, Builder] = {
    OWN: irbkin,
    "eaik": eaik,
    "py-opw-kinematics": py_opw_kinematics,
    "py-ikgeo-kinematics": py_ikgeo_kinematics,
    "spherical-wrist": spherical_wrist,
    "ik-geo": ik_geo,
    "ssik": ssik,
    "ur-analytic-ik": ur_analytic_ik,
    "frankik": frankik,
    "crx-kinematics": crx_kinematics,
    "pin": pinocchio,
    "dynibo": dynibo,
    "roboticstoolbox-python": roboticstoolbox,
    "toppra": toppra,
    "ruckig": ruckig,
}

__all__ = ["BUILDERS", "OWN", "Builder", "Contender"]
