// Questions to the server. Of each kind one is under way; the newest waits for it, and those between are dropped.
async function ask(what, body) {
  let reply;
  try {
    reply = await fetch(what, { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) });
  } catch {
    throw new Error("Mechwright does not answer. Is it still running? What is not saved is on this page alone.");
  }
  const found = await reply.json().catch(() => ({ error: `the server said ${reply.status}` }));
  if (found.error) throw new Error(found.error);
  return found;
}
function newest(what, take, fail) {
  let busy = false, next = null;
  const go = async () => {
    busy = true;
    while (next) {
      const mine = next;
      next = null;
      try {
        const found = await ask(what, mine);
        if (!next) take(found, mine);
      } catch (error) {
        if (!next) fail(error, mine);
      }
    }
    busy = false;
  };
  const question = (body) => { next = body; if (!busy) go(); };
  question.idle = () => !busy && !next;
  return question;
}
const banner = document.getElementById("banner");
function say(words, wrong) {
  banner.hidden = !words;
  banner.className = wrong ? "banner error" : "banner";
  banner.textContent = words || "";
}
// What went well takes back what was wrong; news stay until somebody changes something.
function mended() {
  if (banner.classList.contains("error")) say("");
}
