"use strict";
{
  const data = JSON.parse(document.getElementById("data").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const count = data.count;
  const front = new Uint8Array(bytes(data.front));
  const numbers = new Float64Array(bytes(data.number));
  const columns = data.columns.map((column) => {
    const values = new Float32Array(bytes(column.values));
    let low = Infinity, high = -Infinity;
    for (const value of values) if (Number.isFinite(value)) { if (value < low) low = value; if (value > high) high = value; }
    if (!(low <= high)) { low = 0; high = 1; }
    if (low === high) { low -= 0.5; high += 0.5; }
    return { ...column, values, low, high, from: -Infinity, to: Infinity };
  });
  const title = (column) => column.unit ? `${column.name} [${column.unit}]` : column.name;
  const shown = (column, value) => column.choices ? column.choices[Math.round(value)] ?? "" : Number.isFinite(value) ? String(Number(value.toPrecision(6))) : "none";

  const kept = new Uint8Array(count);
  let total = 0;
  let frontAlone = false;
  function filter() {
    kept.fill(1);
    if (frontAlone) kept.set(front);
    for (const column of columns) {
      if (column.from === -Infinity && column.to === Infinity) continue;
      const values = column.values;
      for (let i = 0; i < count; i++) if (!(values[i] >= column.from && values[i] <= column.to)) kept[i] = 0;
    }
    total = 0;
    for (let i = 0; i < count; i++) total += kept[i];
  }

  // While a brush is dragged a sample is drawn; all lines follow a moment after it is let go.
  const WHILE_DRAGGED = 2000, AT_REST = 20000, BATCH = 500, REST = 160;
  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name);
  function sized(canvas) {
    const scale = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    if (canvas.width !== Math.round(box.width * scale) || canvas.height !== Math.round(box.height * scale)) {
      canvas.width = Math.round(box.width * scale);
      canvas.height = Math.round(box.height * scale);
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.clearRect(0, 0, box.width, box.height);
    return [pen, box.width, box.height];
  }

  const lines = document.getElementById("lines"), dots = document.getElementById("dots");
  const across = document.getElementById("across"), up = document.getElementById("up");
  const TOP = 46, BOTTOM = 22, SIDE = 46, APART = 84;
  lines.style.minWidth = `${APART * columns.length}px`;  // narrower screens scroll
  const axisX = (place, width) => columns.length < 2 ? width / 2 : SIDE + (width - 2 * SIDE) * place / (columns.length - 1);
  const axisY = (column, value, height) => height - BOTTOM - (height - TOP - BOTTOM) * (value - column.low) / (column.high - column.low);

  function some(wanted, most) {
    let there = 0;
    for (let i = 0; i < count; i++) there += kept[i] === wanted;
    const every = Math.max(1, Math.ceil(there / most)), found = [];
    let seen = 0;
    for (let i = 0; i < count; i++) if (kept[i] === wanted && seen++ % every === 0) found.push(i);
    return found;
  }
  function drawLines(most) {
    const [pen, width, height] = sized(lines);
    const strokes = (rows, colour, alpha) => {
      pen.strokeStyle = colour;
      pen.globalAlpha = alpha;
      for (let start = 0; start < rows.length; start += BATCH) {
        pen.beginPath();
        for (const i of rows.slice(start, start + BATCH)) {
          columns.forEach((column, place) => {
            const x = axisX(place, width), y = axisY(column, column.values[i], height);
            if (place) pen.lineTo(x, y); else pen.moveTo(x, y);
          });
        }
        pen.stroke();
      }
      pen.globalAlpha = 1;
    };
    pen.lineWidth = 1;
    strokes(some(0, most / 4), style("--dim"), 0.5);
    const mine = some(1, most);
    strokes(mine, style("--kept"), Math.min(0.9, 30 / Math.sqrt(mine.length + 1)));
    strokes(mine.filter((i) => front[i]), style("--mark"), 0.9);
    pen.fillStyle = pen.strokeStyle = style("--ink");
    pen.font = "12px system-ui, Helvetica, Arial, sans-serif";
    pen.textAlign = "center";
    columns.forEach((column, place) => {
      const x = axisX(place, width);
      pen.lineWidth = 1;
      pen.beginPath(); pen.moveTo(x, TOP); pen.lineTo(x, height - BOTTOM); pen.stroke();
      const most = (width - SIDE) / Math.max(1, columns.length / 2), half = Math.min(most, pen.measureText(title(column)).width) / 2;
      pen.fillText(title(column), Math.min(Math.max(x, half + 2), width - half - 2), place % 2 ? 26 : 12, most);
      pen.fillText(shown(column, column.high), x, TOP - 5);
      pen.fillText(shown(column, column.low), x, height - 6);
      if (column.from !== -Infinity || column.to !== Infinity) {
        const y0 = axisY(column, Math.max(column.from, column.low), height), y1 = axisY(column, Math.min(column.to, column.high), height);
        pen.lineWidth = 7; pen.globalAlpha = 0.35;
        pen.beginPath(); pen.moveTo(x, y0); pen.lineTo(x, y1); pen.stroke();
        pen.globalAlpha = 1;
      }
    });
    return mine.length;
  }
  function drawDots(most) {
    const [pen, width, height] = sized(dots);
    const x = columns[across.value], y = columns[up.value];
    const at = (i) => [SIDE + (width - 2 * SIDE) * (x.values[i] - x.low) / (x.high - x.low), axisY(y, y.values[i], height)];
    const points = (rows, colour, size) => { pen.fillStyle = colour; for (const i of rows) { const [a, b] = at(i); pen.fillRect(a - size / 2, b - size / 2, size, size); } };
    points(some(0, most), style("--dim"), 2);
    const mine = some(1, 2 * most);
    points(mine, style("--kept"), 2.5);
    points(mine.filter((i) => front[i]), style("--mark"), 5);
    pen.fillStyle = style("--ink");
    pen.font = "12px system-ui, Helvetica, Arial, sans-serif";
    pen.textAlign = "left"; pen.fillText(shown(x, x.low), SIDE - 20, height - 6); pen.fillText(`${title(y)}, up to ${shown(y, y.high)}`, 6, 14);
    pen.fillText(shown(y, y.low), 6, height - BOTTOM);
    pen.textAlign = "right"; pen.fillText(`${title(x)}, up to ${shown(x, x.high)}`, width - 6, height - 6);
  }

  const told = document.getElementById("told");
  let rest = 0, held = false;
  function update(dragged) {
    filter();
    const drawn = drawLines(dragged ? WHILE_DRAGGED : AT_REST);
    drawDots(dragged ? WHILE_DRAGGED : AT_REST);
    told.textContent = `${total.toLocaleString("en")} of ${count.toLocaleString("en")} designs kept` + (drawn < total ? `, ${drawn.toLocaleString("en")} of them drawn` : "");
    clearTimeout(rest);
    if (!dragged) table();
    else if (!held) rest = setTimeout(() => update(false), REST);
  }
  // Mice send several moves for each frame: only the last of them is drawn.
  let asked = 0;
  function soon() {
    asked ||= requestAnimationFrame(() => { asked = 0; update(true); });
  }

  const ranges = document.querySelector("#ranges tbody");
  const fields = columns.map((column, place) => {
    const row = ranges.insertRow();
    row.insertCell().textContent = title(column);
    return ["from", "to"].map((end) => {
      const field = document.createElement("input");
      field.type = "number"; field.step = "any";
      field.placeholder = String(Number((end === "from" ? column.low : column.high).toPrecision(6)));
      field.setAttribute("aria-label", `${column.name} ${end === "from" ? "at least" : "at most"}`);
      field.addEventListener("input", () => {
        column[end] = field.value === "" ? (end === "from" ? -Infinity : Infinity) : Number(field.value);
        soon();
      });
      row.insertCell().append(field);
      return field;
    });
  });
  function keep(place, from, to) {
    const column = columns[place];
    [column.from, column.to] = [from, to];
    fields[place][0].value = from === -Infinity ? "" : String(Number(from.toPrecision(6)));
    fields[place][1].value = to === Infinity ? "" : String(Number(to.toPrecision(6)));
  }
  const within = (event, canvas) => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top, box.width, box.height]; };
  function dragging(canvas, begin, move) {
    let start = null;
    canvas.addEventListener("pointerdown", (event) => { held = true; start = begin(...within(event, canvas)); canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointermove", (event) => { if (start !== null) move(start, ...within(event, canvas)); });
    const end = () => { if (start !== null) soon(); start = null; held = false; };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
  }
  const valueY = (column, y, height) => column.low + (column.high - column.low) * (height - BOTTOM - y) / (height - TOP - BOTTOM);
  const valueX = (column, x, width) => column.low + (column.high - column.low) * (x - SIDE) / (width - 2 * SIDE);
  dragging(lines, (x, y, width, height) => {
    let place = 0;
    columns.forEach((_, k) => { if (Math.abs(axisX(k, width) - x) < Math.abs(axisX(place, width) - x)) place = k; });
    keep(place, -Infinity, Infinity);
    soon();
    return { place, y };
  }, (start, x, y, width, height) => {
    if (Math.abs(y - start.y) < 3) return;
    const ends = [valueY(columns[start.place], start.y, height), valueY(columns[start.place], y, height)];
    keep(start.place, Math.min(...ends), Math.max(...ends));
    soon();
  });
  dragging(dots, (x, y) => {
    keep(Number(across.value), -Infinity, Infinity);
    keep(Number(up.value), -Infinity, Infinity);
    soon();
    return [x, y];
  }, (start, x, y, width, height) => {
    if (Math.hypot(x - start[0], y - start[1]) < 4) return;
    const a = columns[across.value], b = columns[up.value];
    const xs = [valueX(a, start[0], width), valueX(a, x, width)], ys = [valueY(b, start[1], height), valueY(b, y, height)];
    keep(Number(across.value), Math.min(...xs), Math.max(...xs));
    if (across.value !== up.value) keep(Number(up.value), Math.min(...ys), Math.max(...ys));
    soon();
  });

  const ROWS = 50;
  const objectives = Object.entries(data.objectives);
  let by = objectives.length ? columns.findIndex((column) => column.name === objectives[0][0]) : 0;
  let sign = objectives.length ? objectives[0][1] : 1;
  const head = document.querySelector("#designs thead").insertRow();
  head.innerHTML = '<th scope="col">design</th>';
  columns.forEach((column, place) => {
    const cell = document.createElement("th"), button = document.createElement("button");
    cell.scope = "col"; button.type = "button"; button.textContent = title(column);
    button.addEventListener("click", () => { sign = by === place ? -sign : 1; by = place; table(); });
    cell.append(button); head.append(cell);
  });
  function table() {
    const rows = [];
    for (let i = 0; i < count; i++) if (kept[i]) rows.push(i);
    const values = columns[by].values;
    rows.sort((a, b) => sign * (values[a] - values[b]) || numbers[a] - numbers[b]);
    [...head.cells].forEach((cell, place) => cell.setAttribute("aria-sort", place - 1 !== by ? "none" : sign > 0 ? "ascending" : "descending"));
    const body = document.querySelector("#designs tbody");
    body.replaceChildren(...rows.slice(0, ROWS).map((i) => {
      const row = document.createElement("tr");
      if (front[i]) row.className = "best";
      row.insertCell().textContent = String(numbers[i]);
      for (const column of columns) row.insertCell().textContent = shown(column, column.values[i]);
      return row;
    }));
  }

  columns.forEach((column, place) => { for (const list of [across, up]) list.add(new Option(title(column), String(place))); });
  const index = (name, otherwise) => { const found = columns.findIndex((column) => column.name === name); return found < 0 ? otherwise : found; };
  across.value = String(index(objectives[0]?.[0], 0));
  up.value = String(index(objectives[1]?.[0] ?? "", Math.min(1, columns.length - 1)));
  for (const list of [across, up]) list.addEventListener("change", () => update(false));
  document.getElementById("all").addEventListener("click", () => { columns.forEach((_, place) => keep(place, -Infinity, Infinity)); update(false); });
  document.getElementById("best").addEventListener("change", (event) => { frontAlone = event.target.checked; update(false); });
  window.addEventListener("resize", () => update(false));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => update(false));
  update(false);
}
