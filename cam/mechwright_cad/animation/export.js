// The picture as it stands as SVG, one period as GIF or WebM, and an address that shows the page as it is now.
const FRAMES = 60, ACROSS = 640, STYLED = ["fill", "fill-rule", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "stroke-linecap", "vector-effect", "display"];
const LEVELS = [6, 7, 6]; // of red, green and blue: 252 colours

// The picture that is shown: an SVG, or a canvas.
const pictureNow = () => [...document.getElementById("picture").querySelectorAll("svg, canvas")].find((one) => one.getClientRects().length);
// The text of the SVG, with what the style sheet says written out.
function standing(svg) {
  const copy = svg.cloneNode(true), own = [svg, ...svg.querySelectorAll("*")], its = [copy, ...copy.querySelectorAll("*")];
  own.forEach((one, k) => {
    const style = getComputedStyle(one);
    for (const name of STYLED) if (!["svg", "g", "title"].includes(one.tagName)) its[k].setAttribute(name, style.getPropertyValue(name));
    its[k].removeAttribute("class");
    its[k].removeAttribute("style");
  });
  const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
  copy.setAttribute("width", ACROSS);
  copy.setAttribute("height", Math.round(ACROSS * height / width));
  return new XMLSerializer().serializeToString(copy);
}
// Draws the picture as it stands now into a canvas.
async function drawn(canvas) {
  const picture = pictureNow(), pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.fillStyle = getComputedStyle(document.getElementById("picture")).backgroundColor;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  if (picture.tagName === "CANVAS") return pen.drawImage(picture, 0, 0, canvas.width, canvas.height);
  const image = new Image();
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(standing(picture));
  await image.decode();
  pen.drawImage(image, 0, 0, canvas.width, canvas.height);
}
function sheet() {
  const box = pictureNow(), of = box.tagName === "CANVAS" ? [box.width, box.height] : box.getAttribute("viewBox").split(" ").map(Number).slice(2);
  const canvas = document.createElement("canvas");
  canvas.width = ACROSS;
  canvas.height = 2 * Math.round(ACROSS * of[1] / of[0] / 2);
  return canvas;
}
function packed(pixels) {
  const out = [], table = new Map();
  let next = 258, size = 9, held = 0, bits = 0, prefix = pixels[0];
  const put = (code) => {
    held |= code << bits;
    for (bits += size; bits >= 8; bits -= 8) { out.push(held & 255); held >>>= 8; }
  };
  put(256);
  for (let k = 1; k < pixels.length; k++) {
    const key = prefix << 8 | pixels[k], known = table.get(key);
    if (known !== undefined) { prefix = known; continue; }
    put(prefix);
    if (next === 4096) { put(256); table.clear(); next = 258; size = 9; }
    else { if (next >= 1 << size) size++; table.set(key, next++); }
    prefix = pixels[k];
  }
  put(prefix);
  put(257);
  if (bits) out.push(held & 255);
  const blocks = [8];
  for (let k = 0; k < out.length; k += 255) { const piece = out.slice(k, k + 255); blocks.push(piece.length, ...piece); }
  blocks.push(0);
  return blocks;
}
function indexed(canvas) {
  const { data: rgba } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height), found = new Uint8Array(rgba.length / 4);
  const level = (value, k) => Math.round(value / 255 * (LEVELS[k] - 1));
  for (let k = 0; k < found.length; k++) found[k] = (level(rgba[4 * k], 0) * LEVELS[1] + level(rgba[4 * k + 1], 1)) * LEVELS[2] + level(rgba[4 * k + 2], 2);
  return found;
}
async function gif(seek, tell) {
  const canvas = sheet(), two = (value) => [value & 255, value >> 8], delay = Math.max(2, Math.round(100 * Number(pace.value) / FRAMES));
  const bytes = [...new TextEncoder().encode("GIF89a"), ...two(canvas.width), ...two(canvas.height), 0xf7, 0, 0];
  for (let k = 0; k < 256; k++) {
    const of = [Math.floor(k / LEVELS[1] / LEVELS[2]), Math.floor(k / LEVELS[2]) % LEVELS[1], k % LEVELS[2]];
    bytes.push(...of.map((one, j) => Math.min(255, Math.round(255 * one / (LEVELS[j] - 1)))));
  }
  bytes.push(0x21, 0xff, 11, ...new TextEncoder().encode("NETSCAPE2.0"), 3, 1, 0, 0, 0);
  const parts = [new Uint8Array(bytes)];
  for (let k = 0; k < FRAMES && !signal.aborted; k++) {
    seek(frame(k / FRAMES));
    await drawn(canvas);
    parts.push(new Uint8Array([0x21, 0xf9, 4, 0, ...two(delay), 0, 0, 0x2c, 0, 0, 0, 0, ...two(canvas.width), ...two(canvas.height), 0]), new Uint8Array(packed(indexed(canvas))));
    tell(`GIF: ${k + 1} of ${FRAMES} pictures`);
  }
  parts.push(new Uint8Array([0x3b]));
  keep(new Blob(parts, { type: "image/gif" }), "gif");
}
// The time of the picture at a part of the film: once round, or there and back.
const frame = (part) => (data.round ? part : 1 - Math.abs(1 - 2 * part)) * last;
async function film(seek, tell) {
  const kind = ["video/webm;codecs=vp9", "video/webm", "video/mp4"].find((one) => window.MediaRecorder && MediaRecorder.isTypeSupported(one));
  if (!kind) return tell("This browser records no film; GIF is there.");
  const canvas = sheet();
  await drawn(canvas);
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: kind, videoBitsPerSecond: 4e6 }), pieces = [];
  const ended = new Promise((done) => { recorder.ondataavailable = (event) => pieces.push(event.data); recorder.onstop = done; });
  recorder.start();
  const start = performance.now(), long = 1000 * Number(pace.value);
  for (let now = 0; now < long && !signal.aborted; now = performance.now() - start) {
    seek(frame(now / long));
    await drawn(canvas);
    tell(`film: ${Math.round(100 * now / long)} %`);
    await new Promise((done) => requestAnimationFrame(done));
  }
  recorder.stop();
  await ended;
  keep(new Blob(pieces, { type: kind.split(";")[0] }), kind.includes("mp4") ? "mp4" : "webm");
}
// What the address says: where the input stands, what is hidden, which channels are plotted.
function asked() {
  const found = new URLSearchParams(location.hash.slice(1)), list = (name) => found.has(name) ? found.get(name).split(",").map(decodeURIComponent).filter(Boolean) : undefined;
  return { at: found.has("at") && Number.isFinite(Number(found.get("at"))) ? Number(found.get("at")) : undefined, off: list("off"), ticked: list("plot") };
}
function address(at, off, plotted) {
  const list = (names) => names.map(encodeURIComponent).join(",");
  return `#at=${Number(at.toPrecision(8))}&off=${encodeURIComponent(list(off))}&plot=${encodeURIComponent(list(plotted))}`;
}
function takeAway(seek, now, state) {
  const tell = (words) => { document.getElementById("taken").textContent = words; }, svg = document.querySelector("#picture svg");
  const guarded = (work) => async () => {
    const before = now();
    play(false);
    try { await work(seek, tell); tell(""); } catch (error) { tell(`not made: ${error.message}`); }
    seek(before);
  };
  const button_ = (name) => document.getElementById(name);
  button_("svg").hidden = !svg;
  for (const name of ["gif", "film"]) button_(name).hidden = !document.getElementById("picture");
  button_("svg").addEventListener("click", () => keep(new Blob([standing(svg)], { type: "image/svg+xml" }), "svg"));
  button_("gif").addEventListener("click", guarded(gif));
  button_("film").addEventListener("click", guarded(film));
  button_("link").hidden = Boolean(data.live);
  button_("link").addEventListener("click", () => {
    history.replaceState(null, "", state());
    tell("The address shows the page as it is now.");
  });
}
