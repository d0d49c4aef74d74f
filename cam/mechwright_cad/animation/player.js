// The input: a slider, a button that lets it run, and a mark in the address (#at=40) where it starts.
const [unitOfInput, factorOfInput] = degrees(input.unit);
const slider = document.getElementById("input"), button = document.getElementById("play");
const pace = document.getElementById("pace"), said = document.getElementById("now");
const asking = data.live ? {} : asked();
kept = { ...kept, ...Object.fromEntries(Object.entries(asking).filter(([key, value]) => key !== "at" && value !== undefined)) };
let time = Math.min(1, kept.at || 0) * last, forwards = 1, before = null;

let viewed = () => kept.view; // of a picture in space
const place = document.getElementById("picture");
const pictured = Object.keys(data.poses).length || data.targets;
const draw = pictured ? (data.layers ? planePicture : spacePicture)(place) : () => {};
if (!pictured) place.remove();

function show() {
  const value = (at(input.values, time) * factorOfInput).toFixed(unitOfInput === "°" ? 1 : 3);
  const words = `${told(data.input)} = ${value}${unitOfInput === "°" ? "°" : " " + unitOfInput}`;
  said.textContent = words;
  slider.value = time;
  slider.setAttribute("aria-valuetext", words);
  draw(time);
  for (const cursor of cursors) cursor(time);
  for (const cell of cells.values()) cell(time);
}
function seek(wanted) {
  time = wanted;
  show();
}
function run(clock) {
  if (before === null || signal.aborted) return;
  let next = time + forwards * (clock - before) / 1000 / Number(pace.value) * last;
  before = clock;
  if (data.round) next = (next % last + last) % last;
  else if (next > last || next < 0) {
    forwards = -forwards;
    next = Math.min(last, Math.max(0, next > last ? 2 * last - next : -next));
  }
  seek(next);
  requestAnimationFrame(run);
}
function play(on) {
  button.textContent = on ? "Pause" : "Play";
  button.setAttribute("aria-pressed", String(on));
  before = on ? performance.now() : null;
  if (on) requestAnimationFrame(run);
}
document.getElementById("way").textContent = data.over !== data.input ? "there and back" : data.round ? "once round" : "one way";
slider.max = last;
slider.setAttribute("aria-label", `Input: ${told(data.input)}`);
slider.addEventListener("input", () => seek(Number(slider.value)));
slider.addEventListener("keydown", (event) => {
  // A step of the slider is a sample, a page a tenth of the motion.
  const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: last / 10, PageDown: -last / 10 };
  if (!(event.key in steps)) return;
  event.preventDefault();
  seek(Math.min(last, Math.max(0, time + steps[event.key])));
});
button.addEventListener("click", () => play(before === null));
document.addEventListener("keydown", (event) => {
  if (event.key !== " " || event.target !== document.body) return;
  event.preventDefault();
  play(before === null);
}, { signal });
const legend = document.getElementById("legend");
for (const [name, show_] of shown) {
  const label = element("label", {}, legend), box = element("input", { type: "checkbox" }, label);
  // What was not there before is as it is at first.
  box.checked = kept.off && (!kept.seen || kept.seen.includes(name)) ? !kept.off.includes(name) : !show_.off;
  const obey = () => show_.parts.forEach((part) => part(box.checked));
  box.addEventListener("change", obey);
  if (!box.checked) obey();
  const swatch = element("span", { class: "swatch" }, label);
  swatch.style.background = show_.colour || "var(--accent)";
  label.append(name);
}
if (!shown.size) legend.remove();
if (data.bare && !data.ghost || data.missing.length) {
  const note = document.getElementById("note");
  note.hidden = false;
  if (data.bare) note.textContent = "Joints and links as points and lines: there are no parts to draw.";
  else
  note.textContent = `Not drawn, because they are no plates: ${data.missing.join(", ")}. mechwright build writes this page with them.`;
}
if (kept.ticked && (!kept.plotted || kept.plotted.some((name) => names.includes(name)))) names.filter((name) => kept.ticked.includes(name)).forEach((name) => ticked.add(name));
else firstChoice();
table(seek, show);
plots(seek);
if (asking.at !== undefined) {
  // The first place at which the input has the value, or the end that is nearer to it.
  const value = asking.at / factorOfInput, off = input.values.map((one) => one - value);
  const after = off.findIndex((one, k) => k > 0 && one * off[k - 1] <= 0);
  time = after > 0 ? after - 1 + off[after - 1] / (off[after - 1] - off[after] || 1)
    : off.reduce((best, one, k) => Math.abs(one) < Math.abs(off[best]) ? k : best, 0);
}
const hiddenNow = () => [...legend.querySelectorAll("input")].filter((box) => !box.checked).map((box) => box.parentElement.textContent);
takeAway(seek, () => time, () => address(at(input.values, time) * factorOfInput, hiddenNow(), [...ticked]));
show();
if (kept.plays) play(true);
if (kept.pace) pace.value = kept.pace;
// What another player goes on from.
return () => ({
  at: last ? time / last : 0, plays: before !== null, pace: pace.value, ticked: [...ticked], view: viewed(),
  off: hiddenNow(), seen: [...shown.keys()], plotted: names,
});
