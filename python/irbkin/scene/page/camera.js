// Where the eye is: around a point, at angles and a distance.

class Camera {
  constructor() {
    Object.assign(this, { azimuth: -0.9, elevation: 0.42, distance: 4, target: [0, 0, 0.6] });
    this.size = [1, 1];
  }

  // Show points whole.
  fit(points) {
    const low = [0, 1, 2].map((i) => Math.min(...points.map((it) => it[i])));
    const high = [0, 1, 2].map((i) => Math.max(...points.map((it) => it[i])));
    this.target = scale(add(low, high), 0.5);
    const narrow = Math.min(1, this.size[0] / this.size[1]);
    this.distance = (1.5 * Math.max(length(subtract(high, low)), 0.3)) / Math.max(narrow, 0.4);
  }

  get forward() {
    const [c, s] = [Math.cos(this.elevation), Math.sin(this.elevation)];
    return [-c * Math.cos(this.azimuth), -c * Math.sin(this.azimuth), -s];
  }

  get right() { return unit(cross(this.forward, [0, 0, 1])); }
  get up() { return cross(this.right, this.forward); }
  get eye() { return subtract(this.target, scale(this.forward, this.distance)); }

  turn(dx, dy) {
    this.azimuth -= 0.008 * dx;
    this.elevation = Math.max(-1.5, Math.min(1.5, this.elevation + 0.008 * dy));
  }

  pan(dx, dy) {
    const each = this.pixel(this.target);
    this.target = add(this.target, add(scale(this.right, -each * dx), scale(this.up, each * dy)));
  }

  zoom(factor) {
    this.distance = Math.max(0.05, Math.min(100, this.distance * factor));
  }

  // World to clip coordinates, column by column.
  matrix() {
    const [r, u, f, e] = [this.right, this.up, this.forward, this.eye];
    const view = [
      r[0], u[0], -f[0], 0, r[1], u[1], -f[1], 0, r[2], u[2], -f[2], 0,
      -dot(r, e), -dot(u, e), dot(f, e), 1,
    ];
    const [near, far] = [this.distance / 50, this.distance * 20];
    const aspect = this.size[0] / this.size[1];
    const depth = 1 / (near - far);
    const lens = [
      FOCUS / aspect, 0, 0, 0, 0, FOCUS, 0, 0,
      0, 0, (near + far) * depth, -1, 0, 0, 2 * near * far * depth, 0,
    ];
    return multiply(lens, view);
  }

  // A point on the screen [pixels], and how far away it is [m].
  project(point) {
    const from = subtract(point, this.eye);
    const away = dot(from, this.forward);
    const each = this.pixel(point);
    return [
      this.size[0] / 2 + dot(from, this.right) / each,
      this.size[1] / 2 - dot(from, this.up) / each,
      away,
    ];
  }

  // The length of a pixel at a point [m].
  pixel(point) {
    const away = Math.max(dot(subtract(point, this.eye), this.forward), 1e-3);
    return (2 * away) / (FOCUS * this.size[1]);
  }

  // The direction from the eye through a pixel.
  ray(x, y) {
    const [dx, dy] = [x - this.size[0] / 2, this.size[1] / 2 - y];
    const each = 2 / (FOCUS * this.size[1]);
    return unit(add(this.forward, add(scale(this.right, each * dx), scale(this.up, each * dy))));
  }
}

const FOCUS = 2.6;
