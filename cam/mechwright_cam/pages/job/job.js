// The page of a program: picture, bar, text and marks show one time of the run.
function job() {
  const run = runOf(data.steps), cutting = cuttingOf(run, data.relief, data.tools), by = (id) => document.getElementById(id);
  const options = { stock: true, tool: true, holder: true, path: "done", fixtures: true, ghost: false, deviation: false };
  const picture = data.large ? null : jobPicture(by("picture"), run, cutting, options), kinds = data.kinds;
  by("still").hidden = Boolean(picture);
  if (data.large) {
    by("why").textContent = `The program has ${data.large}. This is the stock at its end.`;
    for (const one of [...document.querySelectorAll("#bar, #controls, #listing, #picture, .tools")]) one.hidden = true;
  }
  by("views").hidden = by("shown").hidden = by("save").hidden = !picture;
  let time = 0, plays = null;
  const clock = (seconds) => `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(1).padStart(4, "0")}`;
  const severity = new Map();
  for (const mark of data.marks) if (mark.step >= 0 && severity.get(run.line[mark.step]) !== "failed") severity.set(run.line[mark.step], mark.kind);
  const listing = listingIn(by("listing"), data.text, severity, (line, way) => {
    let step = run.stepOfLine(line);
    if (way < 0) while (step > 0 && run.line[step] > line) step--;
    seek(run.time[step], line);
  });
  const bar = barIn(by("bar"), run, data.marks, seek);

  function show(running, line) {
    if (!run.count) return; // nothing moves
    const step = run.stepAt(time), share = run.shareAt(step, time), place = run.place(step, share);
    if (picture) picture.show(step, share, running);
    const own = line === undefined ? run.line[step] : line, operation = run.operations[run.operationAt(step)], tool = data.tools.find((one) => one.number === run.toolAt(step));
    listing.show(own);
    const words = `${clock(time)} of ${clock(run.seconds)}, line ${own + 1}, ${operation ? operation[0] : ""}`;
    bar(time, words);
    by("now").textContent = words;
    by("what").textContent = `${tool ? `T${tool.number} ${tool.name}` : "no tool"} · X${place[0].toFixed(3)} Y${place[1].toFixed(3)} Z${place[2].toFixed(3)} · `
      + (run.feed[step] ? `${run.feed[step]} mm/min, ${run.engaged[step]}° in material` : kinds[run.kind[step]]);
  }
  function seek(to, line) {
    time = Math.min(run.seconds, Math.max(0, to));
    show(false, line);
  }
  function tick(at_) {
    if (plays === null) return;
    time = Math.min(run.seconds, time + (at_ - plays) / 1000 * Number(by("speed").value));
    plays = at_;
    if (time >= run.seconds) play(false);
    show(plays !== null);
    if (plays !== null) requestAnimationFrame(tick);
  }
  function play(on) {
    if (on && time >= run.seconds) time = 0;
    by("play").textContent = on ? "Pause" : "Play";
    by("play").setAttribute("aria-pressed", String(on));
    plays = on ? performance.now() : null;
    if (on) requestAnimationFrame(tick);
  }
  by("play").addEventListener("click", () => { play(plays === null); if (plays === null) show(false); });
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target !== document.body) return;
    event.preventDefault();
    by("play").click();
  });
  const jump = (mark) => {
    play(false);
    if (picture) picture.mark = mark.at || (mark.step >= 0 ? run.place(mark.step, 1) : null);
    seek(mark.step >= 0 ? run.time[mark.step] : time, mark.step >= 0 ? run.line[mark.step] : undefined);
  };
  for (const mark of data.marks) {
    const one = element("li", { class: mark.kind }, by("marks")), button = element("button", { type: "button", text: mark.text }, one);
    button.addEventListener("click", () => jump(mark));
  }
  by("no-marks").hidden = data.marks.length > 0;
  if (picture) {
    VIEWS.forEach((name, k) => { element("button", { type: "button", text: name, title: `Key ${k + 1}` }, by("views")).addEventListener("click", () => picture.eye.look(name)); });
    element("button", { type: "button", text: "fit", title: "Key 0" }, by("views")).addEventListener("click", () => picture.eye.fit());
    for (const box of by("shown").querySelectorAll("input")) box.addEventListener("change", () => { options[box.name] = box.checked; picture.again(); });
    by("path").addEventListener("change", () => { options.path = by("path").value; picture.again(); });
    by("colours").addEventListener("change", () => { picture.route.colour(by("colours").value); picture.again(); legend(); });
    by("save").addEventListener("click", () => { show(false); picture.canvas.toBlob((blob) => keep(blob, "png")); });
    picture.eye.clicked = (x, y) => { const step = picture.stepAt(x, y); if (step >= 0) { play(false); seek(run.time[step]); } };
    legend();
  }
  // What the colours of the path say.
  function legend() {
    const kind = by("colours").value, where = by("legend"), most = picture.route.most;
    const said = kind === "operation" ? run.operations.map(([name], k) => [operationColour(k), name])
      : [0, 0.5, 1].map((share) => [`rgb(${heat(share).map((one) => Math.round(255 * one)).join()})`, kind === "feed" ? `${Math.round(share * most)} mm/min` : `${180 * share}°`]);
    where.replaceChildren(...[...said, [OF_RAPID, "rapid"]].map(([colour, text]) => {
      const one = element("span", {}), swatch = element("i", { class: "swatch" }, one);
      swatch.style.background = colour;
      one.append(text);
      return one;
    }));
  }
  const failed = data.marks.find((mark) => mark.kind === "failed" && mark.step >= 0);
  if (failed) jump(failed); else seek(0);
  return { run, cutting, picture, seek, time: () => time };
}
