// The stock while the program runs: a grid of heights, lowered along the path as the proof's simulation does it.
const NEAR_ = 1e-6, NOTHING = -(2 ** 31), KEPT = 24; // stocks that are kept, so that going back is quick

function inRuns({ lengths, values }, size) {
  const long = unpacked(lengths, "u4"), value = unpacked(values, "i4"), found = new Float32Array(size);
  let at_ = 0;
  long.forEach((count, k) => { found.fill(value[k] === NOTHING ? NaN : value[k] / 1000, at_, at_ += count); });
  return found;
}
function cuttingOf(run, relief, tools) {
  const { rows, columns, cell, corner, thickness } = relief, size = rows * columns;
  const first = inRuns(relief.heights, size), floors = inRuns(relief.floors, size), heights = first.slice();
  const own = { heights, floors, target: inRuns(relief.target, size), changed: [0, rows] };
  const byNumber = new Map(tools.map((tool) => [tool.number, tool])), discs = new Map();
  // Height of a tool's end above its tip, cell by cell; Infinity where the tool is not.
  const discOf = (number) => {
    if (discs.has(number)) return discs.get(number);
    const tool = byNumber.get(number), half = Math.ceil(tool.radius / cell), wide = 2 * half + 1, values = new Float32Array(wide * wide);
    for (let j = -half; j <= half; j++) for (let k = -half; k <= half; k++) {
      const away = Math.hypot(j * cell, k * cell), at_ = away / tool.radius * (tool.end.length - 1), low = Math.min(Math.floor(at_), tool.end.length - 2);
      values[(j + half) * wide + k + half] = away > tool.radius ? Infinity
        : tool.end.length < 2 ? 0 : tool.end[low] + (at_ - low) * (tool.end[low + 1] - tool.end[low]);
    }
    const disc = { half, wide, values, spacing: Math.sqrt(2 * tool.radius * cell) }; // no cusp between two places is wider than a quarter of a cell
    discs.set(number, disc);
    return disc;
  };
  function lower(disc, x, y, z) {
    if (z >= -NEAR_) return;
    const column = Math.floor((x - corner[0]) / cell), row = Math.floor((y - corner[1]) / cell), { half, wide, values } = disc;
    const j0 = Math.max(0, row - half), j1 = Math.min(rows - 1, row + half), k0 = Math.max(0, column - half), k1 = Math.min(columns - 1, column + half);
    if (j0 > j1 || k0 > k1) return;
    for (let j = j0; j <= j1; j++) {
      let at_ = (j - row + half) * wide + k0 - column + half, cell_ = j * columns + k0;
      for (let k = k0; k <= k1; k++, at_++, cell_++) {
        let tip = values[at_] + z;
        if (tip >= heights[cell_]) continue;
        if (tip <= floors[cell_] + NEAR_) tip = -thickness; // cut into what was open from below as well
        heights[cell_] = tip;
      }
    }
    own.changed[0] = Math.min(own.changed[0], j0);
    own.changed[1] = Math.max(own.changed[1], j1 + 1);
  }
  const here = [0, 0, 0];
  // What a step takes from one share of it to another.
  function cut(step, from, to) {
    if (run.kind[step] !== FEED && run.kind[step] !== ARC || Math.min(run.start[3 * step + 2], run.end[3 * step + 2]) >= -NEAR_) return;
    const number = run.toolAt(step);
    if (!byNumber.has(number)) return;
    const disc = discOf(number), count = Math.max(1, Math.ceil(run.lengthOf(step) / disc.spacing));
    for (let k = Math.ceil(from * count); k <= Math.floor(to * count); k++) lower(disc, ...run.place(step, k / count, here));
    if (to < 1) lower(disc, ...run.place(step, to, here));
  }
  const stops = [[0, first]]; // so many steps done, and the stock then
  const apart = Math.max(50, Math.ceil(run.count / KEPT));
  let done = 0, part = 0;
  // The stock at a time: `done` steps whole, and a part of the next.
  own.to = (step, share) => {
    if (step < done || step === done && share < part) {
      const [count, stock] = stops.filter(([one]) => one <= step).pop();
      heights.set(stock);
      own.changed = [0, rows];
      done = count;
      part = 0;
    }
    for (; done < step; done++) {
      cut(done, part, 1);
      part = 0;
      if ((done + 1) % apart === 0 && stops[stops.length - 1][0] < done + 1) stops.push([done + 1, heights.slice()]);
    }
    if (share > part) {
      cut(step, part, share);
      part = share;
    }
  };
  return own;
}
