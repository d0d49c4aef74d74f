// Values of the motion between two samples.
const input = data.channels[data.input];
const along = data.channels[data.over]; // over which plots are drawn: it goes one way
const last = input.values.length - 1;
const degrees = (unit) => unit === "rad" ? ["°", 180 / Math.PI]
  : [unit.replace("^2", "²").replace("^3", "³").replace("*", "·"), 1];
const told = (name) => data.channels[name].label;
const round = (value) => value === null || Number.isNaN(value) ? "" : String(Number(value.toPrecision(5)));

// A column of one number stands for all samples; between two samples it goes straight.
function at(column, time) {
  const first = Math.min(Math.floor(time), column.length - 2);
  if (first < 0) return column[0];
  const a = column[first], b = column[first + 1];
  return a === null || b === null ? NaN : a + (time - first) * (b - a);
}
function element(name, attributes, parent) {
  const svg = ["svg", "g", "path", "polyline", "circle", "line", "rect", "text"].includes(name);
  const made = svg ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (key === "text") made.textContent = value; else made.setAttribute(key, value);
  }
  if (parent) parent.append(made);
  return made;
}
// What can be hidden: name to a function that shows it or not; and how each name is marked.
const shown = new Map();
