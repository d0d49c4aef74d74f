// The fields: one for each key, a slider where it has bounds. `set(key, value)` is called while one drags.
const fields = new Map();
function made(name, attributes, parent, words) {
  const one = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) one.setAttribute(key, value);
  if (words !== undefined) one.textContent = words;
  if (parent) parent.append(one);
  return one;
}
const same = (one, two) => JSON.stringify(one) === JSON.stringify(two);
const shortNumber = (value) => String(Number(Number(value).toPrecision(12)));

// A number with its unit, as the design file would say it, is sent as text.
function read(field, words) {
  const text = words.trim();
  if (field.kind === "data") return text ? JSON.parse(text) : null;
  if (field.kind === "text" || field.kind === "choice") return text || null;
  if (!text) return null;
  const value = Number(text);
  return Number.isFinite(value) ? value : text;
}
function write(field, value) {
  if (value === null || value === undefined) return "";
  if (field.kind === "data") return JSON.stringify(value);
  return typeof value === "number" ? shortNumber(value) : String(value);
}
function bounds(field) {
  const [over, under] = field.open, unit = field.unit ? " " + field.unit : "";
  if (field.low !== null && field.high !== null && !over && !under) return `${field.low} to ${field.high}${unit}`;
  return [[field.low, over ? "above" : "at least"], [field.high, under ? "below" : "at most"]]
    .filter(([value]) => value !== null && value !== undefined).map(([value, word]) => `${word} ${value}${unit}`).join(", ");
}
function row(field, place, set) {
  const own = made("div", { class: "field", "data-key": field.key }, place), top = made("div", { class: "top" }, own);
  const id = "field-" + field.key;
  made("label", { for: id }, top, field.key.split(".").slice(1).join("."));
  let entry, slider = null;
  if (field.kind === "switch") {
    entry = made("input", { type: "checkbox", id }, top);
    entry.addEventListener("change", () => set(field.key, entry.checked, true));
  } else if (field.kind === "choice") {
    entry = made("select", { id }, top);
    if (field.value === null) made("option", { value: "" }, entry, "–");
    for (const choice of field.choices) made("option", { value: choice }, entry, String(choice));
    entry.addEventListener("change", () => set(field.key, field.choices.find((one) => String(one) === entry.value) ?? null, true));
  } else {
    const long = field.kind === "data";
    if (!long) entry = made("input", { type: "text", id, inputmode: field.kind === "text" ? "text" : "decimal", autocomplete: "off", class: field.kind === "text" ? "words" : "" }, top);
    else entry = made("textarea", { id, spellcheck: "false" }, own);
    entry.addEventListener("change", () => {
      try { set(field.key, read(field, entry.value), true); } catch { wrong(field.key, "is no list or table as JSON writes it"); }
    });
    if (!long) made("span", { class: "unit" }, top, field.unit);
    if (field.reach && field.kind !== "text" && !long) {
      const [low, high] = field.reach, whole = field.kind === "whole";
      const step = whole ? 1 : Number((10 ** Math.floor(Math.log10((high - low) / 400 || 1))).toPrecision(1));
      slider = made("input", { type: "range", min: low, max: high, step: whole ? 1 : step, "aria-label": field.key }, own);
      slider.addEventListener("input", () => { entry.value = slider.value; set(field.key, Number(slider.value), false); });
      slider.addEventListener("change", () => set(field.key, Number(slider.value), true));
    }
  }
  const back = made("button", { type: "button", class: "back", title: "As the file has it", hidden: "" }, top, "↺");
  back.setAttribute("aria-label", `${field.key} as the file has it`);
  back.addEventListener("click", () => set(field.key, undefined, true));
  made("p", { class: "about" }, own, [field.about, bounds(field)].filter(Boolean).join(" · "));
  const show = (value, changed) => {
    if (field.kind === "switch") entry.checked = Boolean(value);
    else if (document.activeElement !== entry || field.kind === "choice") entry.value = write(field, value);
    if (slider && typeof value === "number" && document.activeElement !== slider) slider.value = value;
    own.classList.toggle("changed", changed);
    own.classList.remove("wrong");
    back.hidden = !changed;
  };
  fields.set(field.key, { field, own, entry, show });
}
function wrong(key, words) {
  const found = fields.get(key);
  if (found) found.own.classList.add("wrong");
  say(`${key}: ${words}`, true);
}
function lay(list, set) {
  fields.clear();
  const first = document.getElementById("first"), more = document.querySelector("#more > div"), tables = document.getElementById("tables");
  for (const place of [first, more, tables]) place.replaceChildren();
  const others = new Map();
  for (const field of list) {
    const table = field.key.split(".")[0], own = ["parameters", "requirement"].includes(table);
    if (!own && !others.has(table)) {
      const folded = made("details", {}, tables);
      made("summary", {}, folded, `[${table}]`);
      others.set(table, made("div", {}, folded));
    }
    row(field, !own ? others.get(table) : field.first || field.given ? first : more, set);
  }
  document.getElementById("more").hidden = !more.children.length;
}
document.getElementById("filter").addEventListener("input", (event) => {
  const wanted = event.target.value.trim().toLowerCase();
  for (const { field, own } of fields.values())
    own.hidden = Boolean(wanted) && !`${field.key} ${field.about}`.toLowerCase().includes(wanted);
  if (wanted) for (const folded of document.querySelectorAll("#fields details")) folded.open = Boolean(folded.querySelector(".field:not([hidden])"));
});
