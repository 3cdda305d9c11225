// What the files hold, whatever is chosen: errors, axes, orders, signals, lengths, kernels and their words.

import {countersOf} from "./counters.js";
import {axesOf, joinFile, textOf} from "./data.js";

export const union = lists => [...new Set(lists.flat())];

const signalsOf = file => union(file.tables.filter(table => table.aspect === "accuracy" && table.text.signal)
  .map(table => Array.from({length: table.rows}, (_, row) => textOf(table, "signal", row))));

const unknown = {history: "unknown", technique: "unknown", format: "unknown", fixed: false};

// Each word's place, by which it has its colour and mark.
const placesOf = names => new Map(names.map((name, index) => [name, index]));

export function catalogueOf(data) {
  const counters = countersOf(data.counters);
  const wordsOf = kernel => Object.hasOwn(data.kernels, kernel) ? data.kernels[kernel] : unknown;
  const files = data.files.map(file => joinFile(file, counters.ofTheClock));
  const kernels = union(files.map(file => file.kernels));
  const measured = kernels.filter(kernel => files.some(file => [...file.cases.values()].some(byKernel =>
    byKernel.has(kernel) && [...byKernel.get(kernel).values()].some(found => Object.keys(found.signals).length > 0))));
  const formats = union([["f64", "f32", "f32a64", "q31", "q15", "q15c31"], measured.map(kernel => wordsOf(kernel).format)]);
  const words = {}, places = {};
  for (const word of ["format", "history", "technique"]) {
    const used = union([measured.map(kernel => wordsOf(kernel)[word])]);
    words[word] = word === "format" ? formats.filter(format => used.includes(format)) : used;
    places[word] = placesOf(word === "format" ? formats : used);
  }
  const all = {
    version: data.version, d3: data.d3, counters, wordsOf, files, measured, words, places, axes: axesOf(files),
    errors: counters.drawn.filter(error => files.some(file => file.tables.some(table => table.number[error.id]))),
    orders: union(files.map(file => [...file.cases.keys()])),
    signals: union(files.map(signalsOf)),
    taps: union(files.map(file => [...file.lengths.keys()])),
    targets: union(files.map(file => file.tables.map(table => table.aspect)))
  };
  // How long a memory is, in the file that has it shortest.
  all.lengths = new Map(all.taps.map(taps => [taps, Math.min(...files.map(file => file.lengths.get(taps) ?? Infinity))]));
  all.stalls = stallsOf(files[0], counters.stall);
  return all;
}

// Where cycles are lost: {order, kernel, taps, aspect, counters, causes, id: of its case}.
function stallsOf(file, family) {
  const found = [];
  for (const [order, byKernel] of file.cases) {
    for (const [kernel, byTaps] of byKernel) {
      for (const one of byTaps.values()) {
        for (const aspect in one.m7) {
          const causes = Object.keys(one.m7[aspect]).filter(counter => counter.startsWith(family));
          if (causes.length === 0 || one.fault) continue;
          found.push({order, kernel, taps: one.taps, aspect, counters: one.m7[aspect], causes, id: `${order}|${one.taps}|${aspect}`});
        }
      }
    }
  }
  return found;
}
