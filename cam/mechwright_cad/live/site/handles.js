// Places of a requirement or a design as handles in the picture: dragged with the pointer, or moved by the arrow keys.
const GRIP = 1 / 60, REACH = 2.2, NUDGE = 1 / 100, FINE = 1 / 10; // of the picture; of a handle; of the picture; of a nudge
function drawnIn(name, attributes, parent) {
  const one = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
  parent.append(one);
  return one;
}
// A number that a hand can mean in a picture so large: three digits of the size behind the point.
function meant(value, size) {
  const step = 10 ** Math.floor(Math.log10(size / 500));
  return Number((Math.round(value / step) * step).toPrecision(12));
}
function planeView(svg) {
  const layer = svg.querySelector("g"), size = Math.max(...svg.getAttribute("viewBox").split(" ").slice(2).map(Number));
  return {
    layer, size, across: size, up: -1, at: (place) => place,
    from: (event) => {
      const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(layer.getScreenCTM().inverse());
      return [meant(point.x, size), meant(point.y, size)];
    },
    nudged: (place, right, high) => [meant(place[0] + right * size, size), meant(place[1] + high * size, size)],
  };
}
function spaceView(canvas, scene) {
  const layer = drawnIn("svg", { class: "over" }, canvas.parentElement), size = 2 * scene.ball.radius;
  const own = { layer, size, across: 500, up: 1, eye: null };
  own.at = (place) => own.eye.to(place);
  own.from = (event, old) => {
    const box = canvas.getBoundingClientRect();
    return own.eye.back(event.clientX - box.left, event.clientY - box.top, old);
  };
  own.nudged = (place, right, high) => {
    const [x, y] = own.eye.to(place), box = canvas.getBoundingClientRect(), step = Math.min(box.width, box.height);
    return own.eye.back(x + right * step, y - high * step, place);
  };
  return own;
}
// Draws handles over a picture; `drag(name, place, done)` is called while one is moved. Gives what shows others.
function grips(scene, targets, drag) {
  const picture = document.getElementById("picture"), svg = picture.querySelector("svg"), canvas = picture.querySelector("canvas");
  if (!svg && !canvas) return null;
  if (svg) svg.setAttribute("role", "group"); // a picture would hide its handles from a screen reader
  const view = svg ? planeView(svg) : spaceView(canvas, scene), lines = new Map(), made_ = new Map();
  const said = (place) => place.map((part) => shortNumber(Number(part.toPrecision(5)))).join(", ") + " mm";
  for (const { line } of targets) if (line && !lines.has(line)) lines.set(line, drawnIn("path", { class: "wanted" }, view.layer));
  let known = targets, held = null;
  const own = { known: () => known, held: () => held !== null };
  own.show = (found) => {
    known = found;
    if (!svg && !view.eye) return;
    for (const [line, drawn] of lines) {
      const points = known.filter((one) => one.line === line).map((one) => view.at(one.place));
      drawn.setAttribute("d", "M" + points.map(([x, y]) => `${x} ${y}`).join("L"));
    }
    for (const { name, place } of known) {
      const handle = made_.get(name);
      if (!handle) continue;
      const [x, y, depth] = view.at(place);
      handle.setAttribute("transform", `translate(${x} ${y}) scale(1 ${view.up})`);
      handle.classList.toggle("behind", depth < 0);
      handle.setAttribute("aria-valuetext", said(place));
      handle.setAttribute("aria-valuenow", place[0]);
    }
  };
  const placeOf = (name) => known.find((one) => one.name === name).place;
  // Handles that stand close lie over each other: the one whose middle is nearest is taken.
  const nearest = (event) => {
    const away = (handle) => {
      const ring = handle.querySelector(".ring").getBoundingClientRect();
      return Math.hypot(event.clientX - ring.x - ring.width / 2, event.clientY - ring.y - ring.height / 2);
    };
    return [...made_].reduce((one, other) => (away(other[1]) < away(one[1]) ? other : one))[0];
  };
  for (const { name } of targets) {
    const handle = drawnIn("g", { class: "grip", tabindex: 0, role: "slider", "aria-label": name, "aria-valuenow": 0, "data-name": name }, view.layer);
    const radius = view.across * GRIP;
    drawnIn("circle", { class: "hold", r: radius * REACH }, handle);
    drawnIn("circle", { class: "ring", r: radius }, handle);
    const words = name.length <= 3 ? name : name.match(/\d+$/)?.[0];
    if (words) {
      const size = radius * (words.length > 2 ? 0.9 : 1.3);
      drawnIn("text", { "font-size": size, "text-anchor": "middle", y: size * 0.35 }, handle).textContent = words;
    }
    drawnIn("title", {}, handle).textContent = name;
    made_.set(name, handle);
    handle.addEventListener("pointerdown", (event) => {
      event.stopPropagation();
      handle.setPointerCapture(event.pointerId);
      held = nearest(event);
    });
    handle.addEventListener("pointermove", (event) => {
      if (held === null) return;
      const place = view.from(event, placeOf(held));
      own.show(known.map((one) => one.name === held ? { ...one, place } : one));
      drag(held, place, false);
    });
    const end = () => {
      if (held === null) return;
      const moved = held;
      held = null;
      drag(moved, placeOf(moved), true);
    };
    handle.addEventListener("pointerup", end);
    handle.addEventListener("pointercancel", end);
    const keys = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    handle.addEventListener("keydown", (event) => {
      if (!(event.key in keys)) return;
      event.preventDefault();
      event.stopPropagation();
      const step = NUDGE * (event.shiftKey ? FINE : 1), [right, high] = keys[event.key];
      const place = view.nudged(placeOf(name), right * step, high * step);
      own.show(known.map((one) => one.name === name ? { ...one, place } : one));
      drag(name, place, true);
    });
  }
  own.seen = (eye) => { view.eye = eye; own.show(known); };
  own.focus = (name) => made_.get(name)?.focus({ preventScroll: true });
  own.show(targets);
  return own;
}
