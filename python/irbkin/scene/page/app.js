// The page: its state, and what changes it.

const START = "IRB 2600-12/1.65";
const POSTURE = [0.35, 0.25, 0.1, 0.3, 0.9, 0.2];
const NO_ENGINE = "This file draws and plays. It solves nothing: irbkin view does.";

class App {
  // Without an engine arms are drawn and moved by their joints, and not solved.
  static async of(host, engine, options = {}) {
    return new App(host, engine, options, engine ? (await engine.ask({ do: "catalog" })).arms : []);
  }

  constructor(host, engine, options, arms) {
    Object.assign(this, { host, engine, options, arms });
    this.settings = { ghosts: true };
    this.notes = {
      add: (words) => this.parts.notes.append(el("li", {}, words)),
    };
    this.state = {
      name: "", q: [], T: identity(), tool: identity(), base: identity(), wobj: identity(),
      solutions: [], own: -1, confdata: null, armAngle: null, isReached: true,
    };
    this.setUnits("mm", true);
    this.parts = panels(this);
    this.parts.arms.append(...this.arms.map((it) => el("option", { value: it.name }, it.maker)));
    this.stage = el("main", {});
    host.append(el("div", { className: "irbkin" }, this.stage, this.parts.node));
    this.view = new View(this, this.stage);
    this.program = new Program(this);
    this.stage.append(this.program.node);
    this.watch();
  }

  async open() {
    const asked = fromHash(this.options.hash ?? "");
    Object.assign(this.state, { tool: asked.tool, base: asked.base, wobj: asked.wobj });
    try {
      await this.setArm({ name: asked.name ?? START }, asked.q);
    } catch (fault) {
      this.notes.add(fault.message);
      Object.assign(this.state, { tool: identity(), base: identity(), wobj: identity() });
      await this.setArm({ name: START });
    }
    this.view.fit();
  }

  // Run something, and show a sentence in a place if it is refused.
  async guard(words, run) {
    words.classList.remove("bad");
    try {
      await run();
    } catch (fault) {
      words.textContent = fault.message;
      words.classList.toggle("bad", Boolean(fault.message));
    }
  }

  // Set something in the engine, and in that of the program.
  tell(request) {
    this.program.engine?.set(request).catch(() => {});
    return this.engine.set(request);
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

  // Take another arm: of the catalog, or of a URDF, drawn as in a scene if it is of one.
  async setArm(source, q, otherTool) {
    const { base } = this.state;
    const tool = otherTool ?? this.state.tool;
    const { name, urdf, tip } = source;
    const robot = await this.tell({ do: "robot", name, urdf, tip, tool: toRows(tool), base_pose: toRows(base) });
    if (otherTool) this.state.tool = otherTool;
    return this.takeArm(robot, source.drawn?.(base, tool) ?? DrawnArm.ofEngine(robot), source, q);
  }

  // Another arm, of a user: base and work object are of the cell and stay. The tool was of the arm
  // before, in fields that are folded: its poses would not be those of the flange.
  changeArm(source) {
    return this.setArm(source, undefined, identity());
  }

  takeArm(robot, arm, source, q) {
    const isOther = robot.name !== this.robot?.name || robot.dof !== this.robot.dof;
    Object.assign(this, { source, robot, arm });
    this.parts.node.classList.toggle("bare", !source);
    this.state.name = robot.name;
    this.rows = jointRows(this);
    this.parts.joints.replaceChildren(...this.rows.map((it) => it.node));
    this.parts.arm.value = robot.name;
    const body = robot.body ? (robot.body.approximate ? ", body approximate" : "") : ", without a body";
    this.parts.armWords.textContent = source
      ? `${robot.dof} axes, ${robot.structure}${body}` : `${robot.dof} axes, drawn and not solved`;
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
      // A sentence on a text holds of the arm before.
      this.parts.pasteWords.textContent = "";
    }
    this.readProgram(isOther);
    const solving = this.setJoints(own);
    if (isOther) this.view.fit();
    return solving;
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
    if (q.length !== this.robot.dof || !q.every(Number.isFinite)) return undefined;
    this.state.q = q;
    this.from = q;
    this.state.T = this.arm.frames(q).tool;
    return this.solve(light);
  }

  // A pose of the tool: the joints follow if they can.
  setPose(T, { drag = false } = {}) {
    if (!this.source || !T.every(Number.isFinite)) return undefined;
    this.state.T = T;
    // Of a drag, where it began.
    if (!drag) this.from = this.state.q;
    return this.solve(drag, true);
  }

  choose(index) {
    const it = this.state.solutions[index];
    return it && this.setJoints(it.q);
  }

  // Ask for the solutions at the pose and for what is known of the posture; of wishes that come
  // meanwhile, the last counts. A wish that `moves` has the joints follow.
  solve(light, moves = false) {
    this.wish = { light, moves };
    this.solving ??= this.solveAll().finally(() => { this.solving = null; });
    this.view.ask();
    return this.solving;
  }

  async solveAll() {
    while (this.wish) {
      const wish = this.wish;
      this.wish = null;
      const { robot, state } = this;
      const found = this.source ? await this.solved(wish).catch(({ message }) => ({ refused: message, reason: message })) : {};
      if (this.robot !== robot) continue;
      const { q, posture = null, solutions = [], certified = false, refused, reason = null } = found;
      // A slider that was moved meanwhile says where the joints are.
      const isLate = this.wish && !this.wish.moves;
      if (q && !isLate) state.q = q;
      // What is no pose, or is asked of nobody, leaves the tool where it is.
      if (refused) state.T = this.arm.frames(state.q).tool;
      const apart = (it) => Math.max(...it.q.map((angle, i) => Math.abs(Math.sin((angle - state.q[i]) / 2))));
      const distances = solutions.map(apart);
      const least = Math.min(...distances, Infinity);
      Object.assign(state, { solutions, certified, refused, reason, posture, own: least < 1e-4 ? distances.indexOf(least) : -1 });
      state.confdata = posture?.confdata ?? null;
      state.armAngle = posture?.arm_angle ?? null;
      state.isMoved = wish.moves;
      state.isWhole = !wish.light;
      state.isReached = !state.isMoved || !state.reason;
      this.show();
      if (!wish.light) this.settled();
      this.options.onchange?.(state);
    }
  }

  // The answers to a wish: the solutions, and the posture at the joints or at the nearest of them.
  async solved({ light, moves }) {
    const { state, engine, robot } = this;
    const q7 = robot.dof === 7 && !moves ? { q7: state.q[6] } : {};
    const seed = state.q;
    const found = await engine.ask({ do: "ik", T: toRows(state.T), seed, ...q7, collide: !light });
    const q = (moves && (found.nearest?.q ?? found.towards)) || seed;
    const posture = await engine.ask({ do: "fk", q, collide: !light });
    const reason = found.nearest ? null : found.reason ?? found.outcome;
    return { ...found, q, posture, reason };
  }

  // Nothing is dragged any more: what takes longer.
  settled() {
    if (this.wait) clearTimeout(this.wait);
    this.wait = setTimeout(() => {
      if (!this.program.isPlaying && !this.state.isWhole) this.solve(false, this.state.isMoved);
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
    for (const it of [parts.joints, parts.facts]) it.classList.toggle("old", !state.isReached);
    const inside = state.solutions.filter((it) => it.within_limits).length;
    if (!this.source) parts.verdict.textContent = this.engine ? "" : NO_ENGINE;
    else parts.verdict.textContent = state.refused ?? (state.isReached
      ? `${state.solutions.length} solutions, ${inside} inside the limits`
        + (state.certified ? ", certified to be all" : "")
      : `Not reached: ${state.reason}. ${same(state.q, this.from)
        ? "The arm stays where it is." : "The arm is as near as it gets on the straight way."}`);
    this.facts();
    this.view.ask();
  }

  facts() {
    const { posture } = this.state;
    if (!posture) {
      this.parts.facts.replaceChildren();
      return;
    }
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
    this.guard(pasteWords, async () => {
      const meant = meaningOf(text, this.robot.dof, this.units);
      if (meant.kind !== "joints" && !this.source) throw new Error("joint angles alone are read here");
      if (meant.kind === "program") await this.program.open([{ name: "pasted.mod", text: meant.text }]);
      else if (meant.kind === "joints") this.setJoints(meant.q);
      else if (meant.kind === "pose") this.setPose(multiply(this.state.wobj, meant.T));
      else await this.pasteTarget(meant);
      pasteWords.textContent = meant.form ? `read as ${meant.form}` : "";
      this.view.ask();
    });
  }

  async pasteTarget(meant) {
    const { wobj } = this.state;
    const target = await this.engine.ask({ do: "ik_target", robtarget: meant.text, wobj: toRows(wobj) });
    const name = target.name ? ` ${target.name}` : "";
    meant.form = `a ${target.kind}${name}`;
    const frame = { tooldata: "tool", wobjdata: "wobj" }[target.kind];
    if (frame) {
      this.setFrame(frame, fromRows(target.T));
    } else if (target.q) {
      this.setJoints(target.q);
    } else {
      await this.setPose(multiply(wobj, fromRows(target.T)));
      // Out of reach, confdata are not the reason.
      if (this.state.isReached) {
        meant.form += `; no solution inside the limits has its confdata [${target.confdata.join(", ")}]`;
      }
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
    await this.guard(this.parts.pasteWords, async () => {
      const modules = read.filter(isModule);
      if (modules.length && !this.source) throw new Error(`${modules[0].name} is not checked here: irbkin check does`);
      if (modules.length) await this.program.open(modules);
      for (const { name, text } of read.filter((it) => !isModule(it))) {
        try {
          await this.openFile(name, text);
        } catch (fault) {
          throw new Error(`${name}: ${fault.message}`);
        }
      }
    });
  }

  async openFile(name, text) {
    const ending = name.split(".").at(-1).toLowerCase();
    if (this.engine && (ending === "urdf" || ending === "xml")) {
      await this.setUrdf(name, text);
      if (!this.robot.body) this.notes.add(`${name} has no body that can be drawn.`);
      if (this.robot.missing_form) this.notes.add(`${this.robot.name}: ${this.robot.missing_form}`);
    } else if (ending === "json") {
      await openScene(this, JSON.parse(text));
    } else {
      throw new Error(this.engine ? `.${ending} is not read; a .urdf, a .mod or a scene (.json) is` : NO_ENGINE);
    }
  }

  // A URDF; of several ends, the one that is a tool's by its name.
  async setUrdf(name, text) {
    try {
      await this.changeArm({ urdf: text });
    } catch (fault) {
      const ends = fault.message.includes("tip must name") ? fault.message.match(/"[^"]+"/g) : null;
      const tip = ends?.map((it) => it.slice(1, -1)).find((it) => /tool|flange|tcp/i.test(it));
      if (!tip) throw fault;
      await this.changeArm({ urdf: text, tip });
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

  remember() {
    if (this.options.hash === undefined || !this.source?.name) return;
    history.replaceState(null, "", `#${asHash(this.state)}`);
  }

  watch() {
    this.host.addEventListener("dragover", (event) => event.preventDefault());
    this.host.addEventListener("drop", (event) => {
      event.preventDefault();
      this.drop(event.dataTransfer.files);
    });
    this.host.addEventListener("keydown", (event) => this.key(event));
    // Pasted anywhere but into a field.
    this.host.addEventListener("paste", (event) => {
      if (["INPUT", "TEXTAREA"].includes(event.composedPath()[0].tagName)) return;
      this.parts.paste.value = event.clipboardData.getData("text");
      this.paste(this.parts.paste.value);
    });
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
