// Forms: arrays out of the page's text, corners with normals for shading, and the sharp edges.
const CREASE = Math.cos(35 * Math.PI / 180); // a sharper edge is drawn, and not shaded round

function bytesOf(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k++) bytes[k] = raw.charCodeAt(k);
  return bytes.buffer;
}
const KINDS = { i1: Int8Array, u1: Uint8Array, i2: Int16Array, u2: Uint16Array, i4: Int32Array, u4: Uint32Array };
const unpacked = (text, kind) => new KINDS[kind](bytesOf(text));

// Corners (3 n) in millimetres, triangles (3 k), and the box round them.
function formOf(stored) {
  const whole = unpacked(stored.points, "u2"), points = new Float32Array(whole.length);
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < whole.length; k++) {
    const value = stored.low[k % 3] + whole[k] * stored.step;
    points[k] = value;
    low[k % 3] = Math.min(low[k % 3], value);
    high[k % 3] = Math.max(high[k % 3], value);
  }
  return { points, triangles: unpacked(stored.triangles, stored.wide ? "u4" : "u2"), low, high };
}
// The normal of each triangle, as long as twice its area.
function normalsOf({ points: p, triangles: t }) {
  const normals = new Float32Array(t.length);
  for (let i = 0; i < t.length; i += 3) {
    const a = 3 * t[i], b = 3 * t[i + 1], c = 3 * t[i + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const wx = p[c] - p[a], wy = p[c + 1] - p[a + 1], wz = p[c + 2] - p[a + 2];
    normals[i] = uy * wz - uz * wy;
    normals[i + 1] = uz * wx - ux * wz;
    normals[i + 2] = ux * wy - uy * wx;
  }
  return normals;
}
// Corners with normals for the shading, 16 bytes each, the triangles between them, and the ends of sharp edges, 12 bytes each.
function shaded(form) {
  const { points, triangles } = form, count = triangles.length, normals = normalsOf(form);
  const size = new Float32Array(count / 3);
  for (let i = 0; i < count; i += 3) size[i / 3] = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
  const alike = (i, j) => normals[3 * i] * normals[3 * j] + normals[3 * i + 1] * normals[3 * j + 1]
    + normals[3 * i + 2] * normals[3 * j + 2] > CREASE * size[i] * size[j];
  // Triangles round each corner, one corner after the other.
  const first = new Uint32Array(points.length / 3 + 1), around = new Uint32Array(count);
  for (let k = 0; k < count; k++) first[triangles[k] + 1]++;
  for (let k = 1; k < first.length; k++) first[k] += first[k - 1];
  const next = first.slice();
  for (let k = 0; k < count; k++) around[next[triangles[k]]++] = Math.floor(k / 3);
  // Corners at one place with one normal are one.
  const buffer = new ArrayBuffer(16 * count), places = new Float32Array(buffer), turned = new Int8Array(buffer), known = new Map();
  const index = new Uint32Array(count);
  for (let k = 0; k < count; k++) {
    const corner = triangles[k], own = Math.floor(k / 3);
    let x = 0, y = 0, z = 0;
    for (let m = first[corner]; m < first[corner + 1]; m++) {
      const other = around[m];
      if (other !== own && !alike(own, other)) continue;
      x += normals[3 * other];
      y += normals[3 * other + 1];
      z += normals[3 * other + 2];
    }
    const length = Math.hypot(x, y, z) || 1, n = [x, y, z].map((part) => Math.round(127 * part / length));
    const key = ((corner * 256 + n[0] + 128) * 256 + n[1] + 128) * 256 + n[2] + 128;
    let place = known.get(key);
    if (place === undefined) {
      known.set(key, place = known.size);
      places.set(points.subarray(3 * corner, 3 * corner + 3), 4 * place);
      turned.set(n, 16 * place + 12);
    }
    index[k] = place;
  }
  const sides = new Map(), edges = [], many = points.length / 3;
  for (let k = 0; k < count; k++) {
    const from = triangles[k], to = triangles[k % 3 === 2 ? k - 2 : k + 1];
    const key = from < to ? from * many + to : to * many + from, other = sides.get(key);
    if (other === undefined) { sides.set(key, Math.floor(k / 3)); continue; }
    if (alike(other, Math.floor(k / 3))) continue;
    edges.push(...points.subarray(3 * from, 3 * from + 3), ...points.subarray(3 * to, 3 * to + 3));
  }
  return { corners: buffer.slice(0, 16 * known.size), index, edges: new Float32Array(edges) };
}
