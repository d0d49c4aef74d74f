// Picking: which body a ray meets first, and where; the corner of its triangle that is meant, if one is near.
const NEAR = 9; // pixels within which a corner is meant

// `things` have a form and a pose; the ray comes from the eye through a place, along -towards.
function picked(things, from, towards, cut) {
  let best = null;
  for (const thing of things) {
    if (!thing.on || !thing.form) continue;
    const { turn, place } = thing.now, { points: p, triangles: t, low, high } = thing.form;
    const o = turnedBack(turn, plus(from, place, -1)), d = turnedBack(turn, towards);
    if (!meetsBox(o, d, low, high)) continue;
    for (let i = 0; i < t.length; i += 3) {
      const a = 3 * t[i], b = 3 * t[i + 1], c = 3 * t[i + 2];
      const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
      const wx = p[c] - p[a], wy = p[c + 1] - p[a + 1], wz = p[c + 2] - p[a + 2];
      const px = d[1] * wz - d[2] * wy, py = d[2] * wx - d[0] * wz, pz = d[0] * wy - d[1] * wx;
      const size = ux * px + uy * py + uz * pz;
      if (Math.abs(size) < 1e-12) continue;
      const sx = o[0] - p[a], sy = o[1] - p[a + 1], sz = o[2] - p[a + 2];
      const u = (sx * px + sy * py + sz * pz) / size;
      if (u < 0 || u > 1) continue;
      const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
      const v = (d[0] * qx + d[1] * qy + d[2] * qz) / size;
      if (v < 0 || u + v > 1) continue;
      const far = (wx * qx + wy * qy + wz * qz) / size; // towards the eye: the greatest is seen
      if (best && far <= best.far) continue;
      const point = plus(from, towards, far);
      if (dot(cut, point) > cut[3]) continue; // cut away
      best = { far, thing, point, own: plus(o, d, far), corners: [a, b, c].map((k) => [p[k], p[k + 1], p[k + 2]]) };
    }
  }
  return best;
}
function meetsBox(o, d, low, high) {
  let least = -Infinity, most = Infinity;
  for (let k = 0; k < 3; k++) {
    if (Math.abs(d[k]) < 1e-12) {
      if (o[k] < low[k] || o[k] > high[k]) return false;
      continue;
    }
    const one = (low[k] - o[k]) / d[k], two = (high[k] - o[k]) / d[k];
    least = Math.max(least, Math.min(one, two));
    most = Math.min(most, Math.max(one, two));
  }
  return least <= most;
}
// The place that a click on a body means, in the body's own coordinates: a corner that is near, else where it hit.
function meant3(hit, eye, x, y) {
  const { turn, place } = hit.thing.now;
  const near = hit.corners.map((own) => {
    const [u, v] = eye.to(plus(turnedBy(turn, own), place));
    return { own, off: Math.hypot(u - x, v - y) };
  }).sort((one, other) => one.off - other.off)[0];
  return near.off < NEAR ? near.own : hit.own;
}
