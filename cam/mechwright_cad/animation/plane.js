// Bodies in parallel planes: paths of SVG, the highest layer last.
function planePicture(place) {
  const [x, y, width, height] = data.window;
  const svg = element("svg", { viewBox: `${x} ${-y - height} ${width} ${height}`, role: "img",
    "aria-label": "The mechanism seen from above" }, place);
  const turned = element("g", { transform: "scale(1 -1)" }, svg);
  const groups = data.layers.map((layer) => {
    const drawn = element("path", layer.bones
      ? { class: "bone", d: layer.path, stroke: layer.colour } : { class: "part", d: layer.path, fill: layer.colour }, turned);
    element("title", { text: layer.name }, drawn);
    const show = shown.get(layer.name) || { colour: layer.colour, parts: [] };
    show.parts.push((on) => { drawn.style.display = on ? "" : "none"; });
    shown.set(layer.name, show);
    return [drawn, data.poses[layer.body]];
  });
  const dots = Object.entries(data.traces).map(([name, path]) => {
    const line = element("polyline", { points: path.map((point) => point.join()).join(" ") }, turned);
    const dot = element("circle", { class: "point", r: Math.max(width, height) / 130 }, turned);
    shown.set("path of " + name, { parts: [(on) => { line.style.display = dot.style.display = on ? "" : "none"; }] });
    return [dot, path.map((point) => point[0]), path.map((point) => point[1])];
  });
  return (time) => {
    for (const [drawn, pose] of groups) {
      const [px, py, angle] = pose.columns.map((column) => at(column, time));
      const c = Math.cos(angle), s = Math.sin(angle), flip = pose.down ? -1 : 1;
      drawn.setAttribute("transform", `matrix(${c} ${s} ${-s * flip} ${c * flip} ${px} ${py})`);
    }
    for (const [dot, xs, ys] of dots) {
      dot.setAttribute("cx", at(xs, time));
      dot.setAttribute("cy", at(ys, time));
    }
  };
}
