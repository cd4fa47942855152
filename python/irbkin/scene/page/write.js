// Joints and poses as text of other programs.

const trimmed = (number, digits) => {
  const text = number.toFixed(digits).replace(/\.?0+$/, "");
  return text === "-0" ? "0" : text;
};
const listed = (numbers, digits) => numbers.map((it) => trimmed(it, digits)).join(", ");

function asPython(state) {
  const { name, q, T } = state;
  const frames = [
    ["with_tool", state.tool], ["with_base", state.base],
  ].filter(([, it]) => !isIdentity(it));
  const { urdf, tip } = state.source ?? {};
  const end = tip ? `, tip=${JSON.stringify(tip)}` : "";
  const made = urdf ? `Robot.from_urdf("arm.urdf"${end})` : `Robot(${JSON.stringify(name)})`;
  const calls = frames.map(([call, it]) => `.${call}(irbkin.pose(${python(it)}))`).join("");
  return [
    "import irbkin",
    `robot = irbkin.${made}${calls}`,
    `q = [${listed(q, 9)}]  # rad`,
    `T = irbkin.pose(${python(T)})`,
    `print(robot.ik(T${q.length === 7 ? ", q7=q[6]" : ""}))`,
    "",
  ].join("\n");
}

const python = (T) => `[${listed(place(T), 9)}], wxyz=[${listed(toQuaternion(T), 9)}]`;

function asRapid(state) {
  const { q, T, wobj, robot, confdata } = state;
  const away = "9E9,9E9,9E9,9E9,9E9,9E9";
  const degrees = q.map(toDegrees).map((it) => trimmed(it, 4));
  const own = q.length === 7 ? [0, 1, 3, 4, 5, 6].map((it) => degrees[it]) : degrees;
  const axes = q.length === 7 ? `${degrees[2]}${away.slice(3)}` : away;
  const joints = `CONST jointtarget jHere:=[[${own.join(",")}],[${axes}]];\n`;
  if (!robot.has_confdata) return joints;
  const pose = multiply(inverse(wobj), T);
  const xyz = scale(place(pose), 1e3).map((it) => trimmed(it, 3));
  const wxyz = toQuaternion(pose).map((it) => trimmed(it, 7));
  const external = state.armAngle === null ? away : `${trimmed(toDegrees(state.armAngle), 4)}${away.slice(3)}`;
  const target = `[[${xyz}],[${wxyz}],[${confdata ?? [0, 0, 0, 0]}],[${external}]]`;
  return `CONST robtarget pHere:=${target};\n${joints}`;
}

function asCsv(state) {
  const joints = state.q.map((_, index) => `q${index + 1}_deg`);
  const head = ["slot", ...joints, "within_limits"].join(",");
  const rows = state.solutions.map((it) => [
    it.slot, ...it.q.map((angle) => trimmed(toDegrees(angle), 6)), it.within_limits,
  ].join(","));
  return `${[head, ...rows].join("\n")}\n`;
}

const isIdentity = (m) => m.every((it, i) => Math.abs(it - identity()[i]) < 1e-12);

// The state as the part of an address behind #: the arm, joints [deg], tool, base, work object.
function asHash(state) {
  const parts = { arm: state.name, q: state.q.map((it) => trimmed(toDegrees(it), 4)).join(",") };
  for (const frame of ["tool", "base", "wobj"]) {
    if (!isIdentity(state[frame])) parts[frame] = frameNumbers(state[frame]).join(",");
  }
  return new URLSearchParams(parts).toString();
}

const asLink = (state) => `${location.href.split("#")[0]}#${asHash(state)}`;

// A frame as x y z [mm] and rz ry rx [deg].
const frameNumbers = (m) => [
  ...scale(place(m), 1e3).map((it) => trimmed(it, 4)),
  ...toEuler(m).map((it) => trimmed(toDegrees(it), 5)),
];

function fromHash(hash) {
  const parts = new URLSearchParams(hash.replace(/^#/, ""));
  const frame = (name) => {
    const numbers = numbersOf(parts.get(name) ?? "");
    if (numbers.length !== 6) return identity();
    return fromEuler(scale(numbers.slice(0, 3), 1e-3), numbers.slice(3).map(toRadians));
  };
  return {
    name: parts.get("arm"),
    q: numbersOf(parts.get("q") ?? "").map(toRadians),
    tool: frame("tool"),
    base: frame("base"),
    wobj: frame("wobj"),
  };
}
