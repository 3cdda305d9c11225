// Two files, row by row.

import {textOf} from "./data.js";

// The rows of a file by what they measure: key -> {parts, counters, fault}; of repetitions the median.
function rowsByKey(file, counters) {
  const byKey = new Map();
  for (const table of file.tables) {
    const names = counters.compared.filter(name => table.number[name] && counters.isTold(name, table.aspect));
    for (let row = 0; row < table.rows; ++row) {
      const parts = {aspect: table.aspect, kernel: textOf(table, "kernel", row) || textOf(table, "name", row),
                     order: textOf(table, "order", row), taps: textOf(table, "taps", row), signal: textOf(table, "signal", row)};
      const key = Object.values(parts).join("\n");
      if (!byKey.has(key)) byKey.set(key, {...parts, counters: {}, resolution: table.resolution, fault: ""});
      const found = byKey.get(key);
      found.fault = found.fault || textOf(table, "fault", row);
      for (const name of names) {
        const value = table.number[name](row);
        if (!Number.isNaN(value)) (found.counters[name] = found.counters[name] || []).push(value);
      }
    }
  }
  return byKey;
}

/// {rows: [{..parts, counter, a, b, ratio, size}], equal, onlyA, onlyB}: what differs, the largest ratio first.
export function differences(a, b, counters) {
  const [rowsA, rowsB] = [rowsByKey(a, counters), rowsByKey(b, counters)];
  const found = {rows: [], equal: 0, onlyA: 0, onlyB: 0};
  for (const [key, one] of rowsA) {
    const other = rowsB.get(key);
    if (!other) {
      ++found.onlyA;
      found.rows.push({...one, counter: "", note: "only in A", ratio: NaN, size: Infinity});
      continue;
    }
    if (one.fault !== other.fault) {
      found.rows.push({...one, counter: "", note: one.fault ? "wrong in A: " + one.fault : "wrong in B: " + other.fault, ratio: NaN, size: Infinity});
    }
    let same = true;
    for (const counter in one.counters) {
      if (!other.counters[counter]) continue;
      const [p, q] = [d3.median(one.counters[counter]), d3.median(other.counters[counter])];
      // Two files need not have their numbers to the same digits: what the coarser one cannot tell is no difference.
      if (Math.abs(p - q) <= Math.max(one.resolution[counter], other.resolution[counter]) * Math.max(Math.abs(p), Math.abs(q))) continue;
      same = false;
      const ratio = q / p;
      found.rows.push({...one, counter, a: p, b: q, ratio, size: ratio > 0 && Number.isFinite(ratio) ? Math.abs(Math.log(ratio)) : 1e6, note: ""});
    }
    found.equal += same ? 1 : 0;
  }
  for (const [key, other] of rowsB) {
    if (rowsA.has(key)) continue;
    ++found.onlyB;
    found.rows.push({...other, counter: "", note: "only in B", ratio: NaN, size: Infinity});
  }
  found.rows.sort((p, q) => d3.descending(p.size, q.size));
  return found;
}
