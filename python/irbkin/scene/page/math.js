// Rigid transforms as 16 numbers, column by column as WebGL takes them; poses of the engine are 12
// numbers, the first three rows.

const identity = () => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

const fromRows = (rows) => [
  rows[0], rows[4], rows[8], 0, rows[1], rows[5], rows[9], 0,
  rows[2], rows[6], rows[10], 0, rows[3], rows[7], rows[11], 1,
];

const toRows = (m) => [
  m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13], m[2], m[6], m[10], m[14],
];

const same = (a, b) => a.length === b.length && a.every((it, i) => Math.abs(it - b[i]) < 1e-12);

// A way through points as pairs of them.
const segments = (points) => points.slice(1).flatMap((it, i) => [points[i], it]);

function multiply(a, b) {
  const product = new Array(16);
  for (let column = 0; column < 4; column++) {
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += a[4 * k + row] * b[4 * column + k];
      product[4 * column + row] = sum;
    }
  }
  return product;
}

const chain = (...all) => all.reduce(multiply);

// The inverse of a rigid transform.
function inverse(m) {
  const back = [m[0], m[4], m[8], 0, m[1], m[5], m[9], 0, m[2], m[6], m[10], 0, 0, 0, 0, 1];
  for (let row = 0; row < 3; row++) {
    back[12 + row] = -(back[row] * m[12] + back[4 + row] * m[13] + back[8 + row] * m[14]);
  }
  return back;
}

// The turn about a unit vector.
function about(axis, angle) {
  const [x, y, z] = axis;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const d = 1 - c;
  return [
    d * x * x + c, d * x * y + s * z, d * x * z - s * y, 0,
    d * x * y - s * z, d * y * y + c, d * y * z + s * x, 0,
    d * x * z + s * y, d * y * z - s * x, d * z * z + c, 0,
    0, 0, 0, 1,
  ];
}

const place = (m) => [m[12], m[13], m[14]];
const axisOf = (m, column) => [m[4 * column], m[4 * column + 1], m[4 * column + 2]];

const moved = (m, point) => [0, 1, 2].map(
  (row) => m[row] * point[0] + m[4 + row] * point[1] + m[8 + row] * point[2] + m[12 + row],
);

const add = (a, b) => a.map((it, i) => it + b[i]);
const subtract = (a, b) => a.map((it, i) => it - b[i]);
const scale = (a, factor) => a.map((it) => factor * it);
const dot = (a, b) => a.reduce((sum, it, i) => sum + it * b[i], 0);
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];
const length = (a) => Math.sqrt(dot(a, a));
const unit = (a) => (length(a) > 0 ? scale(a, 1 / length(a)) : [0, 0, 1]);

// How far a point of the screen is from a line between two others.
function fromLine(at, a, b) {
  const [u, v] = [b[0] - a[0], b[1] - a[1]];
  const part = ((at[0] - a[0]) * u + (at[1] - a[1]) * v) / (u * u + v * v || 1);
  const along = Math.min(Math.max(part, 0), 1);
  return Math.hypot(at[0] - a[0] - along * u, at[1] - a[1] - along * v);
}

const toRadians = (degrees) => (degrees * Math.PI) / 180;
const toDegrees = (radians) => (radians * 180) / Math.PI;

// A pose of a position and ZYX angles [rad].
function fromEuler(xyz, [rz, ry, rx]) {
  const m = chain(about([0, 0, 1], rz), about([0, 1, 0], ry), about([1, 0, 0], rx));
  [m[12], m[13], m[14]] = xyz;
  return m;
}

function toEuler(m) {
  const ry = Math.atan2(-m[2], Math.hypot(m[0], m[1]));
  // At a quarter turn about y only one of the other two is determined.
  if (Math.hypot(m[0], m[1]) < 1e-9) return [Math.atan2(-m[4], m[5]), ry, 0];
  return [Math.atan2(m[1], m[0]), ry, Math.atan2(m[6], m[10])];
}

function fromQuaternion(xyz, [w, x, y, z]) {
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0,
    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0,
    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0,
    ...xyz, 1,
  ];
}

function toQuaternion(m) {
  const [xx, yy, zz] = [m[0], m[5], m[10]];
  const squares = [1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz];
  const largest = squares.indexOf(Math.max(...squares));
  const size = 2 * Math.sqrt(squares[largest]);
  const differences = [m[6] - m[9], m[8] - m[2], m[1] - m[4]];
  const sums = { 12: m[1] + m[4], 13: m[2] + m[8], 23: m[6] + m[9] };
  const q = [0, 1, 2, 3].map((index) => {
    if (index === largest) return size / 4;
    if (largest === 0) return differences[index - 1] / size;
    if (index === 0) return differences[largest - 1] / size;
    return sums[`${Math.min(index, largest)}${Math.max(index, largest)}`] / size;
  });
  return q[0] < 0 ? scale(q, -1) : q;
}
