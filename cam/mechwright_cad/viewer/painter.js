// The painter: triangles and lines by WebGL 2, cut off by a plane; lines are one pixel wide, three make a bold one.
const BOLD = [[0, 0], [2, 0], [0, 2]], FINEST = 2; // points of a picture at rest for each of the screen: its lines are smooth
const VERTEX = `#version 300 es
layout(location = 0) in vec3 point; layout(location = 1) in vec3 normal;
uniform mat3 turn; uniform vec3 shift; uniform mat3 view; uniform vec3 middle; uniform vec2 scale; uniform float deep; uniform float nearer;
uniform vec2 nudge; out vec3 across; out vec3 place;
void main() { place = turn * point + shift; vec3 seen = view * (place - middle); across = view * (turn * normal);
gl_Position = vec4(seen.xy * scale + nudge, -seen.z * deep - nearer, 1.0); }`;
const FRAGMENT = `#version 300 es
precision highp float; uniform vec3 colour; uniform float lit; uniform float alpha; uniform vec4 cut; in vec3 across; in vec3 place; out vec4 shown;
void main() {
  if (dot(cut.xyz, place) > cut.w) discard;
  if (lit < 0.5) { shown = vec4(colour, 1.0); return; }
  if (!gl_FrontFacing) { // the inside of a body that is cut: its section, hatched
    float line = step(0.8, fract((gl_FragCoord.x + gl_FragCoord.y) / 9.0));
    shown = vec4(colour * (0.86 - 0.3 * line), 1.0); return; }
  vec3 n = normalize(across);
  float light = 0.42 + 0.48 * max(dot(n, normalize(vec3(0.3, 0.6, 0.8))), 0.0) + 0.2 * abs(n.z);
  shown = vec4(colour * light, 1.0) * alpha; }`;
const rgb = (text) => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16) / 255);

function programOf(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const names = Array.from({ length: gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) }, (_, k) => gl.getActiveUniform(program, k).name);
  return { program, at: Object.fromEntries(names.map((name) => [name.replace("[0]", ""), gl.getUniformLocation(program, name)])) };
}
const columnsOf = (m) => [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];

// Draws into a canvas by what `eye` sees; null where the browser has no WebGL 2.
function painterOn(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: false, alpha: true, preserveDrawingBuffer: true });
  if (!gl) return null;
  const { program, at: u } = programOf(gl, VERTEX, FRAGMENT), own = { gl, cut: [0, 0, 0, 1], finer: FINEST, depth: 1 };
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  const stored = (data_, stride, count) => {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, data_, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, stride, 0);
    if (stride > 12) {
      gl.enableVertexAttribArray(1);
      gl.vertexAttribPointer(1, 3, gl.BYTE, true, stride, 12);
    }
    return { array, count };
  };
  own.faces = (corners, index) => {
    const made = stored(corners, 16, index.length);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, index, gl.STATIC_DRAW);
    return made;
  };
  own.lines = (points) => stored(new Float32Array(points), 12, points.length / 3);
  own.begin = (eye) => {
    const dense = (window.devicePixelRatio || 1) * own.finer, box = canvas.getBoundingClientRect();
    const wide = Math.max(1, Math.round(box.width * dense)), tall = Math.max(1, Math.round(box.height * dense));
    if (canvas.width !== wide || canvas.height !== tall) [canvas.width, canvas.height] = [wide, tall];
    gl.viewport(0, 0, wide, tall);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(program);
    gl.uniformMatrix3fv(u.view, false, columnsOf(eye.rows().flat()));
    gl.uniform3fv(u.middle, eye.middle());
    const unit = eye.unit() * dense;
    own.scale = [2 * unit / wide, 2 * unit / tall];
    gl.uniform2f(u.scale, ...own.scale);
    gl.uniform1f(u.deep, 0.9 / own.depth);
    gl.uniform4fv(u.cut, own.cut);
    gl.uniform2f(u.nudge, 0, 0);
    gl.uniform1f(u.alpha, 1);
    own.size = [wide, tall];
  };
  own.stand = ({ turn, place }) => {
    gl.uniformMatrix3fv(u.turn, false, columnsOf(turn));
    gl.uniform3fv(u.shift, place);
  };
  own.solid = ({ array, count }, colour, nearer = 0) => {
    const open = own.cut[0] || own.cut[1] || own.cut[2];
    if (open) gl.disable(gl.CULL_FACE); else gl.enable(gl.CULL_FACE);
    gl.uniform3fv(u.colour, colour);
    gl.uniform1f(u.lit, 1);
    gl.uniform1f(u.nearer, nearer);
    gl.bindVertexArray(array);
    gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
  };
  own.line = ({ array, count }, colour, { bold = false, strip = false, nearer = 0.0006 } = {}) => {
    gl.uniform3fv(u.colour, colour);
    gl.uniform1f(u.lit, 0);
    gl.uniform1f(u.nearer, nearer);
    gl.bindVertexArray(array);
    for (const [right, high] of bold ? BOLD : [[0, 0]]) {
      gl.uniform2f(u.nudge, right / own.size[0], high / own.size[1]);
      gl.drawArrays(strip ? gl.LINE_STRIP : gl.LINES, 0, count);
    }
    gl.uniform2f(u.nudge, 0, 0);
  };
  own.use = () => gl.useProgram(program); // again, after another has drawn
  // What is drawn meanwhile lets through what is behind it.
  own.clear = (alpha, draw) => {
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    gl.uniform1f(u.alpha, alpha);
    draw();
    gl.uniform1f(u.alpha, 1);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  };
  // What is drawn meanwhile is seen through what hides it, and is not cut.
  own.through = (draw) => {
    gl.disable(gl.DEPTH_TEST);
    gl.uniform4f(u.cut, 0, 0, 0, 1);
    draw();
    gl.uniform4fv(u.cut, own.cut);
    gl.enable(gl.DEPTH_TEST);
  };
  // A browser has some sixteen such contexts at most.
  own.end = () => { const end = gl.getExtension("WEBGL_lose_context"); if (end) end.loseContext(); };
  return own;
}
