// The page of a motion: its pictures, what can be hidden, and plots that go with the input.
const asking = data.live ? {} : asked();
kept = { ...kept, ...Object.fromEntries(Object.entries(asking).filter(([key, value]) => key !== "at" && value !== undefined)) };
{% include "clock.js" %}

let viewed = () => kept.view, which_ = kept.which; // of a picture in space; the picture that is shown
const place = document.getElementById("picture");
const pictured = Object.keys(data.poses).length || data.targets;
const draw = pictured ? pictures(place) : () => {};
if (!pictured) place.remove();

// The picture in space, the plan, or both with a button for each.
function pictures(place) {
  const found = [["in space", data.meshes && spacePicture], ["plan", data.layers && planePicture]].filter(([, make]) => make);
  if (found.length < 2) return found[0][1](place);
  const which = element("div", { id: "which", role: "group", "aria-label": "Picture" });
  place.before(which);
  const made = found.map(([name, make]) => {
    const where = element("div", {}, place), paint = make(where);
    return { where, paint, button: element("button", { type: "button", text: name }, which) };
  });
  const choose = (chosen) => made.forEach((one) => {
    one.where.hidden = one !== chosen;
    one.button.setAttribute("aria-pressed", String(one === chosen));
    if (one === chosen) which_ = one.button.textContent;
  });
  // Without WebGL 2 the plan is what there is to see; places are dragged in it.
  const seen = made.filter((one) => one.where.querySelector("canvas, svg"));
  choose(seen.find((one) => one.button.textContent === (kept.which || (data.targets ? "plan" : ""))) || seen[0]);
  for (const one of made) one.button.addEventListener("click", () => { choose(one); show(); });
  // What is hidden is drawn as well while nothing runs, so that it can be kept as a file.
  return (time) => { for (const one of made) if (!one.where.hidden || !runs() && one.where.querySelector("svg")) one.paint(time); };
}
function drawNow(time) {
  draw(time);
  for (const cursor of cursors) cursor(time);
  for (const cell of cells.values()) cell(time);
}
const legend = document.getElementById("legend"), legendOf = legendIn(legend, shown, kept);
if (!shown.size) legend.remove();
if (data.making && !data.bare || data.bare && !data.ghost || data.missing.length) {
  const note = document.getElementById("note");
  note.hidden = false;
  if (data.making) note.textContent = data.making;
  else if (data.bare) note.textContent = "Joints and links as points and lines: there are no parts to draw.";
  else note.textContent = `Not drawn, because they take the CAD kernel: ${data.missing.join(", ")}. mechwright build writes this page with them.`;
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
takeAway(seek, () => time, () => address(at(input.values, time) * factorOfInput, legendOf.hidden(), [...ticked]));
show();
if (kept.plays) play(true);
if (kept.pace) pace.value = kept.pace;
// What another player goes on from.
return () => ({
  at: last ? time / last : 0, plays: before !== null, pace: pace.value, ticked: [...ticked], view: viewed(), which: which_,
  off: legendOf.hidden(), seen: [...shown.keys()], plotted: names,
});
