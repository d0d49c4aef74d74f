// The relief by WebGL 2: vertices and colours from two textures of heights, the stock and the finished part.
const RELIEF_VERTEX = `#version 300 es
precision highp float; precision highp int; uniform highp sampler2D stock; uniform ivec2 cells; uniform ivec2 grid; uniform int stride; uniform vec2 corner; uniform float cell;
uniform float bottom; uniform mat3 view; uniform vec3 middle; uniform vec2 scale; uniform float deep; uniform bool under; out vec3 place;
void main() {
  ivec2 at = ivec2(gl_VertexID % (grid.x + 2), gl_VertexID / (grid.x + 2));
  bool rim = at.x == 0 || at.y == 0 || at.x == grid.x + 1 || at.y == grid.y + 1;
  ivec2 own = min((clamp(at, ivec2(1), grid) - 1) * stride, cells - 1);
  vec2 flat_ = corner + (vec2(own) + 0.5) * cell;
  if (at.x <= 1) flat_.x = corner.x; if (at.y <= 1) flat_.y = corner.y;
  if (at.x >= grid.x) flat_.x = corner.x + float(cells.x) * cell; if (at.y >= grid.y) flat_.y = corner.y + float(cells.y) * cell;
  place = vec3(flat_, rim || under ? bottom : texelFetch(stock, own, 0).r);
  vec3 seen = view * (place - middle);
  gl_Position = vec4(seen.xy * scale, -seen.z * deep, 1.0); }`;
const RELIEF_FRAGMENT = `#version 300 es
precision highp float; precision highp int; uniform highp sampler2D stock; uniform highp sampler2D part; uniform ivec2 cells; uniform vec2 corner; uniform float cell; uniform float bottom;
uniform bool coarse; uniform bool under; uniform bool deviation; uniform mat3 view; uniform vec4 cut; in vec3 place; out vec4 shown;
float high(ivec2 at) { return texelFetch(stock, clamp(at, ivec2(0), cells - 1), 0).r; }
void main() {
  if (dot(cut.xyz, place) > cut.w) discard;
  ivec2 at = clamp(ivec2((place.xy - corner) / cell), ivec2(0), cells - 1);
  float h = high(at);
  if (under || coarse) { if (h <= bottom + 1e-4) discard; } else if (place.z <= bottom + 1e-4 && h <= bottom + 1e-4) discard;
  vec3 n = normalize(vec3(high(at - ivec2(1, 0)) - high(at + ivec2(1, 0)), high(at - ivec2(0, 1)) - high(at + ivec2(0, 1)), 2.0 * cell));
  float edge = min(min(place.x - corner.x, corner.x + float(cells.x) * cell - place.x), min(place.y - corner.y, corner.y + float(cells.y) * cell - place.y));
  if (under) n = vec3(0, 0, -1); else if (edge < 1e-3 && place.z < h - 1e-3) n = normalize(cross(dFdx(place), dFdy(place)));
  float z = coarse ? h : place.z; // on a wall as deep as the place is
  bool uncut = edge < 1e-3 || h > -0.0005 && z > -0.02 * cell;
  vec3 colour = uncut ? vec3(0.87, 0.83, 0.74) : mix(vec3(0.69, 0.78, 0.85), vec3(0.24, 0.36, 0.48), clamp(z / bottom, 0.0, 1.0));
  if (deviation && !under) {
    float off = h - texelFetch(part, at, 0).r;
    colour = off > 1e6 || off < -1e6 ? vec3(0.72) : abs(off) <= 0.1 ? vec3(0.42, 0.68, 0.47)
      : off > 0.0 ? mix(vec3(0.95, 0.8, 0.4), vec3(0.9, 0.45, 0.1), clamp(off / 5.0, 0.0, 1.0)) : mix(vec3(0.9, 0.4, 0.4), vec3(0.69, 0.0, 0.13), clamp(-off, 0.0, 1.0)); }
  vec3 across = view * n;
  float light = 0.45 + 0.45 * max(dot(across, normalize(vec3(0.3, 0.6, 0.8))), 0.0) + 0.18 * abs(across.z);
  shown = vec4(colour * light, 1.0); }`;
const FAR_OFF = -1e9; // stands in the texture for a place of which nothing is said

function surfaceOf(gl, relief, cutting) {
  const { program, at: u } = programOf(gl, RELIEF_VERTEX, RELIEF_FRAGMENT), { rows, columns } = relief;
  const texture = (values) => {
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, columns, rows, 0, gl.RED, gl.FLOAT, values);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    return made;
  };
  const stock = texture(cutting.heights), part = texture(cutting.target.map((one) => (Number.isNaN(one) ? FAR_OFF : one))), grids = new Map();
  const gridOf = (stride) => {
    if (grids.has(stride)) return grids.get(stride);
    const nx = Math.ceil(columns / stride), ny = Math.ceil(rows / stride), wide = nx + 2, index = new Uint32Array(6 * (nx + 1) * (ny + 1));
    let k = 0;
    for (let j = 0; j <= ny; j++) for (let i = 0; i <= nx; i++) {
      const a = j * wide + i;
      index.set([a, a + 1, a + wide + 1, a, a + wide + 1, a + wide], k);
      k += 6;
    }
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, index, gl.STATIC_DRAW);
    const made = { nx, ny, array, count: k };
    grids.set(stride, made);
    return made;
  };
  const closed = cutting.floors.every((one) => one === cutting.floors[0]); // below, the plate is even
  return (eye, painter, { most, deviation }) => {
    const stride = Math.max(1, Math.ceil(Math.sqrt(2 * rows * columns / most))), grid = gridOf(stride);
    const [from, to] = cutting.changed;
    if (to > from) {
      gl.bindTexture(gl.TEXTURE_2D, stock);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, from, columns, to - from, gl.RED, gl.FLOAT, cutting.heights.subarray(from * columns, to * columns));
      cutting.changed = [rows, 0];
    }
    gl.useProgram(program);
    gl.disable(gl.CULL_FACE);
    [stock, part].forEach((one, k) => { gl.activeTexture(gl.TEXTURE0 + k); gl.bindTexture(gl.TEXTURE_2D, one); });
    gl.activeTexture(gl.TEXTURE0);
    gl.uniform1i(u.stock, 0);
    gl.uniform1i(u.part, 1);
    gl.uniform2i(u.cells, columns, rows);
    gl.uniform2f(u.corner, ...relief.corner);
    gl.uniform1f(u.cell, relief.cell);
    gl.uniform1f(u.bottom, -relief.thickness);
    gl.uniform1i(u.deviation, deviation ? 1 : 0);
    gl.uniformMatrix3fv(u.view, false, columnsOf(eye.rows().flat()));
    gl.uniform3fv(u.middle, eye.middle());
    gl.uniform2f(u.scale, ...painter.scale);
    gl.uniform1f(u.deep, 0.9 / painter.depth);
    gl.uniform4fv(u.cut, painter.cut);
    const draw = ({ nx, ny, array, count }, step, under) => {
      gl.uniform2i(u.grid, nx, ny);
      gl.uniform1i(u.stride, step);
      gl.uniform1i(u.coarse, step > 1 ? 1 : 0);
      gl.uniform1i(u.under, under ? 1 : 0);
      gl.bindVertexArray(array);
      gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
    };
    draw(grid, stride, false);
    if (closed && eye.height < 0) draw(gridOf(Math.max(rows, columns)), Math.max(rows, columns), true);
    painter.use();
  };
}
