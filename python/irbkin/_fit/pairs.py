"""The pairs of links that are kept apart, by random postures inside the limits."""

import numpy as np

from irbkin._core import Body, Cell, Robot
from irbkin._fit.solid import Array, Solid, spread_over

# Random postures, and those at which meshes are compared.
POSTURES, COMPARED = 2000, 300
# Part of the postures with touching capsules above which meshes are compared [1].
OFTEN = 0.02
# Points of the surface of a mesh.
POINTS = 600


def pairs_of(
    robot: Robot, body: Body, solids: dict[int, Solid], moving: set[int]
) -> list[tuple[int, int]]:
    """The pairs of links that are not neighbors and whose capsules do not always touch.

    Where they touch in more than 2 % of the postures, their meshes are compared: left out are those
    that touch in none. Links with parts that move are not compared: their meshes are where the
    joints of these are.
    """
    dof = robot.dof
    lower, upper = np.clip(robot.limits, -np.pi, np.pi).T
    q = np.random.default_rng(1).uniform(lower, upper, (POSTURES, dof))
    frames = frames_of(robot, q)
    links = np.unique(body.links).tolist()
    found = []
    for one in links:
        # What the flange carries has the neighbors of the last link.
        for other in (link for link in links if min(link, dof) > one + 1):
            chosen = np.isin(body.links, [one, other])
            hulls = [hull for hull in body.hulls if hull[0] in (one, other)]
            alone = Body(body.links[chosen], body.capsules[chosen], [(one, other)], hulls=hulls)
            touches = Cell().collides(robot.with_body(alone), q)
            if touches.all():
                continue
            if touches.mean() > OFTEN and moving.isdisjoint((one, other)):
                places = np.flatnonzero(touches)[:COMPARED]
                both = [(frames[link][places], solids[link]) for link in (one, other)]
                if not (meet(*both) or meet(*both[::-1])):
                    continue
            found.append((one, other))
    return found


def frames_of(robot: Robot, q: Array) -> list[Array]:
    """The frame of each link of a body at each posture, the flange the last."""
    robot = robot.with_base(np.eye(4)).with_tool(np.eye(4))
    moving = robot.link_frames(q)
    base = np.broadcast_to(np.eye(4), (len(q), 4, 4))
    return [base, *(moving[:, joint] for joint in range(robot.dof)), robot.fk(q)]


def meet(one: tuple[Array, Solid], other: tuple[Array, Solid]) -> bool:
    """Whether a point of the surface of a mesh comes to another, within what the grid is off."""
    (frames, solid), (others, around) = one, other
    points = spread_over(solid.triangles, POINTS)
    spacing = np.sqrt(2 * area(solid.triangles) / POINTS)
    moved = np.linalg.inv(others) @ frames
    seen = points @ moved[:, :3, :3].transpose(0, 2, 1) + moved[:, None, :3, 3]
    nearest = around.signed(seen.reshape(-1, 3)).min()
    return bool(nearest <= 0.5 * (spacing + around.cell))


def area(triangles: Array) -> float:
    a, b, c = triangles.transpose(1, 0, 2)
    return float(0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())
