"use strict";
{
  const SVG = "http://www.w3.org/2000/svg", SECONDS = 4;
  const made = (name, attributes, parent) => {
    const found = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) found.setAttribute(key, value);
    parent.append(found);
    return found;
  };
  const steps = JSON.parse(document.getElementById("moving").textContent).map((one, place) => {
    const [left, bottom, width, height] = one.window;
    const svg = document.querySelectorAll("#pictures svg")[place];
    svg.setAttribute("viewBox", `${left} ${-bottom - height} ${width} ${height}`);
    const upright = made("g", { transform: "scale(1 -1)" }, svg);
    const line = { fill: "none", "vector-effect": "non-scaling-stroke" };
    const shapes = one.shapes.map((shape) => [shape, shape.path
      ? made("path", { d: shape.path, fill: shape.colour, "fill-rule": "evenodd", class: "plate", "vector-effect": "non-scaling-stroke" }, upright)
      : made("polyline", { class: "link", ...line }, upright)]);
    for (const path of one.traces) made("path", { d: path, class: "trace", ...line }, upright);
    if (one.asked) made("path", { d: one.asked, class: "asked", ...line }, upright);
    return (share) => {
      for (const [shape, drawn] of shapes) {
        const now = shape.at[Math.floor(share * shape.at.length) % shape.at.length];
        if (shape.path) drawn.setAttribute("transform", `matrix(${now.join(" ")})`);
        else drawn.setAttribute("points", now.join(" "));
      }
    };
  });
  const button = document.getElementById("play");
  let running = false, since = 0, at = 0;
  const draw = (share) => { for (const step of steps) step(share); };
  function frame(now) {
    if (!running) return;
    at = ((now - since) / 1000 / SECONDS) % 1;
    draw(at);
    requestAnimationFrame(frame);
  }
  function run(wanted) {
    running = wanted;
    button.textContent = running ? "stop" : "move";
    if (running) requestAnimationFrame((now) => { since = now - at * SECONDS * 1000; frame(now); });
  }
  button.addEventListener("click", () => run(!running));
  draw(0);
  run(!matchMedia("(prefers-reduced-motion: reduce)").matches);
}
