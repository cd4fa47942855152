// Triangles of the shapes that a scene has: { position, normal, index } as flat lists.

// Corners around an axis, and rings of a round end: of what is looked at, and of faint copies.
const FINE = { round: 18, caps: 4 };
const COARSE = { round: 8, caps: 2 };

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
  const mesh = { position: [], normal: [], index: [] };
  for (let axis = 0; axis < 3; axis++) {
    for (const side of [-1, 1]) {
      const begin = mesh.position.length / 3;
      for (const [u, v] of [[-1, -1], [1, -1], [-1, 1], [1, 1]]) {
        const corner = [0, 0, 0];
        [corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3]] = [side, u, v];
        mesh.position.push(...corner.map((it, i) => (it * size[i]) / 2));
        const normal = [0, 0, 0];
        normal[axis] = side;
        mesh.normal.push(...normal);
      }
      mesh.index.push(begin, begin + 1, begin + 2, begin + 2, begin + 1, begin + 3);
    }
  }
  return mesh;
}

function trianglesMesh(triangles) {
  const mesh = { position: [], normal: [], index: [] };
  for (const [a, b, c] of triangles) {
    const normal = unit(cross(subtract(b, a), subtract(c, a)));
    for (const corner of [a, b, c]) {
      mesh.index.push(mesh.position.length / 3);
      mesh.position.push(...corner);
      mesh.normal.push(...normal);
    }
  }
  return mesh;
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
    case "mesh": {
      // An index has 16 bits.
      const parts = [];
      for (let at = 0; at < shape.triangles.length; at += 20000) {
        parts.push([pose, trianglesMesh(shape.triangles.slice(at, at + 20000))]);
      }
      return parts;
    }
    case "convex": return [[pose, joined(shape.points.slice(0, 250).map((it) => ball(it, 0.01)))]];
    case "points": return [[pose, joined(shape.points.slice(0, 250).map((it) => ball(it, shape.radius)))]];
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
