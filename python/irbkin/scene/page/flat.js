// Draw without WebGL: capsules as thick lines on a canvas, far ones first.

class FlatDrawing {
  constructor(canvas) {
    this.context = canvas.getContext("2d");
    this.canvas = canvas;
    this.isFlat = true;
  }

  begin(camera, width, height) {
    this.camera = camera;
    this.context.setTransform(width / camera.size[0], 0, 0, height / camera.size[1], 0, 0);
    this.context.clearRect(0, 0, ...camera.size);
  }

  css([r, g, b, alpha = 1]) {
    return `rgba(${[r, g, b].map((it) => Math.round(255 * it)).join(",")},${alpha})`;
  }

  capsules(capsules, frame, color) {
    const { context, camera } = this;
    for (const { a, b, radius } of capsules) {
      const [from, to] = [moved(frame, a), moved(frame, b)];
      const [x, y] = camera.project(from);
      const [u, v] = camera.project(to);
      context.strokeStyle = this.css(color);
      context.lineWidth = (2 * radius) / camera.pixel(from);
      context.lineCap = "round";
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(u + 0.01, v);
      context.stroke();
    }
  }

  // A mesh as its corners: what has no other outline.
  mesh(mesh, model, color) {
    const { context, camera } = this;
    context.fillStyle = this.css(color);
    for (let corner = 0; corner < mesh.position.length; corner += 9) {
      const [x, y] = camera.project(moved(model, mesh.position.slice(corner, corner + 3)));
      context.fillRect(x - 1, y - 1, 2, 2);
    }
  }

  lines(points, color, { loop = false, pairs = false } = {}) {
    const { context, camera } = this;
    context.strokeStyle = this.css(color);
    context.lineWidth = 1.5;
    context.beginPath();
    points.forEach((it, index) => {
      const [x, y] = camera.project(it);
      context[index === 0 || (pairs && index % 2 === 0) ? "moveTo" : "lineTo"](x, y);
    });
    if (loop) context.closePath();
    context.stroke();
  }
}
