// What two files differ in, a line for each kernel and counter: better, worse or only other.

import {show} from "./numbers.js";

// lower, higher: which way is better; equal: no way; neither: nobody's judgement.
function wayOf(better, a, b) {
  if (better === "neither") return "other";
  if (better === "equal") return "worse";
  return (better === "lower") === (b < a) ? "better" : "worse";
}

const change = ratio => `${ratio >= 1 ? "+" : "−"}${Number((100 * Math.abs(ratio - 1)).toPrecision(2))} %`;

function rangeText(group) {
  if (group.ratios.length < group.count) return group.count === 1 ? "from 0" : "from 0, or to another sign";
  const [least, most] = d3.extent(group.ratios);
  return change(least) === change(most) ? change(most) : `${change(least)} to ${change(most)}`;
}

const several = (count, what) => `${show(count)} ${what}${count === 1 ? "" : "s"}`;
const kernelsOf = groups => new Set(groups.map(group => group.kernel)).size;

/// \param compared  as differences() gives it
/// \return {text, columns, rows: the worse first, in each the largest change first}
export function changesOf(all, compared) {
  const groups = new Map();
  let ofTheClock = 0;
  for (const row of compared.rows) {
    if (!row.counter) continue;
    if (all.counters.ofTheClock.includes(row.counter)) {
      ++ofTheClock;
      continue;
    }
    const way = wayOf(all.counters.betterOf(row.counter), row.a, row.b);
    const key = [row.kernel, row.counter, way].join("\n");
    if (!groups.has(key)) groups.set(key, {kernel: row.kernel, counter: row.counter, way, count: 0, ratios: [], size: 0});
    const group = groups.get(key);
    ++group.count;
    group.size = Math.max(group.size, row.size);
    if (row.ratio > 0 && Number.isFinite(row.ratio)) group.ratios.push(row.ratio);
  }
  const rank = {worse: 0, other: 1, better: 2};
  const rows = [...groups.values()].sort((a, b) => rank[a.way] - rank[b.way] || b.size - a.size);
  const told = way => {
    const own = rows.filter(row => row.way === way);
    return own.length === 0 ? "nothing" : `${several(d3.sum(own, row => row.count), "value")} of ${several(kernelsOf(own), "kernel")}`;
  };
  const broken = compared.rows.filter(row => row.note.startsWith("wrong")).length;
  return {
    text: `Worse: ${told("worse")}. Better: ${told("better")}. Unchanged: ${several(compared.equal, "row")} in every counter.` +
      (broken > 0 ? ` Wrong in one of the two: ${several(broken, "row")}.` : "") +
      (compared.onlyA + compared.onlyB > 0 ? ` Only in A: ${several(compared.onlyA, "row")}; only in B: ${several(compared.onlyB, "row")}.` : "") +
      (ofTheClock > 0 ? ` Not judged: ${several(ofTheClock, "host time")}, which two runs do not share.` : ""),
    columns: [
      {title: "kernel", text: row => row.kernel}, {title: "counter", text: row => row.counter},
      {title: "B is", text: row => row.way}, {title: "change", text: rangeText, number: row => row.size},
      {title: "values", text: row => show(row.count), number: row => row.count}
    ],
    rows: rows.map(row => ({...row, mark: row.way}))
  };
}
