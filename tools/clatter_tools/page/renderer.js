// SPDX-License-Identifier: GPL-3.0-or-later
// WebGL2: a skin that moves by Re(X exp(i phase)), its edges, its outline at rest.

const SURFACE_VERTEX = `#version 300 es
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 re;
layout(location = 2) in vec3 im;
uniform mat4 view, projection;
uniform vec2 phase;
uniform float enlargement;
out vec3 eye, rest, real, imaginary;
void main() {
  vec4 at = view * vec4(point + enlargement * (re * phase.x - im * phase.y), 1.0);
  eye = at.xyz;
  rest = point;
  real = re;
  imaginary = im;
  gl_Position = projection * at;
  gl_PointSize = 11.0;
}`;

const SURFACE_FRAGMENT = `#version 300 es
precision highp float;
in vec3 eye, rest, real, imaginary;
uniform sampler2D colours;
uniform vec2 phase;
uniform int shown;
uniform vec2 range;
uniform vec4 plain;
out vec4 colour;
void main() {
  vec3 n = normalize(cross(dFdx(eye), dFdy(eye)));
  float light = 0.55 + 0.45 * clamp(dot(n, normalize(vec3(-0.35, 0.5, 0.8))), 0.0, 1.0);
  vec3 outward = normalize(cross(dFdx(rest), dFdy(rest))) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 velocity = real * phase.x - imaginary * phase.y;
  float value = shown == 0 ? dot(velocity, outward) : shown == 1 ? length(velocity) : length(vec2(dot(real, outward), dot(imaginary, outward)));
  vec3 base = plain.a > 0.5 ? plain.rgb : texture(colours, vec2(clamp((value - range.x) / (range.y - range.x), 0.002, 0.998), 0.5)).rgb;
  colour = vec4(base * (gl_FrontFacing ? light : 0.45 * light), 1.0);
}`;

const EDGE_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 plain;
out vec4 colour;
void main() { colour = vec4(plain.rgb * plain.a, plain.a); }`;

class Renderer {
  /** Throws where the browser has no WebGL2. */
  constructor(canvas) {
    this.canvas = canvas;
    const gl = (this.gl = canvas.getContext("webgl2", { antialias: true, alpha: true }));
    if (!gl) throw new Error("this browser has no WebGL2, which the 3-D view needs");
    this.surface = program(gl, SURFACE_VERTEX, SURFACE_FRAGMENT);
    this.edge = program(gl, SURFACE_VERTEX, EDGE_FRAGMENT);
    this.maps = {};
    for (const name of Object.keys(page.colours)) this.maps[name] = colourTexture(gl, page.colours[name]);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** Takes a skin { points, triangles, edges, owner }; owner: the panel of each face of four triangles, or null. */
  load(skin) {
    const { gl } = this;
    this.skin = skin;
    this.marked = null;
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    attribute(gl, 0, skin.points);
    this.buffers = [1, 2].map(location => attribute(gl, location, new Float32Array(skin.points.length)));
    const groups = new Map();
    skin.owner?.forEach((owner, face) => {
      if (!groups.has(owner)) groups.set(owner, []);
      groups.get(owner).push(face);
    });
    const Index = skin.triangles.constructor;
    this.indexType = Index === Uint16Array ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT;
    this.ranges = [];
    let sorted = skin.triangles;
    if (groups.size) {
      sorted = new Index(skin.triangles.length);
      let at = 0;
      for (const [owner, faces] of groups) {
        const first = at;
        for (const face of faces) {
          sorted.set(skin.triangles.subarray(12 * face, 12 * face + 12), at);
          at += 12;
        }
        this.ranges.push({ owner, first: first * Index.BYTES_PER_ELEMENT, count: at - first });
      }
    }
    this.indices = indexBuffer(gl, sorted);
    this.edges = indexBuffer(gl, skin.edges);
    this.triangleCount = sorted.length;
    this.edgeCount = skin.edges.length;
  }

  /** The node that is drawn as a dot, or null. */
  mark(node) {
    this.marked = node;
  }

  /** The complex velocity of all nodes; `im` may be absent. */
  move(re, im) {
    const { gl } = this;
    [re, im ?? new Float32Array(re.length)].forEach((values, k) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[k]);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    });
  }

  /** Draws { view, projection, phase, enlargement, shown, range, colours, panels, outline, edges, ink }: `panels` are colours by panel
      instead of by value. */
  draw(picture) {
    const { gl } = this,
      { width, height } = fitCanvas(this.canvas);
    if (!width || !height) return;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.bindVertexArray(this.array);
    const colour = rgb(picture.ink.text);
    if (picture.outline) {
      gl.disable(gl.DEPTH_TEST);
      this.paintEdges(picture, 0, [...rgb(picture.ink.quiet), 0.3]);
      gl.enable(gl.DEPTH_TEST);
    }
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1.5, 2);
    this.paintSurface(picture);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (picture.edges) this.paintEdges(picture, picture.enlargement, [...(dark() ? [0, 0, 0] : colour), 0.65]);
    if (picture.outline) this.paintEdges(picture, 0, [...rgb(picture.ink.quiet), 0.5]);
    if (this.marked !== null) this.paintMark(picture);
  }

  paintSurface(picture) {
    const { gl } = this,
      at = this.use(this.surface, picture, picture.enlargement);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices);
    gl.bindTexture(gl.TEXTURE_2D, this.maps[picture.colours]);
    gl.uniform2f(at("range"), ...picture.range);
    gl.uniform1i(at("shown"), picture.shown);
    if (!picture.panels) {
      gl.uniform4f(at("plain"), 0, 0, 0, 0);
      gl.drawElements(gl.TRIANGLES, this.triangleCount, this.indexType, 0);
      return;
    }
    for (const { owner, first, count } of this.ranges) {
      gl.uniform4f(at("plain"), ...rgb(picture.panels[owner] ?? picture.ink.metal), 1);
      gl.drawElements(gl.TRIANGLES, count, this.indexType, first);
    }
  }

  paintEdges(picture, enlargement, colour) {
    const { gl } = this,
      at = this.use(this.edge, picture, enlargement);
    gl.uniform4f(at("plain"), ...colour);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.edges);
    gl.drawElements(gl.LINES, this.edgeCount, this.indexType, 0);
  }

  paintMark(picture) {
    const { gl } = this,
      at = this.use(this.edge, picture, picture.enlargement);
    gl.disable(gl.DEPTH_TEST);
    gl.uniform4f(at("plain"), ...rgb(picture.ink.accent), 1);
    gl.drawArrays(gl.POINTS, this.marked, 1);
    gl.enable(gl.DEPTH_TEST);
  }

  use(own, picture, enlargement) {
    const { gl } = this,
      at = name => gl.getUniformLocation(own, name);
    gl.useProgram(own);
    gl.uniformMatrix4fv(at("view"), false, picture.view);
    gl.uniformMatrix4fv(at("projection"), false, picture.projection);
    gl.uniform2f(at("phase"), Math.cos(picture.phase), Math.sin(picture.phase));
    gl.uniform1f(at("enlargement"), enlargement);
    return at;
  }
}

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`shader: ${gl.getShaderInfoLog(shader)}`);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(`shader: ${gl.getProgramInfoLog(made)}`);
  return made;
}

function attribute(gl, location, values) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(location);
  gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 0, 0);
  return buffer;
}

function indexBuffer(gl, values) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, values, gl.STATIC_DRAW);
  return buffer;
}

function colourTexture(gl, table) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(
    gl.TEXTURE_2D,
    0,
    gl.RGBA,
    table.length,
    1,
    0,
    gl.RGBA,
    gl.UNSIGNED_BYTE,
    Uint8Array.from(table.flatMap(row => [...row, 255])),
  );
  for (const name of ["TEXTURE_MIN_FILTER", "TEXTURE_MAG_FILTER"]) gl.texParameteri(gl.TEXTURE_2D, gl[name], gl.LINEAR);
  for (const name of ["TEXTURE_WRAP_S", "TEXTURE_WRAP_T"]) gl.texParameteri(gl.TEXTURE_2D, gl[name], gl.CLAMP_TO_EDGE);
  return texture;
}
