// Draw triangles and lines with WebGL.

const VERTEX = `
attribute vec3 position; attribute vec3 normal;
uniform mat4 view; uniform mat4 model;
varying vec3 n; varying vec3 p;
void main() {
  vec4 world = model * vec4(position, 1.0);
  n = mat3(model[0].xyz, model[1].xyz, model[2].xyz) * normal;
  p = world.xyz;
  gl_Position = view * world;
}`;
const FRAGMENT = `
precision mediump float;
varying vec3 n; varying vec3 p;
uniform vec4 color; uniform vec3 eye; uniform float lit;
void main() {
  vec3 m = normalize(n);
  vec3 e = normalize(eye - p);
  if (dot(m, e) < 0.0) m = -m;
  float key = max(dot(m, normalize(e + vec3(0.3, -0.2, 0.9))), 0.0);
  float sky = 0.5 + 0.5 * m.z;
  float edge = pow(1.0 - max(dot(m, e), 0.0), 3.0);
  vec3 shade = color.rgb * (0.36 + 0.26 * sky + 0.34 * key) + 0.06 * pow(key, 30.0) - 0.1 * edge;
  gl_FragColor = vec4(mix(color.rgb, shade, lit), color.a);
}`;

// Whether graphics are computed by the processor, where smooth edges take twice as long.
function isSoftware() {
  const probe = document.createElement("canvas").getContext("webgl");
  const info = probe?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? probe.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  probe?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

class GlDrawing {
  constructor(canvas) {
    const options = { antialias: !isSoftware(), alpha: false, preserveDrawingBuffer: true };
    this.isSlow = !options.antialias;
    this.gl = canvas.getContext("webgl", options);
    if (!this.gl) throw new Error("no WebGL");
    const { gl } = this;
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    gl.useProgram(this.program);
    this.at = {};
    for (const name of ["view", "model", "color", "eye", "lit"]) {
      this.at[name] = gl.getUniformLocation(this.program, name);
    }
    for (const name of ["position", "normal"]) {
      this.at[name] = gl.getAttribLocation(this.program, name);
      gl.enableVertexAttribArray(this.at[name]);
    }
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    // Faint arms are behind what is at the same place.
    gl.polygonOffset(1, 8);
    this.buffers = new WeakMap();
  }

  begin(camera, width, height, ground) {
    const { gl } = this;
    gl.viewport(0, 0, width, height);
    gl.clearColor(...ground, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(this.at.view, false, camera.matrix());
    gl.uniform3fv(this.at.eye, camera.eye);
  }

  buffer(data, kind) {
    const { gl } = this;
    const made = gl.createBuffer();
    gl.bindBuffer(kind, made);
    gl.bufferData(kind, data, gl.STATIC_DRAW);
    return made;
  }

  bind(name, buffer) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
    this.gl.vertexAttribPointer(this.at[name], 3, this.gl.FLOAT, false, 0, 0);
  }

  mesh(mesh, model, [r, g, b, alpha = 1], { lit = 1, onTop = false } = {}) {
    if (!mesh.index.length) return;
    const { gl } = this;
    let own = this.buffers.get(mesh);
    if (!own) {
      own = {
        position: this.buffer(new Float32Array(mesh.position), gl.ARRAY_BUFFER),
        normal: this.buffer(new Float32Array(mesh.normal), gl.ARRAY_BUFFER),
        index: this.buffer(new Uint16Array(mesh.index), gl.ELEMENT_ARRAY_BUFFER),
      };
      this.buffers.set(mesh, own);
    }
    this.bind("position", own.position);
    this.bind("normal", own.normal);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, own.index);
    this.set(model, [r, g, b, alpha], lit, onTop);
    if (alpha < 1 && !this.isSlow) {
      // First the depth alone: of a faint arm only its surface is seen.
      gl.colorMask(false, false, false, false);
      gl.drawElements(gl.TRIANGLES, mesh.index.length, gl.UNSIGNED_SHORT, 0);
      gl.colorMask(true, true, true, true);
      gl.depthFunc(gl.LEQUAL);
    }
    gl.drawElements(gl.TRIANGLES, mesh.index.length, gl.UNSIGNED_SHORT, 0);
    gl.depthFunc(gl.LESS);
  }

  set(model, color, lit, onTop) {
    const { gl } = this;
    gl.uniformMatrix4fv(this.at.model, false, model);
    gl.uniform4fv(this.at.color, color);
    gl.uniform1f(this.at.lit, lit);
    gl[color[3] < 1 ? "enable" : "disable"](gl.BLEND);
    gl[color[3] < 1 ? "enable" : "disable"](gl.POLYGON_OFFSET_FILL);
    gl[onTop ? "disable" : "enable"](gl.DEPTH_TEST);
  }

  lines(points, color, { loop = false, onTop = false, pairs = false } = {}) {
    if (points.length < 2) return;
    const { gl } = this;
    const buffer = this.buffer(new Float32Array(points.flat()), gl.ARRAY_BUFFER);
    this.bind("position", buffer);
    this.bind("normal", buffer);
    this.set(identity(), color.length === 3 ? [...color, 1] : color, 0, onTop);
    const kind = pairs ? gl.LINES : loop ? gl.LINE_LOOP : gl.LINE_STRIP;
    gl.drawArrays(kind, 0, points.length);
    gl.deleteBuffer(buffer);
  }
}
