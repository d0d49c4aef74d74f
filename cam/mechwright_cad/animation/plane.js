// Bodies in parallel planes: paths of SVG, the highest layer last.
function planePicture(place) {
  const ghost = data.ghost && data.ghost.layers ? data.ghost : null; // another design below this one
  const [x, y, width, height] = ghost ? around(data.window, ghost.window) : data.window;
  const svg = element("svg", { viewBox: `${x} ${-y - height} ${width} ${height}`, role: "img",
    "aria-label": "The mechanism seen from above" }, place);
  const turned = element("g", { transform: "scale(1 -1)" }, svg);
  const below = !ghost ? [] : ghost.layers.map((layer) =>
    [element("path", { class: "ghost", d: layer.path }, turned), ghost.poses[layer.body]]);
  const stretch = ghost ? (Math.max(...Object.values(ghost.poses).map((pose) => pose.columns[0].length)) - 1) / last : 1;
  const groups = data.layers.map((layer) => {
    const drawn = element("path", layer.bones
      ? { class: "bone", d: layer.path, stroke: layer.colour } : { class: layer.clear ? "part clear" : "part", d: layer.path, fill: layer.colour }, turned);
    element("title", { text: layer.name }, drawn);
    const show = shown.get(layer.name) || { colour: layer.colour, parts: [], group: layer.group, off: layer.off };
    show.parts.push((on) => { drawn.style.display = on ? "" : "none"; });
    shown.set(layer.name, show);
    return [drawn, data.poses[layer.body]];
  });
  const dots = Object.entries(data.traces).map(([name, path]) => {
    const line = element("polyline", { points: path.map(([px, py]) => `${px},${py}`).join(" ") }, turned);
    const dot = element("circle", { class: "point", r: Math.max(width, height) / 130 }, turned);
    shown.set("path of " + name, { parts: [(on) => { line.style.display = dot.style.display = on ? "" : "none"; }] });
    return [dot, path.map((point) => point[0]), path.map((point) => point[1])];
  });
  const over = overlays(turned, Math.max(width, height));
  return (time) => {
    over(time);
    for (const [drawn, pose] of below) put(drawn, pose, Math.min(time * stretch, Math.max(1, pose.columns[0].length) - 1));
    for (const [drawn, pose] of groups) put(drawn, pose, time);
    for (const [dot, xs, ys] of dots) {
      dot.setAttribute("cx", at(xs, time));
      dot.setAttribute("cy", at(ys, time));
    }
  };
}
function put(drawn, pose, time) {
  const [px, py, angle] = pose.columns.map((column) => at(column, time));
  const c = Math.cos(angle), s = Math.sin(angle), flip = pose.down ? -1 : 1;
  drawn.setAttribute("transform", `matrix(${c} ${s} ${-s * flip} ${c * flip} ${px} ${py})`);
}
// The window that holds two.
function around(one, two) {
  const left = Math.min(one[0], two[0]), bottom = Math.min(one[1], two[1]);
  const right = Math.max(one[0] + one[2], two[0] + two[2]), top = Math.max(one[1] + one[3], two[1] + two[3]);
  return [left, bottom, right - left, top - bottom];
}
