// The eye: whence the scene is seen, turned, moved and brought nearer by pointer, wheel, touch and keys.
const FRONT = { front: [0, 0], right: [Math.PI / 2, 0], back: [Math.PI, 0], left: [-Math.PI / 2, 0], top: [0, Math.PI / 2],
  bottom: [0, -Math.PI / 2], corner: [0.56, 0.53] };
const VIEWS = ["corner", "front", "right", "back", "left", "top", "bottom"]; // keys 1 to 7
const CLICK = 4; // pixels that a hand may move in a click

// `ball` is looked at, `up` is drawn upwards; `canvas` is listened to, and `moved` called after each change.
function eyeOn(canvas, ball, up, kept_, moved) {
  const side = Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0], second = unitOf(times(up, side));
  const frame = [times(second, up), second, up]; // of the ground: x to the right, y to the back, z up
  const [azimuth, height, zoom, right, high] = kept_ || [];
  const own = { azimuth: azimuth ?? FRONT.corner[0], height: height ?? FRONT.corner[1], zoom: zoom ?? 1.15, right: right ?? 0, high: high ?? 0, reach: ball.radius };
  own.state = () => [own.azimuth, own.height, own.zoom, own.right, own.high].map((part) => Number(part.toFixed(3)));
  // To the right, up, and towards the eye.
  own.rows = () => {
    const ca = Math.cos(own.azimuth), sa = Math.sin(own.azimuth), ch = Math.cos(own.height), sh = Math.sin(own.height);
    return [[ca, sa, 0], [-sa * sh, ca * sh, ch], [sa * ch, -ca * ch, sh]]
      .map((row) => [0, 1, 2].map((k) => row[0] * frame[0][k] + row[1] * frame[1][k] + row[2] * frame[2][k]));
  };
  own.axes = frame;
  own.unit = () => { const box = canvas.getBoundingClientRect(); return own.zoom * Math.min(box.width, box.height) / own.reach / 2; }; // pixels in a millimetre
  own.middle = () => { const rows = own.rows(); return plus(plus(ball.centre, rows[0], own.right), rows[1], own.high); };
  // Where a place is on the canvas, with its height towards the eye; and the place there in the plane of the middle.
  own.projection = () => {
    const rows = own.rows(), box = canvas.getBoundingClientRect(), unit = own.unit(), middle = own.middle();
    return (p) => {
      const off = plus(p, middle, -1);
      return [box.width / 2 + dot(rows[0], off) * unit, box.height / 2 - dot(rows[1], off) * unit, dot(rows[2], off)];
    };
  };
  own.to = (p) => own.projection()(p);
  own.from = (x, y) => {
    const rows = own.rows(), box = canvas.getBoundingClientRect(), unit = own.unit();
    return plus(plus(own.middle(), rows[0], (x - box.width / 2) / unit), rows[1], (box.height / 2 - y) / unit);
  };
  // The place under a point of the canvas on the sphere about 0 through an old place.
  own.onSphere = (x, y, old) => {
    const rows = own.rows(), seen = own.from(x, y), radius = Math.hypot(...old);
    let u = dot(rows[0], seen), v = dot(rows[1], seen);
    const far = Math.max(1, Math.hypot(u, v) / radius); // outside of the sphere: its rim
    u /= far;
    v /= far;
    const w = (dot(rows[2], old) >= 0 ? 1 : -1) * Math.sqrt(Math.max(0, radius * radius - u * u - v * v));
    return [0, 1, 2].map((k) => rows[0][k] * u + rows[1][k] * v + rows[2][k] * w);
  };
  own.turn = (right_, up_) => {
    own.azimuth -= right_;
    own.height = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, own.height + up_));
    moved();
  };
  own.pan = (x, y) => { own.right -= x / own.unit(); own.high += y / own.unit(); moved(); };
  // Nearer or farther, so that what is under a point of the canvas stays there.
  own.nearer = (share, x, y) => {
    const before = x === undefined ? null : own.from(x, y);
    own.zoom = Math.min(60, Math.max(0.2, own.zoom * share));
    if (before) {
      const rows = own.rows(), off = plus(before, own.from(x, y), -1);
      own.right += dot(rows[0], off);
      own.high += dot(rows[1], off);
    }
    moved();
  };
  own.look = (name) => { [own.azimuth, own.height] = FRONT[name]; moved(); };
  own.fit = () => { own.zoom = 1.15; own.right = own.high = 0; moved(); };
  const STEP = 0.1, keys = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const way = keys[event.key];
    if (way && event.shiftKey) own.pan(30 * way[0], -30 * way[1]);
    else if (way) own.turn(STEP * way[0], STEP * way[1]);
    else if (event.key === "+" || event.key === "=") own.nearer(1.15);
    else if (event.key === "-") own.nearer(1 / 1.15);
    else if (event.key === "0") own.fit();
    else if (VIEWS[Number(event.key) - 1]) own.look(VIEWS[Number(event.key) - 1]);
    else return;
    event.preventDefault();
  });
  own.held = () => held.size > 0;
  const held = new Map(); // fingers, or the mouse, by their number
  let away = 0;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.clientX, event.clientY]);
    if (held.size === 1) away = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const old = held.get(event.pointerId);
    if (!old) return;
    const dx = event.clientX - old[0], dy = event.clientY - old[1];
    away += Math.hypot(dx, dy);
    if (held.size === 2) {
      const other = [...held].find(([id]) => id !== event.pointerId)[1];
      const apart = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]) || 1;
      own.nearer(apart([event.clientX, event.clientY]) / apart(old));
      own.pan(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons & 6) own.pan(dx, dy);
    else own.turn(dx / 150, dy / 150);
    held.set(event.pointerId, [event.clientX, event.clientY]);
  });
  const let_ = (event) => {
    const box = canvas.getBoundingClientRect();
    if (held.delete(event.pointerId) && event.type === "pointerup" && !held.size && away < CLICK && own.clicked) {
      own.clicked(event.clientX - box.left, event.clientY - box.top);
    }
  };
  canvas.addEventListener("pointerup", let_);
  canvas.addEventListener("pointercancel", let_);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect();
    own.nearer(Math.exp(-event.deltaY / 600), event.clientX - box.left, event.clientY - box.top);
  }, { passive: false });
  return own;
}
