// The picture: the arm, its other solutions, the handle, obstacles, ways, findings.

// Links in turn: orange, or light as the arms of makers whose arms are.
const LINK_COLORS = [[0.93, 0.53, 0.13], [0.97, 0.66, 0.31]];
const LIGHT_COLORS = [[0.84, 0.86, 0.88], [0.6, 0.67, 0.73]];
const LIGHT = ["FANUC", "Franka", "UFACTORY", "Universal Robots"];
const BASE_COLOR = [0.32, 0.36, 0.42];
const GHOST_COLOR = [0.55, 0.62, 0.72];
const OBSTACLE_COLOR = [0.45, 0.55, 0.5];
const SEVERITY_COLORS = { error: [0.8, 0.16, 0.16], warning: [0.75, 0.47, 0] };
const NOTE_COLOR = [0.12, 0.47, 0.71];
// Length of the axes of a frame [m].
const AXIS = 0.15;
// A frame takes longer [ms]: it is drawn without smooth edges, then without a shadow, while things move.
const SLOW = 25;

class View {
  constructor(app, host) {
    this.app = app;
    this.camera = new Camera();
    this.canvas = el("canvas", { tabIndex: 0, ariaLabel: "the arm: drag the handle, or the ground to look around" });
    this.words = el("div", { className: "words" });
    this.label = el("span", { className: "label", hidden: true });
    host.append(this.canvas, this.words, this.label);
    try {
      this.drawing = new GlDrawing(this.canvas);
    } catch {
      this.fall("This browser has no WebGL 2: everything is solved, nothing is drawn.");
    }
    Object.assign(this, { way: [], frames: [], marks: [], obstacles: [], extra: [], held: null, hover: null });
    Object.assign(this, { quality: 2, count: 0, late: 0 });
    this.pointers = new Map();
    for (const kind of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) {
      this.canvas.addEventListener(kind, (event) => this[kind](event));
    }
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.camera.zoom(Math.exp(0.0012 * event.deltaY));
      this.ask();
    }, { passive: false });
    this.canvas.addEventListener("pointerleave", () => { this.label.hidden = true; });
    this.canvas.addEventListener("dblclick", () => this.fit());
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.fall("The graphics were lost: reload the page.");
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.ask());
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.resize();
  }

  fall(words) {
    this.drawing = null;
    this.app.notes.add(words);
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth || !clientHeight) return;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.camera.size = [clientWidth, clientHeight];
    this.ask();
  }

  fit() {
    const { arm, state } = this.app;
    const others = this.extra.flatMap((it) => it.arm.points(it.q));
    if (!arm?.links.length) others.push(...this.obstacles.map(([pose]) => place(pose)), ...this.marks.map(({ at }) => at));
    if (arm) this.camera.fit([...arm.points(state.q), ...others, place(arm.base)]);
    this.ask();
  }

  // Draw soon; where that is done in haste, again when nothing moves.
  ask() {
    clearTimeout(this.rest);
    this.isAsked ||= requestAnimationFrame(() => {
      this.isAsked = 0;
      this.draw(this.quality);
      if (this.quality < 2) this.rest = setTimeout(() => this.draw(2), 150);
    });
  }

  // Of quality 2 with smooth edges and a shadow, 1 with a shadow, 0 with neither.
  draw(quality = this.quality) {
    const { drawing, camera, app: { arm, state } } = this;
    if (!arm || !drawing) return;
    const begun = performance.now();
    const floor = { at: place(arm.base), ...this.extent() };
    drawing.begin(camera, this.canvas.width, this.canvas.height, this.color(this.canvas.parentNode.parentNode), floor, quality > 1);
    const solid = this.arms().flatMap(([it, q]) => this.links(it, q));
    solid.push(...this.obstacles.map(([pose, mesh]) => [mesh, pose, OBSTACLE_COLOR]));
    if (quality > 0) drawing.shadow(solid);
    for (const [mesh, model, color] of solid) drawing.mesh(mesh, model, color);
    drawing.ground(this.color(this.words, "color"), quality > 0);
    if (this.way.length) drawing.lines(this.way, NOTE_COLOR, { pairs: true, width: 2.5 });
    this.axes();
    for (const { at, color, size = 0.012 } of this.marks) {
      drawBall(drawing, at, size * camera.distance, color);
    }
    this.faint();
    if (this.app.source) this.target(arm, state);
    drawing.end();
    this.scale();
    this.measure(begun, quality);
  }

  // The handle; where the arm does not reach, the frame is red, and a line leads to it.
  target(arm, state) {
    const { drawing, camera } = this;
    Handle.draw(drawing, camera, state.T, this.held?.part ?? this.over, !state.isReached);
    if (state.isReached) return;
    const ends = [place(arm.frames(state.q).tool), place(state.T)];
    drawing.lines(ends, SEVERITY_COLORS.error, { pairs: true, width: 2.5 });
  }

  // The arms that are not faint.
  arms() {
    return [[this.app.arm, this.app.state.q], ...this.extra.filter((it) => it.alpha === 1).map((it) => [it.arm, it.q])];
  }

  // Other postures: of one color those that one sees through, without what is at the same place.
  faint() {
    const { arm, state, settings, source } = this.app;
    const groups = this.extra.filter((it) => it.alpha < 1).map((it) => [it.arm, [it.q], it.alpha]);
    const hovered = state.solutions[this.hover];
    const others = state.solutions.filter((it, index) => index !== state.own && it !== hovered && it.within_limits);
    if (source && settings.ghosts) groups.push([arm, others.map((it) => it.q), 0.2]);
    if (source && hovered && this.hover !== state.own) groups.push([arm, [hovered.q], 0.55]);
    for (const [own, postures, alpha] of groups) {
      const seen = new Set(this.places(own, state.q));
      const meshes = postures.flatMap((q) => {
        const places = this.places(own, q);
        return this.links(own, q, true).filter((_, link) => !seen.has(places[link]) && seen.add(places[link]));
      });
      this.drawing.faint(meshes, [...GHOST_COLOR, alpha]);
    }
  }

  // Where links are, as texts to compare.
  places(arm, q) {
    return arm.frames(q).links.map((it, link) => `${link} ${it.map((each) => each.toFixed(3))}`);
  }

  // The time of a frame with all that the graphics have to do, of some frames.
  measure(begun, quality) {
    this.frameTime = performance.now() - begun;
    this.count += 1;
    if (quality !== this.quality || quality === 0 || this.count % 4) return;
    this.drawing.finish();
    this.frameTime = performance.now() - begun;
    this.late = this.frameTime > SLOW ? this.late + 1 : 0;
    if (this.late < 2) return;
    this.quality -= 1;
    this.late = 0;
  }

  axes() {
    if (!this.frames.length) return;
    AXIS_COLORS.forEach((color, axis) => {
      const ends = this.frames.flatMap((it) => [place(it), add(place(it), scale(axisOf(it, axis), AXIS))]);
      this.drawing.lines(ends, color, { pairs: true, width: 4 });
    });
  }

  // A color of the page, which is another one in the dark.
  color(of, name = "backgroundColor") {
    const numbers = getComputedStyle(of)[name].match(/[\d.]+/g);
    return (numbers ?? [245, 246, 248]).slice(0, 3).map((it) => it / 255);
  }

  // The meshes of an arm with their places and colors.
  links(arm, q, isFaint = false) {
    const { links } = arm.frames(q);
    const kind = isFaint ? "coarse" : this.app.settings.capsules ? "capsules" : "meshes";
    const maker = this.app.arms.find((it) => it.name === arm.name)?.maker;
    const colors = LIGHT.includes(maker) ? LIGHT_COLORS : LINK_COLORS;
    return arm[kind].map((mesh, link) => [mesh, links[link], link === 0 ? BASE_COLOR : colors[link % 2]]);
  }

  // Half of the edge of the floor, and the size of its cells [m].
  extent() {
    const cell = this.app.reach > 2.2 ? 1 : 0.5;
    return { edge: Math.max(cell * Math.ceil(this.app.reach / cell), 2 * cell), cell };
  }

  // Lengths beside the floor, at the edges that are farthest from the eye, where no arm is before them.
  scale() {
    const { camera, app: { units, arm, state } } = this;
    const { edge, cell } = this.extent();
    const from = place(arm.base);
    const { links } = arm.frames(state.q);
    const before = arm.shapes.flatMap((own, link) => own.map(({ a, b, radius }) => {
      const [one, other] = [moved(links[link], a), moved(links[link], b)];
      return [camera.project(one), camera.project(other), radius / camera.pixel(one) + 12];
    }));
    const texts = [0, 1].flatMap((axis) => {
      const at = (along, across) => add(from, axis === 0 ? [along, across, 0] : [across, along, 0]);
      const side = camera.eye[1 - axis] > from[1 - axis] ? -1 : 1;
      const made = [[at(1.04 * edge, 0), "xy"[axis]]];
      for (let along = -edge + cell; along < edge + cell / 2; along += cell) {
        const unit = along < edge - cell / 2 ? "" : ` ${units.length}`;
        if (Math.abs(along) > 1e-9) made.push([at(along, 1.06 * edge * side), trimmed(units.fromMeters(along), 1) + unit]);
      }
      return made;
    });
    const hides = (point) => ([pose, mesh]) => mesh.index.length < 600
      && this.away(mesh, pose, unit(subtract(point, camera.eye))) < length(subtract(point, camera.eye));
    const seen = texts.filter(([point]) => !this.obstacles.some(hides(point)))
      .map(([point, text]) => [camera.project(point), text])
      .filter(([at]) => at[2] > 0 && at[1] < camera.size[1] - 10 && !before.some(([a, b, room]) => fromLine(at, a, b) < room));
    this.words.replaceChildren(...seen.map(([[x, y], text]) => el("span", {
      style: `transform:translate(${x.toFixed(1)}px,${y.toFixed(1)}px) translate(-50%,-50%)`,
    }, text)));
  }

  // How far from the eye a ray meets a mesh [m].
  away(mesh, model, ray) {
    const back = inverse(model);
    return metAt(mesh, moved(back, this.camera.eye), subtract(moved(back, ray), place(back)));
  }

  // What is at a place of the screen, in words; nothing where nothing is.
  named(x, y) {
    const { camera, wayNames, way } = this;
    const found = [[Infinity, ""]];
    const met = (mesh, model, words) => found.push([this.away(mesh, model, camera.ray(x, y)), words]);
    const near = (point, words, room) => {
      const [u, v, away] = camera.project(point);
      if (Math.hypot(u - x, v - y) < room) found.push([away - 0.05, words]);
    };
    for (const [arm, q] of this.arms()) {
      this.links(arm, q, true).forEach(([mesh, model], i) => met(
        mesh, model, i === 0 ? "base" : i > q.length ? "on the flange" : `link ${i}`,
      ));
    }
    for (const [pose, mesh, name] of this.obstacles) met(mesh, pose, name);
    for (const it of this.frames) near(place(it), it.label, 20);
    for (const it of this.marks.filter(({ text }) => text)) near(it.at, it.text, 10);
    // A program has another way than the scene before it.
    way.forEach((it, i) => near(it, (wayNames?.length === way.length && wayNames[i]) || "path", 7));
    return found.reduce((best, it) => (it[0] < best[0] ? it : best))[1];
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  pointerdown(event) {
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.place(event);
    this.label.hidden = true;
    this.pointers.set(event.pointerId, at);
    const reach = event.pointerType === "touch" ? 26 : 14;
    const part = this.pointers.size === 1 && event.button === 0 && this.app.source
      ? Handle.at(this.camera, this.app.state.T, ...at, reach) : null;
    this.held = part ? { part, from: at, pose: this.app.state.T } : null;
    this.clicked = at;
    this.isPan = event.button !== 0 || event.shiftKey;
    this.ask();
  }

  pointermove(event) {
    const at = this.place(event);
    const last = this.pointers.get(event.pointerId);
    if (!last) {
      const over = Handle.at(this.camera, this.app.state.T, ...at);
      this.canvas.style.cursor = over ? "grab" : "default";
      const words = over ? "" : this.named(...at);
      this.label.hidden = !words;
      this.label.textContent = words;
      this.label.style.transform = `translate(${at[0] + 14}px,${at[1] + 14}px)`;
      if (over !== this.over) {
        this.over = over;
        this.ask();
      }
      return;
    }
    if (this.held) {
      const { part, from, pose } = this.held;
      this.app.setPose(Handle.dragged(this.camera, pose, part, from, at), { drag: true });
    } else if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
      const apart = (it) => Math.hypot(it[0] - other[0], it[1] - other[1]);
      this.camera.zoom(apart(last) / Math.max(apart(at), 1));
      this.camera.pan((at[0] - last[0]) / 2, (at[1] - last[1]) / 2);
    } else {
      this.camera[this.isPan ? "pan" : "turn"](at[0] - last[0], at[1] - last[1]);
    }
    this.pointers.set(event.pointerId, at);
    this.ask();
  }

  pointerup(event) {
    const at = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    const isClick = this.clicked && at && Math.hypot(at[0] - this.clicked[0], at[1] - this.clicked[1]) < 4;
    const away = (it) => Math.hypot(...this.camera.project(it.at).slice(0, 2).map((one, i) => one - at[i]));
    if (isClick && !this.held) this.marks.find((it) => it.go && away(it) < 12)?.go();
    if (this.held) this.app.settled();
    this.held = null;
    this.ask();
  }

  pointercancel(event) { this.pointerup(event); }
}
