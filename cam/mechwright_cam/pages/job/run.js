// The run: all steps of the proof, and where the tool is at a time.
const RAPID = 0, FEED = 1, ARC = 2, MICRON = 1000, TICK = 10000, TURN = 1e6;

function runOf(steps) {
  const n = steps.count, ends = unpacked(steps.end, "i4"), end = Float64Array.from(ends, (one) => one / MICRON), start = new Float64Array(3 * n);
  if (n) start.set(end.subarray(0, 3 * n - 3), 3);
  const from = unpacked(steps.from, "i4");
  unpacked(steps.jump, "u4").forEach((step, k) => { for (let j = 0; j < 3; j++) start[3 * step + j] = from[3 * k + j] / MICRON; });
  const centres = unpacked(steps.centre, "i4"), sweeps = unpacked(steps.sweep, "i4");
  const arcs = new Map(Array.from(unpacked(steps.arc, "u4"), (step, k) => [step, { x: centres[2 * k] / MICRON, y: centres[2 * k + 1] / MICRON, sweep: sweeps[k] / TURN }]));
  const own = {
    count: n, start, end, arcs, seconds: steps.seconds, tools: steps.tools, operations: steps.operations,
    kind: unpacked(steps.kind, "u1"), line: unpacked(steps.line, "u4"), time: Float64Array.from(unpacked(steps.time, "i4"), (one) => one / TICK),
    feed: unpacked(steps.feed, "i4"), engaged: unpacked(steps.engaged, "u1"),
  };
  own.begins = (step) => (step > 0 ? own.time[step - 1] : 0);
  // The step that runs at a time: the first that ends then or later.
  own.stepAt = (time) => {
    let low = 0, high = n - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (own.time[middle] >= time) high = middle; else low = middle + 1;
    }
    return low;
  };
  own.shareAt = (step, time) => {
    const begin = own.begins(step), long = own.time[step] - begin;
    return long > 0 ? Math.min(1, Math.max(0, (time - begin) / long)) : 1;
  };
  // A place of a step; a small difference of the two radii is spread along an arc.
  own.place = (step, share, to = [0, 0, 0]) => {
    const k = 3 * step, arc = own.kind[step] === ARC ? arcs.get(step) : null;
    if (arc) {
      const ax = start[k] - arc.x, ay = start[k + 1] - arc.y, first = Math.hypot(ax, ay);
      const radius = first + share * (Math.hypot(end[k] - arc.x, end[k + 1] - arc.y) - first), angle = Math.atan2(ay, ax) + share * arc.sweep;
      to[0] = arc.x + radius * Math.cos(angle);
      to[1] = arc.y + radius * Math.sin(angle);
    } else {
      to[0] = start[k] + share * (end[k] - start[k]);
      to[1] = start[k + 1] + share * (end[k + 1] - start[k + 1]);
    }
    to[2] = start[k + 2] + share * (end[k + 2] - start[k + 2]);
    return to;
  };
  own.placeAt = (time) => { const step = own.stepAt(time); return own.place(step, own.shareAt(step, time)); };
  own.lengthOf = (step) => {
    const k = 3 * step, arc = own.kind[step] === ARC ? arcs.get(step) : null, high = end[k + 2] - start[k + 2];
    return Math.hypot(arc ? Math.abs(arc.sweep) * Math.hypot(start[k] - arc.x, start[k + 1] - arc.y) : Math.hypot(end[k] - start[k], end[k + 1] - start[k + 1]), high);
  };
  const last_ = (list, step) => { let low = 0, high = list.length; while (low < high) { const m = (low + high) >> 1; if (list[m] <= step) low = m + 1; else high = m; } return low - 1; };
  const changes = own.tools.map(([step]) => step), begun = own.operations.map(([, first]) => first);
  own.toolAt = (step) => { const k = last_(changes, step); return k < 0 ? 0 : own.tools[k][1]; };
  own.operationAt = (step) => last_(begun, step);
  // The first step of a line, or of the next that has one.
  own.stepOfLine = (line) => { const k = own.line.findIndex((one) => one >= line); return k < 0 ? n - 1 : k; };
  return own;
}
