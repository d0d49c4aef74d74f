// One plot for each unit, of the channels that are ticked, with a cursor at the input.
const WIDE = 640, TALL = 170, LEFT = 62, RIGHT = 8, TOP = 8, BOTTOM = 24, COLOURS = 6, FIRST = 3;
const names = Object.keys(data.channels).filter((name) => name !== data.input);
const finite = (name) => data.channels[name].values.filter((value) => value !== null);
const least = (name) => finite(name).reduce((a, b) => Math.min(a, b), Infinity);
const most = (name) => finite(name).reduce((a, b) => Math.max(a, b), -Infinity);
const ticked = new Set();
const cells = new Map();

// Round numbers from low to high.
function ticks(low, high, wanted) {
  const raw = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((k) => k * power).find((k) => k >= raw * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(Number((k * step).toPrecision(12)));
  return found;
}
function ticksOfInput(low, high, unit) {
  if (unit !== "°") return ticks(low, high, 6);
  const step = [1, 2, 5, 10, 15, 30, 45, 60, 90, 180, 360].find((k) => (high - low) / k <= 8) || 720;
  const found = [];
  for (let k = Math.ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; k++) found.push(k * step);
  return found;
}
function firstChoice() {
  const units = [];
  for (const name of names) {
    const unit = data.channels[name].unit;
    if (name === "time" || !(most(name) - least(name) > 1e-9 * Math.max(1, Math.abs(most(name))))) continue;
    if (!units.includes(unit)) units.push(unit);
    const same = [...ticked].filter((other) => data.channels[other].unit === unit).length;
    if (units.indexOf(unit) < 2 && same < FIRST) ticked.add(name);
  }
}
function plot(unit, chosen, place, seek) {
  const [label, factor] = degrees(unit), [across, stretch] = degrees(along.unit);
  let low = Math.min(...chosen.map(least)) * factor, high = Math.max(...chosen.map(most)) * factor;
  if (!(high - low > 1e-9 * Math.max(1, Math.abs(high)))) [low, high] = [low - 1, high + 1];
  const room = 0.04 * (high - low);
  [low, high] = [low - room, high + room];
  const start = along.values[0] * stretch, end = along.values[last] * stretch;
  const x = (value) => LEFT + (value - start) / (end - start) * (WIDE - LEFT - RIGHT);
  const y = (value) => TALL - BOTTOM - (value - low) / (high - low) * (TALL - TOP - BOTTOM);
  const figure = element("figure", { class: "plot" }, place);
  const caption = element("figcaption", {}, figure);
  const svg = element("svg", { viewBox: `0 0 ${WIDE} ${TALL}`, role: "img",
    "aria-label": `${chosen.map(told).join(", ")} over ${told(data.over)}, in ${label || "no unit"}` }, figure);
  element("rect", { class: "frame", x: LEFT, y: TOP, width: WIDE - LEFT - RIGHT, height: TALL - TOP - BOTTOM }, svg);
  for (const value of ticks(low, high, 4)) {
    element("line", { class: "grid", x1: LEFT, x2: WIDE - RIGHT, y1: y(value), y2: y(value) }, svg);
    element("text", { x: LEFT - 5, y: y(value) + 4, "text-anchor": "end", text: round(value) }, svg);
  }
  for (const value of ticksOfInput(Math.min(start, end), Math.max(start, end), across)) {
    element("line", { class: "grid", x1: x(value), x2: x(value), y1: TOP, y2: TALL - BOTTOM }, svg);
    element("text", { x: x(value), y: TALL - BOTTOM + 14, "text-anchor": "middle", text: round(value) + (across === "°" ? "°" : "") }, svg);
  }
  const marks = chosen.map((name, place_) => {
    const colour = "c" + place_ % COLOURS, values = data.channels[name].values;
    let path = "", pen = "M";
    values.forEach((value, k) => {
      if (value === null) { pen = "M"; return; }
      path += `${pen}${x(along.values[k] * stretch).toFixed(1)} ${y(value * factor).toFixed(2)}`;
      pen = "L";
    });
    element("path", { class: "curve " + colour, d: path }, svg);
    element("span", { class: "key " + colour, text: told(name) }, caption);
    return values;
  });
  element("span", { class: "unit", text: `${label ? label + " " : ""}over ${told(data.over)}${across ? ", " + across : ""}` }, caption);
  const cursor = element("line", { class: "cursor", y1: TOP, y2: TALL - BOTTOM }, svg);
  const dots = marks.map((_, place_) => element("circle", { class: "c" + place_ % COLOURS, r: 3.2, fill: "currentColor" }, svg));
  const point = (event) => {
    const box = svg.getBoundingClientRect(), part = ((event.clientX - box.left) / box.width * WIDE - LEFT) / (WIDE - LEFT - RIGHT);
    seek(Math.min(1, Math.max(0, part)) * last);
  };
  svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); point(event); });
  svg.addEventListener("pointermove", (event) => { if (event.buttons & 1) point(event); });
  return (time) => {
    const here = x(at(along.values, time) * stretch);
    cursor.setAttribute("x1", here);
    cursor.setAttribute("x2", here);
    dots.forEach((dot, k) => {
      const value = at(marks[k], time) * factor;
      dot.style.display = Number.isNaN(value) ? "none" : "";
      dot.setAttribute("cx", here);
      dot.setAttribute("cy", Number.isNaN(value) ? 0 : y(value));
    });
  };
}
let cursors = [];
function plots(seek) {
  const place = document.getElementById("plots"), units = new Map();
  place.replaceChildren();
  for (const name of names.filter((other) => ticked.has(other))) {
    const unit = data.channels[name].unit;
    units.set(unit, [...(units.get(unit) || []), name]);
  }
  cursors = [...units].map(([unit, chosen]) => plot(unit, chosen, place, seek));
}
function table(seek, again) {
  const body = document.querySelector("#channels tbody");
  for (const name of [data.input, ...names]) {
    const [unit, factor] = degrees(data.channels[name].unit), row = element("tr", {}, body);
    const head = element("td", {}, row), label = element("label", {}, head);
    if (name !== data.input) {
      const box = element("input", { type: "checkbox" }, label);
      box.checked = ticked.has(name);
      box.addEventListener("change", () => {
        if (box.checked) ticked.add(name); else ticked.delete(name);
        plots(seek);
        again();
      });
    }
    label.append(told(name), " ");
    element("code", { text: name === data.input ? name + ", input" : name }, label);
    const now = element("td", { class: "n" }, row);
    element("td", { text: unit }, row);
    element("td", { class: "n", text: round(least(name) * factor) }, row);
    element("td", { class: "n", text: round(most(name) * factor) }, row);
    cells.set(name, (time) => { now.textContent = round(at(data.channels[name].values, time) * factor); });
  }
}
