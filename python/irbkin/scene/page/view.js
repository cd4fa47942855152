// The picture: the arm, its other solutions, the handle, obstacles, ways, findings.

const LINK_COLORS = [[0.93, 0.53, 0.13], [0.97, 0.66, 0.31]];
const BASE_COLOR = [0.32, 0.36, 0.42];
const GHOST_COLOR = [0.55, 0.62, 0.72];
const SEVERITY_COLORS = { error: [0.8, 0.16, 0.16], warning: [0.75, 0.47, 0] };
const NOTE_COLOR = [0.12, 0.47, 0.71];
// Length of the axes of a frame [m].
const AXIS = 0.15;

class View {
  constructor(app, host) {
    this.app = app;
    this.camera = new Camera();
    this.canvas = el("canvas", { tabIndex: 0, ariaLabel: "the arm: drag the handle, or the ground to look around" });
    host.append(this.canvas);
    this.start();
    Object.assign(this, { way: [], frames: [], marks: [], obstacles: [], extra: [], held: null, hover: null });
    this.pointers = new Map();
    for (const kind of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) {
      this.canvas.addEventListener(kind, (event) => this[kind](event));
    }
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.camera.zoom(Math.exp(0.0012 * event.deltaY));
      this.ask();
    }, { passive: false });
    this.canvas.addEventListener("dblclick", () => this.fit());
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.fall("the graphics were lost");
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.ask());
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.resize();
  }

  start() {
    try {
      if (this.app.options.flat) throw new Error("asked for");
      this.drawing = new GlDrawing(this.canvas);
    } catch {
      this.drawing = new FlatDrawing(this.canvas);
      this.app.notes.add("WebGL is not available: the arm is drawn as lines.");
    }
  }

  fall(words) {
    const other = this.canvas.cloneNode();
    this.app.notes.add(`${words}: reload the page for the full picture.`);
    this.canvas.replaceWith(other);
    this.canvas = other;
    this.drawing = new FlatDrawing(other);
    this.ask();
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
    if (arm) this.camera.fit([...arm.points(state.q), ...others, place(arm.base)]);
    this.ask();
  }

  ask() {
    this.isAsked ||= requestAnimationFrame(() => {
      this.isAsked = 0;
      this.draw();
    });
  }

  draw() {
    const { drawing, camera, app } = this;
    const { arm, state } = app;
    if (!arm) return;
    const begun = performance.now();
    drawing.begin(camera, this.canvas.width, this.canvas.height, this.color());
    this.ground();
    this.body(arm, state.q, 1);
    for (const [pose, mesh] of this.obstacles) drawing.mesh(mesh, pose, [0.45, 0.55, 0.5]);
    for (const it of this.extra) this.body(it.arm, it.q, it.alpha);
    if (this.way.length) drawing.lines(this.way, NOTE_COLOR, { pairs: true });
    this.axes();
    for (const { at, color, size = 0.012 } of this.marks) {
      drawBall(drawing, at, size * camera.distance, color);
    }
    if (!app.source) return;
    if (app.settings.ghosts) {
      state.solutions.forEach((it, index) => {
        if (index !== state.own && index !== this.hover && it.within_limits) this.body(arm, it.q, 0.13);
      });
    }
    const hovered = state.solutions[this.hover];
    if (hovered && this.hover !== state.own) this.body(arm, hovered.q, 0.55);
    Handle.draw(drawing, camera, state.T, this.held?.part ?? this.over);
    this.frameTime = performance.now() - begun;
  }

  axes() {
    if (!this.frames.length) return;
    AXIS_COLORS.forEach((color, axis) => {
      const ends = this.frames.flatMap((it) => [place(it), add(place(it), scale(axisOf(it, axis), AXIS))]);
      this.drawing.lines(ends, color, { pairs: true });
    });
  }

  // The color of the page, which is another one in the dark.
  color() {
    const numbers = getComputedStyle(this.canvas.parentNode.parentNode).backgroundColor.match(/[\d.]+/g);
    return (numbers ?? [245, 246, 248]).slice(0, 3).map((it) => it / 255);
  }

  body(arm, q, alpha) {
    const { links } = arm.frames(q);
    const meshes = alpha < 0.5 ? arm.coarse : arm.meshes;
    meshes.forEach((mesh, link) => {
      const own = link === 0 ? BASE_COLOR : LINK_COLORS[link % 2];
      const color = [...(alpha < 1 ? GHOST_COLOR : own), alpha];
      if (this.drawing.isFlat) this.drawing.capsules(arm.shapes[link], links[link], color);
      else this.drawing.mesh(mesh, links[link], color);
    });
  }

  ground() {
    const { arm } = this.app;
    const z = arm.base[14];
    const reach = Math.max(1, Math.ceil(this.app.reach * 2) / 2);
    const lines = [];
    for (let at = -reach; at <= reach + 1e-9; at += 0.5) {
      lines.push([at, -reach, z], [at, reach, z], [-reach, at, z], [reach, at, z]);
    }
    this.drawing.lines(lines, [0.5, 0.55, 0.62, 0.35], { pairs: true });
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  pointerdown(event) {
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.place(event);
    this.pointers.set(event.pointerId, at);
    const reach = event.pointerType === "touch" ? 26 : 14;
    const part = this.pointers.size === 1 && event.button === 0 && this.app.source
      ? Handle.at(this.camera, this.app.state.T, ...at, reach) : null;
    this.held = part ? { part, from: at, pose: this.app.state.T } : null;
    this.isPan = event.button !== 0 || event.shiftKey;
    this.ask();
  }

  pointermove(event) {
    const at = this.place(event);
    const last = this.pointers.get(event.pointerId);
    if (!last) {
      const over = Handle.at(this.camera, this.app.state.T, ...at);
      this.canvas.style.cursor = over ? "grab" : "default";
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
    this.pointers.delete(event.pointerId);
    if (this.held) this.app.settled();
    this.held = null;
    this.ask();
  }

  pointercancel(event) { this.pointerup(event); }
}
