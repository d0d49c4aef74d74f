// The path: lines of all moves in the order of the run, coloured by operation, feed, or engagement.
const ROUTE_VERTEX = `#version 300 es
layout(location = 0) in vec3 point; layout(location = 1) in vec3 tint; uniform mat3 view; uniform vec3 middle; uniform vec2 scale; uniform float deep; out vec3 colour;
void main() { vec3 seen = view * (point - middle); colour = tint; gl_Position = vec4(seen.xy * scale, -seen.z * deep, 1.0); }`;
const ROUTE_FRAGMENT = `#version 300 es
precision mediump float; uniform float alpha; in vec3 colour; out vec4 shown; void main() { shown = vec4(colour, alpha); }`;
const OPERATIONS = ["#1f6fb4", "#d2691e", "#2e8b57", "#8e44ad", "#c0392b", "#7f6a00", "#17818c", "#b5476f"], OF_RAPID = "#9aa5af";
const operationColour = (k) => OPERATIONS[((k % OPERATIONS.length) + OPERATIONS.length) % OPERATIONS.length];
const PIECE = 0.2; // rad: an arc is drawn in pieces so long
// From blue over green to red.
const heat = (share) => { const s = Math.min(1, Math.max(0, share)); return [Math.min(1, 2 * s), s < 0.5 ? 0.35 + s : 1.7 - 1.7 * s, Math.max(0, 1 - 2 * s)]; };

function routeOf(gl, run) {
  const { program, at: u } = programOf(gl, ROUTE_VERTEX, ROUTE_FRAGMENT), points = [], first = new Uint32Array(run.count + 1), owner = [];
  for (let step = 0; step < run.count; step++) {
    first[step] = owner.length;
    if (run.kind[step] > ARC || run.lengthOf(step) === 0) continue;
    const arc = run.kind[step] === ARC ? run.arcs.get(step) : null, count = arc ? Math.max(1, Math.ceil(Math.abs(arc.sweep) / PIECE)) : 1;
    let before = run.place(step, 0).slice();
    for (let k = 1; k <= count; k++) {
      const next = run.place(step, k / count).slice();
      points.push(...before, ...next);
      owner.push(step, step);
      before = next;
    }
  }
  first[run.count] = owner.length;
  const array = gl.createVertexArray(), tints = gl.createBuffer(), most = run.feed.reduce((a, b) => Math.max(a, b), 1);
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(points), gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 12, 0);
  const places = new Float32Array(points);
  const by = {
    operation: (step) => rgb(operationColour(run.operationAt(step))), feed: (step) => heat(run.feed[step] / most),
    engagement: (step) => heat(run.engaged[step] / 180),
  };
  function colour(name) {
    const bytes = new Uint8Array(4 * owner.length), grey = rgb(OF_RAPID);
    let last_ = -1, tint = grey;
    owner.forEach((step, k) => {
      if (step !== last_) tint = run.kind[step] === RAPID ? grey : by[name](step);
      last_ = step;
      for (let j = 0; j < 3; j++) bytes[4 * k + j] = 255 * tint[j];
    });
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, tints);
    gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 3, gl.UNSIGNED_BYTE, true, 4, 0);
  }
  colour("operation");
  return {
    colour, most,
    draw: (eye, painter, from, to) => {
      gl.useProgram(program);
      gl.uniformMatrix3fv(u.view, false, columnsOf(eye.rows().flat()));
      gl.uniform3fv(u.middle, eye.middle());
      gl.uniform2f(u.scale, ...painter.scale);
      gl.uniform1f(u.deep, 0.9 / painter.depth);
      gl.uniform1f(u.alpha, 1);
      gl.disable(gl.DEPTH_TEST);
      gl.bindVertexArray(array);
      gl.drawArrays(gl.LINES, first[from], first[to] - first[from]);
      gl.enable(gl.DEPTH_TEST);
      painter.use();
    },
    // The step of the move that is seen nearest to a point of the canvas, of some steps; -1 where none is near.
    nearest: (eye, x, y, from, to, reach) => {
      let best = -1, off = reach ** 2;
      const to_ = eye.projection();
      for (let k = first[from]; k < first[to]; k += 2) {
        const a = to_(places.subarray(3 * k, 3 * k + 3)), b = to_(places.subarray(3 * k + 3, 3 * k + 6));
        const dx = b[0] - a[0], dy = b[1] - a[1], long = dx * dx + dy * dy, t = long ? Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / long)) : 0;
        const away = (a[0] + t * dx - x) ** 2 + (a[1] + t * dy - y) ** 2;
        if (away < off) [best, off] = [owner[k], away];
      }
      return best;
    },
  };
}
