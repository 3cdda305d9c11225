// The page's state and what it selects, on small files of its own.
import assert from "node:assert/strict";
import {createRequire} from "node:module";

globalThis.d3 = createRequire(import.meta.url)("/usr/share/nodejs/d3/dist/d3.min.js");
const {answerOf, decidingCost, limits} = await import("./answer.js");
const {coresOf} = await import("./cores.js");
const {catalogueOf} = await import("./catalogue.js");
const {changesOf} = await import("./changes.js");
const {choicesOf, tablesOf} = await import("./choices.js");
const {comparisonOf, conditionsOf, differenceShown, faultsOf, rowsShown} = await import("./rows.js");
const {curvesOf, effectiveOf, passes, placed, pointsOf, stallsShown} = await import("./select.js");
const {listOf, makeState} = await import("./state.js");

const column = values => ({values: [...new Set(values)], at: btoa(String.fromCharCode(...values.map(value => [...new Set(values)].indexOf(value)))), bits: 8});
const table = (aspect, texts, numbers, rows) => ({
  aspect, rows: rows.length, texts: Object.fromEntries(texts.map((name, i) => [name, column(rows.map(row => row[i]))])),
  numbers: Object.fromEntries(numbers.map((name, i) => [name, column(rows.map(row => row[texts.length + i]))]))
});
const keys = ["kernel", "order", "taps", "signal", "fault"];
const file = (name, rows, core, context = {n_samples: 1000}) => ({name, context, bounds: {of: {"0.5": {step: {"600": 0.25}, noise: {"600": 0.5}}}}, tables: [
  table("accuracy", keys, ["error_max", "rounding_error_max", "truncation_error_max", "effective_taps", "state_bytes", "coefficient_bytes"], rows),
  table("m7:pretend", ["kernel", "order", "taps", "fault"], ["model_cycles_per_sample", "stall_load_use", "stall_fpu_latency"], core)
]});
const a = file("a.json", [
  ["ring_plain_f32", "0.5", "600", "step", "", 0.01, 1e-6, 0.01, 600, 40, 10],
  ["ring_plain_f32", "0.5", "600", "noise", "", 0.02, 1e-6, 0.02, 600, 40, 10],
  ["ring_plain_f32", "0.5", "20", "step", "", 0.1, 1e-6, 0.1, 20, 20, 10],
  ["ring_plain_q15", "0.5", "600", "step", "", 0.03, 1e-3, 0.01, 90, 30, 10],
  ["ring_plain_q15", "0.7", "600", "step", "overflows", 0.5, 1e-3, 0.01, 90, 30, 10],
  ["ring_plain_f32", "0.7", "600", "step", "", 0.02, 1e-6, 0.02, 600, 40, 10]
], [
  ["ring_plain_f32", "0.5", "600", "", 1000, 100, 300], ["ring_plain_f32", "0.5", "20", "", 50, 5, 0],
  ["ring_plain_q15", "0.5", "600", "", 2000, 0, 50], ["ring_plain_q15", "0.7", "600", "", 2000, 0, 50],
  ["ring_plain_f32", "0.7", "600", "hangs", 1000, 100, 300]
]);
const b = file("b.json", [["ring_plain_f32", "0.5", "600", "step", "", 0.02, 1e-6, 0.01, 600, 40, 10]],
  [["ring_plain_f32", "0.5", "600", "", 1000, 100, 300]], {n_samples: 2000});
const counter = (name, more) => ({name, family: false, is_time: false, unit: "", better: "lower", layer: "accuracy", compared: true, drawn: false, title: "", meaning: "", ...more});
const drawn = (name, title) => counter(name, {drawn: true, title, meaning: title + " means"});
const counters = [
  drawn("error_max", "total error"), drawn("rounding_error_max", "rounding error"), drawn("truncation_error_max", "truncation error"),
  counter("effective_taps", {better: "higher"}), counter("state_bytes"), counter("coefficient_bytes"), counter("model_cycles_per_sample"),
  counter("real_time", {is_time: true, unit: "ns", layer: "host_time"}), counter("stall_", {family: true, compared: false})
];
// As the catalogue says it, which no name need show.
const kernels = {
  ring_plain_f32: {history: "ring", technique: "plain", format: "f32", fixed: false},
  ring_plain_q15: {history: "ring", technique: "plain", format: "q15", fixed: true},
  mirror_odd: {history: "mirror", technique: "odd", format: "q31", fixed: true}
};
const page = data => { const all = catalogueOf({version: "1", d3: "5", counters, kernels, ...data}); return {all, state: makeState(choicesOf(all))}; };

const tests = {
  theStateChangesInOneWay() {
    const {state} = page({files: [a]});
    const told = [];
    state.listen((changed, now, before) => told.push([changed, now, before]));
    const first = state.now;
    assert.equal(first.error, "error_max");
    assert.throws(() => { first.error = "rounding_error_max"; }, TypeError);
    state.change({error: "rounding_error_max"});
    assert.deepEqual(told.map(one => one[0]), [["error"]]);
    assert.equal(told[0][1], state.now);
    assert.equal(told[0][2], first);
    state.change({error: "rounding_error_max"});
    assert.equal(told.length, 1, "nothing is new");
    state.change({error: "of another page"});
    assert.equal(state.now.error, "error_max");
  },
  aListedChoiceIsFlipped() {
    const {state} = page({files: [a]});
    state.flip("lit", "x");
    state.flip("lit", "y");
    assert.deepEqual(listOf(state.now, "lit"), ["x", "y"]);
    state.flip("lit", "x");
    assert.deepEqual(listOf(state.now, "lit"), ["y"]);
    state.flip("lit", "y");
    assert.deepEqual(listOf(state.now, "lit"), []);
  },
  theAddressSaysWhatIsNotAsAtFirst() {
    const {all, state} = page({files: [a]});
    assert.equal(state.address, "");
    state.change({find: "q15 &", linear: "yes", under: "ring_plain_f32"});
    assert.equal(state.address, "find=q15+%26&linear=yes");
    const other = makeState(choicesOf(all));
    other.read(state.address + "&under=x&toString=y");
    assert.deepEqual(other.now, {...state.now, under: ""});
    other.read("");
    assert.equal(other.now.find, "");
  },
  aResetKeepsTheScheme() {
    const {state} = page({files: [a]});
    state.change({theme: "dark", find: "x"});
    state.reset("theme");
    assert.equal(state.address, "theme=dark");
  },
  noKernelIsPointedAtAfterAChoice() {
    const {state} = page({files: [a]});
    state.change({under: "ring_plain_f32"});
    assert.equal(state.now.under, "ring_plain_f32");
    state.change({find: "x"});
    assert.equal(state.now.under, "");
  },
  aHiddenTableIsNotChosen() {
    const {all, state} = page({files: [a]});
    assert.equal(state.now.rows, "accuracy");
    state.flip("no-targets", "accuracy");
    assert.equal(state.now.rows, "m7:pretend");
    assert.equal(state.address, "no-targets=accuracy", "the first that is shown needs no word");
    assert.deepEqual(tablesOf(all, state.now).map(one => one.id), ["m7:pretend"]);
  },
  filtersAreByWordAndPartOfAName() {
    const {all, state} = page({files: [a]});
    assert.ok(passes(all, state.now, "ring_plain_q15"));
    assert.ok(!passes(all, {...state.now, find: "f32"}, "ring_plain_q15"));
    assert.ok(!passes(all, {...state.now, "no-format": "f32,q15"}, "ring_plain_q15"));
    assert.ok(!passes(all, {...state.now, "no-history": "ring"}, "ring_plain_q15"));
  },
  wordsAreTheCatalogues() {
    const {all, state} = page({files: [a]});
    assert.ok(!passes(all, {...state.now, "no-format": "q31"}, "mirror_odd"));
    assert.ok(!passes(all, {...state.now, "no-technique": "odd"}, "mirror_odd"));
    assert.ok(passes(all, {...state.now, "no-format": "q15", "no-history": "ring"}, "ring_other_q15"), "no part of a name says anything");
    assert.ok(!passes(all, {...state.now, "no-format": "unknown"}, "ring_other_q15"));
    assert.equal(all.wordsOf("ring_other_q15").fixed, false);
    assert.equal(all.wordsOf("toString").format, "unknown");
  },
  pointsAreTheWorstSignalAndNothingWrong() {
    const {all, state} = page({files: [a]});
    const told = order => pointsOf(all, state.now, all.files[0], order).map(point => [point.kernel, point.taps, point.y, point.signal]);
    assert.deepEqual(told("0.5"), [["ring_plain_f32", "600", 0.02, "noise"], ["ring_plain_f32", "20", 0.1, "step"], ["ring_plain_q15", "600", 0.03, "step"]]);
    assert.deepEqual(told("0.7"), []);
    assert.deepEqual(pointsOf(all, {...state.now, signal: "step", "no-taps": "20"}, all.files[0], "0.5").map(point => point.y), [0.01, 0.03]);
  },
  theFrontCostsLessOrErrsLess() {
    const {all, state} = page({files: [a]});
    const at = id => placed(pointsOf(all, state.now, all.files[0], "0.5"), all.axes.find(axis => axis.id === id));
    assert.deepEqual(at("cycles-m7:pretend").map(point => [point.x, point.front]), [[1000, true], [50, true], [2000, false]]);
    assert.deepEqual(at("bytes").map(point => [point.x, point.front]), [[50, true], [30, true], [40, true]]);
    assert.deepEqual(at("taps").map(point => [point.x, point.front]), [[600, undefined], [20, undefined], [600, undefined]]);
  },
  curvesDimWhatNoTimeRanks() {
    const {all, state} = page({files: [a]});
    const curves = curvesOf(all, state.now);
    assert.equal(curves.title, "Total error of the sum");
    assert.deepEqual(curves.orders.map(one => one.order), ["0.5"]);
    assert.deepEqual(curves.orders[0].panels.map(panel => panel.id), ["taps", "cycles-m7:pretend", "bytes"]);
    const dim = index => curves.orders[0].panels[index].series.map(series => [series.kernel, series.dim]);
    assert.deepEqual(dim(0), [["ring_plain_f32", false], ["ring_plain_q15", true]]);
    assert.deepEqual(dim(2), [["ring_plain_f32", false], ["ring_plain_q15", false]], "its bytes are on that front");
    assert.deepEqual(curves.kernels.map(one => [one.kernel, one.front]), [["ring_plain_f32", true], ["ring_plain_q15", false]]);
    assert.deepEqual(curves.orders[0].panels[0].lines.map(line => line.kind), ["bound", "truncation", "discretisation"]);
    assert.deepEqual(curves.orders[0].panels[0].lines[0].points, [{x: 600, y: 0.5}], "the worst of the signals");
    const fronts = curvesOf(all, {...state.now, fronts: "yes", lit: ""}).orders[0].panels[1].series;
    assert.deepEqual(fronts.map(series => series.kernel), ["ring_plain_f32"]);
  },
  aPointIsTold() {
    const {all, state} = page({files: [a, b]});
    const panel = curvesOf(all, state.now).orders[0].panels[1];
    const [title, rows] = panel.describe(panel.series[0].points[1]);
    assert.equal(title, "ring_plain_f32 (A)");
    const told = Object.fromEntries(rows);
    assert.equal(told.signal, "noise (the worst)");
    assert.equal(told["truncation bound"], "0.5");
    assert.equal(told["modelled cycles, pretend"], "1,000");
    assert.equal(told["total error in B"], "0.02");
    assert.equal(told["state + coefficients"], "50 B");
  },
  effectiveTapsAreOfFixedPoint() {
    const {all, state} = page({files: [a]});
    const panels = effectiveOf(all, state.now);
    assert.deepEqual(panels.map(panel => [panel.order, panel.series.map(series => series.kernel)]), [["0.5", ["ring_plain_q15"]]]);
    assert.deepEqual(panels[0].series[0].points.map(point => [point.x, point.y]), [[600, 90]]);
  },
  stallsAreOfOneCaseAndSumUp() {
    const {all, state} = page({files: [a]});
    assert.equal(state.now.stall, "0.5|600|m7:pretend");
    const stalls = stallsShown(all, state.now);
    assert.deepEqual(stalls.cases.map(one => one.text), ["order 0.5, 600 taps, pretend", "order 0.5, 20 taps, pretend"], "of what went wrong none");
    assert.deepEqual(stalls.causes.map(one => one.text), ["issuing", "fpu latency", "load use"]);
    assert.deepEqual(stalls.bars.map(bar => [bar.kernel, bar.parts.map(part => part.value)]), [["ring_plain_f32", [600, 300, 100]], ["ring_plain_q15", [1950, 50]]]);
    assert.deepEqual(stalls.bars[0].tip[1][1], ["issuing", "600 (60 %)"]);
    const short = stallsShown(all, {...state.now, stall: "0.5|20|m7:pretend"});
    assert.deepEqual(short.causes.map(one => one.cause), ["", "stall_load_use"], "a cause that lost nothing has no colour");
  },
  tablesHoldWhatPasses() {
    const {all, state} = page({files: [a]});
    assert.equal(rowsShown(all, state.now).rows.length, 6);
    const shown = rowsShown(all, {...state.now, find: "q15", orders: "0.5"});
    assert.equal(shown.text, "1 of 6 rows of accuracy pass the filters.");
    assert.equal(shown.columns.find(one => one.title === "error_max").text(shown.rows[0]), "0.03");
    const {rows} = faultsOf(all);
    assert.deepEqual(rows.map(row => [row.kernel, row.order, row.fault]), [["ring_plain_q15", "0.7", "overflows"], ["ring_plain_f32", "0.7", "hangs"]]);
  },
  theAnswerIsTheCheapestWithinTheLimit() {
    const modes = [["modes_plain_f32", "0.5", "2+7", "step", "", 0.004, 1e-6, 0.004, 9, 50, 10], ["modes_plain_f32", "0.5", "1+9", "step", "", 0.004, 1e-6, 0.004, 9, 50, 10]];
    const cost = [["modes_plain_f32", "0.5", "2+7", "", 100, 0, 0], ["modes_plain_f32", "0.5", "1+9", "", 120, 0, 0]];
    const withModes = {name: "c.json", context: a.context, bounds: a.bounds, tables: [
      table("accuracy", keys, ["error_max", "rounding_error_max", "truncation_error_max", "effective_taps", "state_bytes", "coefficient_bytes"],
            [["ring_plain_f32", "0.5", "600", "step", "", 0.01, 1e-6, 0.01, 600, 40, 10], ["ring_plain_f32", "0.5", "20", "step", "", 0.1, 1e-6, 0.1, 20, 20, 10],
             ["ring_plain_q15", "0.5", "600", "step", "overflows", 0.001, 1e-3, 0.01, 90, 30, 10], ...modes]),
      table("m7:pretend", ["kernel", "order", "taps", "fault"], ["model_cycles_per_sample", "stall_load_use", "stall_fpu_latency"],
            [["ring_plain_f32", "0.5", "600", "", 1000, 100, 300], ["ring_plain_f32", "0.5", "20", "", 50, 5, 0], ["ring_plain_q15", "0.5", "600", "", 2, 0, 0], ...cost])
    ]};
    const {all, state} = page({files: [withModes]});
    assert.equal(state.now["ask-target"], "cycles-m7:pretend");
    assert.equal(decidingCost({axes: [{id: "taps"}, {id: "bytes"}, {id: "host"}]}).id, "host");
    const answer = answerOf(all, state.now);
    assert.equal(answer.text, "Within 1e-2 (1 %) at order 0.5 the cheapest is modes_plain_f32 of 2+7 taps: 100 model cycles per sample, error 0.004. " +
      "The cheapest window, ring_plain_f32 of 600 taps, takes 10 times as much.");
    assert.deepEqual(answer.rows.map(row => [row.kernel, row.taps, row.mark]), [["ring_plain_f32", "20", ""], ["modes_plain_f32", "2+7", "chosen"]]);
    assert.deepEqual(answer.columns.map(one => one.text(answer.rows[1])), ["modes_plain_f32", "2+7", "0.004", "100", "60"]);
    assert.deepEqual(answer.panel.series.map(one => [one.kernel, one.dim]), [["ring_plain_f32", false], ["modes_plain_f32", false]]);
    assert.deepEqual(answer.panel.lines[0].points.map(point => point.y), [0.01, 0.01]);
    assert.deepEqual([...answer.panel.pinned], ["modes_plain_f32"]);
    const asked = choice => answerOf(all, {...state.now, ...choice}).text;
    assert.match(asked({"ask-error": "1e-1"}), /ring_plain_f32 of 20 taps: 50 .* It is a window\.$/);
    assert.match(asked({"ask-error": "1e-6"}), /^No kernel of this file errs 1e-6 \(0\.0001 %\) or less at order 0\.5\.$/);
    assert.match(asked({find: "ring", "no-format": "f32", "no-taps": "2+7", error: "rounding_error_max"}), /modes_plain_f32 of 2\+7/, "no filter changes what is cheapest");
    assert.match(asked({"ask-target": "bytes"}), /ring_plain_f32 of 600 taps: 50 bytes/);
    state.change({"ask-error": "2", "ask-order": "9", "ask-target": "taps"});
    assert.deepEqual([state.now["ask-error"], state.now["ask-order"], state.now["ask-target"]], ["1e-2", "0.5", "cycles-m7:pretend"], "what cannot be asked is not");
    assert.ok(limits.includes(state.now["ask-error"]));
    assert.equal(answerOf(all, {...state.now, "ask-order": "0.7"}), null);
  },
  bothCoresStandBesideEachOther() {
    const accuracy = table("accuracy", keys, ["error_max", "state_bytes", "coefficient_bytes"], [
      ["ring_plain_f32", "0.5", "600", "step", "", 0.004, 2000, 400], ["ring_plain_q15", "0.5", "600", "step", "", 0.003, 1000, 200]]);
    const on = (aspect, ...rows) => table(aspect, ["kernel", "order", "taps", "fault"], ["model_cycles_per_sample", "model_cycles_high", "real_time"], rows);
    const m7 = on("m7:fast", ["ring_plain_f32", "0.5", "600", "", 216, 270, 1000], ["ring_plain_q15", "0.5", "600", "", 432, 540, 2000]);
    const m4 = on("m4:slow", ["ring_plain_f32", "0.5", "600", "", 960, 1200, 40000], ["ring_plain_q15", "0.5", "600", "", 480, 600, 20000]);
    const of = tables => page({files: [{name: "d.json", context: a.context, bounds: a.bounds, tables}]});
    const {all, state} = of([accuracy, m7, m4]);
    const cores = coresOf(all, state.now);
    assert.deepEqual(cores.rows.map(row => cores.columns.map(one => one.text(row)).concat(row.mark)), [
      ["M7 fast", "ring_plain_f32", "600", "216", "270", "1", "2,400", "0.13 %", "chosen"],
      ["M4 slow", "ring_plain_f32", "600", "960", "1,200", "40", "2,400", "5 %", ""],
      ["M7 fast", "ring_plain_q15", "600", "432", "540", "2", "1,200", "0.25 %", ""],
      ["M4 slow", "ring_plain_q15", "600", "480", "600", "20", "1,200", "2.5 %", "chosen"]]);
    assert.equal(coresOf(all, {...state.now, "ask-error": "1e-6"}), null, "nothing errs so little");
    const alone = of([accuracy, m4]);
    assert.equal(coresOf(alone.all, alone.state.now), null, "a machine alone has nothing beside it");
  },
  changesAreBetterOrWorseByKernelAndCounter() {
    const row = (kernel, counter, from, to) => ({kernel, aspect: "accuracy", counter, a: from, b: to, ratio: to / from, size: Math.abs(Math.log(to / from)), note: ""});
    const {all} = page({files: [a, b]});
    const changes = changesOf(all, {equal: 3, onlyA: 1, onlyB: 0, rows: [
      row("x", "error_max", 1, 2), row("x", "error_max", 1, 1.5), row("x", "effective_taps", 100, 110), row("y", "state_bytes", 10, 9),
      row("y", "real_time", 10, 900), row("z", "of_another_program", 1, 3), {kernel: "x", counter: "", note: "only in A"}, {kernel: "x", counter: "", note: "wrong in B: nan"},
      {...row("w", "error_max", 0, 1), size: 1e6}
    ]});
    assert.equal(changes.text, "Worse: 3 values of 2 kernels. Better: 2 values of 2 kernels. Unchanged: 3 rows in every counter. Wrong in one of the two: 1 row. " +
      "Only in A: 1 row; only in B: 0 rows. Not judged: 1 host time, which two runs do not share.");
    assert.deepEqual(changes.rows.map(one => changes.columns.map(each => each.text(one))), [
      ["w", "error_max", "worse", "from 0", "1"], ["x", "error_max", "worse", "+50 % to +100 %", "2"],
      ["z", "of_another_program", "other", "+200 %", "1"], ["y", "state_bytes", "better", "−10 %", "1"],
      ["x", "effective_taps", "better", "+10 %", "1"]]);
    const same = changesOf(all, {equal: 3, onlyA: 0, onlyB: 0, rows: []});
    assert.equal(same.text, "Worse: nothing. Better: nothing. Unchanged: 3 rows in every counter.");
  },
  whatAnEncodingLeavesOpenIsNoDifference() {
    const float24 = values => ({float24: btoa(String.fromCharCode(...values.flatMap(value => [...new Uint8Array(new Float32Array([value]).buffer)].slice(1))))});
    const whole = ["ring_plain_f32", "ring_plain_q15"].map((kernel, i) => [kernel, "0.5", "600", "step", "", [0.0123456789, 0.01][i]]);
    const with24 = numbers => ({name: "short", context: {}, bounds: {}, tables: [{...table("accuracy", keys, [], whole), numbers: {error_max: float24(numbers)}}]});
    const exact = {name: "exact", context: {}, bounds: {}, tables: [table("accuracy", keys, ["error_max"], whole)]};
    const differing = other => comparisonOf(page({files: [exact, other]}).all).rows.map(row => row.kernel);
    assert.deepEqual(differing(with24([0.0123456789, 0.01])), []);
    assert.deepEqual(differing(with24([0.012347, 0.01])), ["ring_plain_f32"]);
  },
  twoFilesAreCompared() {
    const {all, state} = page({files: [a, b]});
    const compared = comparisonOf(all);
    const shown = differenceShown(all, {...state.now, counter: "error_max"}, compared);
    assert.deepEqual(shown.rows.map(row => [row.kernel, row.taps, row.signal, row.ratio]), [["ring_plain_f32", "600", "step", 2]]);
    assert.deepEqual(shown.counters, ["error_max"]);
    assert.equal(comparisonOf(page({files: [a]}).all), null);
    assert.match(conditionsOf(all).notice, /differ in n_samples:/);
    assert.equal(conditionsOf(page({files: [a]}).all).notice, "");
  }
};

for (const [name, test] of Object.entries(tests)) {
  try {
    test();
  } catch (failure) {
    console.error(`${name}: ${failure.message}`);
    process.exitCode = 1;
  }
}
