// Numbers as they are read: some significant figures, powers of ten only where plain digits get
// unreadable.
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function raised(power) {
  return [...String(power)].map((c) => (c === "-" ? "⁻" : RAISED[c])).join("");
}

function written(x, figures) {
  if (x === 0) return "0";
  if (!Number.isFinite(x)) return "–";
  const [digits, exponent] = x.toExponential(figures - 1).split("e");
  if (exponent < -4 || exponent > 6) {
    return `${Number(digits)}·10${raised(Number(exponent))}`;
  }
  return Number(x.toPrecision(figures)).toFixed(Math.max(0, figures - 1 - exponent));
}

// A value at an axis: narrow, for its title stands beside it.
function tick(value) {
  const plain = Number(value.toPrecision(6));
  const size = Math.abs(plain);
  if (size === 0 || (size >= 1e-3 && size < 1e4)) return String(plain);
  const [digits, exponent] = plain.toExponential().split("e");
  const power = `10${raised(Number(exponent))}`;
  return digits === "1" ? power : `${digits}·${power}`;
}
