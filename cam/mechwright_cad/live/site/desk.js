// The desk: what is changed, undone, saved and built; and the picture that follows.
const button_ = (id) => document.getElementById(id);
let known = null, change = {}, past = [], future = [], settled = {}, ghost = null, kept = () => ({}), end = new AbortController(), picture = null, complete = null;

function draw(scene, more) {
  const before = kept();
  end.abort();
  end = new AbortController();
  picture = scene;
  const main = document.getElementById("main");
  main.replaceChildren(document.getElementById("stage-of").content.cloneNode(true));
  kept = player({ ...scene, ...more, live: true, ghost: ghost || scene.ghost }, before, end.signal) || (() => ({}));
}
// A design with places to drag is drawn with its handles; those that a hand has moved meanwhile stay where it left them.
function present_(scene, asked) {
  if (!handles?.held() && (!scene.targets || same(asked.change, change))) handles = null;
  scene.targets ? drawWhenFree(scene) : draw(scene);
}
const parts = newest("parts", (found, asked) => {
  complete = asked.change;
  if (found.scene) present_(found.scene, asked);
  found.unmade ? say(found.unmade, true) : mended();
  findings(found.findings, false, follow);
  remedies(asked);
}, failed);
const remedies = newest("remedies", (found, asked) => {
  if (!found.findings) document.getElementById("waiting").textContent = "Another page has asked for remedies meanwhile; change something to ask again.";
  else if (same(asked.change, change)) findings(found.findings, true, follow);
}, () => { document.getElementById("waiting").textContent = ""; });
// What a table puts around the mechanism takes longer than the mechanism; whichever comes later stays.
const mechanism = newest("mechanism", (found, asked) => {
  if (found.scene && same(asked.change, change) && !same(asked.change, complete)) present_({ ...found.scene, making: "The frame and what is in it are being made." }, asked);
}, () => {});
const motion = newest("motion", (found, asked) => {
  // While plates are drawn, links go over them; what the plates are comes a moment later.
  present_(ghost || !picture || !picture.layers || picture.bare ? { ...found.scene, making: "The parts are being made. Meanwhile joints and links are shown as points and lines." } : { ...found.scene, ghost: picture }, asked);
  mended();
  complete = null;
  mechanism(asked);
  parts(asked);
}, failed);
function failed(error) {
  const key = [...fields.keys()].find((one) => error.message.includes(one.split(".").slice(1).join(".") + ":"));
  if (key) fields.get(key).own.classList.add("wrong");
  say(error.message, true);
}
function value(key) {
  return key in change ? change[key] : fields.get(key).field.value;
}
function shows() {
  for (const [key, { show }] of fields) show(value(key), key in change);
  button_("undo").disabled = !past.length;
  button_("redo").disabled = !future.length;
  const clean = !Object.keys(change).length;
  button_("save").disabled = clean;
  button_("build").disabled = !clean;
  button_("build").title = clean ? "" : "A build is made of the file: save first";
  document.title = `${clean ? "" : "• "}${known ? known.name : "Mechwright"}: live`;
}
// A choice may bring other fields, as those of another linkage. Values of the file stay what the fields go back to.
const choices = () => JSON.stringify([...fields.values()].filter(({ field }) => field.kind === "choice").map(({ field }) => value(field.key)));
function fieldsOf(found) {
  const own = new Map(known.fields.map((field) => [field.key, field]));
  return found.map((field) => own.get(field.key) || (field.key in change ? { ...field, value: field.default } : field));
}
const relay = newest("described", (found) => {
  const now = fieldsOf(found.fields);
  if (now.length === fields.size && now.every((field) => fields.has(field.key))) return;
  lay(now, set);
  shows();
}, () => {});
function take(next, done) {
  say("");
  const before = choices();
  change = next;
  if (known && choices() !== before) relay({ change });
  if (done && !same(change, settled)) {
    past.push(settled);
    future = [];
    settled = change;
  }
  shows();
  look();
}
// What is shown of the change: a design moves, a requirement is met anew.
const look = () => known && known.seeks ? wishes({ change }) : motion({ change });
function set(key, one, done) {
  const next = { ...change };
  if (one === undefined || same(one, fields.get(key).field.value)) delete next[key];
  else next[key] = one;
  take(next, done);
}
const follow = (fix) => take({ ...change, ...fix }, true);
function step(from, to) {
  if (!from.length) return;
  to.push(settled);
  const before = choices();
  change = settled = from.pop();
  if (choices() !== before) relay({ change });
  shows();
  look();
}
button_("undo").addEventListener("click", () => step(past, future));
button_("redo").addEventListener("click", () => step(future, past));
document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || /^(input|textarea)$/i.test(event.target.tagName) && event.target.type !== "range") return;
  event.preventDefault();
  event.shiftKey ? step(future, past) : step(past, future);
});
button_("compare").addEventListener("click", () => {
  ghost = ghost || !picture ? null : { ...picture, ghost: null };
  button_("compare").setAttribute("aria-pressed", String(Boolean(ghost)));
  if (picture) picture.targets ? drawWished(picture) : draw(picture);
});
async function open(words) {
  try {
    known = await ask("described", { change: {} });
  } catch (error) {
    say(error.message + " The page shows the file as it was.", true);
    return false;
  }
  button_("name").textContent = known.name;
  button_("title").textContent = `${known.title} · ${known.file}`;
  lay(Object.keys(change).length ? fieldsOf(await ask("described", { change }).then((found) => found.fields, () => known.fields)) : known.fields, set);
  for (const key of Object.keys(change)) if (!fields.has(key) || same(change[key], fields.get(key).field.value)) delete change[key];
  settled = change;
  for (const one of document.querySelectorAll("[data-of]")) one.hidden = one.dataset.of !== (known.seeks ? "requirement" : "design");
  shows();
  words ? say(words) : mended();
  look();
  return true;
}
async function news() {
  for (;;) {
    try {
      const found = await (await fetch(`news?known=${known ? known.digest : ""}`)).json();
      if (!known || found.digest !== known.digest) {
        const mine = Object.keys(change).length;
        if (!found.digest) say("The file is gone, or cannot be read. The page shows it as it was.", true);
        else if (await open(mine ? `The file has changed; your ${mine === 1 ? "change stays" : mine + " changes stay"} on top of it.` : "")) continue;
        await new Promise((done) => setTimeout(done, 1000));
      }
    } catch {
      say("Mechwright does not answer. Is it still running? What is not saved is on this page alone.", true);
      await new Promise((done) => setTimeout(done, 2000));
    }
  }
}
