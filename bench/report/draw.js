// The page's drawings, of what select.js gives. acts: {pin(kernel), point(kernel)}, what a reader does with a kernel.

import {colourCount, drawSample, styleOf} from "./marks.js";
import {show, tick} from "./numbers.js";
import {drawPanel} from "./panel.js";
import {hideTip, showTip} from "./tip.js";

const byId = id => document.getElementById(id);

function cleared(id) {
  const node = d3.select("#" + id);
  node.selectAll("*").remove();
  return node;
}

// As many columns as fit, and no panel alone in the last row where that can be helped.
function even(row, count, least = 1) {
  const fit = Math.max(1, Math.floor((row.node().getBoundingClientRect().width + 16) / 336));
  const rows = Math.ceil(count / fit);
  row.style("grid-template-columns", `repeat(${Math.max(Math.min(least, fit), Math.ceil(count / rows))}, minmax(0, 1fr))`);
}

function drawFigure(row, panel) {
  const figure = row.append("figure");
  figure.append("figcaption").text(panel.caption);
  return figure.node();
}

export function drawCurves(curves, acts) {
  byId("curves-title").textContent = curves.title;
  const root = cleared("panels");
  for (const {order, panels} of curves.orders) {
    const block = root.append("div").attr("class", "order");
    block.append("h3").text("order " + order);
    const row = block.append("div").attr("class", "row");
    const figures = panels.map(panel => drawFigure(row, panel));
    even(row, figures.length);
    panels.forEach((panel, index) => drawPanel(figures[index], panel, acts));
  }
  byId("curves-text").textContent = curves.text;
  drawKey(curves.key);
  drawKernels(curves.kernels, acts);
}

function drawKey(key) {
  const root = cleared("key");
  const add = text => { const item = root.append("span"); const svg = item.append("svg"); item.append("span").text(text); return svg; };
  const sample = (kind, text, height, d) => add(text).attr("width", 30).attr("height", height).attr("aria-hidden", "true")
    .append("path").attr("class", kind).attr("d", d);
  for (const word of key.words) drawSample(add(word.text), styleOf(word.place), false);
  sample("front", "Pareto front", 14, "M1,3H15V11H29");
  if (key.bound) {
    sample("reference bound", "truncation bound: absolute sum of the dropped coefficients × peak of the record ÷ its largest exact sum", 12, "M1,6H29");
  }
  key.files.forEach((text, index) => drawSample(add(text), styleOf(0), index > 0));
}

function drawKernels(kernels, acts) {
  const focused = document.activeElement && document.activeElement.dataset ? document.activeElement.dataset.kernel : undefined;
  const root = cleared("kernels");
  for (const {kernel, place, front, pinned} of kernels) {
    const button = root.append("button").attr("type", "button").attr("data-kernel", kernel).attr("aria-pressed", String(pinned))
      .attr("class", front ? null : "dominated").attr("title", front ? "on a front" : "dominated")
      .on("click", () => acts.pin(kernel))
      .on("mouseenter", () => acts.point(kernel)).on("mouseleave", () => acts.point(""))
      .on("focus", () => acts.point(kernel)).on("blur", () => acts.point(""));
    drawSample(button.append("svg"), styleOf(place), false);
    button.append("span").text(kernel);
    if (kernel === focused) button.node().focus();
  }
  if (kernels.length === 0) root.append("p").text("No kernel passes the filters.");
}

/// One kernel in front of the others, in every panel and in the list; "" is none.
export function light(kernel, before) {
  const each = (name, on) => {
    const own = `[data-kernel="${CSS.escape(name)}"]`;
    for (const node of document.querySelectorAll(`svg.panel g.kernel${own}, #kernels button${own}`)) node.classList.toggle("lit", on);
  };
  if (before !== "") each(before, false);
  if (kernel !== "") each(kernel, true);
  byId("layout").classList.toggle("has-lit", kernel !== "");
}

/// The answer to the question on top, but for its table.
export function drawAnswer(answer, acts) {
  byId("answer").hidden = answer === null;
  if (answer === null) return;
  byId("answer-text").textContent = answer.text;
  drawPanel(drawFigure(cleared("answer-panel"), answer.panel), answer.panel, acts);
}

export function drawEffective(panels, acts) {
  const root = cleared("effective-panels");
  byId("effective").hidden = panels.length === 0;
  const row = root.append("div").attr("class", "row");
  even(row, panels.length, 2);
  for (const panel of panels) drawPanel(drawFigure(row, panel), panel, acts);
}

// ---- Stalls: a bar for each kernel.

const rowHeight = 22;
const barClass = place => place < 0 ? "bar issue" : `bar c${place % colourCount}${place >= colourCount ? " hatched" : ""}`;

function drawBar(svg, bar, top, x, width, nameWidth) {
  const [title, rows] = bar.tip;
  const group = svg.append("g").attr("class", "stack").attr("tabindex", 0).attr("role", "listitem").attr("data-kernel", bar.kernel)
    .attr("aria-label", title + ": " + rows.map(([name, value]) => name + " " + value).join(", "));
  const tell = () => { const box = group.node().getBoundingClientRect(); showTip(bar.tip, box.left + box.width / 2, box.top + rowHeight); };
  group.on("mouseenter", tell).on("focus", tell).on("mouseleave", hideTip).on("blur", hideTip);
  group.append("rect").attr("class", "back").attr("x", 0).attr("y", top).attr("width", width).attr("height", rowHeight);
  group.append("text").attr("x", nameWidth).attr("y", top + 15).attr("text-anchor", "end").text(bar.kernel);
  let at = 0;
  for (const part of bar.parts) {
    const from = x(at), to = x(at += part.value);
    group.append("rect").attr("class", barClass(part.place)).attr("data-cause", part.cause).attr("x", from).attr("y", top + 3)
      .attr("width", Math.max(0.5, to - from - 1)).attr("height", rowHeight - 6);
  }
  group.append("text").attr("x", x(at) + 4).attr("y", top + 15).text(show(bar.total));
}

export function drawStalls(stalls) {
  byId("stalls").hidden = stalls.cases.length === 0;
  if (stalls.cases.length === 0) return;
  const key = cleared("stall-key");
  for (const {place, text} of stalls.causes) {
    const item = key.append("span");
    item.append("svg").attr("width", 16).attr("height", 12).attr("aria-hidden", "true").append("rect").attr("width", 16).attr("height", 12)
      .attr("class", barClass(place));
    item.append("span").text(text);
  }
  const {bars} = stalls, root = cleared("stall-bars");
  const width = Math.max(300, Math.floor(root.node().getBoundingClientRect().width)), nameWidth = Math.min(190, width * 0.42);
  const x = d3.scaleLinear().domain([0, d3.max(bars, bar => bar.length) || 1]).range([nameWidth + 6, width - 64]);
  const svg = root.append("svg").attr("class", "stalls").attr("width", width).attr("height", bars.length * rowHeight + 30)
    .attr("role", "list").attr("aria-label", "Modelled cycles per sample by cause, one bar a kernel");
  for (const value of x.ticks(5)) {
    svg.append("line").attr("class", "grid").attr("x1", x(value)).attr("x2", x(value)).attr("y1", 0).attr("y2", bars.length * rowHeight + 4);
    svg.append("text").attr("x", x(value)).attr("y", bars.length * rowHeight + 18).attr("text-anchor", "middle").text(tick(value));
  }
  bars.forEach((bar, index) => drawBar(svg, bar, index * rowHeight, x, width, nameWidth));
}
