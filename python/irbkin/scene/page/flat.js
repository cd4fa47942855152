// Draw without WebGL: triangles on a canvas, far ones first, lines in front of them.

class FlatDrawing {
  constructor(canvas) {
    this.context = canvas.getContext("2d");
    this.isFlat = true;
  }

  begin(camera, width, height, color, floor) {
    Object.assign(this, { camera, floor, faces: [], strokes: [] });
    this.context.setTransform(width / camera.size[0], 0, 0, height / camera.size[1], 0, 0);
    this.context.clearRect(0, 0, ...camera.size);
  }

  mesh({ position, normal, index }, model, [r, g, b, alpha = 1], { onTop = false } = {}) {
    const { camera } = this;
    const corners = Array.from({ length: position.length / 3 }, (_, i) => camera.project(
      moved(model, position.slice(3 * i, 3 * i + 3)),
    ));
    for (let at = 0; at < index.length; at += 3) {
      const ends = [0, 1, 2].map((side) => corners[index[at + side]]);
      const out = moved(model, normal.slice(3 * index[at], 3 * index[at] + 3)).map((it, i) => it - model[12 + i]);
      if (dot(out, camera.forward) > 0.2 * length(out)) continue;
      const light = 0.55 + (0.45 * Math.max(dot(out, LAMP), 0)) / length(out);
      const css = this.css([r * light, g * light, b * light, alpha]);
      this.faces.push([onTop ? 0 : ends.reduce((sum, it) => sum + it[2], 0), ends, css, alpha]);
    }
  }

  shadow() {}

  finish() {}

  ground(color) {
    const { at: [x, y, z], edge, cell } = this.floor;
    const lines = [];
    for (let at = -edge; at <= edge + 1e-9; at += cell) {
      lines.push([x + at, y - edge, z], [x + at, y + edge, z], [x - edge, y + at, z], [x + edge, y + at, z]);
    }
    this.lines(lines, [...color, 0.35], { pairs: true, width: 1 });
  }

  faint(meshes, color) {
    for (const [mesh, model] of meshes) this.mesh(mesh, model, color);
  }

  lines(points, color, { loop = false, pairs = false, width = 2 } = {}) {
    this.strokes.push([points.map((it) => this.camera.project(it)), this.css(color), loop, pairs, width]);
  }

  css([r, g, b, alpha = 1]) {
    return `rgba(${[r, g, b].map((it) => Math.round(255 * it)).join(",")},${alpha})`;
  }

  end() {
    const { context } = this;
    context.lineWidth = 0.7;
    for (const [, ends, css, alpha] of this.faces.sort((a, b) => b[0] - a[0])) {
      context.fillStyle = css;
      context.strokeStyle = css;
      context.beginPath();
      for (const [x, y] of ends) context.lineTo(x, y);
      context.closePath();
      context.fill();
      // The seams between faces.
      if (alpha === 1) context.stroke();
    }
    for (const [points, css, loop, pairs, width] of this.strokes) {
      context.strokeStyle = css;
      context.lineWidth = width;
      context.beginPath();
      points.forEach(([x, y], at) => context[at === 0 || (pairs && at % 2 === 0) ? "moveTo" : "lineTo"](x, y));
      if (loop) context.closePath();
      context.stroke();
    }
  }
}
