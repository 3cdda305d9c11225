// What may be chosen, and what is chosen at first.

import {costsOf, decidingCost, limits} from "./answer.js";
import {listOf} from "./state.js";

/// The tables of rows whose target is shown: {id, table}.
export const tablesOf = (all, now) =>
  all.files.flatMap((file, index) => file.tables.map(table => ({id: (all.files.length > 1 ? "AB"[index] + " " : "") + table.aspect, table})))
    .filter(one => !listOf(now, "no-targets").includes(one.table.aspect));

/// For makeState.
export function choicesOf(all) {
  const modelled = all.axes.filter(axis => axis.id.startsWith("cycles-"));
  const first = {
    error: all.errors.length > 0 ? all.errors[0].id : "", signal: "worst", colour: "format", find: "", linear: "", fronts: "",
    counter: "largest", stall: "", theme: "system", rows: "",
    "ask-order": all.orders.includes("0.5") ? "0.5" : all.orders[0] || "", "ask-error": "1e-2", "ask-target": (decidingCost(all) || {id: ""}).id,
    orders: all.orders.slice(0, 4).join(","),
    axes: all.axes.filter(axis => !axis.extra && (axis.id !== "instructions" || modelled.length === 0) &&
                                  (modelled.length === 0 || !axis.id.startsWith("cycles-") || axis === modelled[0])).map(axis => axis.id).join(","),
    "no-targets": "", "no-taps": "", "no-format": "", "no-history": "", "no-technique": "", lit: ""
  };
  const known = {
    error: all.errors.map(error => error.id), signal: ["worst", ...all.signals], colour: Object.keys(all.words), theme: ["system", "light", "dark"],
    "ask-order": all.orders, "ask-error": limits, "ask-target": costsOf(all).map(axis => axis.id)
  };
  // Of the stalls the case of a length near 600 taps.
  const stallCases = new Set(all.stalls.map(one => one.id));
  const away = id => Math.abs(all.lengths.get(id.split("|")[1]) - 600);
  const nearest = [...stallCases].sort((a, b) => away(a) - away(b))[0] || "";
  const usual = now => {
    const tables = tablesOf(all, now);
    return {stall: nearest, rows: tables.length > 0 ? tables[0].id : ""};
  };
  const settle = now => {
    const settled = {...now};
    for (const name in known) {
      if (!known[name].includes(now[name])) settled[name] = first[name];
    }
    if (!stallCases.has(now.stall)) settled.stall = nearest;
    if (!tablesOf(all, now).some(one => one.id === now.rows)) settled.rows = usual(now).rows;
    return settled;
  };
  return {first, settle, usual};
}
