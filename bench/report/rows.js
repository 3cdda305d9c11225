// What the tables hold under the choices of now: {columns, rows} as tables.js draws them, with what is said of them.

import {union} from "./catalogue.js";
import {tablesOf} from "./choices.js";
import {textOf} from "./data.js";
import {differences} from "./difference.js";
import {grouped, show} from "./numbers.js";
import {shownRow} from "./select.js";

const partsOf = (table, row) => ({
  kernel: textOf(table, "kernel", row) || textOf(table, "name", row), order: textOf(table, "order", row), taps: textOf(table, "taps", row),
  signal: textOf(table, "signal", row), aspect: table.aspect
});
const rowsOf = table => Array.from({length: table.rows}, (_, row) => row);
const column = (title, name) => ({title, text: row => row[name]});
const partColumns = [column("kernel", "kernel"), column("order", "order"), column("taps", "taps"), column("rows", "aspect"), column("signal", "signal")];

/// The second file against the first; null without one. It takes long: ask once.
export const comparisonOf = all => all.files.length > 1 ? differences(all.files[0], all.files[1], all.counters) : null;

/// {text, counters, columns, rows} of a comparison.
export function differenceShown(all, now, compared) {
  const [a, b] = all.files;
  return {
    text: `A is ${a.name}, B is ${b.name}. ${grouped(compared.equal)} rows are equal in every counter; ` +
      `${grouped(compared.onlyA)} are only in A, ${grouped(compared.onlyB)} only in B. Sorted by the size of the ratio. Host times of two runs are not comparable one by one: the machine may have changed between them.`,
    counters: all.counters.compared.filter(name => compared.rows.some(row => row.counter === name)),
    columns: [
      ...partColumns, {title: "counter", text: row => row.counter || row.note},
      {title: "B / A", text: row => row.counter ? row.a === 0 ? "from 0" : row.ratio.toPrecision(4) : "", number: row => row.counter ? row.ratio : NaN},
      {title: "A", text: row => show(row.a), number: row => row.a}, {title: "B", text: row => show(row.b), number: row => row.b}
    ],
    rows: compared.rows.filter(row => (now.counter === "largest" || row.counter === now.counter) && shownRow(all, now, row))
  };
}

/// What a run marked as wrong or impossible, whatever is chosen.
export function faultsOf(all) {
  const columns = [...partColumns, column("reason", "fault")];
  if (all.files.length > 1) columns.unshift(column("file", "file"));
  const rows = all.files.flatMap((file, index) => file.tables.filter(table => table.text.fault).flatMap(table => rowsOf(table)
    .filter(row => table.text.fault(row)).map(row => ({file: "AB"[index], ...partsOf(table, row), fault: table.text.fault(row)}))));
  return {columns, rows};
}

/// {ids: of the tables, chosen: its id, text, columns, rows}; without a table only ids.
export function rowsShown(all, now) {
  const tables = tablesOf(all, now), ids = tables.map(one => one.id), chosen = tables.find(one => one.id === now.rows);
  if (!chosen) return {ids};
  const table = chosen.table, timed = table.aspect === "host";
  const rows = rowsOf(table).filter(row => shownRow(all, now, partsOf(table, row)));
  const texts = ["name", "kernel", "order", "taps", "signal", "label", "fault"].filter(name => table.text[name])
    .map(name => ({title: name, text: table.text[name]}));
  const numbers = Object.keys(table.number).filter(name => all.counters.isTold(name, table.aspect)).map(name =>
    ({title: all.counters.titleOf(name), text: row => show(table.number[name](row)), number: table.number[name]}));
  return {
    ids, chosen: chosen.id, rows, columns: [...texts, ...numbers],
    text: `${grouped(rows.length)} of ${grouped(table.rows)} rows of ${chosen.id} pass the filters.` +
      (timed ? " Host timing is taken at one order." : "") +
      (table.aspect.endsWith(":count") ? " Instructions of the emulated core; they are not cycles." : "")
  };
}

const contextText = value => value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value);

/// {files, run, columns, rows, notice, foot}: what was measured, how and on what.
export function conditionsOf(all) {
  const {files} = all, several = files.length > 1, first = files[0].context;
  const rows = union(files.map(file => Object.keys(file.context)))
    .map(name => ({name, values: files.map(file => contextText(name === "weights" ? file.context[name] ?? "gl" : file.context[name]))}))
    .map(row => ({...row, mark: row.values.length > 1 && row.values[0] !== row.values[1] ? "differs" : ""}));
  const columns = [column("condition", "name"),
    ...files.map((file, index) => ({title: several ? "AB"[index] + ": " + file.name : file.name, text: row => row.values[index]}))];
  if (several) columns.push(column("", "mark"));
  const important = ["compiler", "flags", "contraction", "cpu", "cycle_counter", "core_file", "n_samples", "seed", "weights", "qemu_version"];
  const differing = rows.filter(row => row.mark && important.includes(row.name)).map(row => row.name);
  return {
    files: several ? `A: ${files[0].name}   B: ${files[1].name}` : files[0].name,
    run: [["", first.date], ["", first.cpu], ["compiler ", first.compiler], ["samples ", first.n_samples], ["commit ", first.commit && String(first.commit).slice(0, 10)]]
      .filter(([, value]) => value !== undefined).map(([name, value]) => name + contextText(value)).join(" · "),
    columns, rows,
    notice: differing.length > 0 ? `The two runs differ in ${differing.join(", ")}: see Conditions before you compare.` : "",
    foot: `glsum ${all.version}. Drawn with D3 ${all.d3}, copyright Mike Bostock, BSD 3-clause licence.`
  };
}
