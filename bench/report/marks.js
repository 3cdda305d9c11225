
// ---- Colours and marks: a colour is never alone.

// Okabe and Ito's palette, which colour-blind readers can tell apart; the sixth and fifth are darker on white (page.css).
const colourCount = 8;
const shapes = [d3.symbolCircle, d3.symbolSquare, d3.symbolTriangle, d3.symbolDiamond, d3.symbolStar, d3.symbolWye, d3.symbolCross];

// The colour and shape of a word: by its place, a new pair for each of the first 56.
const styleOf = index => ({colour: "c" + index % colourCount, shape: shapes[(index + Math.floor(index / colourCount)) % shapes.length]});

// Many marks as one path: D3's shapes, moved.
function marksPath(points, shape, size) {
  const path = d3.path();
  for (const [x, y] of points) {
    shape.draw({
      moveTo: (a, b) => path.moveTo(a + x, b + y),
      lineTo: (a, b) => path.lineTo(a + x, b + y),
      rect: (a, b, w, h) => path.rect(a + x, b + y, w, h),
      arc: (a, b, r, from, to) => { path.moveTo(a + x + r, b + y); path.arc(a + x, b + y, r, from, to); },
      closePath: () => path.closePath()
    }, size);
  }
  return path.toString();
}

// ---- Numbers as a person reads them.

const superscript = text => String(text).replace(/[-\d]/g, c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]);
const grouped = d3.format(",");

function show(value) {
  if (value === undefined || Number.isNaN(value)) return "";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e9) return value.toExponential(3);
  if (Number.isInteger(value)) return grouped(value);
  return size >= 1000 ? grouped(Number(value.toFixed(1))) : String(Number(value.toPrecision(4)));
}

function tick(value) {
  if (value === 0) return "0";
  if (value >= 1e6) return Number((value / 1e6).toPrecision(3)) + "M";
  if (value >= 1e3) return Number((value / 1e3).toPrecision(3)) + "k";
  return value >= 0.01 ? String(Number(value.toPrecision(3))) : value.toExponential(0);
}

const tenTo = exponent => exponent === 0 ? "1" : "10" + superscript(exponent);
