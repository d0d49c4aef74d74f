// The bar over the time of the job: operations as stretches, tool changes and marks on it, and the slider.
function barIn(place, run, marks, seek) {
  const track = element("div", { class: "track", "aria-hidden": "true" }, place), long = run.seconds || 1, at_ = (time) => `${100 * time / long}%`;
  run.operations.forEach(([name, first, last], k) => {
    const one = element("span", { class: "operation", title: name }, track);
    one.style.left = at_(run.begins(first));
    one.style.width = at_(run.time[last - 1] - run.begins(first));
    one.style.background = operationColour(k);
  });
  for (const [step] of run.tools) {
    const tick = element("span", { class: "change", title: `T${run.toolAt(step)}` }, track);
    tick.style.left = at_(run.begins(step));
  }
  for (const mark of marks) {
    if (mark.step < 0) continue;
    const tick = element("span", { class: `mark ${mark.kind}`, title: mark.text }, track);
    tick.style.left = at_(run.time[mark.step]);
  }
  const slide = element("input", { type: "range", min: "0", max: String(long), step: "any", value: "0", "aria-label": "Time of the program" }, place);
  slide.addEventListener("input", () => seek(Number(slide.value)));
  slide.addEventListener("keydown", (event) => {
    // An arrow is a step of the program, a page a fiftieth of it.
    const now = Number(slide.value), way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    let to = run.stepAt(now);
    while (way > 0 && to < run.count - 1 && run.time[to] <= now) to++;
    while (way < 0 && to >= 0 && run.time[to] >= now) to--;
    const page = { PageUp: long / 50, PageDown: -long / 50 }[event.key];
    if (!way && page === undefined) return;
    event.preventDefault();
    seek(page !== undefined ? Math.min(long, Math.max(0, now + page)) : to < 0 ? 0 : run.time[to]);
  });
  return (time, words) => { slide.value = time; slide.setAttribute("aria-valuetext", words); };
}
