// An element with its attributes, at the end of another one; `text` is what it says.
function element(name, attributes, parent) {
  const svg = ["svg", "g", "path", "polyline", "circle", "line", "rect", "text"].includes(name);
  const made = svg ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (key === "text") made.textContent = value; else made.setAttribute(key, value);
  }
  if (parent) parent.append(made);
  return made;
}
