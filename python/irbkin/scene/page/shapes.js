// Triangles of the shapes that a scene has: { position, normal, index } as flat lists.

// Corners around an axis, and rings of a round end: of what is looked at, and of faint copies.
const FINE = { round: 24, caps: 5, bends: 1 };
const COARSE = { round: 8, caps: 2, bends: 0 };

function joined(meshes) {
  const whole = { position: [], normal: [], index: [] };
  for (const mesh of meshes) {
    const begin = whole.position.length / 3;
    for (const it of mesh.position) whole.position.push(it);
    for (const it of mesh.normal) whole.normal.push(it);
    for (const it of mesh.index) whole.index.push(begin + it);
  }
  return whole;
}

// Two unit vectors square to one.
function sides(along) {
  const other = Math.abs(along[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const first = unit(cross(other, along));
  return [first, cross(along, first)];
}

// A surface of rings: each has a point on the axis, a radius, and the slope of its normal.
function rings(along, list, round = FINE.round) {
  const [u, v] = sides(along);
  const mesh = { position: [], normal: [], index: [] };
  list.forEach(({ center, radius, slope }, ring) => {
    for (let step = 0; step <= round; step++) {
      const angle = (2 * Math.PI * step) / round;
      const out = add(scale(u, Math.cos(angle)), scale(v, Math.sin(angle)));
      mesh.position.push(...add(center, scale(out, radius)));
      mesh.normal.push(...add(scale(out, Math.cos(slope)), scale(along, Math.sin(slope))));
    }
    if (ring === 0) return;
    const row = round + 1;
    for (let step = 0; step < round; step++) {
      const [a, b] = [(ring - 1) * row + step, ring * row + step];
      mesh.index.push(a, a + 1, b, b, a + 1, b + 1);
    }
  });
  return mesh;
}

function capsuleMesh({ a, b, radius }, { round, caps } = FINE) {
  const along = unit(subtract(b, a));
  const list = [];
  for (let step = 0; step <= 2 * caps; step++) {
    const slope = (Math.PI * (step - caps)) / (2 * caps);
    const [end, half] = step <= caps ? [a, slope] : [b, slope];
    const ring = (center) => ({
      center: add(center, scale(along, radius * Math.sin(half))),
      radius: radius * Math.cos(half),
      slope: half,
    });
    list.push(ring(end));
    if (step === caps) list.push(ring(b));
  }
  return rings(along, list, round);
}

// Faces that meet at less than this look round [1].
const SMOOTH = Math.cos(toRadians(42));

// A hull as a solid: its points moved out by the radius along their mean normals, with normals that
// are even across edges which look round. Finer, faces between such edges are bent.
function hullMesh({ points, faces, radius }, { bends } = FINE) {
  if (!faces.length) return capsuleMesh({ a: points[0], b: points.at(-1), radius });
  const flat = faces.map(([a, b, c]) => unit(
    cross(subtract(points[b], points[a]), subtract(points[c], points[a])),
  ));
  // The corners of faces, each 3 * face + side; those at one point that round edges join are one.
  const joinedTo = faces.flatMap((_, face) => [0, 1, 2].map((side) => 3 * face + side));
  const root = (at) => (joinedTo[at] === at ? at : root(joinedTo[at]));
  const edges = new Map();
  const outward = points.map(() => [0, 0, 0]);
  const weighted = faces.flatMap((face, own) => face.map((from, side) => {
    const [next, last] = [(side + 1) % 3, (side + 2) % 3];
    const other = edges.get(`${face[next]},${from}`);
    edges.set(`${from},${face[next]}`, [own, 3 * own + side, 3 * own + next]);
    if (other && dot(flat[own], flat[other[0]]) > SMOOTH) {
      joinedTo[root(3 * own + side)] = root(other[2]);
      joinedTo[root(3 * own + next)] = root(other[1]);
    }
    const sides = [next, last].map((it) => unit(subtract(points[face[it]], points[from])));
    const normal = scale(flat[own], Math.acos(Math.min(Math.max(dot(...sides), -1), 1)));
    outward[from] = add(outward[from], normal);
    return normal;
  }));
  const [position, normals, number] = [[], [], new Map()];
  const index = weighted.map((normal, at) => {
    const [corner, point] = [root(at), faces[Math.floor(at / 3)][at % 3]];
    if (!number.has(corner)) {
      number.set(corner, position.length);
      position.push(add(points[point], scale(unit(outward[point]), radius)));
      normals.push([0, 0, 0]);
    }
    const own = number.get(corner);
    normals[own] = add(normals[own], normal);
    return own;
  });
  const made = { position, normals: normals.map(unit), index };
  for (let step = 0; step < bends; step++) bend(made, radius);
  return { position: made.position.flat(), normal: made.normals.flat(), index: made.index };
}

// Divide each triangle in four. The middle of an edge that looks round, which both faces beside it
// share, is moved towards the planes that its ends have by their normals, by the radius at most.
function bend(made, radius) {
  const { position, normals, index } = made;
  const sides = index.map((from, at) => [from, index[at % 3 === 2 ? at - 2 : at + 1]]);
  const all = new Set(sides.map((it) => it.join()));
  const middles = new Map();
  const middle = ([a, b]) => {
    const key = `${Math.min(a, b)},${Math.max(a, b)}`;
    if (!middles.has(key)) {
      const at = scale(add(position[a], position[b]), 0.5);
      const up = (end) => scale(normals[end], 0.4 * dot(subtract(position[end], at), normals[end]));
      const shift = all.has(`${b},${a}`) ? add(up(a), up(b)) : [0, 0, 0];
      middles.set(key, position.length);
      position.push(add(at, scale(shift, Math.min(1, radius / (length(shift) || 1)))));
      normals.push(unit(add(normals[a], normals[b])));
    }
    return middles.get(key);
  };
  made.index = index.flatMap((a, at) => {
    if (at % 3) return [];
    const [ab, bc, ca] = [0, 1, 2].map((side) => middle(sides[at + side]));
    return [a, ab, ca, ab, index[at + 1], bc, ca, bc, index[at + 2], ab, bc, ca];
  });
}

// How far along a ray a mesh is met first; Infinity if it is not.
function metAt({ position, index }, from, along) {
  const corner = (at) => position.slice(3 * index[at], 3 * index[at] + 3);
  let nearest = Infinity;
  for (let at = 0; at < index.length; at += 3) {
    const a = corner(at);
    const [u, v, w] = [subtract(corner(at + 1), a), subtract(corner(at + 2), a), subtract(from, a)];
    const [p, q] = [cross(along, v), cross(w, u)];
    const scaled = 1 / dot(u, p);
    const [x, y, far] = [scaled * dot(w, p), scaled * dot(along, q), scaled * dot(v, q)];
    if (x >= 0 && y >= 0 && x + y <= 1 && far > 0 && far < nearest) nearest = far;
  }
  return nearest;
}

function cylinderMesh({ radius, length: long }) {
  const [low, high] = [[0, 0, -long / 2], [0, 0, long / 2]];
  const flat = (center, slope, size) => ({ center, radius: size, slope });
  return rings([0, 0, 1], [
    flat(low, -Math.PI / 2, 0), flat(low, -Math.PI / 2, radius),
    flat(low, 0, radius), flat(high, 0, radius),
    flat(high, Math.PI / 2, radius), flat(high, Math.PI / 2, 0),
  ]);
}

function boxMesh({ size }) {
  const corner = (at) => size.map((it, axis) => (((at >> axis) & 1) - 0.5) * it);
  return trianglesMesh([0, 1, 2].flatMap((axis) => [0, 1].flatMap((side) => {
    const [u, v] = [1, 2].map((it) => 1 << ((axis + (side ? it : 3 - it)) % 3));
    const a = side << axis;
    return [[a, a + u, a + v], [a + u, a + u + v, a + v]].map((it) => it.map(corner));
  })));
}

function trianglesMesh(triangles) {
  const position = triangles.flat(2);
  const normal = triangles.flatMap(([a, b, c]) => {
    const own = unit(cross(subtract(b, a), subtract(c, a)));
    return [...own, ...own, ...own];
  });
  return { position, normal, index: triangles.flatMap((_, at) => [3 * at, 3 * at + 1, 3 * at + 2]) };
}

// The meshes of a shape as `irbkin.body.Shape.data` has it, each with its pose.
function shapeMeshes(shape) {
  const pose = shape.pose ? fromRows(shape.pose.flat()) : identity();
  const ball = (center, radius) => capsuleMesh({ a: center, b: center, radius });
  switch (shape.kind) {
    case "box": return [[pose, boxMesh(shape)]];
    case "cylinder": return [[pose, cylinderMesh(shape)]];
    case "sphere": return [[pose, ball(shape.center, shape.radius)]];
    case "capsule": return [[pose, capsuleMesh(shape)]];
    case "mesh": return [[pose, trianglesMesh(shape.triangles)]];
    case "convex":
    case "points": return [[pose, joined(shape.points.slice(0, 250).map((it) => ball(it, shape.radius ?? 0.01)))]];
    case "union": return shape.shapes.flatMap(shapeMeshes);
    case "half_space": {
      const [u, v] = sides(unit(shape.normal));
      const corner = (a, b) => add(shape.point, add(scale(u, 3 * a), scale(v, 3 * b)));
      const [p, q, r, s] = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
      return [[identity(), trianglesMesh([[p, q, r], [p, r, s]])]];
    }
    default: return [];
  }
}
