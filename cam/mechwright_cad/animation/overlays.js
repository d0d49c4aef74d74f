// Over the bodies of a plane picture, hidden at first: poles and circles, velocities, lines fixed to bodies.
const LEAP = 3; // sizes of the picture: who goes farther between two samples came round through infinity
const STRAIGHT = 200; // sizes: a circle so wide rises by 1/800 of the picture, a pixel, and is none to be seen
const ARROW = 1 / 5, HEAD = 0.18; // of the picture: the longest arrow; of an arrow: its head
function overlays(turned, size) {
  const moves = [], add = (name, colour, ...drawn) => {
    shown.set(name, { colour, off: true, parts: [(on) => drawn.forEach((one) => { one.style.display = on ? "" : "none"; })] });
  };
  const poly = (xs, ys, kind) => {
    let path = "", pen = "M";
    xs.forEach((x, k) => {
      if (x === null || ys[k] === null) { pen = "M"; return; }
      // What comes back from infinity on the other side is no line across the picture.
      if (k && xs[k - 1] !== null && Math.hypot(x - xs[k - 1], ys[k] - ys[k - 1]) > LEAP * size) pen = "M";
      path += `${pen}${x} ${ys[k]}`;
      pen = "L";
    });
    return element("path", { class: kind, d: path }, turned);
  };
  for (const line of data.lines) {
    const drawn = element("path", { class: "fixed", d: line.path }, turned), pose = data.poses[line.body];
    moves.push((time) => put(drawn, pose, time));
    add(line.name, "var(--soft)", drawn);
  }
  for (const one of data.instants) {
    const [x0, y0, angle] = one.pose, [px, py] = one.centre, own = { columns: one.pose };
    // The instant centre as the body sees it.
    const inside = px.map((x, k) => x === null || py[k] === null ? [null, null] : [
      Math.cos(angle[k]) * (x - x0[k]) + Math.sin(angle[k]) * (py[k] - y0[k]), Math.cos(angle[k]) * (py[k] - y0[k]) - Math.sin(angle[k]) * (x - x0[k])]);
    const still = poly(px, py, "centrode"), moving = poly(inside.map(([x]) => x), inside.map(([, y]) => y), "centrode own");
    const mark = (kind) => element("circle", { class: "mark " + kind, r: size / 150 }, turned);
    const centre = mark("centre"), pole = mark("pole"), locus = poly(...one.pole, "locus"), circle = element("circle", { class: "inflection" }, turned);
    const move = (drawn, [xs, ys], time) => {
      const x = at(xs, time), y = at(ys, time), there = Number.isFinite(x) && Number.isFinite(y);
      drawn.setAttribute("cx", there ? x : 1e9);
      drawn.setAttribute("cy", there ? y : 1e9);
      return there ? [x, y] : null;
    };
    moves.push((time) => {
      put(moving, own, time);
      const p = move(centre, one.centre, time), j = [at(one.opposite[0], time), at(one.opposite[1], time)];
      move(pole, one.pole, time);
      const there = p && j.every(Number.isFinite) && Math.hypot(j[0] - p[0], j[1] - p[1]) < STRAIGHT * size;
      circle.setAttribute("cx", there ? (p[0] + j[0]) / 2 : 0);
      circle.setAttribute("cy", there ? (p[1] + j[1]) / 2 : 0);
      circle.setAttribute("r", there ? Math.hypot(j[0] - p[0], j[1] - p[1]) / 2 : 0);
    });
    add(`instant centre of ${one.body}, with its centrodes`, "#2e8b57", still, moving, centre);
    add(`acceleration pole of ${one.body}, with its path`, "#8e44ad", locus, pole);
    add(`inflection circle of ${one.body}`, "#d2691e", circle);
  }
  for (const [name, of] of Object.entries(data.arrows)) for (const [word, [xs, ys]] of Object.entries(of)) {
    const path = data.traces[name], kind = word === "velocity" ? "speed" : "push";
    const drawn = element("path", { class: "arrow " + kind }, turned);
    moves.push((time) => {
      const x = at(path.map((point) => point[0]), time), y = at(path.map((point) => point[1]), time);
      const u = at(xs, time) * size * ARROW, v = at(ys, time) * size * ARROW;
      const wing = (side) => `${x + u - HEAD * (u - side * v * 0.6)} ${y + v - HEAD * (v + side * u * 0.6)}`;
      drawn.setAttribute("d", `M${x} ${y}L${x + u} ${y + v}M${wing(1)}L${x + u} ${y + v}L${wing(-1)}`);
    });
    add(`${word} of ${name}`, word === "velocity" ? "#1f6fb4" : "#c0392b", drawn);
  }
  return (time) => moves.forEach((move) => move(time));
}
