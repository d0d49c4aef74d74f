// The tools under a picture in space: standard views, section, exploded view, picking, measuring, a picture to keep.
const AXES = ["x", "y", "z"];

function spaceTools(box, own) {
  const { canvas, eye, painter, things, ball } = own, tools = element("div", { class: "tools", role: "group", "aria-label": "View" }, box.parentElement);
  const row = (label) => element("div", { class: "row", role: "group", "aria-label": label }, tools);
  const button = (text, where, act, more = {}) => {
    const made = element("button", { type: "button", text, ...more }, where);
    made.addEventListener("click", () => act(made));
    return made;
  };
  const range = (label, where, most, act) => {
    const slide = element("input", { type: "range", min: "0", max: "1", step: "0.005", value: most, "aria-label": label }, where);
    slide.addEventListener("input", () => act(Number(slide.value)));
    return slide;
  };
  const views = row("Standard views");
  VIEWS.forEach((name, k) => button(name, views, () => eye.look(name), { title: `Key ${k + 1}` }));
  button("fit", views, () => eye.fit(), { title: "Key 0" });

  const cutting = row("Section and exploded view"), axis = element("select", { "aria-label": "Section plane" }, cutting);
  for (const name of ["no section", ...AXES.map((one) => `section across ${one}`)]) element("option", { text: name }, axis);
  const turned = element("button", { type: "button", text: "other side", "aria-pressed": "false" }, cutting);
  const depth = range("Place of the section plane", cutting, 0.5, () => cut());
  turned.addEventListener("click", () => { turned.setAttribute("aria-pressed", String(turned.getAttribute("aria-pressed") !== "true")); cut(); });
  function cut() {
    const k = axis.selectedIndex - 1, sign = turned.getAttribute("aria-pressed") === "true" ? -1 : 1;
    depth.disabled = turned.disabled = k < 0;
    const way = k < 0 ? [0, 0, 0] : eye.axes[k].map((part) => part * (k === 1 ? -sign : sign));
    painter.cut = [...way, k < 0 ? 1 : dot(way, ball.centre) + (2 * Number(depth.value) - 1) * ball.radius];
    own.again();
  }
  axis.addEventListener("change", cut);
  cut();
  if (things.some((thing) => thing.shift)) {
    const label = element("label", { text: "exploded " }, cutting);
    range("Exploded view", label, 0, (share) => { own.explode = share; own.again(); });
  }

  const acting = row("Picking"), taker = measuring(box, own);
  let mode = "pick";
  const modes = new Map([["pick", "pick"], ["measure", "measure"], ...(last > 0 ? [["trace", "trace a point"]] : [])].map(([name, text]) =>
    [name, button(text, acting, () => enter(name), { "aria-pressed": String(name === mode) })]));
  button("clear", acting, () => { taker.clear(); tell(""); });
  button("PNG", acting, () => { own.paint(own.time()); canvas.toBlob((blob) => keep(blob, "png")); });
  const note = element("p", { class: "note", role: "status" }, tools), card = element("div", { class: "card", hidden: "" }, tools);
  const tell = (text) => { note.textContent = text; };
  function enter(name) {
    mode = name;
    for (const [one, made] of modes) made.setAttribute("aria-pressed", String(one === name));
    tell({ pick: "", measure: "Choose two points; a corner that is near is taken.", trace: "Choose the point whose path is drawn." }[name]);
  }
  function choose(thing) {
    own.chosen = thing;
    card.replaceChildren();
    card.hidden = !thing;
    own.again();
    if (!thing) return;
    const part = (data.parts || [])[thing.part] || {};
    element("strong", { text: thing.name }, card);
    for (const text of [part.what, part.mass === undefined ? "" : `${part.mass} g`]) if (text) element("span", { text }, card);
    for (const file of part.files || []) element("a", { text: file, href: encodeURI(file) }, card);
    button("hide", card, () => { legendOf.set(thing.name, false); choose(null); });
    button("only this", card, () => { legendOf.only(thing.name); });
    button("show all", card, () => legendOf.all());
  }
  own.choose = choose;
  own.take = (x, y) => {
    const hit = own.pick(x, y);
    if (mode === "pick") choose(hit && hit.thing);
    else tell(hit ? taker[mode === "measure" ? "take" : "trace"](hit, x, y) : "There is no body.");
  };
  eye.clicked = own.take;
  canvas.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== "h") return;
    event.preventDefault();
    const area = canvas.getBoundingClientRect();
    if (event.key === "Enter") own.take(area.width / 2, area.height / 2);
    else if (own.chosen) { legendOf.set(own.chosen.name, false); choose(null); }
  });
}
