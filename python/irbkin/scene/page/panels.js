// The panels beside the picture.

function panels(app) {
  const units = () => app.units;
  const parts = {};

  parts.arm = el("input", {
    type: "search", list: "irbkin-arms", ariaLabel: "arm", spellcheck: false, className: "arm",
    onchange: () => app.guard(parts.armWords, () => app.changeArm({ name: parts.arm.value })),
    onfocus: () => parts.arm.select(),
  });
  parts.arms = el("datalist", { id: "irbkin-arms" });
  parts.armWords = el("p", { className: "dim words-of-arm" });

  parts.paste = el("textarea", {
    rows: 2, spellcheck: false, ariaLabel: "paste a target, a tool, a pose, joints or a module",
    placeholder: "Paste a robtarget, tooldata, wobjdata, a module, a pose (x y z rz ry rx), a matrix or joints",
    oninput: () => app.paste(parts.paste.value),
  });
  parts.pasteWords = el("p", { className: "dim", ariaLive: "polite" });

  parts.pose = new FrameFields("pose of the tool", units, (pose) => app.setPose(multiply(app.state.wobj, pose)));
  parts.verdict = el("p", { className: "verdict", ariaLive: "polite" });
  parts.joints = el("div", { className: "joints" });
  parts.facts = el("dl", { className: "facts" });
  parts.solutions = el("tbody");
  parts.copied = el("span", { className: "dim", ariaLive: "polite" });
  parts.frames = ["tool", "base", "wobj"].map((name) => {
    const title = { tool: "Tool, seen from the flange", base: "Base, seen from the world", wobj: "Work object, seen from the world" }[name];
    const fields = new FrameFields(title, units, (pose) => app.setFrame(name, pose));
    return { name, fields, node: el("div", {}, el("h3", {}, title), fields.node) };
  });
  parts.notes = el("ul", { className: "notes" });
  const toggle = (name) => el("input", {
    type: "checkbox", checked: app.settings[name], onchange: ({ target }) => { app.settings[name] = target.checked; app.view.ask(); },
  });
  [parts.ghosts, parts.capsules] = ["ghosts", "capsules"].map(toggle);
  parts.units = el("select", { ariaLabel: "units", onchange: () => app.setUnits(parts.units.value) },
    el("option", { value: "mm" }, "mm, deg"), el("option", { value: "m" }, "m, rad"));
  const copy = (name, write) => el("button", { type: "button", onclick: () => app.copy(name, write) }, name);
  parts.file = el("input", {
    type: "file", multiple: true, hidden: true, accept: ".urdf,.mod,.modx,.prg,.sys,.json,.xml",
    onchange: () => { app.drop([...parts.file.files]); parts.file.value = ""; },
  });

  parts.node = el("aside", {},
    el("section", {},
      el("div", { className: "row" }, parts.arm, parts.arms, parts.units,
        el("button", { type: "button", onclick: () => parts.file.click(), title: "a URDF of your arm, a RAPID module, a scene" }, "open"), parts.file),
      parts.armWords,
      parts.paste, parts.pasteWords),
    el("section", {},
      el("h2", {}, "Tool ", parts.seen = el("span", { className: "dim" })), parts.pose.node, parts.verdict),
    el("section", { className: "solved" },
      el("h2", {}, "Solutions ",
        el("label", { className: "switch" }, parts.ghosts, " ghosts"),
        el("label", { className: "switch", title: "capsules, which are compared first" }, parts.capsules, " collision shapes")),
      el("div", { className: "scroll" }, el("table", { className: "solutions" },
        el("thead", {}, parts.head = el("tr")), parts.solutions))),
    el("section", {}, el("h2", {}, "Joints"), parts.joints, parts.facts),
    el("section", {}, el("h2", {}, "Copy"),
      el("div", { className: "row" }, copy("Python", asPython), copy("RAPID", asRapid), copy("CSV", asCsv),
        app.options.hash === undefined ? null : copy("link", asLink), parts.copied)),
    el("details", { className: "solved" }, el("summary", {}, "Tool, base, work object"), ...parts.frames.map((it) => it.node)),
    el("details", {}, el("summary", {}, "Keys"),
      el("p", { className: "dim" },
        "1 to 9: a solution; [ and ]: the one before, the next; space: play; f: fit; g: ghosts; with the picture "
        + "in focus, arrows and page up, page down: move the tool by 10 mm, with shift by 1 mm.")),
    parts.notes);
  return parts;
}

// Whether a joint is beyond its limits, of which one that does not exist is null.
const isOutside = (angle, [low, high]) => angle < (low ?? -Infinity) - 1e-9 || angle > (high ?? Infinity) + 1e-9;

// A slider and a field for each joint.
function jointRows(app) {
  return app.robot.limits.map(([low, high], joint) => {
    const bounded = low !== null && high !== null;
    const [from, to] = bounded ? [low, high] : [-Math.PI, Math.PI];
    const set = (angle) => {
      const q = app.state.q.slice();
      q[joint] = angle;
      app.setJoints(q);
    };
    const slider = el("input", {
      type: "range", min: from, max: to, step: "any", ariaLabel: `J${joint + 1}`,
      oninput: () => set(Number(slider.value)),
    });
    const field = numberField(`J${joint + 1}`, {
      onvalue: (value) => set(app.units.toRadians(value)), bound: 36000,
      step: () => (app.units.angle === "deg" ? 1 : 0.01),
    });
    const node = el("div", { className: "joint" }, field.node, slider);
    const show = (angle) => {
      slider.value = angle;
      field.show(app.units.fromRadians(angle), app.units.digits[1]);
      node.classList.toggle("outside", isOutside(angle, [low, high]));
      node.title = bounded
        ? `${trimmed(app.units.fromRadians(low), 2)} .. ${trimmed(app.units.fromRadians(high), 2)} ${app.units.angle}`
        : "without limits";
    };
    return { node, show };
  });
}

// The rows of the table of solutions.
function solutionRows(app) {
  const { state, robot, units } = app;
  const joints = robot.limits.map((_, joint) => `J${joint + 1}`);
  app.parts.head.replaceChildren(...["slot", robot.has_confdata ? "confdata" : "", ...joints].map((it) => el("th", {}, it)));
  return state.solutions.map((it, index) => {
    const outside = it.q.map((angle, joint) => isOutside(angle, robot.limits[joint]));
    // Joints that are outside are red; a linkage between two of them is none of them.
    const flags = [
      it.within_limits || outside.includes(true) ? "" : "outside",
      ...it.singularities,
      it.free_joint ?? "",
      it.collides ? "collides" : "",
    ].filter(Boolean).join(", ");
    return el("tr", {
      tabIndex: 0, title: it.words ?? "",
      className: [index === state.own ? "own" : "", it.within_limits ? "" : "faint"].join(" ").trim(),
      onclick: () => app.choose(index),
      onkeydown: (event) => event.key === "Enter" && app.choose(index),
      onpointerenter: () => { app.view.hover = index; app.view.ask(); },
      onpointerleave: () => { app.view.hover = null; app.view.ask(); },
    },
    el("td", {}, String(it.slot)),
    el("td", {}, it.confdata?.join(" ") ?? "",
      el("div", { className: it.collides || !it.within_limits ? "bad" : "dim" }, flags)),
    ...it.q.map((angle, joint) => el("td", { className: outside[joint] ? "angle bad" : "angle" },
      units.fromRadians(angle).toFixed(units.angle === "deg" ? 1 : 3).replace(/^-(0\.0+)$/, "$1"))));
  });
}
