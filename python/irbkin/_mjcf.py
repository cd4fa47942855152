"""Arms of MuJoCo's MJCF, of which only the kinematics is read: `pip install 'irbkin[mjcf]'`."""

import os
import re
from typing import Any

from irbkin import _bounded
from irbkin._arguments import check_extra
from irbkin._core import Robot
from irbkin.errors import InvalidModelError

UNREAD = ("tuples", "sensors", "skins", "meshes", "hfields", "textures", "materials")
"""What places no body and may need files that are not there; what refers to others comes first."""


def robot_of(
    path: str | os.PathLike[str],
    base: str | None = None,
    tip: str | None = None,
    name: str = "",
    snap: float = 0.0,
) -> Robot:
    """Read the arm from a body to a body or site of a file, or of a text that begins with "<".

    `fk` is MuJoCo's, in the frame of `base`: when not given, the body below the world that carries
    the arm. `tip` is chosen, and `snap` acts, as by `Robot.from_urdf`. The file may include others;
    meshes and textures are not read.

    Raises:
        InvalidModelError: MuJoCo refuses it, no arm or several could be meant, or a joint slides
            behind another one, is a ball or is coupled to another one.
        OSError: The file cannot be read.
    """
    check_extra("Robot.from_mjcf", "mjcf", "mujoco")
    with _bounded.source(path) as (text, file):
        if re.match(r"[^<]*(<[?!][^<]*)*<robot\b", text):
            raise InvalidModelError("is a URDF: Robot.from_urdf reads it")
        answer = _bounded.call("mujoco", "irbkin._mjcf.tree", text, file, base, tip)
        root, urdf, couplings = answer
        robot = Robot.from_urdf(urdf, base or root, tip, name, snap=snap)
        for what, joints in couplings:
            if not set(joints).isdisjoint(robot.joint_names):
                acts = f"{what} acts on {' and '.join(joints)}"
                raise InvalidModelError(f"{acts}: joints of an arm must move by themselves")
        return robot


def tree(text: str, file: str | None, base: str | None, tip: str | None) -> Any:
    """The default base, a URDF of bodies and sites, and what couples which joints."""
    import mujoco

    from irbkin._mjcf_tree import Tree

    # A warning would be written to a file in the working folder.
    mujoco.set_mju_user_warning(lambda words: None)
    spec = mujoco.MjSpec.from_file(file) if file else mujoco.MjSpec.from_string(text)
    for kind in UNREAD:
        for element in list(getattr(spec, kind)):
            spec.delete(element)
    for shape in [*spec.geoms, *spec.sites]:
        shape.material = ""
    for geom in spec.geoms:
        if geom.meshname or geom.hfieldname:
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, [1.0, 1.0, 1.0]
            geom.meshname = geom.hfieldname = ""
    # Links without shapes have no mass.
    spec.compiler.boundmass = spec.compiler.boundinertia = 1.0
    spec.compiler.balanceinertia, spec.compiler.fusestatic = True, False
    own = Tree(spec.compile())
    root = own.root(base, tip)
    return own.bodies[root], own.urdf(root, spec.modelname), own.couplings()
