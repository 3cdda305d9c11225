// Colours and marks: a colour is never alone.

// Okabe and Ito's palette, which colour-blind readers can tell apart; the sixth and fifth are darker on white (page.css).
export const colourCount = 8;
const shapes = [d3.symbolCircle, d3.symbolSquare, d3.symbolTriangle, d3.symbolDiamond, d3.symbolStar, d3.symbolWye, d3.symbolCross];

// The colour and shape of a word: by its place, a new pair for each of the first 56.
export const styleOf = index => ({colour: "c" + index % colourCount, shape: shapes[(index + Math.floor(index / colourCount)) % shapes.length]});

// Many marks as one path: D3's shapes, moved.
export function marksPath(points, shape, size) {
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

/// A short line with one mark, as a kernel's curve looks.
export function drawSample(svg, style, second) {
  svg.attr("width", 30).attr("height", 12).attr("aria-hidden", "true").attr("class", "sample kernel " + style.colour + (second ? " second" : ""));
  svg.append("path").attr("class", "line").attr("d", "M1,6H29");
  svg.append("path").attr("class", "marks").attr("d", marksPath([[15, 6]], style.shape, 34));
}
