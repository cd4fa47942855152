// A scene of irbkin.scene: its first arm is the page's, everything else is drawn around it.

const KNOWN = ["box", "sphere", "capsule", "cylinder", "half_space"];

// What `irbkin check` found is in `program`.
async function openScene(app, scene, program = null) {
  if (scene?.format !== "irbkin scene") throw new Error('not a scene: it has no "format": "irbkin scene"');
  if (scene.version !== 1) throw new Error(`the scene has version ${scene.version}, this page reads 1`);
  const { view } = app;
  app.program.close();
  const [first, ...others] = scene.arms ?? [];
  const obstacles = scene.obstacles ?? [];
  const cell = obstacles.filter((it) => KNOWN.includes(it.shape.kind)).map(({ name, shape }) => ({
    ...shape, name, shape: shape.kind, pose: shape.pose?.slice(0, 3).flat(),
  }));
  if (app.engine) await app.tell({ do: "cell", obstacles: cell });
  if (app.engine && cell.length < obstacles.length) {
    app.notes.add(`${obstacles.length - cell.length} obstacles are drawn and not tested for collisions.`);
  }
  view.obstacles = obstacles.flatMap((it) => shapeMeshes(it.shape).map((part) => [...part, it.name]));
  const dots = (scene.clouds ?? []).flatMap((it) => {
    const most = Math.max(...it.values, 1e-9);
    const each = Math.max(1, Math.floor(it.points.length / 1500));
    return it.points.filter((_, i) => i % each === 0)
      .map((at, i) => ({ at, size: 0.004, color: [0.9 - 0.7 * (it.values[i * each] / most), 0.75, 0.45] }));
  });
  if (first) {
    const posture = (first.postures ?? []).find((it) => !it.is_ghost) ?? first.postures?.[0];
    const q = posture?.q ?? first.motion?.q[0];
    const drawn = DrawnArm.ofScene(first);
    await takeSceneArm(app, first, drawn, q);
    const rest = (first.postures ?? []).filter((it) => it !== posture);
    view.extra = rest.map((it) => ({ arm: drawn, q: it.q, alpha: it.is_ghost ? 0.2 : 0.6 }));
  }
  if (!first && !app.engine) {
    const none = { name: "", base: identity(), links: [], tool: identity(), coupling: 0, shapes: [], hulls: [] };
    await app.takeArm({ name: "", dof: 0, limits: [] }, new DrawnArm(none), null, []);
  }
  for (const arm of others) {
    const drawn = DrawnArm.ofScene(arm);
    const q = arm.postures?.[0]?.q ?? arm.motion?.q[0];
    if (q) view.extra.push({ arm: drawn, q, alpha: 1 });
  }
  view.way = (scene.paths ?? []).flatMap((it) => segments(it.points));
  view.wayNames = (scene.paths ?? []).flatMap((it) => segments(it.points).map(() => it.name));
  view.frames = (scene.frames ?? []).map((it) => Object.assign(fromRows(it.pose.flat()), { label: it.name }));
  view.marks = [...(scene.marks ?? []).map((it) => ({ at: it.point, text: it.text, color: SEVERITY_COLORS[it.severity] ?? NOTE_COLOR })), ...dots];
  const { motion } = first ?? {};
  if (program) {
    await app.program.open(program.modules, program.routine, program);
  // A program with its text is checked.
  } else if (motion?.source && app.source) {
    await app.program.open([{ name: scene.title || "program.mod", text: motion.source }], motion.routine);
  } else {
    for (const it of (scene.marks ?? []).slice(0, 50)) app.notes.add(`${it.place ?? ""} ${it.text}`.trim());
    if (motion) app.program.openMotion(scene.title ?? "motion", motion);
  }
  view.fit();
}

// Take the arm of a scene: of the catalog, or of the URDF that the scene has of it; without an engine,
// or where neither is known, it is drawn and moved by its joints.
async function takeSceneArm(app, own, drawn, q) {
  const { state } = app;
  const source = { name: own.urdf ? null : own.name, urdf: own.urdf };
  const isKnown = app.engine && (own.urdf || app.arms.some((it) => it.name === own.name));
  state.wobj = identity();
  state.base = drawn.base;
  if (!isKnown) {
    state.tool = drawn.tool;
    const dof = own.joints.length;
    const limits = own.limits.map((it) => it.map((angle) => (Math.abs(angle) < 1e9 ? angle : null)));
    await app.takeArm({ name: own.name, dof, limits }, drawn, null, q);
    return;
  }
  // The scene has the tool behind the last joint, the engine behind the flange.
  const rest = Array(own.joints.length).fill(0);
  const bare = DrawnArm.ofEngine(await app.engine.ask({ do: "robot", ...source }));
  const flange = multiply(inverse(bare.base), bare.frames(rest).tool);
  const tool = multiply(inverse(drawn.base), drawn.frames(rest).tool);
  state.tool = multiply(inverse(flange), tool);
  const behind = multiply(drawn.tool, inverse(state.tool));
  source.drawn = (base, tool) => drawn.moved(base, multiply(behind, tool));
  await app.setArm(source, q);
}
