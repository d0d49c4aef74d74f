// The input: a slider, and a button that lets it run. The page says what is drawn at a time, by `drawNow`.
const [unitOfInput, factorOfInput] = degrees(input.unit);
const slider = document.getElementById("input"), button = document.getElementById("play");
const pace = document.getElementById("pace"), said = document.getElementById("now");
let time = Math.min(1, kept.at || 0) * last, forwards = 1, before = null;

function show() {
  const value = (at(input.values, time) * factorOfInput).toFixed(unitOfInput === "°" ? 1 : 3);
  const words = `${told(data.input)} = ${value}${unitOfInput === "°" ? "°" : " " + unitOfInput}`;
  said.textContent = words;
  slider.value = time;
  slider.setAttribute("aria-valuetext", words);
  drawNow(time);
}
const runs = () => before !== null;
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
