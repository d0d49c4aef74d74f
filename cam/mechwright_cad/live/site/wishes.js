// A requirement: its places are dragged, designs that meet it are sought while the hand rests, and one is taken over.
const REST = 300, LOOK = 250; // ms that the hand rests before a search begins; between two looks at it
let handles = null, shownDesign = "", resting = 0, watched = 0, waitingScene = null;

function drawWished(scene) {
  const targets = handles ? handles.known() : scene.targets, focused = document.activeElement?.closest?.(".grip")?.dataset.name;
  let eye = null;
  draw(scene, { targets: true, seen: (found) => { eye = found; handles?.seen(found); } });
  handles = null;
  handles = grips(scene, targets, drag);
  if (eye) handles?.seen(eye);
  if (focused) handles?.focus(focused);
}
// While a handle is held the picture stays: it would be taken out of the hand.
function drawWhenFree(scene) {
  if (handles && handles.held()) waitingScene = scene; else drawWished(scene);
}
const dragged = newest("drag", (found, asked) => {
  take(found.change, asked.done);
  if (!handles?.held()) handles?.show(found.targets);
}, failed);
function drag(target, place, done) {
  dragged({ change, target, place, done });
  if (done && waitingScene) { const scene = waitingScene; waitingScene = null; drawWished(scene); }
}
const wishes = newest("targets", (found) => {
  const scene = { ...found.scene, targets: found.targets };
  if (!handles || handles.known().length !== found.targets.length) { handles = null; drawWished(scene); }
  else if (!handles.held()) handles.show(found.targets);
  mended();
  clearTimeout(resting);
  resting = setTimeout(seek, REST);
}, (error) => { clearTimeout(resting); failed(error); });
async function seek() {
  try {
    const begun = await ask("seek", { change });
    watched = begun.number;
    await follow_(begun);
  } catch (error) { say(error.message, true); }
}
async function follow_(state) {
  const mine = watched;
  while (state.number === watched) {
    seeking(state);
    if (state.state !== "runs") return;
    await new Promise((done) => setTimeout(done, LOOK));
    try { state = await (await fetch("seeking")).json(); } catch { return; }
  }
  if (state.number > watched && mine === watched) seeking({ state: "taken" });
}
const inSeconds = (value) => `${value < 10 ? value.toFixed(1) : Math.round(value)} s`;
function seeking(state) {
  const at = state.at || {}, runs = state.state === "runs";
  button_("sought").hidden = button_("end-search").hidden = !runs;
  if (runs && at.done) button_("sought").value = at.done; else button_("sought").removeAttribute("value");
  const left = state.left === null || state.left === undefined ? state.last ? `the last search took ${inSeconds(state.last)}` : "" : `about ${inSeconds(state.left)} left of this`;
  button_("seeking").textContent = runs ? [`${at.doing || "starting"} …`, `${inSeconds(state.seconds)} so far`, left].filter(Boolean).join(", ")
    : state.state === "taken" ? "Another page searches now, and this search has ended; change something to search again." : state.error ? "" : state.state === "done" ? `${state.told}; it took ${inSeconds(state.seconds)}` : "Stopped.";
  if (state.error) say(state.error, true);
  if (state.state === "done" && !state.error) found(state);
}
function found(state) {
  findings(state.findings, true, follow);
  const others = button_("rejected");
  others.replaceChildren(...state.rejected.map((one) => made("li", {}, null, `${one.count} × ${one.message}`)));
  button_("not-given").hidden = !state.rejected.length;
  const list = button_("designs");
  list.replaceChildren();
  for (const one of state.designs) {
    const item = made("li", {}, list), head = made("div", { class: "head" }, item);
    const show = made("button", { type: "button", "data-design": one.name, "aria-pressed": "false" }, head, one.name);
    show.addEventListener("click", () => present(one.name));
    const save = made("button", { type: "button" }, head, "Save design as …");
    save.setAttribute("aria-label", `Save ${one.name} as …`);
    save.addEventListener("click", () => nameIt(one.name, (name) => ask("take", { design: one.name, name })));
    made("p", { class: "remedy" }, item, one.figures.map((of) => `${of.name.replaceAll("_", " ")} ${of.value === null ? "–" : Number(of.value.toPrecision(5))} ${of.unit}`.trim()).join(" · "));
  }
  if (state.designs.length) present((state.designs.find((one) => one.name === shownDesign) || state.designs[0]).name);
  else { shownDesign = ""; wishesAlone(); }
}
const present = (name) => { shownDesign = name; shown_({ change, design: name }); };
const shown_ = newest("shown", (answer, asked) => {
  drawWhenFree({ ...answer.scene, targets: answer.targets });
  for (const button of document.querySelectorAll("[data-design]")) button.setAttribute("aria-pressed", String(button.dataset.design === asked.design));
}, (error) => say(error.message, true));
const wishesAlone = async () => {
  try { const answer = await ask("targets", { change }); drawWhenFree({ ...answer.scene, targets: answer.targets }); } catch (error) { failed(error); }
};
button_("end-search").addEventListener("click", async () => { try { const state = await ask("stop", {}); watched = state.number; seeking(state); } catch (error) { say(error.message, true); } });
