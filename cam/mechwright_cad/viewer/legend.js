// What can be hidden: name to a function that shows it or not; and how each name is marked.
const shown = new Map();
// A box for each name, those of one group together under a box for all of them.
function legendIn(place, shown_, kept_) {
  const boxes = new Map(), groups = new Map();
  const box_ = (parent, text, colour) => {
    const label = element("label", {}, parent), box = element("input", { type: "checkbox" }, label);
    if (colour !== undefined) element("span", { class: "swatch" }, label).style.background = colour;
    label.append(text);
    return box;
  };
  const groupOf = (name) => {
    if (!name) return place;
    if (!groups.has(name)) {
      const pair = element("div", { class: "group" }, place), all = element("input", { type: "checkbox", "aria-label": `All of ${name}` }, pair);
      const whole = element("details", {}, pair), summary = element("summary", {}, whole), own = { all, summary, boxes: [] };
      element("span", { text: name }, summary);
      own.inside = element("div", {}, whole);
      groups.set(name, own);
      all.addEventListener("change", () => { const on = all.checked; own.boxes.forEach((one) => put_(one, on)); refresh(); });
    }
    return groups.get(name).inside;
  };
  const put_ = (name, on) => {
    const { box, parts } = boxes.get(name);
    if (box.checked === on) return;
    box.checked = on;
    parts.forEach((part) => part(on));
  };
  function refresh() {
    for (const { all, boxes: names, summary } of groups.values()) {
      const on = names.filter((name) => boxes.get(name).box.checked).length;
      all.checked = on > 0;
      all.indeterminate = on > 0 && on < names.length;
      summary.dataset.count = `${on} of ${names.length}`;
    }
  }
  for (const [name, show] of shown_) {
    const box = box_(groupOf(show.group), name, show.colour || "var(--accent)");
    boxes.set(name, { box, parts: show.parts });
    if (show.group) groups.get(show.group).boxes.push(name);
    // What was not there before is as it is at first.
    box.checked = kept_.off && (!kept_.seen || kept_.seen.includes(name)) ? !kept_.off.includes(name) : !show.off;
    box.addEventListener("change", () => { show.parts.forEach((part) => part(box.checked)); refresh(); });
    if (!box.checked) show.parts.forEach((part) => part(false));
  }
  refresh();
  const every = (want) => { for (const name of boxes.keys()) if (shown_.get(name).group) put_(name, want(name)); refresh(); };
  return {
    set: (name, on) => { put_(name, on); refresh(); },
    only: (name) => every((other) => other === name),
    all: () => every(() => true),
    hidden: () => [...boxes].filter(([, { box }]) => !box.checked).map(([name]) => name),
  };
}
