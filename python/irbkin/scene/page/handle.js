// The handle at the tool: arrows to move along its axes, rings to turn about them, a ball to move in
// the plane of the screen.

const AXIS_COLORS = [[0.84, 0.15, 0.16], [0.17, 0.63, 0.17], [0.12, 0.47, 0.71]];
const GRIP_COLOR = [0.98, 0.75, 0.14];
const HANDLE = 90;
const NEAR = 14;
const RING = 48;
// Of size 1: they are drawn larger.
const BALL = capsuleMesh({ a: [0, 0, 0], b: [0, 0, 0], radius: 1 });
const SHAFT = capsuleMesh({ a: [0, 0, 0], b: [0, 0, 1], radius: 0.018 });

// A ball at a point.
function drawBall(drawing, center, radius, color, options) {
  const model = identity().map((it, i) => (i < 11 ? radius * it : it));
  drawing.mesh(BALL, Handle.shifted(model, center), color, options);
}

class Handle {
  // The size of the handle in the world: the same on the screen wherever it is.
  static size(camera, pose) {
    return HANDLE * camera.pixel(place(pose));
  }

  static ring(pose, axis, radius) {
    const [u, v] = [axisOf(pose, (axis + 1) % 3), axisOf(pose, (axis + 2) % 3)];
    return Array.from({ length: RING }, (_, step) => {
      const angle = (2 * Math.PI * step) / RING;
      const out = add(scale(u, radius * Math.cos(angle)), scale(v, radius * Math.sin(angle)));
      return add(place(pose), out);
    });
  }

  static draw(drawing, camera, pose, held, isRed) {
    const size = Handle.size(camera, pose);
    const from = place(pose);
    for (let axis = 0; axis < 3; axis++) {
      const bright = (part) => (held === part ? [1, 0.85, 0.2] : isRed ? AXIS_COLORS[0] : AXIS_COLORS[axis]);
      const tip = add(from, scale(axisOf(pose, axis), size));
      // The shaft is along z: the axes in turn, so that this one is third.
      const [u, v, w] = [1, 2, 3].map((it) => scale(axisOf(pose, (axis + it) % 3), size));
      const model = [...u, 0, ...v, 0, ...w, 0, ...from, 1];
      drawing.mesh(SHAFT, model, bright(`move${axis}`), { onTop: true });
      drawBall(drawing, tip, 0.07 * size, bright(`move${axis}`), { onTop: true });
      drawing.lines(Handle.ring(pose, axis, 0.72 * size), bright(`turn${axis}`), {
        loop: true, onTop: true,
      });
    }
    drawBall(drawing, from, 0.075 * size, GRIP_COLOR, { onTop: true });
  }

  // The part of the handle at a place of the screen; null if there is none.
  static at(camera, pose, x, y, reach = NEAR) {
    const size = Handle.size(camera, pose);
    const away = (point) => {
      const [u, v] = camera.project(point);
      return Math.hypot(u - x, v - y);
    };
    const parts = [["ball", away(place(pose)) - 2]];
    for (let axis = 0; axis < 3; axis++) {
      const along = [0.4, 0.6, 0.8, 1].map((part) => add(place(pose), scale(axisOf(pose, axis), part * size)));
      parts.push([`move${axis}`, Math.min(...along.map(away))]);
      parts.push([`turn${axis}`, Math.min(...Handle.ring(pose, axis, 0.72 * size).map(away))]);
    }
    const [part, distance] = parts.reduce((best, it) => (it[1] < best[1] ? it : best));
    return distance <= reach ? part : null;
  }

  // The pose of the tool while a part is dragged from one place of the screen to another.
  static dragged(camera, pose, part, from, to) {
    const middle = place(pose);
    if (part === "ball") {
      const each = camera.pixel(middle);
      const [dx, dy] = [to[0] - from[0], from[1] - to[1]];
      return Handle.shifted(pose, add(scale(camera.right, each * dx), scale(camera.up, each * dy)));
    }
    const axis = axisOf(pose, Number(part.slice(4)));
    if (part.startsWith("move")) {
      const way = Handle.along(camera, middle, axis, to) - Handle.along(camera, middle, axis, from);
      return Handle.shifted(pose, scale(axis, way));
    }
    // Seen from the side a ring is turned by the way across it.
    const isFlat = Math.abs(dot(camera.ray(...from), axis)) < 0.12;
    const at = (place) => Handle.angle(camera, middle, axis, place, isFlat);
    const angle = at(to) - at(from);
    const turned = multiply(about(axis, Number.isFinite(angle) ? angle : 0), pose);
    [turned[12], turned[13], turned[14]] = middle;
    return turned;
  }

  static shifted(pose, by) {
    const there = pose.slice();
    for (let i = 0; i < 3; i++) there[12 + i] += by[i];
    return there;
  }

  // Where the line through a point is nearest to the ray of a pixel [m].
  static along(camera, point, axis, [x, y]) {
    const ray = camera.ray(x, y);
    const from = subtract(camera.eye, point);
    const [b, d, e] = [dot(axis, ray), dot(axis, from), dot(ray, from)];
    const spread = 1 - b * b;
    return spread > 1e-4 ? (d - b * e) / spread : 0;
  }

  // The angle about an axis at which the ray of a pixel meets the plane of a ring [rad].
  static angle(camera, point, axis, [x, y], isFlat) {
    const ray = camera.ray(x, y);
    const slope = dot(ray, axis);
    const [u, v] = sides(axis);
    if (isFlat) {
      const tangent = cross(axis, camera.forward);
      const [px, py] = camera.project(point);
      const each = camera.pixel(point);
      const shift = add(scale(camera.right, each * (x - px)), scale(camera.up, each * (py - y)));
      return dot(shift, tangent) / (0.72 * HANDLE * each);
    }
    const hit = add(camera.eye, scale(ray, dot(subtract(point, camera.eye), axis) / slope));
    const out = subtract(hit, point);
    return Math.atan2(dot(out, v), dot(out, u));
  }
}
