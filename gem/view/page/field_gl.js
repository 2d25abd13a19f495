// Draws all floes in one call of WebGL2: fans of triangles, moved by a texture with place and rotation of each floe.

const vertexText = `#version 300 es
precision highp float;
precision highp sampler2D;
in vec2 corner;
in float edge;
in uint floe;
uniform sampler2D poses;   // x, y from the camera [m], cosine, sine
uniform sampler2D values;  // share of the colour range; below 0: no value, below -1: not there
uniform vec2 scale;
out float to_edge;
flat out float value;
void main() {
  ivec2 at = ivec2(int(floe) % 256, int(floe) / 256);
  vec4 pose = texelFetch(poses, at, 0);
  value = texelFetch(values, at, 0).r;
  to_edge = edge;
  vec2 turned = vec2(pose.z * corner.x - pose.w * corner.y, pose.w * corner.x + pose.z * corner.y);
  gl_Position = value < -1.5 ? vec4(2.0, 2.0, 2.0, 1.0) : vec4((pose.xy + turned) * scale, 0.0, 1.0);
}`;

const fragmentText = `#version 300 es
precision highp float;
in float to_edge;
flat in float value;
uniform sampler2D colours;
uniform vec3 without;
uniform vec3 outline;
out vec4 colour;
void main() {
  vec3 inner = value < 0.0 ? without : texture(colours, vec2(value, 0.5)).rgb;
  float pixels = (1.0 - to_edge) / max(fwidth(to_edge), 1e-6);
  colour = vec4(mix(outline, inner, 0.35 + 0.65 * clamp(pixels - 0.3, 0.0, 1.0)), 1.0);
}`;

function compiled(gl, kind, text) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function linked(gl) {
  const program = gl.createProgram();
  gl.attachShader(program, compiled(gl, gl.VERTEX_SHADER, vertexText));
  gl.attachShader(program, compiled(gl, gl.FRAGMENT_SHADER, fragmentText));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

// A vertex: corner x, y, edge (0 at the centroid, 1 at the outline), floe.
function fans(shapes) {
  const {floes, start, xy} = shapes;
  const corners = start[floes];
  const bytes = new ArrayBuffer(16 * (corners + floes));
  const real = new Float32Array(bytes), whole = new Uint32Array(bytes);
  const triangles = new Uint32Array(3 * corners);
  let vertex = 0, at = 0;
  for (let i = 0; i < floes; ++i) {
    const centre = vertex++;
    whole[4 * centre + 3] = i;
    const first = vertex, count = start[i + 1] - start[i];
    for (let k = 0; k < count; ++k, ++vertex) {
      real.set([xy[2 * (start[i] + k)], xy[2 * (start[i] + k) + 1], 1], 4 * vertex);
      whole[4 * vertex + 3] = i;
      triangles.set([centre, vertex, first + (k + 1) % count], at);
      at += 3;
    }
  }
  return {bytes, triangles};
}

// Whether WebGL is computed by the processor: then smooth edges would cost more than all else.
function isSoftware() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const names = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class FieldGl {
  constructor(canvas, shapes) {
    this.canvas = canvas;
    const gl = this.gl = canvas.getContext('webgl2', {antialias: !isSoftware(), alpha: false});
    if (!gl) throw new Error('this browser has no WebGL2');
    this.floes = shapes.floes;
    this.rows = Math.max(1, Math.ceil(shapes.floes / 256));
    this.poses = new Float32Array(4 * 256 * this.rows);
    this.values = new Float32Array(256 * this.rows);
    this.program = linked(gl);
    gl.useProgram(this.program);
    this.setVertices(fans(shapes));
    ['poses', 'values', 'colours'].forEach((name, unit) => this.setTexture(name, unit));
  }

  setVertices({bytes, triangles}) {
    const {gl, program} = this;
    this.count = triangles.length;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
    const at = name => {
      const place = gl.getAttribLocation(program, name);
      gl.enableVertexAttribArray(place);
      return place;
    };
    gl.vertexAttribPointer(at('corner'), 2, gl.FLOAT, false, 16, 0);
    gl.vertexAttribPointer(at('edge'), 1, gl.FLOAT, false, 16, 8);
    gl.vertexAttribIPointer(at('floe'), 1, gl.UNSIGNED_INT, 16, 12);
  }

  setTexture(name, unit) {
    const {gl} = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
    for (const way of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, way, gl.CLAMP_TO_EDGE);
    gl.uniform1i(gl.getUniformLocation(this.program, name), unit);
  }

  setColours(table) {
    const {gl} = this;
    gl.activeTexture(gl.TEXTURE2);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, table);
  }

  // `shares`: of the colour range, NaN without a value. `theme`: colours as [r, g, b] from 0 to 1.
  draw(camera, pose, shares, theme) {
    const {gl, poses, values} = this;
    for (let i = 0; i < this.floes; ++i) {
      poses[4 * i] = pose.x[i] - camera.x;
      poses[4 * i + 1] = pose.y[i] - camera.y;
      poses[4 * i + 2] = pose.cosine[i];
      poses[4 * i + 3] = pose.sine[i];
      const share = shares[i];
      values[i] = !pose.there[i] ? -2 : share === share ? Math.min(1, Math.max(0, share)) : -1;
    }
    gl.activeTexture(gl.TEXTURE0);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 256, this.rows, 0, gl.RGBA, gl.FLOAT, poses);
    gl.activeTexture(gl.TEXTURE1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, 256, this.rows, 0, gl.RED, gl.FLOAT, values);
    const place = name => gl.getUniformLocation(this.program, name);
    gl.uniform2f(place('scale'), 2 * camera.scale / camera.width, 2 * camera.scale / camera.height);
    gl.uniform3f(place('without'), ...theme.without);
    gl.uniform3f(place('outline'), ...theme.outline);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(...theme.water, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.drawElements(gl.TRIANGLES, this.count, gl.UNSIGNED_INT, 0);
  }
}
