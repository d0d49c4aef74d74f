// A train of elliptic gears in closed form, as mechwright_elliptic_gears.kinematics has it. Angles in rad, lengths
// in mm. A design is { a, e, gamma, omega, along, across }.

// The gear that a gear drives: equations (5) to (7).
function driven({ theta, omega, alpha }, e) {
  const turns = Math.floor((theta + Math.PI) / (2 * Math.PI)), half = (theta - 2 * Math.PI * turns) / 2;
  const angle = 2 * Math.PI * (1 - turns) - 2 * Math.atan2((1 + e) * Math.sin(half), (1 - e) * Math.cos(half));
  const f = (e * e - 1) / (1 + e * e - 2 * e * Math.cos(theta));
  const slope = 2 * e / (1 - e * e) * f * f * Math.sin(theta);
  return { theta: angle, omega: f * omega, alpha: slope * omega * omega + f * alpha };
}
// Angle of gear 4 ahead of gear 3, and how fast it grows with the phase angle.
function joint(gamma, e) {
  return 2 * Math.atan2((1 + e) * Math.sin(gamma / 2), (1 - e) * Math.cos(gamma / 2));
}
function jointRate(gamma, e) {
  return (1 - e * e) / (1 + e * e - 2 * e * Math.cos(gamma));
}
// Gears 4 and 5, and the place, speed and acceleration of point Q of the coupler.
function at(theta2, design) {
  const { a, e, gamma, omega, along, across } = design;
  const three = driven({ theta: theta2, omega, alpha: 0 }, e);
  const four = { ...three, theta: three.theta + joint(gamma, e) }, five = driven(four, e);
  const c = [along, across / (2 * a)], q = [2 * a * c[0], 2 * a * c[1]], v = [0, 0], w = [0, 0];
  for (const [gear, re, im] of [[four, 1 - c[0], -c[1]], [five, c[0], c[1]]]) {
    const cos = 2 * a * e * Math.cos(gear.theta), sin = 2 * a * e * Math.sin(gear.theta);
    const x = re * cos - im * sin, y = re * sin + im * cos, square = gear.omega * gear.omega;
    q[0] += x;
    q[1] += y;
    v[0] -= gear.omega * y;
    v[1] += gear.omega * x;
    w[0] += -square * x - gear.alpha * y;
    w[1] += -square * y + gear.alpha * x;
  }
  return { four, five, q, speed: Math.hypot(...v), acceleration: Math.hypot(...w) };
}
// The greatest value over a turn: the best samples, each refined by golden sections.
function peak(f, samples = 2048) {
  const step = 2 * Math.PI / samples, values = Array.from({ length: samples }, (_, k) => f(k * step));
  const most = Math.max(...values), golden = (Math.sqrt(5) - 1) / 2;
  let best = { value: -Infinity, angle: 0 };
  values.forEach((value, k) => {
    const before = values[(k + samples - 1) % samples], after = values[(k + 1) % samples];
    if (value < before || value < after || value < most - 0.2 * Math.abs(most)) return;
    let low = (k - 1) * step, high = (k + 1) * step;
    for (let n = 0; n < 50; n++) {
      const one = high - golden * (high - low), two = low + golden * (high - low);
      if (f(one) < f(two)) low = one; else high = two;
    }
    const angle = (low + high) / 2, found = Math.max(f(angle), value);
    // Of two mirrored peaks the first is told, and one at 0 is not said to be at a whole turn.
    if (found > best.value + 1e-9 * Math.abs(most)) best = { value: found, angle: angle > 2 * Math.PI - 1e-6 ? 0 : Math.max(angle, 0) };
  });
  return best;
}
// The longest part of a turn, taken cyclically, on which the spread of f is at most the band.
function longestWindow(f, band, samples = 8192) {
  const step = 2 * Math.PI / samples, values = Array.from({ length: samples }, (_, k) => f(k * step));
  if (Math.max(...values) - Math.min(...values) <= band) return { start: 0, length: 2 * Math.PI, low: Math.min(...values) };
  const value = (k) => values[k % samples], lows = [], highs = [];
  let best = { from: 0, to: 0, low: 0, high: 0 }, from = 0;
  for (let to = 0; to < 2 * samples; to++) {
    while (lows.length && value(lows.at(-1)) >= value(to)) lows.pop();
    while (highs.length && value(highs.at(-1)) <= value(to)) highs.pop();
    lows.push(to);
    highs.push(to);
    while (value(highs[0]) - value(lows[0]) > band) {
      from++;
      if (lows[0] < from) lows.shift();
      if (highs[0] < from) highs.shift();
    }
    if (to - from > best.to - best.from) best = { from, to, low: value(lows[0]), high: value(highs[0]) };
  }
  // Between two samples the end is where the band is left.
  const end = (inside, outside) => {
    for (let n = 0; n < 40; n++) {
      const middle = (inside + outside) / 2, here = f(middle);
      if (here <= best.low + band && here >= best.high - band) inside = middle; else outside = middle;
    }
    best.low = Math.min(best.low, f(inside));
    best.high = Math.max(best.high, f(inside));
    return inside;
  };
  const first = end(best.from * step, (best.from - 1) * step), last = end(best.to * step, (best.to + 1) * step);
  return { start: (first + 2 * Math.PI) % (2 * Math.PI), length: last - first, low: best.low };
}
// What a row of tables 2 and 3 says of a design.
function figuresOf(design, band) {
  const speed = (theta2) => at(theta2, design).speed;
  return {
    joint: joint(design.gamma, design.e),
    rate: jointRate(design.gamma, design.e),
    most: peak(speed),
    least: -peak((theta2) => -speed(theta2)).value,
    acceleration: peak((theta2) => at(theta2, design).acceleration),
    window: longestWindow(speed, band),
  };
}
