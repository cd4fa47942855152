"""A model of MuJoCo as a URDF of its bodies, sites and joints; runs in the process of the reader.

A hinge turns by q - ref about a point of its body, a slide moves it by q - ref along its axis, the
joints of a body one after the other
(MuJoCo, engine_core_smooth.c, mj_kinematics).
"""

from typing import Any
from xml.sax.saxutils import quoteattr

import mujoco
import numpy as np

KINDS = ("floating", "ball", "prismatic", "revolute")
"""Of joints, in MuJoCo's order, as URDF names them; it has no balls, and refuses them by name."""
LEAST_JOINTS = 6
"""Hinge joints of an arm, in the choice of the base."""


class Tree:
    """Bodies, joints and sites of a compiled model, with names for those that have none."""

    def __init__(self, model: Any) -> None:
        self.model = model
        self.bodies = [model.body(it).name or f"body {it}" for it in range(model.nbody)]
        self.joints = [model.joint(it).name or f"joint {it}" for it in range(model.njnt)]
        sites = [model.site(it).name for it in range(model.nsite)]
        self.sites = [f"{it} (site)" if it in self.bodies else it for it in sites]
        self.kinds: list[list[str]] = [[] for _ in self.bodies]
        self.coupled = {it for _, joints in self.couplings() for it in joints}
        for body, kind in zip(model.jnt_bodyid, model.jnt_type, strict=True):
            self.kinds[body].append(KINDS[kind])

    def root(self, base: str | None, tip: str | None) -> int:
        """The base; when not given, the body below the world that carries the tip or the only arm,
        and the world if that body moves on a joint or there are several.
        """
        if base in self.bodies:
            return self.bodies.index(base)
        turns = [0] * len(self.bodies)
        for body in range(1, len(self.bodies)):
            above = turns[self.model.body_parentid[body]]
            turns[body] = above + self.kinds[body].count("revolute")
        most = min(LEAST_JOINTS, max(turns))
        ends = [body for body, count in enumerate(turns) if count >= most]
        if tip in self.bodies:
            ends = [self.bodies.index(tip)]
        elif tip in self.sites:
            ends = [self.model.site_bodyid[self.sites.index(tip)]]
        tops = {int(self.model.body_rootid[body]) for body in ends}
        top = tops.pop() if len(tops) == 1 else 0
        return top if set(self.kinds[top]) <= {"floating"} else 0

    def urdf(self, root: int, name: str) -> str:
        """The text of what hangs on a body; what floats is no part of an arm."""
        model = self.model
        links = {root: self.bodies[root]}
        parts = [f'<robot version="1.1" name={quoteattr(name)}>']
        parts.append(f"<link name={quoteattr(links[root])}/>")
        for body in range(root + 1, model.nbody):
            parent = links.get(int(model.body_parentid[body]))
            if parent is not None and "floating" not in self.kinds[body]:
                links[body] = self.bodies[body]
                parts += self._body(parent, body)
        for site, (label, body) in enumerate(zip(self.sites, model.site_bodyid, strict=True)):
            if label and body in links:
                place = model.site_pos[site], model.site_quat[site]
                parts.append(_joint("fixed", f"to {label}", links[int(body)], label, *place))
        return "".join([*parts, "</robot>"])

    def _body(self, parent: str, body: int) -> list[str]:
        """A body behind its joints."""
        model = self.model
        own = self.bodies[body]
        parts = []
        xyz = model.body_pos[body]
        quat = model.body_quat[body]
        # Written by MuJoCo.
        step = np.zeros(3)
        turn = np.zeros(4)
        first = model.body_jntadr[body]
        for joint, kind in enumerate(self.kinds[body], first):
            point = model.jnt_pos[joint]
            axis = model.jnt_axis[joint]
            name = self.joints[joint]
            mujoco.mju_rotVecQuat(step, point, quat)
            xyz = xyz + step
            zero = -model.qpos0[model.jnt_qposadr[joint]]
            if kind == "prismatic":
                kind = "coupled prismatic" if name in self.coupled else kind
                mujoco.mju_rotVecQuat(step, zero * axis, quat)
                xyz = xyz + step
            if kind == "revolute":
                mujoco.mju_axisAngle2Quat(turn, axis, zero)
                turned = np.zeros(4)
                mujoco.mju_mulQuat(turned, quat, turn)
                quat = turned
                kind = kind if model.jnt_limited[joint] else "continuous"
            is_last = joint - first == len(self.kinds[body]) - 1 and not point.any()
            child = own if is_last else f"{own} behind {name}"
            limits = model.jnt_range[joint] if model.jnt_limited[joint] else (-np.inf, np.inf)
            parts.append(_joint(kind, name, parent, child, xyz, quat, axis, limits))
            parent = child
            xyz = -point
            quat = np.array([1.0, 0.0, 0.0, 0.0])
        if parent != own:
            parts.append(_joint("fixed", f"to {own}", parent, own, xyz, quat))
        return parts

    def couplings(self) -> list[tuple[str, list[str]]]:
        """Equalities and tendons, each with the joints that it makes depend on each other."""
        model = self.model
        found = []
        tendons = set(np.flatnonzero(model.tendon_limited))
        for index in np.flatnonzero(model.eq_active0):
            ends = [it for it in (model.eq_obj1id[index], model.eq_obj2id[index]) if it >= 0]
            if model.eq_type[index] == mujoco.mjtEq.mjEQ_JOINT:
                found.append(("an equality", [self.joints[it] for it in ends]))
            elif model.eq_type[index] == mujoco.mjtEq.mjEQ_TENDON:
                tendons.update(ends)
        for index in tendons:
            first = model.tendon_adr[index]
            wraps = range(first, first + model.tendon_num[index])
            if model.wrap_type[first] == mujoco.mjtWrap.mjWRAP_JOINT:
                joints = [self.joints[model.wrap_objid[it]] for it in wraps]
                found.append((f"the tendon {model.tendon(index).name!r}", joints))
        return found


def _joint(kind: str, name: str, parent: str, child: str, *rows: Any) -> str:
    """A link and the joint above it, of position, quaternion, axis and limits."""
    words = [" ".join(repr(float(it)) for it in row) for row in rows]
    words[1] = " ".join([*words[1].split()[1:], words[1].split()[0]])
    turning = f'<axis xyz="{words[2]}"/>' if len(rows) > 2 else ""
    if kind in ("revolute", "prismatic"):
        low, high = words[3].split()
        turning += f'<limit lower="{low}" upper="{high}" effort="0" velocity="0"/>'
    return (
        f'<link name={quoteattr(child)}/><joint name={quoteattr(name)} type="{kind}">'
        f"<parent link={quoteattr(parent)}/><child link={quoteattr(child)}/>"
        f'<origin xyz="{words[0]}" quat_xyzw="{words[1]}"/>{turning}</joint>'
    )
