// The meaning of a pasted text: a target of RAPID, a pose in numbers, a joint vector.

const NUMBER = /[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/g;
const DECLARED = /\b(robtarget|jointtarget|tooldata|wobjdata)\b/i;

// A literal of a target has groups of 3, 4, 4 and 6 numbers, or of 6 and 6; of a tool or a work object
// it begins with a truth.
const isTarget = (text) => DECLARED.test(text) || /^\[\s*(TRUE|FALSE)\b/i.test(text) || /^(3,4,4,6|6,6)$/.test(
  (text.match(/\[[^[\]]*\]/g) ?? []).map((it) => it.split(",").length).join(),
);

const numbersOf = (text) => (text.match(NUMBER) ?? []).map(Number);

// { kind: "joints", q }, { kind: "pose", T }, { kind: "rapid", text } or { kind: "program", text };
// throws a sentence otherwise.
function meaningOf(text, dof, units) {
  // Without comments of RAPID.
  const trimmed = text.replace(/![^\n]*/g, "").trim();
  if (!trimmed) throw new Error("");
  if (/^[ \t]*(MODULE|(LOCAL\s+)?PROC)\b/im.test(trimmed)) return { kind: "program", text };
  if (isTarget(trimmed) && !/\b(Offs|RelTool)\s*\(/i.test(trimmed)) return { kind: "rapid", text: declared(trimmed) };
  const unlabeled = trimmed.replace(/\b[A-Za-z]\w*\s*[:=]/g, " ");
  if (/[a-df-zA-DF-Z_]{2,}/.test(unlabeled.replace(/array|np|deg|rad|mm|pose|xyz|wxyz|euler/gi, ""))) {
    throw new Error(`"${trimmed.slice(0, 40)}" is no target, no pose and no joint vector`);
  }
  if (/\b(Offs|RelTool)\s*\(/i.test(trimmed)) throw new Error("Offs and RelTool are not calculated here: open the module");
  const numbers = numbersOf(unlabeled);
  const wrong = numbers.findIndex((it) => !Number.isFinite(it) || Math.abs(it) > 1e6);
  if (wrong >= 0) throw new Error(`number ${wrong + 1} is ${numbers[wrong]}: it must be at most 1e6`);
  const meters = units.length === "mm" ? 1e-3 : 1;
  const turn = units.angle === "deg" ? toRadians : (it) => it;
  if (numbers.length === 16 || numbers.length === 12) {
    const rows = numbers.slice(0, 12);
    const last = numbers.length === 16 ? numbers.slice(12) : [0, 0, 0, 1];
    if (last.join() !== "0,0,0,1") {
      throw new Error(`the last row of the matrix is ${last.join(" ")}, it must be 0 0 0 1`);
    }
    // A matrix is in meters, unless its lengths are too large for an arm.
    const long = Math.max(...[3, 7, 11].map((i) => Math.abs(rows[i])));
    for (const i of [3, 7, 11]) rows[i] *= long > 20 ? 1e-3 : 1;
    return { kind: "pose", T: fromRows(rows), form: "a 4x4 matrix" };
  }
  if (numbers.length === 7 && (dof === 6 || isUnit(numbers.slice(3)))) {
    const size = Math.hypot(...numbers.slice(3));
    if (Math.abs(size - 1) > 0.02) {
      throw new Error(`the quaternion w, x, y, z has length ${size.toFixed(3)}, it must be 1`);
    }
    const q = scale(numbers.slice(3), 1 / size);
    const T = fromQuaternion(scale(numbers.slice(0, 3), meters), q);
    return { kind: "pose", T, form: `x y z [${units.length}] and a quaternion w x y z` };
  }
  if (numbers.length === dof && !(dof === 6 && isPose(numbers, units))) {
    return { kind: "joints", q: numbers.map(turn), form: `${dof} joint angles [${units.angle}]` };
  }
  if (numbers.length === 6) {
    const T = fromEuler(scale(numbers.slice(0, 3), meters), numbers.slice(3).map(turn));
    return { kind: "pose", T, form: `x y z [${units.length}] and rz ry rx [${units.angle}]` };
  }
  throw new Error(
    `${numbers.length} numbers: a pose has 6, 7 or 16, a joint vector of this arm has ${dof}`,
  );
}

// Whether six numbers are a position and angles: no joint turns so far.
function isPose(numbers, units) {
  const most = units.length === "mm" ? 720 : 4 * Math.PI;
  return numbers.slice(0, 3).some((it) => Math.abs(it) > most);
}

const isUnit = (numbers) => Math.abs(Math.hypot(...numbers) - 1) < 0.02;

// A declaration or a literal, without the instruction around it.
function declared(text) {
  const declaration = text.match(/((?:LOCAL\s+|TASK\s+)?(?:CONST|PERS|VAR)\s+(?:robtarget|jointtarget|tooldata|wobjdata)\s[\s\S]*?;)/i);
  if (declaration) return `MODULE M\n${declaration[1]}\nENDMODULE`;
  const begin = text.indexOf("[");
  let depth = 0;
  for (let end = begin; end < text.length; end++) {
    depth += { "[": 1, "]": -1 }[text[end]] ?? 0;
    if (depth === 0) return text.slice(begin, end + 1);
  }
  return text;
}
