// Poses: a turn of nine numbers, row by row, and a place, out of the columns of the page.
const STANDS = { turn: [1, 0, 0, 0, 1, 0, 0, 0, 1], place: [0, 0, 0] };
function poseAt(pose, time) {
  if (!pose) return STANDS;
  const columns = pose.columns;
  if (columns.length === 3) {
    const angle = at(columns[2], time), c = Math.cos(angle), s = Math.sin(angle), flip = pose.down ? -1 : 1;
    return { turn: [c, -s * flip, 0, s, c * flip, 0, 0, 0, flip], place: [at(columns[0], time), at(columns[1], time), pose.z || 0] };
  }
  const [x, y, z, ...q] = columns.map((column) => at(column, time));
  const size = Math.hypot(...q), [w, i, j, k] = q.map((part) => part / size);
  return { place: [x, y, z], turn: [1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w),
    2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w),
    2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)] };
}
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const plus = (a, b, share = 1) => [a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]];
const times = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unitOf = (a) => { const size = Math.hypot(...a) || 1; return a.map((part) => part / size); };
const turnedBy = (m, p) => [m[0] * p[0] + m[1] * p[1] + m[2] * p[2], m[3] * p[0] + m[4] * p[1] + m[5] * p[2], m[6] * p[0] + m[7] * p[1] + m[8] * p[2]];
const turnedBack = (m, p) => [m[0] * p[0] + m[3] * p[1] + m[6] * p[2], m[1] * p[0] + m[4] * p[1] + m[7] * p[2], m[2] * p[0] + m[5] * p[1] + m[8] * p[2]];
