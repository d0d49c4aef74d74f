// Bodies in space: drawn by WebGL 2, turned, cut, taken apart, picked and measured.
const SLOW = 50, LONGEST = 500, REST = 220; // ms: a picture that takes longer is drawn coarser while things move; when it is fine again; of a picture that counts
const DISTANCE = "#1f6fb4", TRACE = "#c4302b", MARK = [0.95, 0.55, 0.1], SOFT = "#8a929a";

function spacePicture(place) {
  if (data.large) {
    element("p", { class: "note", text: `The mechanism has ${data.large.toLocaleString("en")} triangles, too many to be drawn here: open its STEP file.` }, place);
    return () => {};
  }
  const box = element("div", { class: "space" }, place), shape = data.bare ? "joints and links" : "bodies";
  const canvas = element("canvas", { tabindex: "0", role: "img", "aria-label": `The mechanism in space, its ${shape}. `
    + "Arrow keys turn the view, with Shift they move it; plus and minus change its size; 1 to 7 are the standard views, 0 fits it; Enter picks what is in the middle" }, box);
  const painter = painterOn(canvas);
  if (!painter) {
    box.remove();
    element("p", { class: "note", text: "This browser has no WebGL 2, so the mechanism in space cannot be shown." }, place);
    return () => {};
  }
  const forms = (data.forms || []).map(formOf), faces = forms.map((form) => {
    const { corners, index, edges } = shaded(form);
    return { faces: painter.faces(corners, index), edges: painter.lines(edges) };
  });
  const ends = (mesh) => painter.lines(mesh.lines);
  const things = data.meshes.map((mesh) => {
    const thing = { ...mesh, on: true, now: STANDS, pose: data.poses[mesh.body], rgb: rgb(mesh.colour), lift: [0, 0, mesh.z || 0], bold: Boolean(mesh.lines) };
    if (mesh.form === undefined) thing.edges = ends(mesh);
    else Object.assign(thing, faces[mesh.form], { form: forms[mesh.form] });
    const show = shown.get(mesh.name) || { colour: mesh.colour, parts: [], group: mesh.group, off: mesh.off };
    show.parts.push((on) => { thing.on = on; again(); });
    shown.set(mesh.name, show);
    return thing;
  });
  // Another design below this one: its edges alone, in the time of this one.
  const ghost = data.ghost && data.ghost.meshes ? data.ghost : null;
  const stretch = ghost ? (Math.max(...Object.values(ghost.poses).map((pose) => pose.columns[0].length)) - 1) / last : 1;
  const below = !ghost ? [] : ghost.meshes.map((mesh) => ({ pose: ghost.poses[mesh.body], lift: [0, 0, mesh.z || 0],
    edges: mesh.form === undefined ? ends(mesh) : painter.lines(shaded(formOf(ghost.forms[mesh.form])).edges) }));
  const apart = (one, two) => Math.hypot(...plus(one.centre, two.centre, -1)) + two.radius;
  const ball = { centre: data.ball.centre, radius: ghost ? Math.max(data.ball.radius, apart(data.ball, ghost.ball)) : data.ball.radius };
  const eye = eyeOn(canvas, ball, data.up, kept.view, () => again());
  const paths = Object.entries(data.traces).map(([name, points]) => {
    const path = { line: painter.lines(points.flat()), columns: [0, 1, 2].map((k) => points.map((point) => point[k])), on: true };
    shown.set("path of " + name, { parts: [(on) => { path.on = on; again(); }] });
    return path;
  });
  const cross = painter.lines([0, 1, 2].flatMap((k) => [-1, 1].flatMap((sign) => [0, 1, 2].map((j) => j === k ? sign * ball.radius / 40 : 0))));
  const own = { canvas, eye, painter, things, ball, explode: 0, chosen: null, measures: [], traces: [], drawn: 0 };
  const far = Math.max(0, ...data.meshes.map((mesh) => Math.hypot(...mesh.shift || [0])));
  let now = 0, before = 0, slow = 0, resting = 0;
  viewed = () => eye.state();
  signal.addEventListener("abort", painter.end);
  const shiftOf = (thing) => plus(thing.now.place, thing.shift || [0, 0, 0], thing.shift ? own.explode : 0);

  own.stand = (thing, time) => {
    const { turn, place: at_ } = poseAt(thing.pose, time);
    return { turn, place: plus(at_, turnedBy(turn, thing.lift)) };
  };
  function paint(time) {
    now = time;
    own.drawn += 1;
    for (const thing of things) {
      thing.now = own.stand(thing, time);
      if (own.explode) thing.now.place = shiftOf(thing);
    }
    painter.depth = 2 * ball.radius + far * own.explode; // within which all is drawn, before and behind the middle
    painter.begin(eye);
    for (const one of below) {
      painter.stand(own.stand(one, Math.min(time * stretch, Math.max(1, one.pose.columns[0].length) - 1)));
      painter.line(one.edges, rgb(SOFT));
    }
    for (const thing of things) {
      if (!thing.on) continue;
      const colour = thing === own.chosen ? thing.rgb.map((part, k) => (part + 2 * MARK[k]) / 3) : thing.rgb;
      painter.stand(thing.now);
      if (thing.faces) painter.solid(thing.faces, colour);
      if (thing.bold || painter.finer > 0.5) painter.line(thing.edges, colour.map((part) => part * (thing.bold ? 0.9 : 0.35)), { bold: thing.bold || painter.finer > 1 });
    }
    painter.through(() => {
      for (const path of [...paths, ...own.traces]) {
        if (path.on === false) continue;
        painter.stand(STANDS);
        painter.line(path.line, rgb(TRACE), { bold: true, strip: true });
        painter.stand({ turn: STANDS.turn, place: path.columns.map((column) => at(column, time)) });
        painter.line(cross, rgb(TRACE));
      }
      painter.stand(STANDS);
      for (const measure of own.measures) painter.line(measure.line(painter), rgb(DISTANCE), { bold: true });
    });
    if (data.seen) data.seen({ to: (p) => { const seen = eye.to(p); return [seen[0], seen[1], seen[2] - eye.to([0, 0, 0])[2]]; }, back: eye.onSphere });
    if (own.painted) own.painted();
    pace_();
  }
  // What moves too slowly is drawn with a quarter of the points until it rests, and if need be with a quarter of these.
  function pace_() {
    const at_ = performance.now(), moves = eye.held() || runs();
    slow = moves && before ? 0.7 * slow + 0.3 * Math.min(at_ - before, LONGEST) : 0;
    before = at_;
    if (slow > SLOW && painter.finer > 0.5) {
      painter.finer /= 2;
      slow = 0;
    }
    clearTimeout(resting);
    if (painter.finer < FINEST) resting = setTimeout(rest, REST);
  }
  function rest() {
    if (eye.held() || runs()) { resting = setTimeout(rest, REST); return; }
    painter.finer = FINEST;
    paint(now);
  }
  let asked_ = 0;
  function again() {
    cancelAnimationFrame(asked_);
    asked_ = requestAnimationFrame(() => { if (!signal.aborted) paint(now); });
  }
  own.again = again;
  own.time = () => now;
  own.pick = (x, y) => picked(things, eye.from(x, y), eye.rows()[2], painter.cut);
  own.paint = paint;
  window.addEventListener("resize", again, { signal });
  new ResizeObserver(again).observe(canvas);
  spaceTools(box, own);
  canvas.space = own; // for tests, which read back what is drawn
  return paint;
}
