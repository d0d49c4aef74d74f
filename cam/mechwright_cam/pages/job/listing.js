// The text of the program: only the lines in view are in the page. A click on a line shows its place.
const HIGH = 18, SPARE = 12; // px of a line; lines above and below what is seen

function listingIn(place, lines, marked, chosen) {
  const inner = element("div", { class: "lines" }, place), own = { now: -1 };
  inner.style.height = `${lines.length * HIGH}px`;
  const digits = String(lines.length).length;
  function fill() {
    const first = Math.max(0, Math.floor(place.scrollTop / HIGH) - SPARE), last = Math.min(lines.length, Math.ceil((place.scrollTop + place.clientHeight) / HIGH) + SPARE);
    inner.replaceChildren(...Array.from({ length: last - first }, (_, k) => {
      const row = element("div", { class: `line${first + k === own.now ? " now" : ""}${marked.has(first + k) ? " marked " + marked.get(first + k) : ""}`, text: `${String(first + k + 1).padStart(digits)}  ${lines[first + k]}` });
      row.style.top = `${(first + k) * HIGH}px`;
      row.dataset.line = first + k;
      return row;
    }));
  }
  own.show = (line) => {
    if (line === own.now) return;
    own.now = line;
    const top = line * HIGH;
    if (top < place.scrollTop + HIGH || top > place.scrollTop + place.clientHeight - 2 * HIGH) place.scrollTop = top - place.clientHeight / 2;
    fill();
  };
  place.addEventListener("scroll", fill);
  place.addEventListener("click", (event) => {
    const row = event.target.closest(".line");
    if (row && String(getSelection()) === "") chosen(Number(row.dataset.line), 0);
  });
  place.addEventListener("keydown", (event) => {
    const way = { ArrowDown: 1, ArrowUp: -1, PageDown: 20, PageUp: -20 }[event.key];
    if (!way || event.ctrlKey || event.altKey) return;
    event.preventDefault();
    chosen(Math.min(lines.length - 1, Math.max(0, own.now + way)), Math.sign(way));
  });
  new ResizeObserver(fill).observe(place);
  fill();
  return own;
}
