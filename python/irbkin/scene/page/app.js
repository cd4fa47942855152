// The page: its state, and what changes it.

const START = "IRB 2600-12/1.65";
const POSTURE = [0.35, 0.25, 0.1, 0.3, 0.9, 0.2];

class App {
  constructor(host, engine, options = {}) {
    Object.assign(this, { host, engine, options });
    this.settings = { ghosts: true };
    this.notes = {
      add: (words) => this.parts.notes.append(el("li", {}, words)),
    };
    this.state = {
      name: "", q: [], T: identity(), tool: identity(), base: identity(), wobj: identity(),
      solutions: [], own: -1, confdata: null, armAngle: null,
    };
    this.setUnits("mm", true);
    this.parts = panels(this);
    this.arms = engine.ask({ do: "catalog" }).arms;
    this.parts.arms.append(...this.arms.map((it) => el("option", { value: it.name }, it.maker)));
    this.stage = el("main", {});
    host.append(el("div", { className: "irbkin" }, this.stage, this.parts.node));
    this.view = new View(this, this.stage);
    this.program = new Program(this);
    this.stage.append(this.program.node);
    this.watch();
  }

  open() {
    const asked = fromHash(this.options.hash ?? "");
    Object.assign(this.state, { tool: asked.tool, base: asked.base, wobj: asked.wobj });
    try {
      this.setArm({ name: asked.name ?? this.options.arm ?? START }, asked.q);
    } catch (fault) {
      this.notes.add(fault.message);
      Object.assign(this.state, { tool: identity(), base: identity(), wobj: identity() });
      this.setArm({ name: START });
    }
    this.view.fit();
  }

  // Run something, and show a sentence in a place if it is refused.
  guard(words, run) {
    words.classList.remove("bad");
    try {
      run();
      return true;
    } catch (fault) {
      words.textContent = fault.message;
      words.classList.toggle("bad", Boolean(fault.message));
      return false;
    }
  }

  setUnits(length, isFirst = false) {
    const inMeters = length === "m";
    this.units = {
      length,
      angle: inMeters ? "rad" : "deg",
      digits: inMeters ? [5, 5] : [2, 3],
      places: inMeters ? 4 : 1,
      toMeters: (it) => (inMeters ? it : it / 1e3),
      fromMeters: (it) => (inMeters ? it : it * 1e3),
      toRadians: (it) => (inMeters ? it : toRadians(it)),
      fromRadians: (it) => (inMeters ? it : toDegrees(it)),
    };
    if (!isFirst) this.show();
  }

  // Take another arm: of the catalog, or of a URDF.
  setArm(source, q) {
    this.view.isBare = false;
    const { tool, base } = this.state;
    const robot = this.engine.set({ do: "robot", ...source, tool: toRows(tool), base_pose: toRows(base) });
    const isOther = robot.name !== this.robot?.name;
    this.source = source;
    this.robot = robot;
    this.arm = DrawnArm.ofEngine(robot);
    this.state.name = robot.name;
    this.rows = jointRows(this);
    this.parts.joints.replaceChildren(...this.rows.map((it) => it.node));
    this.parts.arm.value = robot.name;
    const body = robot.body ? (robot.body.approximate ? ", body approximate" : "") : ", without a body";
    this.parts.armWords.textContent = `${robot.dof} axes, ${robot.structure}${body}`;
    this.parts.armWords.classList.remove("bad");
    const rest = robot.limits.map(([low, high], i) => {
      const angle = POSTURE[i] ?? 0;
      return Math.min(Math.max(angle, low ?? -Infinity), high ?? Infinity);
    });
    const own = q?.length === robot.dof && q.every(Number.isFinite) ? q : isOther ? rest : this.state.q;
    this.reach = Math.max(...this.arm.points(own).map((it) => length(subtract(it, place(this.arm.base)))), 0.5);
    if (isOther) {
      this.program.forgetMotion();
      Object.assign(this.view, { way: [], frames: [], marks: [], extra: [] });
    }
    this.setJoints(own);
    if (isOther) this.view.fit();
    this.readProgram(isOther);
  }

  // Check the program again: at once with another arm, after a pause with another frame.
  readProgram(isOther) {
    clearTimeout(this.later);
    if (isOther) this.program.read();
    else this.later = setTimeout(() => this.program.read(true), 500);
  }

  setFrame(name, pose) {
    this.state[name] = pose;
    if (name === "wobj") this.show();
    else this.guard(this.parts.verdict, () => this.setArm(this.source));
    this.remember();
  }

  // Joint angles: the tool follows.
  setJoints(q, { light = false } = {}) {
    if (q.length !== this.robot.dof || !q.every(Number.isFinite)) return;
    this.state.q = q;
    this.state.T = this.arm.frames(q).tool;
    this.solve(light);
  }

  // A pose of the tool: the joints follow if they can.
  setPose(T, { drag = false } = {}) {
    if (!T.every(Number.isFinite)) return;
    this.state.T = T;
    this.solve(drag, true);
  }

  choose(index) {
    const it = this.state.solutions[index];
    if (it) this.setJoints(it.q);
  }

  solve(light, moves = false) {
    const { state, engine } = this;
    const seed = { seed: state.q };
    const q7 = this.robot.dof === 7 && !moves ? { q7: state.q[6] } : {};
    try {
      const found = engine.ask({ do: "ik", T: toRows(state.T), ...seed, ...q7, collide: !light });
      state.solutions = found.solutions;
      state.reason = found.nearest ? null : found.reason ?? found.outcome;
      state.certified = found.certified;
      if (moves && found.nearest) state.q = found.nearest.q;
      const apart = (it) => Math.max(...it.q.map((angle, i) => Math.abs(Math.sin((angle - state.q[i]) / 2))));
      const distances = state.solutions.map(apart);
      const least = Math.min(...distances, Infinity);
      state.own = least < 1e-4 ? distances.indexOf(least) : -1;
      state.posture = engine.ask({ do: "fk", q: state.q, collide: !light });
      state.confdata = state.posture.confdata;
      state.armAngle = state.posture.arm_angle;
    } catch (fault) {
      Object.assign(state, { solutions: [], own: -1, reason: fault.message });
    }
    if (moves) state.isMoved = true;
    else if (!this.isSettling) state.isMoved = false;
    state.isReached = !state.isMoved || !state.reason;
    this.show(light);
    if (!light) this.settled();
    this.options.onchange?.(state);
  }

  // Nothing is dragged any more: what takes longer.
  settled() {
    if (this.wait) clearTimeout(this.wait);
    this.wait = setTimeout(() => {
      if (!this.program.isPlaying && this.state.posture && !this.state.posture.contact) {
        this.isSettling = true;
        this.solve(false, this.state.isMoved);
        this.isSettling = false;
      }
      this.remember();
    }, 120);
  }

  show() {
    const { state, parts } = this;
    if (!this.robot) return;
    parts.pose.show(multiply(inverse(state.wobj), state.T));
    parts.seen.textContent = `${this.units.length}, ${this.units.angle}`
      + (isIdentity(state.wobj) ? "" : ", in the work object");
    this.rows.forEach((row, joint) => row.show(state.q[joint]));
    parts.frames.forEach(({ name, fields }) => fields.show(state[name]));
    const root = this.host.getRootNode();
    const focused = [...parts.solutions.children].indexOf(root.activeElement);
    parts.solutions.replaceChildren(...solutionRows(this));
    parts.solutions.children[focused]?.focus({ preventScroll: true });
    parts.verdict.classList.toggle("bad", !state.isReached);
    const inside = state.solutions.filter((it) => it.within_limits).length;
    parts.verdict.textContent = state.isReached
      ? `${state.solutions.length} solutions, ${inside} inside the limits`
        + (state.certified ? ", certified to be all" : "")
      : `Not reached: ${state.reason}`;
    this.facts();
    this.view.ask();
  }

  facts() {
    const { posture } = this.state;
    if (!posture) return;
    const turn = (angle) => `${trimmed(this.units.fromRadians(angle), 2)} ${this.units.angle}`;
    const { margin, singular, contact, arm_angle: armAngle } = posture;
    const rows = [
      posture.confdata && ["confdata", posture.confdata.join(" ")],
      armAngle !== null && ["arm angle", turn(armAngle)],
      margin.joint && ["nearest limit", `J${margin.joint}, ${turn(margin.rad)}`],
      singular && ["from singularities", `wrist ${turn(singular.wrist)}, elbow ${turn(singular.elbow)}, shoulder `
        + `${trimmed(this.units.fromMeters(singular.shoulder), this.units.places)} ${this.units.length}`],
      contact?.near && [contact.collides ? "collides" : "nearest", `link ${contact.link} and ${contact.near}: `
        + `${trimmed(this.units.fromMeters(contact.distance), this.units.places)} ${this.units.length}`],
    ].filter(Boolean);
    this.parts.facts.replaceChildren(...rows.flatMap(([name, text]) => [
      el("dt", {}, name), el("dd", { className: name === "collides" ? "bad" : "" }, text),
    ]));
  }

  paste(text) {
    const { pasteWords } = this.parts;
    if (!text.trim()) {
      pasteWords.textContent = "";
      return;
    }
    this.guard(pasteWords, () => {
      const meant = meaningOf(text, this.robot.dof, this.units);
      if (meant.kind === "joints") this.setJoints(meant.q);
      else if (meant.kind === "pose") this.setPose(multiply(this.state.wobj, meant.T));
      else this.pasteTarget(meant);
      if (meant.form) pasteWords.textContent = `read as ${meant.form}`;
      this.view.ask();
    });
  }

  pasteTarget(meant) {
    const { wobj } = this.state;
    const target = this.engine.ask({ do: "ik_target", robtarget: meant.text, wobj: toRows(wobj) });
    const name = target.name ? ` ${target.name}` : "";
    meant.form = `a ${target.kind}${name}`;
    if (target.q) {
      this.setJoints(target.q);
    } else {
      this.setPose(multiply(wobj, fromRows(target.T)));
      meant.form += `, whose confdata [${target.confdata.join(", ")}] no solution inside the limits has`;
    }
  }

  // Modules among the files are read together: they are of one task.
  async drop(files) {
    const read = [];
    for (const file of files) {
      if (file.size > 4e6) {
        this.notes.add(`${file.name} has ${(file.size / 1e6).toFixed(1)} MB, at most 4 MB are read here: irbkin check reads it.`);
      } else {
        read.push({ name: file.name, text: await file.text() });
      }
    }
    const isModule = ({ name }) => /\.(modx?|prg|sysx?)$/i.test(name);
    this.guard(this.parts.pasteWords, () => {
      const modules = read.filter(isModule);
      if (modules.length) this.program.open(modules);
      for (const { name, text } of read.filter((it) => !isModule(it))) {
        try {
          this.openFile(name, text);
        } catch (fault) {
          throw new Error(`${name}: ${fault.message}`);
        }
      }
    });
  }

  openFile(name, text) {
    const ending = name.split(".").at(-1).toLowerCase();
    if (ending === "urdf" || ending === "xml") {
      this.setUrdf(name, text);
      if (!this.robot.body) this.notes.add(`${name} has no body that can be drawn.`);
      if (this.robot.missing_form) this.notes.add(`${this.robot.name}: ${this.robot.missing_form}`);
    } else if (ending === "json") {
      openScene(this, JSON.parse(text));
    } else {
      throw new Error(`.${ending} is not read; a .urdf, a .mod or a scene (.json) is`);
    }
  }

  // A URDF; of several ends, the one that is a tool's by its name.
  setUrdf(name, text) {
    try {
      this.setArm({ urdf: text });
    } catch (fault) {
      const ends = fault.message.includes("tip must name") ? fault.message.match(/"[^"]+"/g) : null;
      const tip = ends?.map((it) => it.slice(1, -1)).find((it) => /tool|flange|tcp/i.test(it));
      if (!tip) throw fault;
      this.setArm({ urdf: text, tip });
      this.notes.add(`${name} has several ends: the arm ends at ${tip}.`);
    }
  }

  async copy(name, write) {
    const T = this.arm.frames(this.state.q).tool;
    const text = write({ ...this.state, T, robot: this.robot, source: this.source });
    try {
      await navigator.clipboard.writeText(text);
      this.parts.copied.textContent = `${name} copied`;
    } catch {
      // Without a clipboard the text stands in the field, selected.
      this.parts.paste.value = text;
      this.parts.paste.select();
      this.parts.copied.textContent = "press Ctrl+C";
    }
  }

  link() {
    return `${String(location.href).split("#")[0]}#${asHash(this.state)}`;
  }

  remember() {
    if (this.options.hash === undefined || this.source?.urdf) return;
    history.replaceState(null, "", `#${asHash(this.state)}`);
  }

  watch() {
    this.host.addEventListener("dragover", (event) => event.preventDefault());
    this.host.addEventListener("drop", (event) => {
      event.preventDefault();
      this.drop(event.dataTransfer.files);
    });
    this.host.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const at = event.composedPath()[0];
    if (["INPUT", "TEXTAREA", "SELECT", "BUTTON", "SUMMARY"].includes(at.tagName) || event.ctrlKey || event.metaKey) return;
    const step = event.shiftKey ? 1e-3 : 1e-2;
    const moves = {
      ArrowUp: [step, 0, 0], ArrowDown: [-step, 0, 0], ArrowLeft: [0, step, 0],
      ArrowRight: [0, -step, 0], PageUp: [0, 0, step], PageDown: [0, 0, -step],
    };
    const { state } = this;
    const others = state.solutions.map((_, i) => i).filter((i) => state.solutions[i].within_limits);
    const next = (way) => others[(others.indexOf(state.own) + way + others.length) % others.length];
    if (event.key in moves && at === this.view.canvas) this.setPose(Handle.shifted(state.T, moves[event.key]));
    else if (event.key >= "1" && event.key <= "9") this.choose(Number(event.key) - 1);
    else if (event.key === "]") this.choose(next(1));
    else if (event.key === "[") this.choose(next(-1));
    else if (event.key === " ") this.program.toggle();
    else if (event.key === "f") this.view.fit();
    else if (event.key === "g") this.parts.ghosts.click();
    else return;
    event.preventDefault();
  }
}
