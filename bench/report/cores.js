// The question under the first one, "which core can afford it?": what is cheapest within the error on each modelled core, on all of them.
// Of files with rows of one emulated machine alone there is none.

import {cheapest, unfiltered} from "./answer.js";
import {bytesOf} from "./data.js";
import {show} from "./numbers.js";
import {placed, pointsOf} from "./select.js";

const stepsPerSecond = 1000;  // at which a share of real time is told

const coreOf = axis => axis.aspect.slice(axis.aspect.indexOf(":") + 1);
const machineOf = axis => axis.aspect.slice(0, axis.aspect.indexOf(":"));

// What a kernel takes on a core: of its row there, the time at the core's clock. The share is of the band's upper end.
function takenOn(axis, point, chosenThere) {
  const row = point.found.m7[axis.aspect] || {};
  const high = row.model_cycles_high ?? row.model_cycles_per_sample;
  return {machine: machineOf(axis), core: coreOf(axis), kernel: point.kernel, taps: point.taps, cycles: row.model_cycles_per_sample, high,
          us: row.real_time / 1e3, share: row.real_time / 1e9 * high / row.model_cycles_per_sample * stepsPerSecond,
          bytes: bytesOf(point.found), mark: chosenThere ? "chosen" : ""};
}

/// {text, columns, rows: a line for each core of each kernel that is cheapest on one, marked where it is}; null where none is to be shown.
export function coresOf(all, now) {
  const axes = all.axes.filter(axis => axis.id.startsWith("cycles-"));
  if (new Set(axes.map(machineOf)).size < 2 || all.files.length > 1) return null;
  const order = now["ask-order"], limit = Number(now["ask-error"]);
  const points = pointsOf(all, unfiltered(all, now), all.files[0], order);
  const named = point => point.kernel + "/" + point.taps;
  const bests = axes.map(axis => [axis, cheapest(placed(points, axis), limit)]).filter(([, best]) => best);
  if (bests.length === 0) return null;
  const chosenOn = axis => bests.filter(([one]) => one === axis).map(([, best]) => named(best));
  const shown = [...new Map(bests.map(([, best]) => [named(best), best])).values()];
  const share = row => Number.isNaN(row.share) ? "" : `${Number((100 * row.share).toPrecision(2))} %`;
  return {
    text: "What is cheapest on one core is shown on the others; marked where it is chosen. At most: the band's upper end, of which the share of " +
      `real time is, at ${stepsPerSecond / 1000} kHz and the core's clock.`,
    columns: [
      {title: "core", text: row => `${row.machine.toUpperCase()} ${row.core}`}, {title: "kernel", text: row => row.kernel}, {title: "taps", text: row => row.taps},
      {title: "model cycles per sample", text: row => show(row.cycles), number: row => row.cycles},
      {title: "at most", text: row => show(row.high), number: row => row.high},
      {title: "us", text: row => show(Number(row.us.toPrecision(3))), number: row => row.us},
      {title: "bytes", text: row => show(row.bytes), number: row => row.bytes},
      {title: "of real time", text: share, number: row => row.share}
    ],
    rows: shown.flatMap(point => axes.map(axis => takenOn(axis, point, chosenOn(axis).includes(named(point)))))
  };
}
