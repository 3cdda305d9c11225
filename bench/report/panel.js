// A panel: series over a cost, on one error axis; hover and arrow keys.

import {marksPath, styleOf} from "./marks.js";
import {tenTo, tick} from "./numbers.js";
import {hideTip, showTip} from "./tip.js";

const panelHeight = 320;
const margin = {top: 10, right: 16, bottom: 44, left: 50};

function scaleOf(values, range, linear) {
  const positive = values.filter(value => value > 0);
  const low = d3.min(positive), high = d3.max(positive);
  if (linear) return d3.scaleLinear().domain([0, (high || 1) * 1.05]).range(range);
  return d3.scaleLog().domain([(low || 1) / 1.25, (high || 1) * 1.25]).range(range);
}

// Powers of ten, few enough to read; within one decade D3's own choice.
function decades(scale, most) {
  const [low, high] = scale.domain();
  const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
  if (last - first < 1) return scale.ticks(4).slice(0, 12);
  const step = Math.ceil((last - first + 1) / most);
  return d3.range(last, first - 1, -step).map(exponent => Number("1e" + exponent));
}

const isPowerOfTen = value => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9;

// Labels that fit between the others, the first ones first.
function spread(ticks, position, width) {
  const kept = [];
  for (const one of ticks) {
    const [from, to] = [position(one.value) - width(one) / 2, position(one.value) + width(one) / 2];
    if (kept.every(other => to + 6 < other.from || from - 6 > other.to)) kept.push({...one, from, to});
  }
  return kept;
}

function drawAxes(svg, panel, x, y, width, height) {
  const floor = panel.zero ? y.zero : null;
  const rows = (panel.linear ? y.ticks(5) : decades(y, 7)).map(value => ({value, at: y(value),
    text: panel.yText ? panel.yText(value) : !panel.linear && isPowerOfTen(value) ? tenTo(Math.round(Math.log10(value))) : tick(value)}));
  if (floor !== null && !panel.linear) rows.push({value: 0, at: floor, text: "0"});
  const grid = svg.append("g").attr("class", "axis");
  for (const row of rows) {
    grid.append("line").attr("x1", margin.left).attr("x2", width - margin.right).attr("y1", row.at).attr("y2", row.at);
    grid.append("text").attr("x", margin.left - 6).attr("y", row.at + 4).attr("text-anchor", "end").text(row.text);
  }
  const wanted = panel.xTicks ? panel.xTicks.map(one => ({...one}))
    : (panel.linear ? x.ticks(5) : decades(x, 6)).map(value => ({value, text: tick(value)}));
  // The outermost first, so that what is left out lies between.
  const ordered = panel.xTicks ? [wanted[wanted.length - 1], wanted[0], ...wanted.slice(1, -1)].filter(Boolean) : wanted;
  for (const one of spread(ordered, x, one => one.text.length * 6.5)) {
    grid.append("line").attr("x1", x(one.value)).attr("x2", x(one.value)).attr("y1", margin.top).attr("y2", height - margin.bottom);
    grid.append("text").attr("x", x(one.value)).attr("y", height - margin.bottom + 16).attr("text-anchor", "middle").text(one.text);
  }
  grid.append("text").attr("class", "title").attr("x", (margin.left + width - margin.right) / 2).attr("y", height - 6)
    .attr("text-anchor", "middle").text(panel.xTitle);
}

const overlap = (a, b) => a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h;

// Names at points: beside, above or below, where no other name is; else left out.
function placeLabels(svg, wanted, width, height) {
  const placed = [];
  const layer = svg.append("g").attr("class", "labels").attr("aria-hidden", "true");
  for (const label of wanted) {
    const w = label.text.length * 6.1 + 4, h = 14;
    const spots = [[8, -4], [8, -14], [8, 6], [-w - 6, -4], [-w / 2, -20], [-w / 2, 10], [-w - 6, -16], [-w - 6, 8]]
      .map(([dx, dy]) => ({x: label.px + dx, y: label.py + dy - 4, w, h}))
      .filter(box => box.x > margin.left && box.x + w < width - 2 && box.y > 2 && box.y + h < height - margin.bottom)
      .filter(box => !placed.some(other => overlap(box, other)));
    if (spots.length === 0) continue;
    placed.push(spots[0]);
    layer.append("text").attr("x", spots[0].x).attr("y", spots[0].y + 11).attr("class", label.kind).attr("data-kernel", label.kernel)
      .text(label.text);
    if (placed.length >= 9) break;
  }
}

/// panel: {id, order, label, xTitle, xTicks, yDomain: values, linear, series, lines, describe(point), pinned: Set}; acts: {pin(kernel),
/// point(kernel)}, the latter with "" where no kernel is pointed at any more.
/// series: {kernel, place: of its style, dim, second: whether of the second file, points: [{x, y, band, front, key}]}; lines: {text, kind, points}.
export function drawPanel(node, panel, acts) {
  const width = Math.max(240, Math.floor(node.getBoundingClientRect().width)), height = panelHeight;
  const all = panel.series.flatMap(series => series.points);
  panel.zero = panel.yValues.some(value => value === 0);
  const bottom = height - margin.bottom - (panel.zero && !panel.linear ? 16 : 0);
  const x = scaleOf(all.flatMap(point => point.band ? [point.x, ...point.band] : [point.x]).concat((panel.xTicks || []).map(t => t.value)),
                    [margin.left + 6, width - margin.right], panel.linear);
  const y = scaleOf(panel.yValues, [bottom, margin.top], panel.linear);
  y.zero = height - margin.bottom - 4;
  const px = point => x(point.x), py = point => point.y === 0 && !panel.linear ? y.zero : y(point.y);

  const svg = d3.select(node).append("svg").attr("class", "panel").attr("width", width).attr("height", height)
    .attr("viewBox", `0 0 ${width} ${height}`).attr("tabindex", 0).attr("role", "application").attr("aria-roledescription", "chart")
    .attr("data-order", panel.order).attr("data-axis", panel.id)
    .attr("aria-label", panel.label + ` ${new Set(panel.series.map(s => s.kernel)).size} kernels. Arrow keys: left and right along a kernel, up and down between kernels of the same length; Enter keeps a kernel lit.`);
  drawAxes(svg, panel, x, y, width, height);

  const line = d3.line().x(px).y(py);
  const drawn = [...panel.series].sort((a, b) => d3.descending(a.dim, b.dim));
  for (const series of drawn) {
    const points = series.points.filter(point => point.x > 0 || panel.linear);
    series.drawn = points;
    const style = styleOf(series.place);
    if (points.length === 0) continue;
    const group = svg.append("g").attr("data-kernel", series.kernel)
      .attr("class", `kernel ${style.colour}${series.dim ? " dim" : ""}${series.second ? " second" : ""}${panel.pinned.has(series.kernel) ? " pinned" : ""}`);
    const bands = points.filter(point => point.band);
    if (bands.length > 0) {
      group.append("path").attr("class", "band")
        .attr("d", bands.map(point => `M${x(point.band[0])},${py(point) - 3}v6m0,-3H${x(point.band[1])}m0,-3v6`).join(""));
    }
    group.append("path").attr("class", "line").attr("d", line(points));
    group.append("path").attr("class", "marks").attr("d", marksPath(points.map(point => [px(point), py(point)]), style.shape, series.dim ? 16 : 34));
  }
  for (const one of panel.lines) {
    const points = one.points.filter(point => point.y > 0);
    if (points.length === 0) continue;
    svg.append("path").attr("class", "reference " + one.kind).attr("d", line(points)).append("title").text(one.text);
  }
  for (const second of [false, true]) {
    const front = all.filter(point => point.front && point.second === second && point.x > 0).sort((a, b) => a.x - b.x);
    if (front.length > 1) {
      svg.append("path").attr("class", "front" + (second ? " second" : "")).attr("d", d3.line().x(px).y(py).curve(d3.curveStepAfter)(front));
    }
    const ring = d3.path();
    for (const point of front) {
      ring.moveTo(px(point) + 6, py(point));
      ring.arc(px(point), py(point), 6, 0, 2 * Math.PI);
    }
    svg.append("path").attr("class", "front ring" + (second ? " second" : "")).attr("d", ring.toString());
  }

  const labels = [];
  const seen = new Set();
  for (const series of drawn.filter(s => panel.pinned.has(s.kernel) && !s.second && s.drawn.length > 0)) {
    const last = series.drawn[series.drawn.length - 1];
    labels.push({kernel: series.kernel, text: series.kernel, px: px(last), py: py(last), kind: "name pinned"});
    seen.add(series.kernel);
  }
  for (const one of panel.lines) {
    const point = one.points.filter(point => point.y > 0).pop();
    if (point) labels.push({text: one.text, px: px(point), py: py(point), kind: "name reference", kernel: ""});
  }
  // Of the front the most accurate point of each kernel, these first: the crowd is at the other end.
  const best = drawn.filter(series => !series.second && !seen.has(series.kernel))
    .map(series => series.drawn.filter(point => point.front).sort((a, b) => a.y - b.y)[0]).filter(Boolean);
  for (const point of best.sort((a, b) => a.y - b.y)) {
    labels.push({kernel: point.kernel, text: point.kernel, px: px(point), py: py(point), kind: "name"});
  }
  placeLabels(svg, labels, width, height);

  const ring = svg.append("circle").attr("class", "focus").attr("r", 9).attr("visibility", "hidden");
  const points = drawn.flatMap(series => series.drawn.map((point, index) => ({point, series, index})));
  let current = null;
  const select = found => {
    current = found;
    ring.attr("visibility", "visible").attr("cx", px(found.point)).attr("cy", py(found.point));
    const box = svg.node().getBoundingClientRect();
    showTip(panel.describe(found.point), box.left + px(found.point), box.top + py(found.point));
    acts.point(found.series.kernel);
  };
  const leave = () => {
    ring.attr("visibility", "hidden");
    hideTip();
    acts.point("");
  };
  const nearest = event => {
    const box = svg.node().getBoundingClientRect();
    const [mx, my] = [event.clientX - box.left, event.clientY - box.top];
    const distance = found => Math.hypot(px(found.point) - mx, py(found.point) - my) + (found.series.dim ? 4 : 0);
    const best = points[d3.scan(points, (a, b) => distance(a) - distance(b))];
    return best && distance(best) < 32 ? best : null;
  };
  svg.on("pointermove", () => {
    const found = nearest(d3.event);
    if (found) select(found); else leave();
  }).on("pointerleave", leave).on("blur", leave).on("click", () => {
    const found = nearest(d3.event);
    if (found) acts.pin(found.series.kernel);
  }).on("focus", () => {
    if (svg.node().matches(":focus-visible") && points.length > 0) select(current || points[points.length - 1]);
  }).on("keydown", () => {
    const key = d3.event.key;
    if (points.length === 0) return;
    const found = current || points[points.length - 1];
    const along = points.filter(other => other.series === found.series);
    const across = points.filter(other => other.point.taps === found.point.taps)
      .sort((a, b) => b.point.y - a.point.y || b.point.x - a.point.x);
    const step = (list, by) => list[Math.max(0, Math.min(list.length - 1, list.indexOf(found) + by))];
    const moves = {ArrowLeft: () => step(along, -1), ArrowRight: () => step(along, 1), ArrowUp: () => step(across, -1),
                   ArrowDown: () => step(across, 1), Home: () => along[0], End: () => along[along.length - 1]};
    if (moves[key]) {
      select(moves[key]());
    } else if (key === "Enter" || key === " ") {
      acts.pin(found.series.kernel);
    } else if (key === "Escape") {
      leave();
    } else {
      return;
    }
    d3.event.preventDefault();
  });
}
