// All together: the data, the state of its choices, and what is drawn anew when that changes.

import {answerOf} from "./answer.js";
import {coresOf} from "./cores.js";
import {catalogueOf} from "./catalogue.js";
import {changesOf} from "./changes.js";
import {choicesOf} from "./choices.js";
import {drawControls, drawCounter, drawQuestion, drawStallCase, drawTabs, drawTheme} from "./controls.js";
import {drawAnswer, drawCurves, drawEffective, drawStalls, light} from "./draw.js";
import {comparisonOf, conditionsOf, differenceShown, faultsOf, rowsShown} from "./rows.js";
import {curvesOf, effectiveOf, stallsShown} from "./select.js";
import {makeState} from "./state.js";
import {drawTable} from "./tables.js";
import {hideTip} from "./tip.js";

const byId = id => document.getElementById(id);
const root = document.documentElement;
const all = catalogueOf(JSON.parse(byId("data").textContent));
const state = makeState(choicesOf(all));
const acts = {pin: kernel => state.flip("lit", kernel), point: kernel => state.change({under: kernel})};

const writeAddress = () => {
  const text = state.address;
  if (text === location.hash.slice(1)) return;
  try {
    history.replaceState(null, "", text ? "#" + text : location.pathname + location.search);
  } catch (refused) {
    location.hash = text;  // some browsers refuse the former for files
  }
};

function drawConditions() {
  const conditions = conditionsOf(all);
  for (const id of ["files", "run", "foot"]) byId(id).textContent = conditions[id];
  drawTable(byId("context-table"), "Conditions", conditions.columns, conditions.rows);
  if (conditions.notice) d3.select("#notices").append("p").attr("class", "notice").text(conditions.notice);
}

function drawFaults() {
  const {columns, rows} = faultsOf(all);
  byId("faults").hidden = rows.length === 0;
  drawTable(byId("fault-table"), "Wrong or impossible rows", columns, rows);
}

function drawFirst() {
  const answer = answerOf(all, state.now);
  drawQuestion(all, state);
  drawAnswer(answer, acts);
  if (answer) drawTable(byId("answer-table"), "The front", answer.columns, answer.rows);
  const cores = coresOf(all, state.now);
  byId("cores").hidden = !cores;
  if (!cores) return;
  byId("cores-text").textContent = cores.text;
  drawTable(byId("cores-table"), "Cores", cores.columns, cores.rows);
}

const drawOfWidth = () => {
  drawEffective(effectiveOf(all, state.now), acts);
  const stalls = stallsShown(all, state.now);
  if (stalls.cases.length > 0) drawStallCase(state, stalls.cases);
  drawStalls(stalls);
};

function drawRows() {
  const shown = rowsShown(all, state.now);
  drawTabs(state, shown.ids);
  if (!shown.chosen) return;
  byId("rows-text").textContent = shown.text;
  drawTable(byId("row-table"), "Rows of " + shown.chosen, shown.columns, shown.rows);
}

const once = make => { let made; return () => made ??= make(); };
const comparison = once(() => comparisonOf(all));

function drawDifference() {
  if (all.files.length < 2) return;
  const shown = differenceShown(all, state.now, comparison());
  byId("difference").hidden = false;
  if (!root.dataset.compared) {
    const changes = changesOf(all, comparison());
    byId("changes-text").textContent = changes.text;
    drawTable(byId("changes-table"), "What is better and worse in B", changes.columns, changes.rows);
    root.dataset.compared = "yes";
  }
  drawCounter(state, shown.counters);
  byId("difference-text").textContent = shown.text;
  drawTable(byId("difference-table"), "Differences", shown.columns, shown.rows);
}

function drawBelow() {
  drawOfWidth();
  drawRows();
  drawDifference();
}

function drawAll() {
  drawTheme(state);
  drawControls(all, state);
  hideTip();
  const focused = document.activeElement && document.activeElement.matches("svg.panel")
    ? `svg.panel[data-axis="${CSS.escape(document.activeElement.dataset.axis)}"][data-order="${CSS.escape(document.activeElement.dataset.order)}"]` : null;
  drawFirst();
  drawCurves(curvesOf(all, state.now), acts);
  // What the first screen cannot show waits until that is painted: a quarter of the time of a large file.
  if (root.dataset.drawn) drawBelow();
  else requestAnimationFrame(() => setTimeout(() => { drawBelow(); root.dataset.drawn = "all"; performance.mark("drawn"); }));
  if (focused && document.querySelector(focused)) document.querySelector(focused).focus();
}

// What a choice changes alone; whatever else changes all.
const drawnAlone = {
  under: () => {}, theme: () => drawTheme(state), rows: drawRows, "ask-order": drawFirst, "ask-error": drawFirst, "ask-target": drawFirst
};

for (const id of ["panel-controls", "panel-kernels"]) {
  byId(id).open = matchMedia("(min-width: 900px)").matches;
}
byId("changes").hidden = all.files.length < 2;
d3.selectAll("form").on("submit", () => d3.event.preventDefault());
drawConditions();
drawFaults();
state.read(location.hash.slice(1));
writeAddress();
drawAll();
state.listen((changed, now, before) => {
  if (now.under !== before.under) light(now.under, before.under);
  if (changed.every(name => name === "under")) return;
  writeAddress();
  if (changed.every(name => name in drawnAlone)) changed.forEach(name => drawnAlone[name]());
  else drawAll();
});

let drawnWidth = root.clientWidth, waiting;
addEventListener("resize", () => {
  if (root.clientWidth === drawnWidth) return;
  drawnWidth = root.clientWidth;
  clearTimeout(waiting);
  waiting = setTimeout(() => { drawFirst(); drawCurves(curvesOf(all, state.now), acts); drawOfWidth(); }, 150);
});
addEventListener("hashchange", () => { state.read(location.hash.slice(1)); writeAddress(); });
