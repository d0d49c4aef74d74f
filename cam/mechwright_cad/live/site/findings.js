// What the family finds, the gravest first; a remedy that was tried is one press away.
function find(key) {
  const whole = [key, `parameters.${key}`, `requirement.${key}`].find((one) => fields.has(one)), found = fields.get(whole);
  if (!found) return;
  for (let place = found.own.parentElement; place; place = place.parentElement) if (place.tagName === "DETAILS") place.open = true;
  found.own.hidden = false;
  found.own.scrollIntoView({ block: "center" });
  found.entry.focus();
}
const told = (fix) => Object.entries(fix).map(([key, value]) => value === null ? `leave out ${key}` : `${key} = ${typeof value === "number" ? shortNumber(value) : JSON.stringify(value)}`).join(", ");
function findings(list, tried, follow) {
  const place = document.getElementById("findings");
  place.replaceChildren();
  const words = { error: "Error", warning: "Warning", note: "Note" };
  for (const one of list) {
    const item = made("li", { class: one.severity }, place), head = made("div", { class: "head" }, item);
    head.append(`${words[one.severity]} `);
    made("span", { class: "code" }, head, one.code + " ");
    if (one.parameter) made("button", { type: "button", class: "link" }, head, one.parameter).addEventListener("click", () => find(one.parameter));
    made("div", {}, item, one.message);
    if (one.remedy) made("p", { class: "remedy" }, item, one.remedy);
    if (one.fix) made("button", { type: "button", class: "fix" }, item, `Apply: ${told(one.fix)}`).addEventListener("click", () => follow(one.fix));
  }
  if (!list.length) made("li", {}, place, "Nothing to object to.");
  document.getElementById("waiting").textContent =
    !tried && list.some((one) => one.severity !== "note") ? "Remedies are being tried …" : "";
}
