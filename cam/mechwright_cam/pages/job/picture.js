// The picture of the job: stock, tool, path, what holds the part, the finished part, and a mark that is looked at.
const MOVING = 40000, RESTING = 500000, LAST = 3000, REACH = 8; // triangles of the stock while it changes, and at rest; steps of the path meanwhile; pixels to it

function jobPicture(place, run, cutting, options) {
  const canvas = element("canvas", { tabindex: "0", role: "img", "aria-label": "The program played on its stock. Arrow keys turn the view, "
    + "with Shift they move it; plus and minus change its size; 1 to 7 are the standard views, 0 fits it" }, place);
  const painter = painterOn(canvas);
  if (!painter) { canvas.remove(); return null; }
  const [x0, y0] = data.relief.corner, x1 = x0 + data.relief.columns * data.relief.cell, y1 = y0 + data.relief.rows * data.relief.cell;
  const ball = { centre: [(x0 + x1) / 2, (y0 + y1) / 2, -data.relief.thickness / 2], radius: Math.hypot(x1 - x0, y1 - y0, data.relief.thickness) / 2 };
  const made = (form) => { const { corners, index, edges } = shaded(form); return { faces: painter.faces(corners, index), edges: painter.lines(edges) }; };
  const surface = surfaceOf(painter.gl, data.relief, cutting), route = routeOf(painter.gl, run);
  const tools = new Map(data.tools.map((tool) => [tool.number, tool.outlines.map((one) => ({ rgb: rgb(one.colour), ...made(turnedForm(one.profile)) }))]));
  const fixtures = data.fixtures.map((one) => ({ ...one, rgb: rgb(one.colour), ...made(formOf(one.form)) }));
  const ghost = { rgb: rgb(data.ghost.colour), ...made(formOf(data.ghost.form)) };
  const cross = painter.lines([0, 1, 2].flatMap((k) => [-1, 1].flatMap((sign) => [0, 1, 2].map((j) => (j === k ? sign * ball.radius / 14 : 0)))));
  const own = { canvas, painter, route, cutting, ball, drawn: 0, mark: null };
  let step = 0, share = 0, before = 0, slow = 0, resting = 0, asked = 0, still = true;
  const eye = own.eye = eyeOn(canvas, ball, [0, 0, 1], [FRONT.corner[0], 0.75, 0.95], () => again());
  function paint() {
    own.drawn += 1;
    cutting.to(step, share);
    const tool = run.toolAt(step), at_ = own.at = run.place(step, share), turn = STANDS.turn;
    painter.depth = 4 * ball.radius + data.clearance;
    painter.begin(eye);
    if (options.stock) surface(eye, painter, { most: still && painter.finer === FINEST ? RESTING : MOVING, deviation: options.deviation });
    for (const one of fixtures) {
      if (!options.fixtures || one.kind === "clamp" && step < one.since) continue;
      painter.stand(STANDS);
      painter.solid(one.faces, one.rgb);
      painter.line(one.edges, one.rgb.map((part) => part * 0.4));
    }
    if (options.path !== "none") {
      const [, first] = run.operations[run.operationAt(step)] || [0, 0];
      const rests = still && painter.finer === FINEST, to = options.path === "all" && rests ? run.count : step + 1;
      route.draw(eye, painter, Math.max(options.path === "operation" ? first : 0, rests ? 0 : step - LAST), to);
    }
    painter.stand({ turn, place: at_ });
    if (options.tool) for (const one of tools.get(tool) || []) {
      const draw = () => painter.solid(one.faces, one.rgb);
      if (options.holder) draw(); else painter.clear(0.45, draw);
    }
    painter.stand(STANDS);
    if (options.ghost) {
      painter.clear(0.35, () => painter.solid(ghost.faces, ghost.rgb, 0.001)); // before the faces of the stock that it shares
      painter.line(ghost.edges, ghost.rgb.map((part) => part * 0.7), { nearer: 0.0015 });
    }
    if (own.mark) painter.through(() => { painter.stand({ turn, place: own.mark }); painter.line(cross, rgb("#d4145a"), { bold: true }); });
    const at_now = performance.now(), moves = !still || eye.held();
    slow = moves && before ? 0.7 * slow + 0.3 * Math.min(at_now - before, 500) : 0;
    before = at_now;
    if (slow > SLOW_ && painter.finer > 0.5) { painter.finer /= 2; slow = 0; }
    clearTimeout(resting);
    if (painter.finer < FINEST) resting = setTimeout(rest, 220);
  }
  function rest() {
    if (!still || eye.held()) { resting = setTimeout(rest, 220); return; }
    painter.finer = FINEST;
    paint();
  }
  function again() {
    cancelAnimationFrame(asked);
    asked = requestAnimationFrame(paint);
  }
  // Shows a step and a share of it; `runs` says that more follows at once.
  own.show = (step_, share_, runs) => {
    [step, share] = [step_, share_];
    if (still && runs) painter.finer = Math.min(painter.finer, 1);
    still = !runs;
    paint();
  };
  own.again = again;
  own.stepAt = (x, y) => route.nearest(eye, x, y, 0, options.path === "all" ? run.count : step + 1, REACH);
  new ResizeObserver(again).observe(canvas);
  canvas.job = own; // for tests, which read back what is drawn
  return own;
}
const SLOW_ = 60; // ms
