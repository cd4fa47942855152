// A module of RAPID: its moves as a table with findings, played back on a slider.

class Program {
  constructor(app) {
    this.app = app;
    this.slider = el("input", {
      type: "range", min: 0, max: 1, step: "any", value: 0, ariaLabel: "time",
      oninput: () => this.at(Number(this.slider.value)),
    });
    this.clock = el("span", { className: "clock" });
    this.button = el("button", { type: "button", onclick: () => this.toggle(), title: "space" }, "play");
    this.line = el("pre", { className: "source", ariaLive: "off" });
    this.list = el("tbody");
    this.words = el("p", { className: "dim" });
    this.node = el("section", { className: "program", hidden: true },
      el("h2", {}, "Program ", this.title = el("span", { className: "dim" })),
      this.words,
      this.player = el("div", { className: "player" }, this.button, this.slider, this.clock),
      this.line,
      el("div", { className: "moves" }, el("table", {},
        el("thead", {}, el("tr", {}, ...["line", "move", "confdata", "finding"].map((it) => el("th", {}, it)))),
        this.list)),
    );
  }

  open(name, text) {
    this.name = name;
    this.text = text;
    this.lines = text.split("\n");
    this.read();
  }

  // A motion of a scene is of its arm alone.
  forgetMotion() {
    this.stop();
    if (this.text === undefined) {
      this.motion = null;
      this.node.hidden = true;
    }
  }

  close() {
    this.text = undefined;
    this.forgetMotion();
  }

  // Play a motion of a scene.
  openMotion(name, motion) {
    if (!motion.t.length) return;
    this.stop();
    this.shown = null;
    this.name = name;
    this.text = undefined;
    this.title.textContent = name;
    this.words.textContent = "";
    this.list.replaceChildren();
    this.lines = (motion.source ?? "").split("\n");
    const duration = motion.t.at(-1);
    this.motion = { t: motion.t, q: motion.q.flat(), lines: motion.lines ?? [], duration, moves: [] };
    this.node.hidden = false;
    this.player.hidden = false;
    this.at(0);
  }

  // Check the module with the arm as it is; `stays` where the motion is.
  read(stays = false) {
    if (this.text === undefined) return;
    this.stop();
    this.shown = null;
    this.line.textContent = "";
    const { engine } = this.app;
    this.motion = null;
    this.node.hidden = false;
    this.title.textContent = this.name;
    let checked;
    try {
      checked = engine.ask({ do: "check", module: this.text, collide: this.app.view.obstacles.length > 0 });
    } catch (fault) {
      this.words.textContent = `${this.name} cannot be checked: ${fault.message}`;
      this.list.replaceChildren();
      this.player.hidden = true;
      return;
    }
    let why = "";
    try {
      this.motion = engine.ask({ do: "motion" });
    } catch (fault) {
      why = ` It is not played: ${fault.message}.`;
    }
    const shown = checked.findings.filter((it) => it.shown);
    const unchecked = checked.moves.filter((it) => it.unchecked).length;
    const errors = shown.filter((it) => it.severity === "error").length;
    this.words.textContent = `${checked.moves.length - unchecked} of ${checked.moves.length} moves `
      + `checked, ${errors} ${errors === 1 ? "error" : "errors"}, ${shown.length - errors} other findings`
      + `${checked.faults.length ? `, ${checked.faults.length} statements not read` : ""}.${why}`;
    this.player.hidden = !this.motion;
    this.fill(checked, shown);
    this.paths();
    if (this.motion && !stays) this.at(0);
  }

  fill(checked, shown) {
    const rows = [];
    for (const move of checked.moves.slice(0, 3000)) {
      const own = shown.filter((it) => it.line === move.line && it.column === move.column);
      const worst = ["error", "warning", "note"].find((it) => own.some((one) => one.severity === it));
      rows.push(el("tr", {
        className: worst ?? "", tabIndex: 0, "data-line": move.line,
        onclick: () => this.go(move), onkeydown: (event) => event.key === "Enter" && this.go(move),
      },
      el("td", {}, String(move.line)),
      el("td", {}, `${move.instruction ?? ""} ${move.target}`.trim()),
      el("td", {}, move.confdata ? move.confdata.join(" ") : ""),
      el("td", {}, ...own.map((it) => el("div", {}, el("b", {}, it.code), ` ${it.message}`)),
        own.length || !move.unchecked ? "" : "not checked")));
    }
    for (const fault of checked.faults) {
      rows.push(el("tr", { className: "error" }, el("td", {}, String(fault.line)),
        el("td", {}, ""), el("td", {}, ""), el("td", {}, fault.message)));
    }
    this.list.replaceChildren(...rows);
    if (checked.moves.length > 3000) {
      this.words.textContent += ` The table has the first 3000.`;
    }
    this.marks = shown.slice(0, 300).flatMap((it) => {
      const move = checked.moves.find((one) => one.line === it.line && one.column === it.column);
      const color = SEVERITY_COLORS[it.severity];
      return move?.q && color ? [{ q: move.q, color }] : [];
    });
  }

  // The way of the tool, and the places of findings.
  paths() {
    const { arm } = this.app;
    const way = [];
    const { dof } = this.app.robot;
    if (this.motion) {
      const count = this.motion.t.length;
      const each = Math.max(1, Math.floor(count / 800));
      for (let i = 0; i < count; i += each) {
        way.push(place(arm.frames(this.motion.q.slice(dof * i, dof * (i + 1))).tool));
      }
    }
    this.app.view.way = way;
    this.app.view.marks = (this.marks ?? []).map((it) => ({ at: place(arm.frames(it.q).tool), color: it.color }));
  }

  go(move) {
    this.stop();
    this.show(move.line);
    if (move.q) this.app.setJoints(move.q);
    const at = this.motion?.moves.find((it) => it.line === move.line);
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
    this.show(motion.lines[after]);
  }

  time(t) {
    const { duration } = this.motion;
    this.slider.max = duration;
    this.slider.value = t;
    this.clock.textContent = `${t.toFixed(2)} of ${duration.toFixed(2)} s`;
  }

  show(line) {
    if (this.shown === line) return;
    this.shown = line;
    this.line.textContent = line ? `${line}  ${(this.lines[line - 1] ?? "").trim()}` : "";
    for (const row of this.list.children) {
      const isOwn = Number(row.dataset.line) === line;
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
