// A scene of irbkin.scene: its first arm is the page's, everything else is drawn around it.

const KNOWN = ["box", "sphere", "capsule", "cylinder", "half_space"];

function openScene(app, scene) {
  if (scene.format !== "irbkin scene") throw new Error('not a scene: it has no "format": "irbkin scene"');
  if (scene.version !== 1) throw new Error(`the scene has version ${scene.version}, this page reads 1`);
  const { view, state } = app;
  app.program.close();
  const [first, ...others] = scene.arms ?? [];
  const obstacles = scene.obstacles ?? [];
  const cell = obstacles.filter((it) => KNOWN.includes(it.shape.kind)).map(({ name, shape }) => ({
    ...shape, name, shape: shape.kind, pose: shape.pose?.slice(0, 3).flat(),
  }));
  app.engine.set({ do: "cell", obstacles: cell });
  if (cell.length < obstacles.length) {
    app.notes.add(`${obstacles.length - cell.length} obstacles are drawn and not tested for collisions.`);
  }
  view.obstacles = obstacles.flatMap((it) => shapeMeshes(it.shape));
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
    const isSolved = app.arms.some((it) => it.name === first.name);
    if (isSolved) {
      // The scene has the tool behind the last joint, the engine behind the flange.
      const bare = app.engine.ask({ do: "robot", name: first.name });
      state.base = drawn.base;
      state.tool = multiply(inverse(fromRows(bare.flange)), drawn.tool);
      state.wobj = identity();
      app.setArm({ name: first.name }, q);
    } else {
      app.notes.add(`${first.name} is not in the catalog: it is drawn, and not solved.`);
      app.view.isBare = true;
    }
    const rest = (first.postures ?? []).filter((it) => it !== posture || !isSolved);
    view.extra = rest.map((it) => ({ arm: drawn, q: it.q, alpha: it === posture ? 1 : it.is_ghost ? 0.2 : 0.6 }));
    if (first.motion && isSolved) app.program.openMotion(scene.title ?? "motion", first.motion);
  }
  for (const arm of others) {
    const drawn = DrawnArm.ofScene(arm);
    const q = arm.postures?.[0]?.q ?? arm.motion?.q[0];
    if (q) view.extra.push({ arm: drawn, q, alpha: 1 });
  }
  view.way = (scene.paths ?? []).flatMap((it) => segments(it.points));
  view.frames = (scene.frames ?? []).map((it) => fromRows(it.pose.flat()));
  view.marks = [...(scene.marks ?? []).map((it) => ({ at: it.point, color: SEVERITY_COLORS[it.severity] ?? NOTE_COLOR })), ...dots];
  for (const it of (scene.marks ?? []).slice(0, 50)) app.notes.add(`${it.place ?? ""} ${it.text}`.trim());
  view.fit();
}
