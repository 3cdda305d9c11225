
// ---- The page: its state, its controls, what it draws.

const byId = id => document.getElementById(id);
const data = JSON.parse(byId("data").textContent);
const files = data.files.map(joinFile);
const axes = axesOf(files);
const errors = [
  {id: "error_max", title: "total error", text: "largest distance from the exact full-memory sum"},
  {id: "error_rms", title: "total error, rms", text: "root mean square distance from the exact full-memory sum"},
  {id: "rounding_error_max", title: "rounding error", text: "largest distance from the exact sum of the same length"},
  {id: "truncation_error_max", title: "truncation error", text: "largest distance of the exact sum of that length from full memory"},
  {id: "discretisation_error_max", title: "discretisation error", text: "distance of the exact full-memory sum from h^v times the exact derivative"}
].filter(error => files.some(file => file.tables.some(table => table.number[error.id])));

const union = lists => [...new Set(lists.flat())];
const signalsOf = file => union(file.tables.filter(table => table.aspect === "accuracy" && table.text.signal)
  .map(table => d3.range(table.rows).map(table.text.signal)));
const every = {
  orders: union(files.map(file => [...file.cases.keys()])),
  signals: union(files.map(signalsOf)),
  taps: union(files.map(file => [...file.lengths.keys()])),
  targets: union(files.map(file => file.tables.map(table => table.aspect))),
  kernels: union(files.map(file => file.kernels))
};
const measured = every.kernels.filter(kernel => files.some(file => [...file.cases.values()].some(byKernel =>
  byKernel.has(kernel) && [...byKernel.get(kernel).values()].some(found => Object.keys(found.signals).length > 0))));
const formats = union([["f64", "f32", "f32a64", "q31", "q15", "q15c31"], measured.map(kernel => wordsOf(kernel).format)]);
const words = {};
for (const word of ["format", "history", "technique"]) {
  const used = union([measured.map(kernel => wordsOf(kernel)[word])]);
  words[word] = word === "format" ? formats.filter(format => used.includes(format)) : used;
}
const styles = {format: new Map(formats.map((name, index) => [name, styleOf(index)]))};
for (const word of ["history", "technique"]) {
  styles[word] = new Map(words[word].map((name, index) => [name, styleOf(index)]));
}

// ---- State: what is not as at first stands in the address.

const modelled = axes.filter(axis => axis.id.startsWith("cycles-"));
const defaults = {
  error: errors.length > 0 ? errors[0].id : "", signal: "worst", colour: "format", find: "", linear: "", fronts: "", counter: "largest",
  stall: "", theme: "system", rows: "",
  orders: every.orders.slice(0, 4).join(","),
  axes: axes.filter(axis => !axis.extra && (axis.id !== "instructions" || modelled.length === 0) &&
                            (modelled.length === 0 || !axis.id.startsWith("cycles-") || axis === modelled[0])).map(axis => axis.id).join(","),
  "no-targets": "", "no-taps": "", "no-format": "", "no-history": "", "no-technique": "", lit: ""
};
let state = {...defaults};

function readAddress() {
  state = {...defaults};
  for (const [name, value] of new URLSearchParams(location.hash.slice(1))) {
    if (name in state) state[name] = value;
  }
  const known = (name, list) => { if (!list.includes(state[name])) state[name] = defaults[name]; };
  known("error", errors.map(error => error.id));
  known("signal", ["worst", ...every.signals]);
  known("colour", Object.keys(words));
  known("theme", ["system", "light", "dark"]);
}

function writeAddress() {
  const changed = new URLSearchParams(Object.entries(state).filter(([name, value]) => value !== defaults[name]));
  const text = changed.toString();
  if (text !== location.hash.slice(1)) {
    try {
      history.replaceState(null, "", text ? "#" + text : location.pathname + location.search);
    } catch (refused) {
      location.hash = text;  // some browsers refuse the former for files
    }
  }
}

const listOf = name => state[name] === "" ? [] : state[name].split(",");
const setList = (name, list) => { state[name] = list.join(","); };
function flip(name, value) {
  const list = listOf(name);
  setList(name, list.includes(value) ? list.filter(other => other !== value) : [...list, value]);
}

// ---- Controls.

function chips(id, name, values, off) {  // off: the state lists what is not shown
  const chosen = value => off ? !listOf(name).includes(value.id) : listOf(name).includes(value.id);
  const labels = d3.select("#" + id).selectAll("label").data(values, value => value.id);
  const fresh = labels.enter().append("label").attr("class", "chip");
  fresh.append("input").attr("type", "checkbox").attr("value", value => value.id)
    .on("change", value => { flip(name, value.id); update(); });
  fresh.append("span").text(value => value.text);
  fresh.merge(labels).select("input").property("checked", chosen);
}

const plain = values => values.map(value => ({id: value, text: value}));

function options(id, name, values) {
  const select = d3.select("#" + id);
  select.selectAll("option").data(values, value => value.id).enter().append("option")
    .attr("value", value => value.id).text(value => value.text);
  select.property("value", state[name]).on("change", function() { state[name] = this.value; update(); });
}

function drawControls() {
  options("error", "error", errors.map(error => ({id: error.id, text: error.title})));
  options("signal", "signal", [{id: "worst", text: "worst of the signals"}, ...plain(every.signals)]);
  chips("orders", "orders", plain(every.orders), false);
  chips("axes", "axes", axes.map(axis => ({id: axis.id, text: axis.title})), false);
  chips("targets", "no-targets", plain(every.targets), true);
  chips("taps", "no-taps", plain([...every.taps].sort((a, b) => lengthOf(a) - lengthOf(b))), true);
  for (const word in words) {
    chips("words-" + word, "no-" + word, plain(words[word]), true);
  }
  d3.select("#colour").property("value", state.colour).on("change", function() { state.colour = this.value; update(); });
  d3.select("#find").property("value", state.find).on("input", function() { state.find = this.value.trim(); update(); });
  for (const name of ["linear", "fronts"]) {
    d3.select("#" + name).property("checked", state[name] === "yes").on("change", function() { state[name] = this.checked ? "yes" : ""; update(); });
  }
  d3.select("#reset").on("click", () => { state = {...defaults, theme: state.theme}; update(); });
}

const lengthOf = taps => d3.min(files, file => file.lengths.get(taps));

// ---- What passes the filters.

function passes(kernel) {
  const own = wordsOf(kernel);
  return Object.keys(words).every(word => !listOf("no-" + word).includes(own[word])) && kernel.includes(state.find);
}
const styleFor = kernel => styles[state.colour].get(wordsOf(kernel)[state.colour]) || styleOf(0);
const shownTaps = taps => !listOf("no-taps").includes(taps);
const shownAxes = () => axes.filter(axis => listOf("axes").includes(axis.id) && !(axis.aspect && listOf("no-targets").includes(axis.aspect)));
const pins = () => new Set(listOf("lit"));

// The points of one order of a file: {kernel, taps, y, case, signal}; wrong rows are not among them.
function pointsOf(file, order) {
  const points = [];
  for (const [kernel, byTaps] of file.cases.get(order) || []) {
    if (!passes(kernel)) continue;
    for (const found of byTaps.values()) {
      if (found.fault || !shownTaps(found.taps)) continue;
      const error = errorOf(found, state.error, state.signal);
      if (error) points.push({kernel, taps: found.taps, y: error.value, signal: error.signal, found, file});
    }
  }
  return points;
}

// With the cost of an axis and what is on its front.
function placed(points, axis) {
  const at = points.map(point => ({...point, x: axis.cost(point.found), band: axis.band && axis.band(point.found) || null}))
    .filter(point => point.x !== undefined && !Number.isNaN(point.x));
  if (axis.id === "taps") return at;
  onFront(at.map(point => ({cost: point.x, error: point.y}))).forEach((front, index) => { at[index].front = front; });
  return at;
}

// ---- The panels.

function boundOf(file, order, taps) {
  const of = file.bounds.of && file.bounds.of[order];
  if (!of) return undefined;
  const signals = state.signal === "worst" ? Object.keys(of) : of[state.signal] ? [state.signal] : [];
  return d3.max(signals, signal => of[signal][taps]);
}

// The bound is of what truncation adds.
const bounded = () => ["error_max", "error_rms", "truncation_error_max"].includes(state.error);

function referenceLines(points, order) {
  if (!bounded()) return [];
  const file = files[0];
  const lengths = [...file.lengths].filter(([taps]) => shownTaps(taps) && !taps.includes("+"));  // windows
  const line = (value, kind, text) =>
    ({kind, text, points: lengths.map(([taps, at]) => ({x: at, y: value(taps)})).filter(point => point.y !== undefined && point.y > 0)});
  const worst = (taps, counter) => d3.max(points.filter(point => point.taps === taps && point.file === file), point => {
    const error = errorOf(point.found, counter, state.signal);
    return error && error.value;
  });
  const lines = [line(taps => boundOf(file, order, taps), "bound", "truncation bound")];
  if (state.error !== "truncation_error_max") {
    lines.push(line(taps => worst(taps, "truncation_error_max"), "truncation", "truncation"));
    lines.push(line(taps => worst(taps, "discretisation_error_max"), "discretisation", "discretisation"));
  }
  return lines;
}

function describe(point) {
  const found = point.found, rows = [];
  const add = (name, value, note) => { if (value !== undefined && value !== "" && !Number.isNaN(value)) rows.push([name, (typeof value === "number" ? show(value) : value) + (note || "")]); };
  const effective = accuracyOf(found, point.signal, "effective_taps");
  add("order", found.order);
  add("taps", found.taps, effective < found.at ? `, ${effective} effective` : "");
  add("signal", point.signal, state.signal === "worst" ? " (the worst)" : "");
  for (const error of errors) {
    const other = errorOf(found, error.id, state.signal);
    if (other) add(error.title, other.value, other.signal !== point.signal ? ` (${other.signal})` : "");
  }
  const bound = boundOf(point.file, found.order, found.taps);
  add("truncation bound", bound);
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
    const error = errorOf(other, state.error, state.signal);
    const where = point.file === files[0] ? " in B" : " in A";
    if (error) add(errors.find(one => one.id === state.error).title + where, error.value);
    for (const axis of shownAxes().filter(axis => axis.aspect)) add(axis.title.split(",")[0] + where, axis.cost(other));
  }
  if (point.front) add("front", "no kernel shown here costs less at this error");
  return [found.kernel + (files.length > 1 ? point.file === files[0] ? " (A)" : " (B)" : ""), rows];
}

// As many columns as fit, and no panel alone in the last row where that can be helped.
function even(row, count, least = 1) {
  const fit = Math.max(1, Math.floor((row.node().getBoundingClientRect().width + 16) / 336));
  const rows = Math.ceil(count / fit);
  row.style("grid-template-columns", `repeat(${Math.max(Math.min(least, fit), Math.ceil(count / rows))}, minmax(0, 1fr))`);
}

function drawCurves() {
  const error = errors.find(one => one.id === state.error);
  byId("curves-title").textContent = error ? error.title[0].toUpperCase() + error.title.slice(1) + " of the sum" : "No accuracy in this file";
  const root = d3.select("#panels");
  root.selectAll("*").remove();
  panels.length = 0;
  const pinned = pins();
  const active = shownAxes();
  const litFronts = new Set();  // kernels on a front somewhere
  const orders = every.orders.filter(order => listOf("orders").includes(order));
  for (const order of orders) {
    const points = files.map(file => pointsOf(file, order)).flat();
    if (points.length === 0) continue;
    const block = root.append("div").attr("class", "order");
    block.append("h3").text("order " + order);
    const row = block.append("div").attr("class", "row");
    const costs = axes.filter(axis => axis.id !== "taps" && active.includes(axis));
    const onAxis = new Map(active.map(axis => [axis, files.map(file => placed(points.filter(point => point.file === file), axis)).flat()]));
    const fronts = new Map(costs.map(axis => [axis, new Set(onAxis.get(axis).filter(point => point.front).map(point => point.kernel))]));
    // As in the tables of `glsum bench`: what no target's time ranks is dominated, whatever its bytes.
    const ranking = costs.some(axis => axis.aspect) ? costs.filter(axis => axis.aspect) : costs;
    const anyFront = new Set(ranking.flatMap(axis => [...fronts.get(axis)]));
    for (const kernel of anyFront) litFronts.add(kernel);
    const lines = referenceLines(points, order);
    const shared = points.map(point => point.y).concat(lines.flatMap(line => line.points.map(point => point.y)));
    const hasLines = active.some(axis => axis.id === "taps");
    const figures = [];
    for (const axis of active) {
      const at = onAxis.get(axis);
      if (at.length === 0) continue;
      const best = axis.id === "taps" ? (costs.length > 0 ? anyFront : new Set(points.map(point => point.kernel))) : fronts.get(axis);
      const series = [];
      for (const [kernel, ofKernel] of d3.nest().key(point => point.kernel).entries(at).map(entry => [entry.key, entry.values])) {
        if (state.fronts && !best.has(kernel) && !pinned.has(kernel)) continue;
        for (const file of files) {
          const own = ofKernel.filter(point => point.file === file).sort((a, b) => lengthOf(a.taps) - lengthOf(b.taps));
          if (own.length === 0) continue;
          for (const point of own) point.second = file !== files[0];
          series.push({kernel, style: styleFor(kernel), dim: !best.has(kernel), second: file !== files[0], points: own});
        }
      }
      const figure = row.append("figure");
      figure.append("figcaption").text("against " + axis.title);
      figures.push([figure, {
        id: axis.id, order, label: `Order ${order}: ${error.title} against ${axis.title}.`, xTitle: axis.unit,
        xTicks: axis.id === "taps" ? [...files[0].lengths].filter(([taps]) => shownTaps(taps)).map(([taps, value]) => ({value, text: taps})) : null,
        yValues: hasLines ? shared : points.map(point => point.y), linear: state.linear === "yes", series,
        lines: axis.id === "taps" ? lines : [], describe, pinned,
        onPin: kernel => { flip("lit", kernel); update(); }
      }]);
    }
    even(row, figures.length);
    for (const [figure, panel] of figures) drawPanel(figure.node(), panel);
  }
  const shown = measured.filter(passes);
  byId("curves-text").textContent = error ? `${error.text[0].toUpperCase()}${error.text.slice(1)}, relative to the largest exact sum` +
    (state.signal === "worst" ? "; the worst of the signals" : `; signal ${state.signal}`) +
    `. ${shown.length} of ${measured.length} kernels; those on no front are dimmed.` +
    (files[0].bounds.missing && bounded() ? ` No truncation bound: ${files[0].bounds.missing}.` : "") : "";
  drawKey();
  drawKernels(litFronts);
}

function mark(svg, style, second) {
  svg.attr("width", 30).attr("height", 12).attr("aria-hidden", "true").attr("class", "sample kernel " + style.colour + (second ? " second" : ""));
  svg.append("path").attr("class", "line").attr("d", "M1,6H29");
  svg.append("path").attr("class", "marks").attr("d", marksPath([[15, 6]], style.shape, 34));
}

function drawKey() {
  const key = d3.select("#key");
  key.selectAll("*").remove();
  const add = text => { const item = key.append("span"); const svg = item.append("svg"); item.append("span").text(text); return svg; };
  for (const name of words[state.colour].filter(name => !listOf("no-" + state.colour).includes(name))) {
    mark(add(name), styles[state.colour].get(name), false);
  }
  const sample = (kind, text) => {
    const svg = add(text).attr("width", 30).attr("height", 12).attr("aria-hidden", "true");
    svg.append("path").attr("class", kind).attr("d", "M1,6H29");
  };
  const front = add("Pareto front").attr("width", 30).attr("height", 14).attr("aria-hidden", "true");
  front.append("path").attr("class", "front").attr("d", "M1,3H15V11H29");
  if (bounded() && !files[0].bounds.missing) sample("reference bound", "truncation bound: absolute sum of the dropped coefficients × peak of the record ÷ its largest exact sum");
  if (files.length > 1) {
    mark(add("A: " + files[0].name), styleOf(0), false);
    mark(add("B: " + files[1].name), styleOf(0), true);
  }
}

function drawKernels(fronts) {
  const pinned = pins();
  const shown = measured.filter(passes).sort((a, b) =>
    d3.ascending(words[state.colour].indexOf(wordsOf(a)[state.colour]), words[state.colour].indexOf(wordsOf(b)[state.colour])));
  const focused = document.activeElement && document.activeElement.dataset ? document.activeElement.dataset.kernel : undefined;
  const root = d3.select("#kernels");
  root.selectAll("*").remove();
  for (const kernel of shown) {
    const button = root.append("button").attr("type", "button").attr("data-kernel", kernel).attr("aria-pressed", String(pinned.has(kernel)))
      .attr("class", fronts.has(kernel) ? null : "dominated").attr("title", fronts.has(kernel) ? "on a front" : "dominated")
      .on("click", () => { flip("lit", kernel); update(); })
      .on("mouseenter", () => light(kernel)).on("mouseleave", () => light(null))
      .on("focus", () => light(kernel)).on("blur", () => light(null));
    mark(button.append("svg"), styleFor(kernel), false);
    button.append("span").text(kernel);
    if (kernel === focused) button.node().focus();
  }
  if (shown.length === 0) root.append("p").text("No kernel passes the filters.");
}

// ---- Effective taps.

function drawEffective() {
  const root = d3.select("#effective-panels");
  root.selectAll("*").remove();
  const any = [];
  for (const order of every.orders.filter(order => listOf("orders").includes(order))) {
    const series = [];
    for (const [kernel, byTaps] of files[0].cases.get(order) || []) {
      if (!passes(kernel) || !wordsOf(kernel).format.startsWith("q")) continue;
      const points = [...byTaps.values()].filter(found => !found.fault && shownTaps(found.taps) && atFirstSignal(found, "effective_taps") !== undefined)
        .map(found => ({kernel, taps: found.taps, x: found.at, y: atFirstSignal(found, "effective_taps"), signal: Object.keys(found.signals)[0], found, file: files[0], second: false}))
        .sort((a, b) => a.x - b.x);
      if (points.length > 0) series.push({kernel, style: styleFor(kernel), dim: false, second: false, points});
    }
    if (series.length > 0) any.push([order, series]);
  }
  byId("effective").hidden = any.length === 0;
  const row = root.append("div").attr("class", "row");
  even(row, any.length, 2);
  for (const [order, series] of any) {
    const figure = row.append("figure");
    figure.append("figcaption").text("order " + order);
    const ends = [...files[0].lengths].filter(([taps]) => shownTaps(taps));
    drawPanel(figure.node(), {
      id: "effective", order, label: `Order ${order}: effective taps against memory length.`, xTitle: "taps",
      xTicks: ends.map(([taps, value]) => ({value, text: taps})),
      yValues: [...series.flatMap(one => one.points.map(point => point.y)), ...ends.map(([, at]) => at)], yText: tick,
      linear: state.linear === "yes", series,
      lines: [{kind: "truncation", text: "every tap", points: ends.map(([, at]) => ({x: at, y: at}))}],
      describe: point => [point.kernel, [["order", order], ["taps", point.taps], ["effective taps", show(point.y)]]], pinned: pins(),
      onPin: kernel => { flip("lit", kernel); update(); }
    });
  }
}

// ---- Stalls.

const causeOf = counter => counter.slice(6).replace(/_/g, " ");

function drawStalls() {
  const found = [];
  for (const [order, byKernel] of files[0].cases) {
    for (const [kernel, byTaps] of byKernel) {
      for (const one of byTaps.values()) {
        for (const aspect in one.m7) {
          const causes = Object.keys(one.m7[aspect]).filter(counter => counter.startsWith("stall_"));
          if (causes.length > 0 && !one.fault) found.push({order, kernel, taps: one.taps, aspect, counters: one.m7[aspect], causes});
        }
      }
    }
  }
  byId("stalls").hidden = found.length === 0;
  if (found.length === 0) return;
  const cases = new Map(found.map(one => [`${one.order}|${one.taps}|${one.aspect}`, `order ${one.order}, ${one.taps} taps, ${one.aspect.slice(3)}`]));
  if (!cases.has(state.stall)) state.stall = [...cases.keys()].sort((a, b) => Math.abs(lengthOf(a.split("|")[1]) - 600) - Math.abs(lengthOf(b.split("|")[1]) - 600))[0];
  defaults.stall = defaults.stall || state.stall;
  options("stall-case", "stall", [...cases].map(([id, text]) => ({id, text})));
  const rows = found.filter(one => `${one.order}|${one.taps}|${one.aspect}` === state.stall && passes(one.kernel));
  const all = union(found.map(one => one.causes));
  const sum = d3.nest().key(cause => cause).rollup(list => d3.sum(rows, one => one.counters[list[0]])).object(all);
  const causes = all.filter(cause => sum[cause] > 0).sort((a, b) => sum[b] - sum[a]);
  const bars = rows.map(one => {
    const lost = d3.sum(causes, cause => Math.max(0, one.counters[cause] || 0));
    const total = one.counters.model_cycles_per_sample;
    const parts = causes.map(cause => ({cause, value: Math.max(0, one.counters[cause] || 0)})).filter(part => part.value > 0);
    const left = total === undefined ? 0 : Math.max(0, total - lost);
    return {kernel: one.kernel, total: total === undefined ? lost : total, length: left + lost, parts: left > 0 ? [{cause: "", value: left}, ...parts] : parts};
  }).sort((a, b) => d3.ascending(a.length, b.length));
  const nameOf = cause => cause === "" ? "issuing" : causeOf(cause);
  const classOf = cause => cause === "" ? "issue" : `c${causes.indexOf(cause) % colourCount}${causes.indexOf(cause) >= colourCount ? " hatched" : ""}`;

  const key = d3.select("#stall-key");
  key.selectAll("*").remove();
  for (const cause of ["", ...causes]) {
    const item = key.append("span");
    item.append("svg").attr("width", 16).attr("height", 12).attr("aria-hidden", "true").append("rect").attr("width", 16).attr("height", 12)
      .attr("class", "bar " + classOf(cause));
    item.append("span").text(nameOf(cause));
  }
  const node = byId("stall-bars");
  d3.select(node).selectAll("*").remove();
  const width = Math.max(300, Math.floor(node.getBoundingClientRect().width)), nameWidth = Math.min(190, width * 0.42), rowHeight = 22;
  const x = d3.scaleLinear().domain([0, d3.max(bars, bar => bar.length) || 1]).range([nameWidth + 6, width - 64]);
  const svg = d3.select(node).append("svg").attr("class", "stalls").attr("width", width).attr("height", bars.length * rowHeight + 30)
    .attr("role", "list").attr("aria-label", "Modelled cycles per sample by cause, one bar a kernel");
  for (const value of x.ticks(5)) {
    svg.append("line").attr("class", "grid").attr("x1", x(value)).attr("x2", x(value)).attr("y1", 0).attr("y2", bars.length * rowHeight + 4);
    svg.append("text").attr("x", x(value)).attr("y", bars.length * rowHeight + 18).attr("text-anchor", "middle").text(tick(value));
  }
  bars.forEach((bar, index) => {
    const rowsOf = () => [bar.kernel, [["modelled cycles", show(bar.total)], ...bar.parts.map(part => [nameOf(part.cause), `${show(part.value)} (${(100 * part.value / bar.length).toFixed(0)} %)`])]];
    const top = index * rowHeight;
    const group = svg.append("g").attr("class", "stack").attr("tabindex", 0).attr("role", "listitem").attr("data-kernel", bar.kernel)
      .attr("aria-label", rowsOf()[0] + ": " + rowsOf()[1].map(([name, value]) => name + " " + value).join(", "));
    const tell = () => { const box = group.node().getBoundingClientRect(); showTip(rowsOf(), box.left + box.width / 2, box.top + rowHeight); };
    group.on("mouseenter", tell).on("focus", tell).on("mouseleave", hideTip).on("blur", hideTip);
    group.append("rect").attr("class", "back").attr("x", 0).attr("y", top).attr("width", width).attr("height", rowHeight);
    group.append("text").attr("x", nameWidth).attr("y", top + 15).attr("text-anchor", "end").text(bar.kernel);
    let at = 0;
    for (const part of bar.parts) {
      const from = x(at), to = x(at += part.value);
      group.append("rect").attr("class", "bar " + classOf(part.cause)).attr("data-cause", part.cause).attr("x", from).attr("y", top + 3)
        .attr("width", Math.max(0.5, to - from - 1)).attr("height", rowHeight - 6);
    }
    group.append("text").attr("x", x(at) + 4).attr("y", top + 15).text(show(bar.total));
  });
}

// ---- Tables.

let compared = null;  // made when it is first wanted

function drawDifference() {
  if (files.length < 2) return;
  byId("difference").hidden = false;
  compared = compared || differences(files[0], files[1]);
  const counters = comparable.filter(name => compared.rows.some(row => row.counter === name));
  options("counter", "counter", [{id: "largest", text: "any"}, ...plain(counters)]);
  const rows = compared.rows.filter(row => (state.counter === "largest" || row.counter === state.counter) && shownRow(row));
  byId("difference-text").textContent = `A is ${files[0].name}, B is ${files[1].name}. ${grouped(compared.equal)} rows are equal in every counter; ` +
    `${grouped(compared.onlyA)} are only in A, ${grouped(compared.onlyB)} only in B. Sorted by the size of the ratio. Host times of two runs are not comparable one by one: the machine may have changed between them.`;
  drawTable(byId("difference-table"), "Differences", [
    {title: "kernel", text: row => row.kernel}, {title: "order", text: row => row.order}, {title: "taps", text: row => row.taps},
    {title: "rows", text: row => row.aspect}, {title: "signal", text: row => row.signal}, {title: "counter", text: row => row.counter || row.note},
    {title: "B / A", text: row => row.counter ? row.a === 0 ? "from 0" : row.ratio.toPrecision(4) : "", number: row => row.counter ? row.ratio : NaN},
    {title: "A", text: row => show(row.a), number: row => row.a}, {title: "B", text: row => show(row.b), number: row => row.b}
  ], rows);
}

const shownRow = row => (!measured.includes(row.kernel) ? row.kernel.includes(state.find) : passes(row.kernel)) &&
  (row.order === "" || listOf("orders").includes(row.order) || row.aspect === "host") && (row.taps === "" || shownTaps(row.taps)) &&
  (row.signal === "" || state.signal === "worst" || row.signal === state.signal) && !listOf("no-targets").includes(row.aspect);

function drawFaults() {
  const rows = files.flatMap((file, index) => file.tables.flatMap(table => d3.range(table.text.fault ? table.rows : 0)
    .filter(row => table.text.fault(row)).map(row => ({file: "AB"[index], aspect: table.aspect, kernel: textOf(table, "kernel", row) || textOf(table, "name", row),
      order: textOf(table, "order", row), taps: textOf(table, "taps", row), signal: textOf(table, "signal", row), fault: table.text.fault(row)}))));
  byId("faults").hidden = rows.length === 0;
  const columns = [{title: "kernel", text: row => row.kernel}, {title: "order", text: row => row.order}, {title: "taps", text: row => row.taps},
    {title: "rows", text: row => row.aspect}, {title: "signal", text: row => row.signal}, {title: "reason", text: row => row.fault}];
  if (files.length > 1) columns.unshift({title: "file", text: row => row.file});
  drawTable(byId("fault-table"), "Wrong or impossible rows", columns, rows);
}

function drawRows() {
  const tables = files.flatMap((file, index) => file.tables.map(table => ({id: (files.length > 1 ? "AB"[index] + " " : "") + table.aspect, table})))
    .filter(one => !listOf("no-targets").includes(one.table.aspect));
  if (!tables.some(one => one.id === state.rows)) state.rows = tables.length > 0 ? tables[0].id : "";
  defaults.rows = tables.length > 0 ? tables[0].id : "";
  const tabs = d3.select("#row-aspects").selectAll("button").data(tables, one => one.id);
  tabs.exit().remove();
  tabs.enter().append("button").attr("type", "button").text(one => one.id).on("click", one => { state.rows = one.id; writeAddress(); drawRows(); })
    .merge(tabs).attr("aria-pressed", one => String(one.id === state.rows));
  const chosen = tables.find(one => one.id === state.rows);
  if (!chosen) return;
  const table = chosen.table;
  const rows = d3.range(table.rows).filter(row => shownRow({kernel: textOf(table, "kernel", row) || textOf(table, "name", row),
    order: textOf(table, "order", row), taps: textOf(table, "taps", row), signal: textOf(table, "signal", row), aspect: table.aspect}));
  byId("rows-text").textContent = `${grouped(rows.length)} of ${grouped(table.rows)} rows of ${chosen.id} pass the filters.` +
    (table.aspect === "host" ? " Host timing is taken at one order." : "") +
    (table.aspect === "m7:count" ? " Instructions of the emulated core; they are not cycles." : "");
  const columns = ["name", "kernel", "order", "taps", "signal", "label", "fault"].filter(name => table.text[name])
    .map(name => ({title: name, text: table.text[name]}));
  const hidden = ["iterations", "repetition_index"];
  const timed = table.aspect === "host";
  for (const name in table.number) {
    if (hidden.includes(name) || (name === "real_time" && !timed)) continue;
    columns.push({title: name === "real_time" ? "real_time (ns)" : name, text: row => show(table.number[name](row)), number: table.number[name]});
  }
  columns.sort((a, b) => Boolean(a.number) - Boolean(b.number));
  drawTable(byId("row-table"), "Rows of " + chosen.id, columns, rows);
}

const contextText = value => value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value);

function drawContext() {
  const names = union(files.map(file => Object.keys(file.context)));
  const rows = names.map(name => ({name, values: files.map(file => contextText(name === "weights" ? file.context[name] ?? "gl" : file.context[name]))}))
    .map(row => ({...row, mark: row.values.length > 1 && row.values[0] !== row.values[1] ? "differs" : ""}));
  const columns = [{title: "condition", text: row => row.name},
    ...files.map((file, index) => ({title: files.length > 1 ? "AB"[index] + ": " + file.name : file.name, text: row => row.values[index]}))];
  if (files.length > 1) columns.push({title: "", text: row => row.mark});
  drawTable(byId("context-table"), "Conditions", columns, rows);
  const first = files[0].context;
  byId("files").textContent = files.length > 1 ? `A: ${files[0].name}   B: ${files[1].name}` : files[0].name;
  byId("run").textContent = [["", first.date], ["", first.cpu], ["compiler ", first.compiler], ["samples ", first.n_samples], ["commit ", first.commit && String(first.commit).slice(0, 10)]]
    .filter(([, value]) => value !== undefined).map(([name, value]) => name + contextText(value)).join(" · ");
  const important = ["compiler", "flags", "contraction", "cpu", "cycle_counter", "core_file", "n_samples", "seed", "weights", "qemu_version"];
  const differing = rows.filter(row => row.mark && important.includes(row.name)).map(row => row.name);
  if (differing.length > 0) {
    byId("notices").textContent = "";
    d3.select("#notices").append("p").attr("class", "notice").text(`The two runs differ in ${differing.join(", ")}: see Conditions before you compare.`);
  }
  byId("foot").textContent = `glsum ${data.version}. Drawn with D3 ${data.d3}, copyright Mike Bostock, BSD 3-clause licence.`;
}

// ---- All together.

const schemes = {system: "light", light: "dark", dark: "system"};

function drawTheme() {
  document.documentElement.dataset.theme = state.theme;
  byId("theme").textContent = "Scheme: " + state.theme;
}

function update() {
  writeAddress();
  drawTheme();
  drawControls();
  hideTip();
  lit = null;
  byId("layout").classList.remove("has-lit");
  const focused = document.activeElement && document.activeElement.matches("svg.panel")
    ? `svg.panel[data-axis="${CSS.escape(document.activeElement.dataset.axis)}"][data-order="${CSS.escape(document.activeElement.dataset.order)}"]` : null;
  drawCurves();
  // What the first screen cannot show waits until that is painted: a quarter of the time of a large file.
  if (document.documentElement.dataset.drawn) drawBelow();
  else requestAnimationFrame(() => setTimeout(() => { drawBelow(); document.documentElement.dataset.drawn = "all"; performance.mark("drawn"); }));
  if (focused && document.querySelector(focused)) document.querySelector(focused).focus();
}

function drawBelow() {
  drawEffective();
  drawStalls();
  drawRows();
  drawDifference();
}

readAddress();
for (const id of ["panel-controls", "panel-kernels"]) {
  byId(id).open = matchMedia("(min-width: 900px)").matches;
}
d3.select("#theme").on("click", () => { state.theme = schemes[state.theme]; writeAddress(); drawTheme(); });
d3.select("#controls").on("submit", () => d3.event.preventDefault());
drawContext();
drawFaults();
update();
let drawnWidth = document.documentElement.clientWidth;
addEventListener("resize", () => {
  if (document.documentElement.clientWidth !== drawnWidth) {
    drawnWidth = document.documentElement.clientWidth;
    clearTimeout(addEventListener.timer);
    addEventListener.timer = setTimeout(() => { drawCurves(); drawEffective(); drawStalls(); }, 150);
  }
});
addEventListener("hashchange", () => { readAddress(); update(); });
