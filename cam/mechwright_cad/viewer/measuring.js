// Distances between picked points, and paths of picked points: what stands on the bodies moves with them.
function measuring(box, own) {
  const { eye, things } = own, tags = element("div", { class: "tags" }, box);
  let first = null;
  const placeOf = ({ thing, at: own_ }) => plus(turnedBy(thing.now.turn, own_), thing.now.place);
  const said = (value) => String(Number(value.toFixed(2)) + 0);
  function measure(one, two) {
    const tag = element("span", { class: "tag" }, tags);
    let stored = null;
    own.measures.push({
      line: (painter) => {
        if (stored) painter.gl.deleteVertexArray(stored.array);
        stored = painter.lines([...placeOf(one), ...placeOf(two)]);
        return stored;
      },
      show: () => {
        const a = placeOf(one), b = placeOf(two), off = plus(b, a, -1), middle = plus(a, off, 0.5), [x, y] = eye.to(middle);
        tag.textContent = `${said(Math.hypot(...off))} mm`;
        tag.title = `x ${said(Math.abs(off[0]))}, y ${said(Math.abs(off[1]))}, z ${said(Math.abs(off[2]))} mm`;
        tag.style.transform = `translate(${x}px, ${y}px)`;
      },
      words: () => {
        const off = plus(placeOf(two), placeOf(one), -1);
        return `${said(Math.hypot(...off))} mm from ${one.thing.name} to ${two.thing.name} (x ${said(off[0])}, y ${said(off[1])}, z ${said(off[2])})`;
      },
      drop: () => tag.remove(),
    });
  }
  own.painted = () => own.measures.forEach((one) => one.show());
  return {
    // Takes a hit; gives what there is to say of it.
    take: (hit, x, y) => {
      const point = { thing: hit.thing, at: meant3(hit, eye, x, y) };
      if (!first) {
        first = point;
        return `From ${point.thing.name}; now the other point.`;
      }
      measure(first, point);
      first = null;
      own.again();
      return own.measures[own.measures.length - 1].words();
    },
    trace: (hit, x, y) => {
      const at_ = meant3(hit, eye, x, y), points = Array.from({ length: last + 1 }, (_, time) => {
        const pose = own.stand(hit.thing, time);
        return plus(turnedBy(pose.turn, at_), pose.place);
      });
      own.traces.push({ line: own.painter.lines(points.flat()), columns: [0, 1, 2].map((k) => points.map((point) => point[k])) });
      own.again();
      return `The path of a point of ${hit.thing.name}.`;
    },
    clear: () => {
      own.measures.splice(0).forEach((one) => one.drop());
      own.traces.splice(0);
      first = null;
      own.again();
    },
  };
}
