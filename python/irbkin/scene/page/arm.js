// An arm that is drawn: its chain and the meshes of its links. Of the engine's answer to `robot`, or
// of an arm of a scene.

class DrawnArm {
  constructor({ name, base, links, tool, coupling, shapes, hulls }) {
    Object.assign(this, { name, base, links, tool, coupling, shapes });
    // Hulls are drawn in place of the capsules of their links.
    const own = shapes.map((_, link) => hulls.filter((it) => it.link === link));
    const meshes = (detail, withHulls) => shapes.map((capsules, link) => joined(
      withHulls && own[link].length
        ? own[link].map((it) => hullMesh(it, detail))
        : capsules.map((it) => capsuleMesh(it, detail)),
    ));
    this.hasHulls = hulls.length > 0;
    this.meshes = meshes(FINE, true);
    this.coarse = meshes(COARSE, true);
    this.capsules = this.hasHulls ? meshes(FINE, false) : this.meshes;
  }

  static ofEngine(robot) {
    const body = robot.body ?? { links: [], parts: [] };
    return new DrawnArm({
      name: robot.name,
      base: fromRows(robot.base),
      links: robot.links.map(fromRows),
      tool: multiply(fromRows(robot.flange), fromRows(robot.tool)),
      coupling: -robot.coupling,
      shapes: body.links.map((own, link) => [...own, ...(body.parts[link] ?? [])]),
      hulls: body.hulls ?? [],
    });
  }

  static ofScene(arm) {
    const shapes = Array.from({ length: arm.joints.length + 2 }, () => []);
    for (const it of arm.body ?? []) shapes[it.link].push(it);
    return new DrawnArm({
      name: arm.name,
      base: fromRows(arm.base.flat()),
      links: arm.joints.map((it) => fromRows(it.flat())),
      tool: fromRows(arm.tool.flat()),
      coupling: arm.coupling ?? 0,
      shapes,
      hulls: arm.hulls ?? [],
    });
  }

  // The same with another base and another tool.
  moved(base, tool) {
    return Object.assign(Object.create(DrawnArm.prototype), this, { base, tool });
  }

  // The frames of base, links, and what the flange carries, and the pose of the tool.
  frames(q) {
    const frames = [this.base];
    this.links.forEach((link, joint) => {
      const turn = joint === 2 ? q[2] + this.coupling * q[1] : q[joint];
      frames.push(chain(frames.at(-1), link, about([0, 0, 1], turn)));
    });
    const last = frames.at(-1);
    return { links: [...frames, last], tool: multiply(last, this.tool) };
  }

  // Points around the arm at joint angles.
  points(q) {
    const { links, tool } = this.frames(q);
    const points = [place(this.base), place(tool)];
    this.shapes.forEach((capsules, link) => {
      for (const { a, b } of capsules) points.push(moved(links[link], a), moved(links[link], b));
    });
    return points;
  }
}
