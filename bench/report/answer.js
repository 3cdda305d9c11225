// The question on top, "which kernel is the cheapest within this error?", and its answer: plain values, as in select.js. The filters
// below narrow what is drawn there; what is cheapest does not depend on them.

import {bytesOf} from "./data.js";
import {show} from "./numbers.js";
import {describe, placed, pointsOf} from "./select.js";

/// What may be asked.
export const limits = ["1e-1", "5e-2", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6"];
export const costsOf = all => all.axes.filter(axis => axis.id !== "taps");

/// As the terminal's tables decide: modelled cycles of the first core, else instructions, else the host's time, else bytes.
export const decidingCost = all =>
  ["cycles-", "instructions", "host", "bytes"].map(id => all.axes.find(axis => axis.id.startsWith(id))).find(axis => axis) || null;

// As `is_window` of rows/key.hpp.
const isWindow = taps => !taps.includes("+");

// The least cost within the limit, of two that cost the same the more exact: as `cheapest` of best.hpp.
export const cheapest = (points, limit) => points.filter(point => point.y <= limit)
  .reduce((held, point) => !held || point.x < held.x || point.x === held.x && point.y < held.y ? point : held, null);

// No filter, and the error that limits are of.
export const unfiltered = (all, now) =>
  ({...now, error: "error_max", signal: "worst", find: "", ...Object.fromEntries(["taps", ...Object.keys(all.words)].map(name => ["no-" + name, ""]))});

/// With what a limit is in per cent.
export const limitText = limit => `${limit} (${Number((100 * limit).toPrecision(1))} %)`;

const lengthText = taps => taps === "full" ? "over the whole record" : `of ${taps} taps`;

function sentence(best, window, limit, order, axis) {
  if (!best) return `No kernel of this file errs ${limitText(limit)} or less at order ${order}.`;
  const what = `Within ${limitText(limit)} at order ${order} the cheapest is ${best.kernel} ${lengthText(best.taps)}: ` +
    `${show(best.x)} ${axis.unit}${best.band ? ` (${show(best.band[0])} to ${show(best.band[1])})` : ""}, error ${show(best.y)}. `;
  if (!window) return what + "No window of this file errs so little.";
  if (window === best) return what + "It is a window.";
  return what + `The cheapest window, ${window.kernel} ${lengthText(window.taps)}, takes ${show(Number((window.x / best.x).toPrecision(2)))} times as much.`;
}

/// {text, panel: as panel.js draws it, columns, rows: of the front, the answer marked}; null where no error or no cost is known.
export function answerOf(all, now) {
  const order = now["ask-order"], axis = all.axes.find(one => one.id === now["ask-target"]), limit = Number(now["ask-error"]);
  if (!axis || !all.errors.some(error => error.id === "error_max")) return null;
  const asked = unfiltered(all, now);
  const points = placed(pointsOf(all, asked, all.files[0], order), axis);
  if (points.length === 0) return null;
  const best = cheapest(points, limit), window = cheapest(points.filter(point => isWindow(point.taps)), limit);
  const front = points.filter(point => point.front).sort((a, b) => a.x - b.x || b.y - a.y);
  const onFront = [...new Set(front.map(point => point.kernel))];
  const byKernel = d3.nest().key(point => point.kernel).entries(points);
  const [least, most] = d3.extent(points, point => point.x);
  return {
    text: sentence(best, window, now["ask-error"], order, axis),
    panel: {
      id: "answer", order, caption: `Total error against ${axis.title}. The front has colours and names; the rest is dimmed.`,
      label: `Order ${order}: total error against ${axis.title}.`, xTitle: axis.unit, xTicks: null, linear: false,
      yValues: [...points.map(point => point.y), limit],
      // Of the last place is what is on no front: grey.
      series: byKernel.map(({key, values}) => ({
        kernel: key, place: onFront.includes(key) ? onFront.indexOf(key) % 7 : 7, dim: !onFront.includes(key), second: false,
        points: values.sort((a, b) => a.found.at - b.found.at).map(point => ({...point, second: false}))
      })),
      lines: [{kind: "limit", text: limitText(now["ask-error"]), points: [{x: least, y: limit}, {x: most, y: limit}]}],
      describe: point => describe(all, asked, point), pinned: new Set(best ? [best.kernel] : [])
    },
    columns: [
      {title: "kernel", text: row => row.kernel}, {title: "taps", text: row => row.taps},
      {title: "error", text: row => show(row.y), number: row => row.y},
      {title: axis.unit, text: row => show(row.x), number: row => row.x},
      ...(axis.id === "bytes" ? [] : [{title: "bytes", text: row => show(bytesOf(row.found)), number: row => bytesOf(row.found)}])
    ],
    rows: front.map(point => ({...point, mark: point === best ? "chosen" : ""}))
  };
}
