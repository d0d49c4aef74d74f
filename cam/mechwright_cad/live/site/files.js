// The file: saved, written anew under another name, and built.
button_("save").addEventListener("click", async () => {
  try {
    const { said } = await ask("save", { change, digest: known.digest });
    change = {};
    past = []; future = []; settled = {};
    await open(said);
  } catch (error) { say(error.message, true); }
});
// A new file is asked for by its name: a copy of what is shown, or a design that was found.
const naming = button_("naming");
let written = null;
function nameIt(suggested, write) {
  written = write;
  naming.hidden = false;
  button_("new-name").value = suggested;
  button_("new-name").focus();
}
button_("save-as").addEventListener("click", () => nameIt(`${known ? known.name : "design"}-2`, (name) => ask("save-as", { change, name })));
button_("not-named").addEventListener("click", () => { naming.hidden = true; });
naming.addEventListener("submit", async (event) => {
  event.preventDefault();
  try {
    const { said } = await written(button_("new-name").value);
    naming.hidden = true;
    say(said);
  } catch (error) { say(error.message, true); }
});
function progress(state) {
  button_("building").hidden = state.state === "none";
  const at = state.at || {}, runs = state.state === "runs";
  button_("done").hidden = button_("stop").hidden = !runs;
  if (at.done !== undefined) button_("done").value = at.done; else button_("done").removeAttribute("value");
  button_("doing").textContent = runs ? `${at.doing || "starting"} …` : state.state === "done"
    ? `Built: ${state.printed}` : state.state === "failed" ? "Nothing was built:" : "";
  button_("said").replaceChildren(...(state.said || []).map((line) => made("li", {}, null, line)));
}
async function watch() {
  for (;;) {
    let state;
    try { state = await (await fetch("building")).json(); } catch { return; }
    progress(state);
    if (state.state !== "runs") return;
    await new Promise((done) => setTimeout(done, 300));
  }
}
button_("build").addEventListener("click", async () => {
  try { progress(await ask("build", { change })); watch(); } catch (error) { say(error.message, true); }
});
button_("stop").addEventListener("click", async () => { try { progress(await ask("stop", {})); } catch (error) { say(error.message, true); } });
window.addEventListener("beforeunload", (event) => { if (Object.keys(change).length) event.preventDefault(); });
open("").then(() => { news(); if (!known || !known.seeks) watch(); });
