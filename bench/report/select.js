// What is shown of the files under the choices of now: plain values, which draw.js lays out. Nothing here knows the page.

import {union} from "./catalogue.js";
import {accuracyOf, atFirstSignal, bytesOf, errorOf} from "./data.js";
import {onFront} from "./front.js";
import {show, tick} from "./numbers.js";
import {listOf} from "./state.js";

// ---- What passes the filters.

export function passes(all, now, kernel) {
  const own = all.wordsOf(kernel);
  return Object.keys(all.words).every(word => !listOf(now, "no-" + word).includes(own[word])) && kernel.includes(now.find);
}

export const shownTaps = (now, taps) => !listOf(now, "no-taps").includes(taps);
export const pinned = now => new Set(listOf(now, "lit"));
/// The place by which a kernel has its colour and mark.
export const placeFor = (all, now, kernel) => all.places[now.colour].get(all.wordsOf(kernel)[now.colour]) || 0;

const shownAxes = (all, now) =>
  all.axes.filter(axis => listOf(now, "axes").includes(axis.id) && !(axis.aspect && listOf(now, "no-targets").includes(axis.aspect)));
const shownOrders = (all, now) => all.orders.filter(order => listOf(now, "orders").includes(order));
const errorShown = (all, now) => all.errors.find(error => error.id === now.error);
const capital = text => text[0].toUpperCase() + text.slice(1);
const most = values => {
  const known = values.filter(value => value !== undefined && !Number.isNaN(value));
  return known.length > 0 ? known.reduce((a, b) => b > a ? b : a) : undefined;
};

/// Whether the rows of tables pass: {kernel, order, taps, signal, aspect}.
export const shownRow = (all, now, row) =>
  (!all.measured.includes(row.kernel) ? row.kernel.includes(now.find) : passes(all, now, row.kernel)) &&
  (row.order === "" || listOf(now, "orders").includes(row.order) || row.aspect === "host") && (row.taps === "" || shownTaps(now, row.taps)) &&
  (row.signal === "" || now.signal === "worst" || row.signal === now.signal) && !listOf(now, "no-targets").includes(row.aspect);

// ---- The curves.

/// The points of one order of a file: {kernel, taps, y, signal, found: the case, file}; wrong rows are not among them.
export function pointsOf(all, now, file, order) {
  const points = [];
  for (const [kernel, byTaps] of file.cases.get(order) || []) {
    if (!passes(all, now, kernel)) continue;
    for (const found of byTaps.values()) {
      if (found.fault || !shownTaps(now, found.taps)) continue;
      const error = errorOf(found, now.error, now.signal);
      if (error) points.push({kernel, taps: found.taps, y: error.value, signal: error.signal, found, file});
    }
  }
  return points;
}

/// With the cost of an axis and what is on its front.
export function placed(points, axis) {
  const at = points.map(point => ({...point, x: axis.cost(point.found), band: axis.band && axis.band(point.found) || null}))
    .filter(point => point.x !== undefined && !Number.isNaN(point.x));
  if (axis.id === "taps") return at;
  onFront(at.map(point => ({cost: point.x, error: point.y}))).forEach((front, index) => { at[index].front = front; });
  return at;
}

function boundOf(now, file, order, taps) {
  const of = file.bounds.of && file.bounds.of[order];
  if (!of) return undefined;
  const signals = now.signal === "worst" ? Object.keys(of) : of[now.signal] ? [now.signal] : [];
  return most(signals.map(signal => of[signal][taps]));
}

// The bound is of what truncation adds.
const bounded = now => ["error_max", "error_rms", "truncation_error_max"].includes(now.error);

function referenceLines(all, now, points, order) {
  if (!bounded(now)) return [];
  const file = all.files[0];
  const lengths = [...file.lengths].filter(([taps]) => shownTaps(now, taps) && !taps.includes("+"));  // windows
  const line = (value, kind, text) =>
    ({kind, text, points: lengths.map(([taps, at]) => ({x: at, y: value(taps)})).filter(point => point.y !== undefined && point.y > 0)});
  const worst = (taps, counter) => most(points.filter(point => point.taps === taps && point.file === file).map(point => {
    const error = errorOf(point.found, counter, now.signal);
    return error && error.value;
  }));
  const lines = [line(taps => boundOf(now, file, order, taps), "bound", "truncation bound")];
  if (now.error !== "truncation_error_max") {
    lines.push(line(taps => worst(taps, "truncation_error_max"), "truncation", "truncation"));
    lines.push(line(taps => worst(taps, "discretisation_error_max"), "discretisation", "discretisation"));
  }
  return lines;
}

/// What the tip says of a point: [title, [[name, value]...]].
export function describe(all, now, point) {
  const {files} = all, found = point.found, rows = [];
  const add = (name, value, note) => {
    if (value !== undefined && value !== "" && !Number.isNaN(value)) rows.push([name, (typeof value === "number" ? show(value) : value) + (note || "")]);
  };
  const effective = accuracyOf(found, point.signal, "effective_taps");
  add("order", found.order);
  add("taps", found.taps, effective < found.at ? `, ${effective} effective` : "");
  add("signal", point.signal, now.signal === "worst" ? " (the worst)" : "");
  for (const error of all.errors) {
    const other = errorOf(found, error.id, now.signal);
    if (other) add(error.title, other.value, other.signal !== point.signal ? ` (${other.signal})` : "");
  }
  add("truncation bound", boundOf(now, point.file, found.order, found.taps));
  if (found.host) {
    add("host", found.host.real_time, " ns");
    add("host cycles", found.host.cycles_per_sample);
  }
  for (const aspect in found.m7) {
    const row = found.m7[aspect];
    add("instructions (emulated)", row.instructions_per_sample, row.worst_instructions !== undefined ? `, worst ${show(row.worst_instructions)}` : "");
    add("modelled cycles, " + aspect.slice(3), row.model_cycles_per_sample,
        row.model_cycles_low !== undefined ? ` (${show(row.model_cycles_low)} to ${show(row.model_cycles_high)})` : "");
    add("code, stack", row.code_bytes, ` B, ${show(row.stack_bytes)} B`);
  }
  add("state + coefficients", bytesOf(found), " B");
  const twin = files.length > 1 && files[point.file === files[0] ? 1 : 0].cases.get(found.order);
  const other = twin && twin.get(found.kernel) && twin.get(found.kernel).get(found.taps);
  if (other && !other.fault) {
    const error = errorOf(other, now.error, now.signal);
    const where = point.file === files[0] ? " in B" : " in A";
    if (error) add(errorShown(all, now).title + where, error.value);
    for (const axis of shownAxes(all, now).filter(axis => axis.aspect)) add(axis.title.split(",")[0] + where, axis.cost(other));
  }
  if (point.front) add("front", "no kernel shown here costs less at this error");
  return [found.kernel + (files.length > 1 ? point.file === files[0] ? " (A)" : " (B)" : ""), rows];
}

// The curves of one panel: a kernel of a file each.
function seriesOf(all, now, points, best) {
  const {files} = all, lit = pinned(now), series = [], byKernel = new Map();
  for (const point of points) {
    if (!byKernel.has(point.kernel)) byKernel.set(point.kernel, []);
    byKernel.get(point.kernel).push(point);
  }
  for (const [kernel, ofKernel] of byKernel) {
    if (now.fronts && !best.has(kernel) && !lit.has(kernel)) continue;
    for (const file of files) {
      const second = file !== files[0];
      const own = ofKernel.filter(point => point.file === file)
        .sort((a, b) => all.lengths.get(a.taps) - all.lengths.get(b.taps)).map(point => ({...point, second}));
      if (own.length > 0) series.push({kernel, place: placeFor(all, now, kernel), dim: !best.has(kernel), second, points: own});
    }
  }
  return series;
}

// One order: its panels, and the kernels on a front that ranks.
function orderShown(all, now, order, points) {
  const {files} = all, active = shownAxes(all, now), error = errorShown(all, now);
  const costs = active.filter(axis => axis.id !== "taps");
  const onAxis = new Map(active.map(axis => [axis, files.flatMap(file => placed(points.filter(point => point.file === file), axis))]));
  const fronts = new Map(costs.map(axis => [axis, new Set(onAxis.get(axis).filter(point => point.front).map(point => point.kernel))]));
  // As in the tables of `glsum bench`: what no target's time ranks is dominated, whatever its bytes.
  const ranking = costs.some(axis => axis.aspect) ? costs.filter(axis => axis.aspect) : costs;
  const anyFront = new Set(ranking.flatMap(axis => [...fronts.get(axis)]));
  const lines = referenceLines(all, now, points, order);
  const errors = points.map(point => point.y);
  const yValues = active.some(axis => axis.id === "taps") ? errors.concat(lines.flatMap(line => line.points.map(point => point.y))) : errors;
  const panels = active.filter(axis => onAxis.get(axis).length > 0).map(axis => {
    const overTaps = axis.id === "taps";
    const best = !overTaps ? fronts.get(axis) : costs.length > 0 ? anyFront : new Set(points.map(point => point.kernel));
    return {
      id: axis.id, order, caption: "against " + axis.title, label: `Order ${order}: ${error.title} against ${axis.title}.`, xTitle: axis.unit,
      xTicks: overTaps ? [...files[0].lengths].filter(([taps]) => shownTaps(now, taps)).map(([taps, value]) => ({value, text: taps})) : null,
      yValues, linear: now.linear === "yes", series: seriesOf(all, now, onAxis.get(axis), best), lines: overTaps ? lines : [],
      describe: point => describe(all, now, point), pinned: pinned(now)
    };
  });
  return {order, panels, front: anyFront};
}

/// {title, text, orders: [{order, panels}], kernels: [{kernel, place, front, pinned}], key}.
export function curvesOf(all, now) {
  const {files} = all, error = errorShown(all, now), missing = files[0].bounds.missing;
  const orders = shownOrders(all, now).map(order => [order, files.flatMap(file => pointsOf(all, now, file, order))])
    .filter(([, points]) => points.length > 0).map(([order, points]) => orderShown(all, now, order, points));
  const fronts = new Set(orders.flatMap(one => [...one.front]));
  const shown = all.measured.filter(kernel => passes(all, now, kernel));
  const place = kernel => all.words[now.colour].indexOf(all.wordsOf(kernel)[now.colour]);
  return {
    title: error ? capital(error.title) + " of the sum" : "No accuracy in this file",
    text: error ? `${capital(error.text)}, relative to the largest exact sum` +
      (now.signal === "worst" ? "; the worst of the signals" : `; signal ${now.signal}`) +
      `. ${shown.length} of ${all.measured.length} kernels; those on no front are dimmed.` +
      (missing && bounded(now) ? ` No truncation bound: ${missing}.` : "") : "",
    orders,
    kernels: [...shown].sort((a, b) => place(a) - place(b))
      .map(kernel => ({kernel, place: placeFor(all, now, kernel), front: fronts.has(kernel), pinned: pinned(now).has(kernel)})),
    key: {
      words: all.words[now.colour].filter(name => !listOf(now, "no-" + now.colour).includes(name))
        .map(text => ({text, place: all.places[now.colour].get(text)})),
      bound: bounded(now) && !missing,
      files: files.length > 1 ? files.map((file, index) => "AB"[index] + ": " + file.name) : []
    }
  };
}

// ---- Effective taps.

/// [{order, panel}]: the formats in which coefficients end early.
export function effectiveOf(all, now) {
  const file = all.files[0], shown = [];
  const ends = [...file.lengths].filter(([taps]) => shownTaps(now, taps));
  for (const order of shownOrders(all, now)) {
    const series = [];
    for (const [kernel, byTaps] of file.cases.get(order) || []) {
      if (!passes(all, now, kernel) || !all.wordsOf(kernel).fixed) continue;
      const points = [...byTaps.values()]
        .filter(found => !found.fault && shownTaps(now, found.taps) && atFirstSignal(found, "effective_taps") !== undefined)
        .map(found => ({kernel, taps: found.taps, x: found.at, y: atFirstSignal(found, "effective_taps"), second: false}))
        .sort((a, b) => a.x - b.x);
      if (points.length > 0) series.push({kernel, place: placeFor(all, now, kernel), dim: false, second: false, points});
    }
    if (series.length === 0) continue;
    shown.push({
      id: "effective", order, caption: "order " + order, label: `Order ${order}: effective taps against memory length.`, xTitle: "taps",
      xTicks: ends.map(([taps, value]) => ({value, text: taps})),
      yValues: [...series.flatMap(one => one.points.map(point => point.y)), ...ends.map(([, at]) => at)], yText: tick,
      linear: now.linear === "yes", series,
      lines: [{kind: "truncation", text: "every tap", points: ends.map(([, at]) => ({x: at, y: at}))}],
      describe: point => [point.kernel, [["order", order], ["taps", point.taps], ["effective taps", show(point.y)]]], pinned: pinned(now)
    });
  }
  return shown;
}

// ---- Stalls.

const causeName = (all, cause) => cause === "" ? "issuing" : cause.slice(all.counters.stall.length).replace(/_/g, " ");

/// {cases: [{id, text}], causes: [{cause, text}], bars: [{kernel, total, length, parts: [{cause, place, value}], tip}]}; "" is issuing, of
/// place -1.
export function stallsShown(all, now) {
  const cases = [...new Map(all.stalls.map(one => [one.id, `order ${one.order}, ${one.taps} taps, ${one.aspect.slice(3)}`]))].map(([id, text]) => ({id, text}));
  const rows = all.stalls.filter(one => one.id === now.stall && passes(all, now, one.kernel));
  const lostTo = (one, cause) => Math.max(0, one.counters[cause] || 0);
  const sums = new Map(union(all.stalls.map(one => one.causes)).map(cause => [cause, rows.reduce((sum, one) => sum + (one.counters[cause] || 0), 0)]));
  const causes = [...sums.keys()].filter(cause => sums.get(cause) > 0).sort((a, b) => sums.get(b) - sums.get(a));
  const bars = rows.map(one => {
    const lost = causes.reduce((sum, cause) => sum + lostTo(one, cause), 0);
    const total = one.counters.model_cycles_per_sample;
    const left = total === undefined ? 0 : Math.max(0, total - lost);
    const length = left + lost;
    const parts = [{cause: "", place: -1, value: left}, ...causes.map((cause, place) => ({cause, place, value: lostTo(one, cause)}))].filter(part => part.value > 0);
    const told = total === undefined ? lost : total;
    return {kernel: one.kernel, total: told, length, parts, tip: [one.kernel, [["modelled cycles", show(told)],
      ...parts.map(part => [causeName(all, part.cause), `${show(part.value)} (${(100 * part.value / length).toFixed(0)} %)`])]]};
  }).sort((a, b) => a.length - b.length);
  return {cases, causes: ["", ...causes].map((cause, index) => ({cause, place: index - 1, text: causeName(all, cause)})), bars};
}
