// Bodies in space: triangles through WebGL, turned by dragging or by the arrow keys.
const BOLD = [[0, 0], [2, 0], [0, 2]]; // lines are one pixel wide: three make a bold one
const CREASE = Math.cos(35 * Math.PI / 180); // a sharper edge is drawn, and not shaded round

// Corners with normals, and the sharp edges, of a mesh.
function shaded(mesh) {
  const p = mesh.points, t = mesh.triangles, normals = [], around = new Map(), sides = new Map();
  for (let i = 0; i < t.length; i += 3) {
    const [a, b, c] = [t[i], t[i + 1], t[i + 2]].map((k) => p.slice(3 * k, 3 * k + 3));
    const u = b.map((v, k) => v - a[k]), w = c.map((v, k) => v - a[k]);
    normals.push([u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]]);
    for (let k = 0; k < 3; k++) {
      const from = t[i + k], to = t[i + (k + 1) % 3], key = Math.min(from, to) + "," + Math.max(from, to);
      if (!around.has(from)) around.set(from, []);
      around.get(from).push(i / 3);
      if (!sides.has(key)) sides.set(key, []);
      sides.get(key).push(i / 3);
    }
  }
  const size = normals.map((n) => Math.hypot(...n) || 1);
  const alike = (i, j) => normals[i].reduce((sum, v, k) => sum + v * normals[j][k], 0) > CREASE * size[i] * size[j];
  const corners = [], edges = [];
  t.forEach((k, place) => {
    const own = Math.floor(place / 3), n = [0, 0, 0];
    for (const other of around.get(k)) if (alike(own, other)) for (let j = 0; j < 3; j++) n[j] += normals[other][j];
    corners.push(p[3 * k], p[3 * k + 1], p[3 * k + 2], ...n);
  });
  for (const [key, [i, j]] of sides) {
    if (j === undefined || alike(i, j)) continue;
    for (const k of key.split(",")) edges.push(p[3 * k], p[3 * k + 1], p[3 * k + 2], 0, 0, 0);
  }
  return [corners, edges];
}

const VERTEX = `attribute vec3 point; attribute vec3 normal; uniform mat3 turn; uniform vec3 shift; uniform mat3 view;
uniform vec3 centre; uniform vec2 scale; uniform float nearer; uniform vec2 nudge; varying vec3 across;
void main() { vec3 seen = view * (turn * point + shift - centre); across = view * (turn * normal);
gl_Position = vec4(seen.xy * scale + nudge, -seen.z * min(scale.x, scale.y) * 0.45 - nearer, 1.0); }`;
const FRAGMENT = `precision mediump float; uniform vec3 colour; uniform float lit; varying vec3 across;
void main() { float light = 1.0; if (lit > 0.5) { vec3 n = normalize(across); light = 0.42 + 0.48 * max(dot(n,
normalize(vec3(0.3, 0.6, 0.8))), 0.0) + 0.2 * abs(n.z); } gl_FragColor = vec4(colour * light, 1.0); }`;

function spacePicture(place) {
  const canvas = element("canvas", { tabindex: "0", role: "img",
    "aria-label": "The mechanism in space; arrow keys turn the view, plus and minus change its size" }, place);
  const gl = canvas.getContext("webgl", { antialias: true, alpha: true, preserveDrawingBuffer: true });
  if (!gl) {
    canvas.remove();
    element("p", { class: "note", text: "This browser has no WebGL, so the mechanism in space cannot be shown." }, place);
    return () => {};
  }
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "point");
  gl.bindAttribLocation(program, 1, "normal");
  gl.linkProgram(program);
  gl.useProgram(program);
  gl.enable(gl.DEPTH_TEST);
  gl.enableVertexAttribArray(0);
  gl.enableVertexAttribArray(1);
  const uniform = (name) => gl.getUniformLocation(program, name);
  const [turn, shift, view, centre, scale, nearer, nudge, colour, lit] =
    ["turn", "shift", "view", "centre", "scale", "nearer", "nudge", "colour", "lit"].map(uniform);
  const stored = (values) => {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(values), gl.STATIC_DRAW);
    return [buffer, values.length / 6];
  };
  const draw = (kind, [buffer, count]) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 24, 0);
    gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 24, 12);
    gl.drawArrays(kind, 0, count);
  };
  const rgb = (text) => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16) / 255);
  const things = data.meshes.map((mesh) => {
    const [corners, edges] = shaded(mesh);
    for (let k = 0; mesh.lines && k < mesh.lines.length; k += 3) edges.push(...mesh.lines.slice(k, k + 3), 0, 0, 0);
    const thing = { faces: stored(corners), edges: stored(edges), colour: rgb(mesh.colour), bold: Boolean(mesh.lines), pose: data.poses[mesh.body], on: true };
    const show = shown.get(mesh.name) || { colour: mesh.colour, parts: [] };
    show.parts.push((on) => { thing.on = on; paint(now); });
    shown.set(mesh.name, show);
    return thing;
  });
  // Another design below this one: its edges alone, in the time of this one.
  const ghost = data.ghost && data.ghost.meshes ? data.ghost : null;
  const stretch = ghost ? (Math.max(...Object.values(ghost.poses).map((pose) => pose.columns[0].length)) - 1) / last : 1;
  const soft = rgb("#8a929a"), below = !ghost ? [] : ghost.meshes.map((mesh) => {
    const edges = shaded(mesh)[1];
    for (let k = 0; mesh.lines && k < mesh.lines.length; k += 3) edges.push(...mesh.lines.slice(k, k + 3), 0, 0, 0);
    return { edges: stored(edges), pose: ghost.poses[mesh.body] };
  });
  const apart = (one, two) => Math.hypot(...one.centre.map((part, k) => part - two.centre[k])) + two.radius;
  const reach = ghost ? Math.max(data.ball.radius, apart(data.ball, ghost.ball)) : data.ball.radius;
  const paths = Object.entries(data.traces).map(([name, path]) => {
    const thing = { line: stored(path.flatMap((point) => [...point, 0, 0, 0])), columns: [0, 1, 2].map((k) => path.map((point) => point[k])), on: true };
    shown.set("path of " + name, { parts: [(on) => { thing.on = on; paint(now); }] });
    return thing;
  });
  // A small cross of three lines marks where the point is.
  const cross = stored([0, 1, 2].flatMap((k) => [-1, 1].flatMap((sign) => [0, 1, 2].map((j) => j === k ? sign * reach / 40 : 0).concat(0, 0, 0))));
  let [azimuth, height, zoom] = kept.view || [-0.6, 0.35, 1.15], now = 0;
  viewed = () => [azimuth, height, zoom];
  // A browser has some sixteen such contexts at most.
  signal.addEventListener("abort", () => { const end = gl.getExtension("WEBGL_lose_context"); if (end) end.loseContext(); });
  // The ground's frame, whose third axis is drawn upwards.
  const up = data.up, side = Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const times = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unitOf = (a) => a.map((part) => part / Math.hypot(...a));
  const second = unitOf(times(up, side)), frame = [times(second, up), second, up];
  const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1];

  function stand(pose, time) {
    const [x, y, z, ...q] = pose.columns.map((column) => at(column, time));
    const size = Math.hypot(...q), [w, i, j, k] = q.map((part) => part / size);
    gl.uniformMatrix3fv(turn, false, [1 - 2 * (j * j + k * k), 2 * (i * j + k * w), 2 * (i * k - j * w),
      2 * (i * j - k * w), 1 - 2 * (i * i + k * k), 2 * (j * k + i * w),
      2 * (i * k + j * w), 2 * (j * k - i * w), 1 - 2 * (i * i + j * j)]);
    gl.uniform3f(shift, x, y, z);
  }
  function paint(time) {
    now = time;
    const dense = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    const wide = Math.max(1, Math.round(box.width * dense)), tall = Math.max(1, Math.round(box.height * dense));
    if (canvas.width !== wide || canvas.height !== tall) [canvas.width, canvas.height] = [wide, tall];
    gl.viewport(0, 0, wide, tall);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const ca = Math.cos(azimuth), sa = Math.sin(azimuth), ch = Math.cos(height), sh = Math.sin(height);
    // Columns of the matrix: to the right, up, and towards the eye.
    const rows = [[ca, sa, 0], [sa * sh, -ca * sh, ch], [-sa * ch, ca * ch, sh]]
      .map((row) => [0, 1, 2].map((k) => row.reduce((sum, part, j) => sum + part * frame[j][k], 0)));
    gl.uniformMatrix3fv(view, false, [0, 1, 2].flatMap((k) => rows.map((row) => row[k])));
    gl.uniform3fv(centre, data.ball.centre);
    const unit = zoom * Math.min(wide, tall) / reach;
    gl.uniform2f(scale, unit / wide, unit / tall);
    gl.uniform1f(lit, 0);
    gl.uniform1f(nearer, 0);
    gl.uniform2f(nudge, 0, 0);
    gl.uniform3fv(colour, soft);
    for (const { edges, pose } of below) {
      stand(pose, Math.min(time * stretch, Math.max(1, pose.columns[0].length) - 1));
      draw(gl.LINES, edges);
    }
    for (const thing of things) {
      if (!thing.on) continue;
      stand(thing.pose, time);
      gl.uniform3fv(colour, thing.colour);
      gl.uniform1f(lit, 1);
      gl.uniform1f(nearer, 0);
      if (!thing.bold) draw(gl.TRIANGLES, thing.faces);
      gl.uniform3fv(colour, thing.colour.map((part) => part * (thing.bold ? 0.9 : 0.35)));
      gl.uniform1f(lit, 0);
      gl.uniform1f(nearer, 0.0015);
      for (const [right, high] of thing.bold ? BOLD : [[0, 0]]) {
        gl.uniform2f(nudge, right / wide, high / tall);
        draw(gl.LINES, thing.edges);
      }
      gl.uniform2f(nudge, 0, 0);
    }
    gl.uniformMatrix3fv(turn, false, IDENTITY);
    gl.uniform3fv(colour, rgb("#c4302b"));
    gl.uniform1f(lit, 0);
    gl.disable(gl.DEPTH_TEST); // a path is seen through what hides it
    for (const path of paths) {
      if (!path.on) continue;
      for (const [right, high] of BOLD) {
        gl.uniform2f(nudge, right / wide, high / tall);
        gl.uniform3f(shift, 0, 0, 0);
        draw(gl.LINE_STRIP, path.line);
        gl.uniform3f(shift, ...path.columns.map((column) => at(column, time)));
        draw(gl.LINES, cross);
      }
    }
    gl.uniform2f(nudge, 0, 0);
    gl.enable(gl.DEPTH_TEST);
    if (data.seen) data.seen(seenAs(rows, zoom * Math.min(box.width, box.height) / reach / 2, box));
  }
  // Where a place is on the canvas, with its height towards the eye; and the place of the sphere under a point there.
  function seenAs(rows, unit, box) {
    const turned = (p) => rows.map((row) => row.reduce((sum, part, k) => sum + part * (p[k] - data.ball.centre[k]), 0));
    const middle = turned([0, 0, 0]);
    return {
      to: (p) => { const [u, v, w] = turned(p); return [box.width / 2 + u * unit, box.height / 2 - v * unit, w - middle[2]]; },
      back: (x, y, old) => {
        const radius = Math.hypot(...old), front = turned(old)[2] >= middle[2] ? 1 : -1;
        let u = (x - box.width / 2) / unit - middle[0], v = (box.height / 2 - y) / unit - middle[1];
        const far = Math.max(1, Math.hypot(u, v) / radius); // outside of the sphere: its rim
        u /= far;
        v /= far;
        const w = front * Math.sqrt(Math.max(0, radius * radius - u * u - v * v));
        return [0, 1, 2].map((k) => rows[0][k] * u + rows[1][k] * v + rows[2][k] * w);
      },
    };
  }
  const look = (right, up, size) => {
    azimuth -= right;
    height = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, height + up));
    zoom = Math.min(20, Math.max(0.3, zoom * size));
    paint(now);
  };
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) look(event.movementX / 150, event.movementY / 150, 1);
  });
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); look(0, 0, Math.exp(-event.deltaY / 600)); }, { passive: false });
  const keys = { ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1], "+": [0, 0, 1.15], "-": [0, 0, 1 / 1.15] };
  canvas.addEventListener("keydown", (event) => {
    if (!(event.key in keys)) return;
    event.preventDefault();
    look(...keys[event.key]);
  });
  window.addEventListener("resize", () => paint(now));
  return paint;
}
