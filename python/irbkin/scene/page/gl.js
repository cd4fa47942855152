// Draw triangles and lines with WebGL 2: lit by the sky and a lamp, whose soft shadow is on the floor.

// The direction to the lamp.
const LAMP = unit([0.45, -0.55, 1.1]);
// Corners of the shadow's picture, how far it reaches [edges of the floor], and how often it is halved.
const SHADOW = { size: 256, reach: 1.6, halved: 2 };
const MESH = [`
in vec3 position; in vec3 normal;
uniform mat4 view; uniform mat4 model;
out vec3 n; out vec3 p;
void main() {
  n = mat3(model) * normal;
  p = (model * vec4(position, 1.0)).xyz;
  gl_Position = view * vec4(p, 1.0);
}`, `
in vec3 n; in vec3 p;
uniform vec4 color; uniform vec3 eye; uniform vec3 lamp; uniform vec3 floor; uniform float lit;
out vec4 drawn;
void main() {
  // A caster of the shadow is what is above the floor.
  if (lit < 0.0) {
    if (p.z < floor.z + 0.002) discard;
    drawn = vec4(1.0);
    return;
  }
  vec3 e = normalize(eye - p);
  vec3 m = normalize(n);
  // Bent faces turn away from the eye a little at their edges; open surfaces show their other side.
  float away = dot(m, e);
  m = away < -0.35 ? -m : normalize(m - min(away, 0.0) * e);
  float key = max(dot(m, lamp), 0.0);
  float front = max(dot(m, e), 0.0);
  vec3 sky = mix(vec3(0.33, 0.31, 0.30), vec3(0.72, 0.76, 0.82), 0.5 + 0.5 * m.z);
  vec3 light = 0.62 * sky + 0.68 * key * vec3(1.0, 0.97, 0.92) + 0.16 * front;
  float spot = max(dot(m, normalize(lamp + e)), 0.0), rim = (1.0 - front) * (1.0 - front);
  for (int i = 0; i < 5; i++) spot *= spot;
  // Squares and roots stand for the response of a screen.
  vec3 shade = sqrt(color.rgb * color.rgb * light * 1.12 + 0.22 * spot + 0.1 * rim * rim);
  drawn = vec4(mix(color.rgb, shade, lit), color.a);
}`];
// A line is a strip as wide as it is asked for, from one point to the other.
const LINE = [`
in vec3 position; in vec3 normal;
uniform mat4 view; uniform vec3 screen;
void main() {
  vec4 a = view * vec4(position, 1.0), b = view * vec4(normal, 1.0);
  vec2 along = (b.xy / b.w - a.xy / a.w) * screen.xy;
  vec2 across = length(along) > 0.0 ? normalize(vec2(-along.y, along.x)) : vec2(0.0, 1.0);
  vec4 end = (gl_VertexID & 1) == 0 ? a : b;
  float side = gl_VertexID < 2 ? 1.0 : -1.0;
  gl_Position = end + vec4(side * screen.z * across / screen.xy * end.w, 0.0, 0.0);
}`, `
uniform vec4 color;
out vec4 drawn;
void main() { drawn = color; }`];
// The floor has a grid to its edge, the axes of the base in its colors, and the shadow.
const FLOOR = [`
in vec3 position;
uniform mat4 view; uniform vec4 color; uniform vec3 floor;
out vec2 at;
void main() {
  at = position.xy * ${SHADOW.reach.toFixed(1)} * color.a;
  gl_Position = view * vec4(floor.xy + at, floor.z, 1.0);
}`, `
in vec2 at;
uniform vec4 color; uniform vec3 screen; uniform float shadows; uniform sampler2D image;
out vec4 drawn;
float grid(float cell) {
  vec2 wide = fwidth(at) / cell;
  vec2 near = abs(fract(at / cell - 0.5) - 0.5) / wide;
  return (1.0 - min(min(near.x, near.y), 1.0)) * (1.0 - smoothstep(0.1, 0.5, max(wide.x, wide.y)));
}
void main() {
  float edge = color.a;
  vec2 beyond = max(abs(at) - edge, 0.0) / fwidth(at);
  float inside = 1.0 - min(max(beyond.x, beyond.y), 1.0);
  float lines = inside * max(0.55 * grid(screen.x), 0.22 * grid(screen.x / 5.0));
  vec2 axis = (1.0 - min(abs(at.yx) / fwidth(at.yx) / 1.5, 1.0)) * step(0.0, at) * inside;
  vec3 ink = mix(mix(color.rgb, vec3(0.84, 0.15, 0.16), axis.x), vec3(0.17, 0.63, 0.17), axis.y);
  // Four places of a picture that is halved make its edges soft.
  vec2 there = at / (${(2 * SHADOW.reach).toFixed(1)} * edge) + 0.5;
  float dark = 0.0;
  for (int i = 0; i < 4; i++) {
    vec2 beside = (vec2(i & 1, i >> 1) - 0.5) * ${(1.6 * 2 ** SHADOW.halved / SHADOW.size).toFixed(6)};
    dark += 0.25 * shadows * textureLod(image, there + beside, ${SHADOW.halved.toFixed(1)}).r;
  }
  float line = max(lines, 0.8 * max(axis.x, axis.y));
  float tint = 0.07 * inside;
  drawn = vec4(mix(ink * line + color.rgb * tint * (1.0 - line), vec3(0.0), dark), line + (1.0 - line) * (tint + dark));
}`];
class GlDrawing {
  constructor(canvas) {
    // Smooth edges are its own, so that frames can be drawn without.
    this.gl = canvas.getContext("webgl2", { antialias: false, stencil: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("no WebGL");
    const { gl } = this;
    this.programs = Object.fromEntries(Object.entries({ MESH, LINE, FLOOR })
      .map(([name, texts]) => [name, this.program(texts)]));
    gl.enableVertexAttribArray(0);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.buffers = new WeakMap();
    this.square = this.buffer(new Float32Array([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0]), gl.ARRAY_BUFFER);
    this.samples = Math.min(4, gl.getParameter(gl.MAX_SAMPLES));
    this.frame = gl.createFramebuffer();
    this.shade = gl.createFramebuffer();
    // The only texture stays bound.
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, SHADOW.halved + 1, gl.R8, SHADOW.size, SHADOW.size);
    for (const it of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, it, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shade);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    this.parts = [gl.createRenderbuffer(), gl.createRenderbuffer()];
  }

  program([vertex, fragment]) {
    const { gl } = this;
    const made = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, `#version 300 es\nprecision highp float;${text}`);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.bindAttribLocation(made, 0, "position");
    gl.bindAttribLocation(made, 1, "normal");
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    const names = ["view", "model", "color", "eye", "lamp", "floor", "lit", "screen", "shadows"];
    return { made, at: Object.fromEntries(names.map((it) => [it, gl.getUniformLocation(made, it)])) };
  }

  use(name) {
    const { made, at } = this.programs[name];
    if (this.used !== name) this.gl.useProgram(made);
    this.used = name;
    return at;
  }

  // Begin a frame; a floor has a place, an edge, and the size of its cells.
  begin(camera, width, height, ground, floor, isSmooth = true) {
    const { gl } = this;
    Object.assign(this, { width, height, floor, isSmooth, view: camera.matrix(), eye: camera.eye });
    gl.bindFramebuffer(gl.FRAMEBUFFER, isSmooth ? this.frame : null);
    if (isSmooth && (this.made?.[0] !== width || this.made[1] !== height)) {
      this.made = [width, height];
      [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH24_STENCIL8, gl.DEPTH_STENCIL_ATTACHMENT]].forEach(([kind, place], i) => {
        gl.bindRenderbuffer(gl.RENDERBUFFER, this.parts[i]);
        gl.renderbufferStorageMultisample(gl.RENDERBUFFER, this.samples, kind, width, height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, this.parts[i]);
      });
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(...ground, 1);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  end() {
    const { gl, width, height } = this;
    if (!this.isSmooth) return;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }

  // Wait until all is drawn.
  finish() {
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, null);
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  buffer(data, kind) {
    const { gl } = this;
    const made = gl.createBuffer();
    gl.bindBuffer(kind, made);
    gl.bufferData(kind, data, gl.STATIC_DRAW);
    return made;
  }

  bind(place, buffer, stride = 0, offset = 0, divisor = 0) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.FLOAT, false, stride, offset);
    gl.vertexAttribDivisor(place, divisor);
  }

  // The shadow of meshes, each with its model, on the floor.
  shadow(meshes) {
    const { gl, floor: { at, edge } } = this;
    gl.viewport(0, 0, SHADOW.size, SHADOW.size);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shade);
    gl.disable(gl.DEPTH_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const each = 1 / (SHADOW.reach * edge);
    const [x, y] = [0, 1].map((i) => (-each * LAMP[i]) / LAMP[2]);
    const seen = this.view;
    this.view = [
      each, 0, 0, 0, 0, each, 0, 0, x, y, 0, 0,
      -each * at[0] - x * at[2], -each * at[1] - y * at[2], 0, 1,
    ];
    for (const [mesh, model] of meshes) this.mesh(mesh, model, [0, 0, 0], { lit: -1, onTop: true });
    this.view = seen;
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.isSmooth ? this.frame : null);
    gl.viewport(0, 0, this.width, this.height);
    gl.enable(gl.DEPTH_TEST);
  }

  ground(color, hasShadow) {
    const { gl, floor } = this;
    const uniform = this.use("FLOOR");
    gl.uniformMatrix4fv(uniform.view, false, this.view);
    gl.uniform4f(uniform.color, ...color, floor.edge);
    gl.uniform3fv(uniform.floor, floor.at);
    gl.uniform3f(uniform.screen, floor.cell, 0, 0);
    gl.uniform1f(uniform.shadows, hasShadow ? 0.42 : 0);
    this.bind(0, this.square);
    gl.disableVertexAttribArray(1);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(-1, -2);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.depthMask(true);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  mesh(mesh, model, color, { lit = 1, onTop = false } = {}) {
    if (!mesh.index.length) return;
    const { gl } = this;
    let own = this.buffers.get(mesh);
    if (!own) {
      own = {
        position: this.buffer(new Float32Array(mesh.position), gl.ARRAY_BUFFER),
        normal: this.buffer(new Float32Array(mesh.normal), gl.ARRAY_BUFFER),
        index: this.buffer(new Uint32Array(mesh.index), gl.ELEMENT_ARRAY_BUFFER),
      };
      this.buffers.set(mesh, own);
    }
    const uniform = this.use("MESH");
    gl.uniformMatrix4fv(uniform.model, false, model);
    gl.uniform3fv(uniform.eye, this.eye);
    gl.uniform3fv(uniform.lamp, LAMP);
    gl.uniform3fv(uniform.floor, this.floor.at);
    gl.uniform1f(uniform.lit, lit);
    this.set(uniform, color, onTop);
    this.bind(0, own.position);
    this.bind(1, own.normal);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, own.index);
    gl.drawElements(gl.TRIANGLES, mesh.index.length, gl.UNSIGNED_INT, 0);
  }

  // Meshes through which one sees, behind what is at the same place: of them, one at each pixel.
  faint(meshes, color) {
    const { gl, eye } = this;
    const away = ([, model]) => length(subtract(place(model), eye));
    gl.clear(gl.STENCIL_BUFFER_BIT);
    gl.enable(gl.STENCIL_TEST);
    gl.enable(gl.CULL_FACE);
    gl.stencilFunc(gl.EQUAL, 0, 1);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
    gl.depthMask(false);
    for (const [mesh, model] of meshes.sort((a, b) => away(a) - away(b))) this.mesh(mesh, model, color);
    gl.depthMask(true);
    gl.disable(gl.STENCIL_TEST);
    gl.disable(gl.CULL_FACE);
  }

  set(uniform, [r, g, b, alpha = 1], onTop) {
    const { gl } = this;
    gl.uniformMatrix4fv(uniform.view, false, this.view);
    gl.uniform4f(uniform.color, r, g, b, alpha);
    gl[alpha < 1 ? "enable" : "disable"](gl.BLEND);
    gl[alpha < 1 ? "enable" : "disable"](gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 8);
    gl[onTop ? "disable" : "enable"](gl.DEPTH_TEST);
  }

  // Lines of a width [pixels] through points, or between pairs of them.
  lines(points, color, { loop = false, onTop = false, pairs = false, width = 2 } = {}) {
    if (points.length < 2) return;
    const { gl } = this;
    const ends = pairs ? points : segments(loop ? [...points, points[0]] : points);
    const buffer = this.buffer(new Float32Array(ends.flat()), gl.ARRAY_BUFFER);
    const uniform = this.use("LINE");
    gl.uniform3f(uniform.screen, this.width, this.height, width);
    this.set(uniform, color, onTop);
    this.bind(0, buffer, 24, 0, 1);
    this.bind(1, buffer, 24, 12, 1);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, ends.length / 2);
    gl.deleteBuffer(buffer);
  }
}
