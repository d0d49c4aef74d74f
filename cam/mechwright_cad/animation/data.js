// Values of the motion between two samples.
const input = data.channels[data.input];
const along = data.channels[data.over]; // over which plots are drawn: it goes one way
const last = input.values.length - 1;
const degrees = (unit) => unit === "rad" ? ["°", 180 / Math.PI]
  : [unit.replace("^2", "²").replace("^3", "³").replace("*", "·"), 1];
const told = (name) => data.channels[name].label;
const round = (value) => value === null || Number.isNaN(value) ? "" : String(Number(value.toPrecision(5)));

// A column of one number stands for all samples; between two samples it goes straight.
function at(column, time) {
  const first = Math.min(Math.floor(time), column.length - 2);
  if (first < 0) return column[0];
  const a = column[first], b = column[first + 1];
  return a === null || b === null ? NaN : a + (time - first) * (b - a);
}
