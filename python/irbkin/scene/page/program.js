// A program of RAPID: its text with findings, its moves as a table, a routine played on a slider.

const MOST_ROWS = 3000;
const MOST_MARKS = 300;

class Program {
  constructor(app) {
    this.app = app;
    this.slider = el("input", {
      type: "range", min: 0, max: 1, step: "any", value: 0, ariaLabel: "time",
      oninput: () => this.at(Number(this.slider.value)),
    });
    this.clock = el("span", { className: "clock" });
    this.button = el("button", { type: "button", onclick: () => this.toggle(), title: "space" }, "play");
    this.source = new Source((line) => this.goLine(line));
    this.list = el("tbody");
    this.words = el("p", { className: "dim" });
    this.files = el("select", { ariaLabel: "module", onchange: () => this.turnTo(Number(this.files.value)) });
    this.routines = el("select", { ariaLabel: "routine", onchange: () => this.play() });
    this.node = el("section", { className: "program", hidden: true },
      el("div", { className: "row" },
        el("h2", {}, "Program ", this.title = el("span", { className: "dim" })),
        this.files, this.routines,
        el("button", { type: "button", onclick: () => this.close(), ariaLabel: "close the program" }, "close")),
      this.words,
      this.player = el("div", { className: "player" }, this.button, this.slider, this.clock),
      el("div", { className: "sides" }, this.source.node,
        this.moves = el("div", { className: "moves" }, el("table", {}, this.list))),
    );
  }

  // Modules of one task: each with a name and a text; a routine of them. What is `known` of them is
  // not asked.
  open(modules, routine, known) {
    this.engine ??= this.app.engine && this.app.engine.twin();
    this.modules = modules;
    this.isRead = false;
    this.found = [];
    this.bytes = modules.map(({ text }) => new TextEncoder().encode(text));
    this.wanted = routine;
    this.title.textContent = "";
    this.list.replaceChildren();
    this.files.replaceChildren(...modules.map((it, index) => el("option", { value: index }, it.name)));
    this.turnTo(0);
    return this.read(false, known);
  }

  // Show the text of another module.
  turnTo(module) {
    this.module = module;
    this.files.value = module;
    this.source.open(this.modules[module].text);
    this.mark();
  }

  // A motion of a scene is of its arm alone.
  forgetMotion() {
    this.stop();
    if (!this.modules) {
      this.motion = null;
      this.node.hidden = true;
    }
  }

  close() {
    this.modules = this.turn = this.checked = null;
    Object.assign(this.app.view, { way: [], marks: [] });
    this.forgetMotion();
    this.app.view.ask();
  }

  // Play a motion of a scene.
  openMotion(name, motion) {
    if (!motion.t.length) return;
    this.stop();
    this.shown = null;
    this.modules = this.checked = null;
    this.title.textContent = name;
    this.words.textContent = "";
    this.list.replaceChildren();
    const places = (motion.lines ?? []).map((line) => ({ module: 0, line }));
    this.motion = { t: motion.t, q: motion.q.flat(), places, duration: motion.t.at(-1), moves: [] };
    for (const it of [this.files, this.routines, this.moves]) it.hidden = true;
    this.source.node.hidden = !motion.source;
    this.source.open(motion.source ?? "");
    this.source.mark(new Map());
    this.node.hidden = false;
    this.player.hidden = false;
    this.at(0);
  }

  // Ask an engine of its own, beside the one that solves, when it is free; nothing where another
  // program or arm has come.
  async asked(request) {
    const { turn, engine } = this;
    await engine.last;
    const answer = this.turn === turn && await engine.ask(request);
    return this.turn === turn ? answer : null;
  }

  // Check the program with the arm as it is; `stays` where the motion is.
  async read(stays = false, known = null) {
    if (!this.modules) return;
    // What was asked before is of another arm.
    this.turn = {};
    this.stop();
    this.node.hidden = this.moves.hidden = this.source.node.hidden = false;
    this.files.hidden = this.modules.length < 2;
    this.words.textContent = "is checked";
    let checked = known;
    try {
      checked ??= await this.asked({ do: "check", modules: this.texts(), collide: this.app.view.obstacles.length > 0 });
      if (!checked) return;
      this.isRead = !known;
    } catch (fault) {
      this.words.textContent = `It cannot be checked: ${fault.message}`;
      this.found = [];
      this.list.replaceChildren();
      this.routines.hidden = this.player.hidden = true;
      return;
    }
    const shown = checked.findings.filter((it) => it.shown);
    const unchecked = checked.moves.filter((it) => it.unchecked).length;
    const errors = shown.filter((it) => it.severity === "error").length;
    this.counted = `${checked.moves.length - unchecked} of ${checked.moves.length} moves `
      + `checked, ${errors} ${errors === 1 ? "error" : "errors"}, ${shown.length - errors} other findings`
      + `${checked.faults.length ? `, ${checked.faults.length} statements not read` : ""}.`;
    if (known) this.counted = known.words;
    if (checked.moves.length > MOST_ROWS) this.counted += ` The table has the first ${MOST_ROWS}.`;
    const faults = checked.faults.map((it) => ({ ...it, severity: "error", code: "", edits: [] }));
    Object.assign(this, { found: [...shown, ...faults], checked: checked.moves });
    this.fill(checked.moves);
    this.mark();
    this.choices(checked);
    await this.play(stays, known);
  }

  texts() {
    return this.modules.map(({ text }) => ({ text }));
  }

  // The motion of a procedure; the engine keeps the modules that it has read.
  async motionOf(procedure) {
    const modules = this.isRead ? null : this.texts();
    const motion = await this.asked({ do: "motion", modules, module: procedure?.module, routine: procedure?.name });
    this.isRead = true;
    return motion;
  }

  // What was found on the lines of the module that is shown.
  mark() {
    const found = new Map();
    for (const it of this.found) {
      if (it.module === this.module) found.set(it.line, [...(found.get(it.line) ?? []), it]);
    }
    this.source.mark(found);
  }

  goLine(line) {
    const move = this.checked?.find((it) => it.module === this.module && it.line === line);
    if (move) this.go(move);
  }

  // The procedures, `main` or the first that moves chosen unless another one was.
  choices({ procedures, moves }) {
    const moving = moves.find((move) => move.routine !== null);
    const isFirst = (it) => it.module === moving?.module && it.name === moving.routine;
    const named = (name) => procedures.find((it) => it.name.toLowerCase() === name?.toLowerCase());
    const own = named(this.wanted ?? this.routines.selectedOptions[0]?.textContent) ?? named("main") ?? procedures.find(isFirst);
    this.wanted = null;
    this.procedures = procedures;
    this.routines.replaceChildren(...procedures.map((it, index) => el("option", { value: index }, it.name)));
    this.routines.value = procedures.indexOf(own);
    this.routines.hidden = procedures.length < 2 || !this.engine;
  }

  // Follow the chosen routine; `stays` where the motion is.
  async play(stays = false, known = null) {
    this.stop();
    this.shown = null;
    this.motion = null;
    const chosen = this.procedures[this.routines.value];
    let why = "";
    try {
      const motion = known ? granted(known.motion) : await this.motionOf(chosen);
      if (!motion) return;
      motion.places = motion.move_index.map((index) => motion.moves[index]);
      this.motion = motion;
    } catch (fault) {
      why = ` ${chosen?.name ?? "It"} is not played: ${fault.message}.`;
    }
    this.words.textContent = this.counted + why;
    this.player.hidden = !this.motion;
    this.paths();
    if (this.motion && !stays) this.at(0);
  }

  // A row for each move with what was found on it, and for each finding on anything else.
  fill(moves) {
    const rows = [];
    const place = ({ module, line, column }) => `${module}:${line}:${column}`;
    const found = new Map();
    for (const it of this.found) found.set(place(it), [...(found.get(place(it)) ?? []), it]);
    const named = ({ module, line }) => (this.modules.length > 1 ? `${this.modules[module].name.split("/").at(-1)}:${line}` : String(line));
    const row = (it, className, options, ...cells) => el("tr", {
      className, "data-module": it.module, "data-line": it.line, ...options,
    }, ...[named(it), ...cells].map((words) => el("td", {}, words)));
    for (const move of moves.slice(0, MOST_ROWS)) {
      const own = found.get(place(move)) ?? [];
      const worst = SEVERITIES.find((it) => own.some((one) => one.severity === it));
      const go = () => this.go(move);
      rows.push(row(
        move, worst ?? "", { tabIndex: 0, onclick: go, onkeydown: (event) => event.key === "Enter" && go() },
        `${move.instruction ?? ""} ${move.target}`.trim(), move.confdata?.join(" ") ?? "",
        own.length || !move.unchecked ? own.map((it) => this.said(it)) : "not checked",
      ));
    }
    const moving = new Map(moves.map((it) => [place(it), it]));
    for (const it of this.found.filter((one) => !moving.has(place(one))).slice(0, MOST_ROWS)) {
      rows.push(row(it, it.severity, { onclick: () => this.show(it) }, "", "", this.said(it)));
    }
    this.list.replaceChildren(...rows);
    this.marks = this.found.slice(0, MOST_MARKS).flatMap((it) => {
      const q = moving.get(place(it))?.q;
      const color = SEVERITY_COLORS[it.severity];
      return q && color ? [{ ...it, q, color }] : [];
    });
  }

  // A finding, and the lines that correct it.
  said({ code, message, edits }) {
    const lines = this.bytes.flatMap((it, module) => corrected(it, edits.filter((one) => one.module === module)));
    return el("div", {}, el("b", {}, code), ` ${message}`,
      ...lines.map((line) => el("code", { className: "dim" }, `fix: ${line}`)));
  }

  // The way of the program's tool, and the findings at the ends of their moves.
  paths() {
    const { arm, view } = this.app;
    const way = this.motion?.way ?? [];
    const count = way.length / 3;
    const each = Math.max(1, Math.floor(count / 800));
    view.way = segments(Array.from({ length: Math.ceil(count / each) }, (_, i) => way.slice(3 * each * i, 3 * each * i + 3)));
    const ends = new Map((this.motion?.places ?? []).map((it, i) => [`${it.module}:${it.line}`, 3 * i]));
    view.marks = this.marks.map(({ module, line, code, message, q, color }) => {
      const end = ends.get(`${module}:${line}`);
      const at = end === undefined ? place(arm.frames(q).tool) : way.slice(end, end + 3);
      return { at, color, text: `${line}: ${code} ${message}`, go: () => this.go({ module, line, q }) };
    });
  }

  go(move) {
    this.stop();
    this.show(move);
    if (move.q) this.app.setJoints(move.q);
    const at = this.motion?.moves.find((it) => it.module === move.module && it.line === move.line);
    if (at) this.time(at.end);
  }

  // The posture at a time.
  at(t) {
    const { motion } = this;
    const { dof } = this.app.robot;
    this.time(t);
    let after = motion.t.findIndex((it) => it >= t);
    if (after < 0) after = motion.t.length - 1;
    const before = Math.max(0, after - 1);
    const span = motion.t[after] - motion.t[before];
    const part = span > 0 ? (t - motion.t[before]) / span : 1;
    const [from, to] = [before, after].map((it) => motion.q.slice(dof * it, dof * (it + 1)));
    this.app.setJoints(from.map((it, i) => it + part * (to[i] - it)), { light: this.isPlaying });
    this.show(motion.places[after]);
  }

  time(t) {
    const { duration } = this.motion;
    this.slider.max = duration;
    this.slider.value = t;
    this.clock.textContent = `${t.toFixed(2)} of ${duration.toFixed(2)} s`;
  }

  // The source line of a place.
  show(place) {
    const { module, line } = place ?? {};
    const shown = `${module}:${line}`;
    if (this.shown === shown) return;
    this.shown = shown;
    if (line && this.modules && module !== this.module) this.turnTo(module);
    this.source.go(line);
    for (const row of this.list.children) {
      const isOwn = Number(row.dataset.module) === module && Number(row.dataset.line) === line;
      row.classList.toggle("here", isOwn);
      if (isOwn && this.isPlaying) row.scrollIntoView({ block: "nearest" });
    }
  }

  toggle() {
    if (!this.motion) return;
    if (this.isPlaying) {
      this.stop();
      return;
    }
    this.isPlaying = true;
    this.button.textContent = "pause";
    let last = performance.now();
    const begin = Number(this.slider.value) >= this.motion.duration ? 0 : Number(this.slider.value);
    this.at(begin);
    const step = (now) => {
      if (!this.isPlaying) return;
      // A tab in the background comes back where it was.
      const t = Number(this.slider.value) + Math.min(now - last, 100) / 1e3;
      last = now;
      this.at(Math.min(t, this.motion.duration));
      if (t >= this.motion.duration) this.stop();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  stop() {
    if (this.isPlaying) this.app.settled();
    this.isPlaying = false;
    this.button.textContent = "play";
  }
}
