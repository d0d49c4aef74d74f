// Turned bodies: a tool's outlines turned about its axis, closed at both ends.
const SIDES = 32;
function turnedForm(profile) {
  const rings = [[0, profile[0][1]], ...profile, [0, profile[profile.length - 1][1]]].filter(([r, z], k, all) => !k || r !== all[k - 1][0] || z !== all[k - 1][1]);
  const points = new Float32Array(3 * SIDES * rings.length), triangles = [];
  rings.forEach(([r, z], k) => {
    for (let j = 0; j < SIDES; j++) points.set([r * Math.cos(2 * Math.PI * j / SIDES), r * Math.sin(2 * Math.PI * j / SIDES), z], 3 * (k * SIDES + j));
  });
  for (let k = 0; k + 1 < rings.length; k++) for (let j = 0; j < SIDES; j++) {
    const a = k * SIDES + j, b = k * SIDES + (j + 1) % SIDES, c = a + SIDES, d = b + SIDES;
    if (rings[k][0] > 0) triangles.push(a, b, d);
    if (rings[k + 1][0] > 0) triangles.push(a, d, c);
  }
  return { points, triangles: new Uint32Array(triangles) };
}
