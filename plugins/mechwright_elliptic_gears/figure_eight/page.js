// Sliders, the figure eight, the speed over a turn, and the tables.
const SVG = "http://www.w3.org/2000/svg", DEGREE = Math.PI / 180, POINTS = 720, WIDE = 640, TALL = 200;
const EDGE = { left: 60, right: 24, top: 10, bottom: 26 };
const data = JSON.parse(document.getElementById("data").textContent);
const by = (id) => document.getElementById(id);
const shown = (value, digits = 4) => Number(value.toPrecision(digits)).toString().replace("-", "−");
const degrees = (angle) => (angle / DEGREE).toFixed(3) + "°";

function drawn(name, attributes, place) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  place.append(element);
  return element;
}
function cell(row, text, name = "td", kind = "n") {
  const element = document.createElement(name);
  element.textContent = text;
  element.className = kind;
  row.append(element);
}
function designOf(gamma, e) {
  return { a: data.a, e, gamma: gamma * DEGREE, omega: data.omega, along: data.along, across: data.across };
}
const line = (points) => points.map(([x, y], k) => (k ? "L" : "M") + x.toFixed(2) + " " + y.toFixed(2)).join("");

function drawFigure(samples, now) {
  const stage = by("figure"), r = 2 * data.a * now.e, out = Math.max(r, 0.4 * data.a) + 0.1 * data.a;
  stage.replaceChildren();
  stage.setAttribute("viewBox", `${-out} ${-out} ${2 * data.a + 2 * out} ${2 * out}`);
  drawn("line", { class: "grid", x1: -out, x2: 2 * data.a + out, y1: 0, y2: 0 }, stage);
  drawn("path", { class: "trace", d: line(samples.map(({ q }) => [q[0], -q[1]])) + "Z" }, stage);
  const j = [r * Math.cos(now.four.theta), -r * Math.sin(now.four.theta)];
  const k = [2 * data.a + r * Math.cos(now.five.theta), -r * Math.sin(now.five.theta)];
  drawn("path", { class: "link", d: line([[0, 0], j, k, [2 * data.a, 0]]) }, stage);
  for (const [x, y, kind] of [[0, 0, "axis"], [2 * data.a, 0, "axis"], [...j, "axis"], [...k, "axis"], [now.q[0], -now.q[1], "q"]])
    drawn("circle", { class: kind, cx: x, cy: y, r: data.a / 30 }, stage);
}
function drawSpeed(samples, found, theta2, now) {
  const plot = by("speed"), top = 1.05 * found.most.value;
  plot.replaceChildren();
  plot.setAttribute("viewBox", `0 0 ${WIDE} ${TALL}`);
  const x = (angle) => EDGE.left + angle / (2 * Math.PI) * (WIDE - EDGE.left - EDGE.right);
  const y = (speed) => TALL - EDGE.bottom - speed / top * (TALL - EDGE.top - EDGE.bottom);
  const { start, length } = found.window;
  for (const [from, to] of [[start, Math.min(start + length, 2 * Math.PI)], [0, start + length - 2 * Math.PI]])
    if (to > from) drawn("rect", { class: "window", x: x(from), width: x(to) - x(from), y: EDGE.top, height: TALL - EDGE.top - EDGE.bottom }, plot);
  for (let k = 0; k <= 8; k++) {
    drawn("line", { class: "grid", x1: x(k * Math.PI / 4), x2: x(k * Math.PI / 4), y1: EDGE.top, y2: TALL - EDGE.bottom }, plot);
    drawn("text", { x: x(k * Math.PI / 4), y: TALL - 8, "text-anchor": "middle" }, plot).textContent = 45 * k + "°";
  }
  for (let k = 0; k <= 4; k++) {
    drawn("line", { class: "grid", x1: x(0), x2: x(2 * Math.PI), y1: y(k * top / 4), y2: y(k * top / 4) }, plot);
    drawn("text", { x: EDGE.left - 6, y: y(k * top / 4) + 4, "text-anchor": "end" }, plot).textContent = shown(k * top / 4, 3);
  }
  drawn("path", { class: "trace", d: line(samples.map(({ speed }, k) => [x(2 * Math.PI * k / POINTS), y(speed)])) }, plot);
  drawn("circle", { class: "q", cx: x(theta2), cy: y(now.speed), r: 5 }, plot);
}
function row(body, gamma, e, values) {
  const made = body.insertRow();
  made.dataset.cell = `${gamma} ${e}`;
  cell(made, shown(gamma) + "°", "th");
  cell(made, shown(e));
  for (const value of values) cell(made, value);
}
function machine() {
  if (data.settable) for (const gamma of data.phases) {
    const { joint, most, acceleration, window } = figuresOf(designOf(gamma, data.e), data.band);
    row(by("machine").tBodies[0], gamma, data.e, [degrees(joint), window.start.toFixed(3), (window.start + window.length).toFixed(3), window.length.toFixed(3), most.value.toFixed(2), (acceleration.value / 1000).toFixed(4)]);
  }
}
function tables() {
  const [two, three] = [by("table2").tBodies[0], by("table3").tBodies[0]];
  for (const gamma of data.phases) for (const e of data.eccentricities) {
    const { most, acceleration, window } = figuresOf(designOf(gamma, e), data.band);
    row(two, gamma, e, [window.start.toFixed(3), (window.start + window.length).toFixed(3), window.length.toFixed(3), window.low.toFixed(2), (window.low + data.band).toFixed(2)]);
    row(three, gamma, e, [most.value.toFixed(2), most.angle.toFixed(3), (acceleration.value / 1000).toFixed(4), acceleration.angle.toFixed(3)]);
  }
}
function update() {
  const gamma = Number(by("gamma").value), e = Number(by("e").value), theta2 = Number(by("turn").value) * DEGREE;
  const design = designOf(gamma, e), found = figuresOf(design, data.band);
  const samples = Array.from({ length: POINTS + 1 }, (_, k) => at(2 * Math.PI * k / POINTS, design));
  const now = { ...at(theta2, design), e };
  drawFigure(samples, now);
  drawSpeed(samples, found, theta2, now);
  by("gamma-now").textContent = shown(gamma) + "°";
  by("e-now").textContent = shown(e);
  by("turn-now").textContent = shown(Number(by("turn").value)) + "°";
  const rows = {
    "joint φ": degrees(found.joint), "dφ/dγ": shown(found.rate), "speed of Q now": shown(now.speed, 5) + " mm/s",
    "greatest speed": shown(found.most.value, 6) + " mm/s at " + degrees(found.most.angle),
    "least speed": shown(found.least, 6) + " mm/s",
    "greatest acceleration": shown(found.acceleration.value, 6) + " mm/s² at " + degrees(found.acceleration.angle),
    "near-constant speed": `${found.window.length.toFixed(3)} rad from ${found.window.start.toFixed(3)}, ${shown(found.window.low, 5)} to ${shown(found.window.low + data.band, 5)} mm/s`,
  };
  by("figures").replaceChildren(...Object.entries(rows).map(([name, value]) => {
    const row = document.createElement("tr");
    cell(row, name, "th", "");
    cell(row, value);
    return row;
  }));
  const key = `${gamma} ${e}`;
  for (const row of document.querySelectorAll("tr[data-cell]")) row.classList.toggle("now", row.dataset.cell === key);
}
for (const id of ["gamma", "e", "turn"]) by(id).addEventListener("input", update);
for (const button of document.querySelectorAll("button[data-gamma]")) button.addEventListener("click", () => {
  by("gamma").value = button.dataset.gamma;
  update();
});
machine();
tables();
update();
