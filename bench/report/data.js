// The rows of a result file, out of the columns that the page holds, and what each kernel does in them.

function decodeBytes(text) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes.buffer;
}

// One letter of base64's alphabet each.
function decodeLetters(text) {
  const alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/", place = new Uint8Array(128);
  for (let i = 0; i < alphabet.length; ++i) place[alphabet.charCodeAt(i)] = i;
  return Uint8Array.from(text, letter => place[letter.charCodeAt(0)]);
}

// The upper three bytes of each float: four digits and a half.
function decodeFloats24(text) {
  const upper = new Uint8Array(decodeBytes(text)), whole = new Uint8Array(upper.length / 3 * 4);
  for (let i = 0; i < upper.length; ++i) whole[Math.floor(i / 3) * 4 + 1 + i % 3] = upper[i];
  return Array.from(new Float32Array(whole.buffer), value => Number(value.toPrecision(5)));
}

// What a column's encoding leaves open of a number, relative to it: three bytes of a float, all of it, or nothing.
const resolutionOf = column => column.float24 ? 2 ** -15 : column.float32 ? 2 ** -23 : 0;

// A column as a function of the row, decoded when it is first asked: a text, a number or NaN.
function decodeColumn(column) {
  const values = (column.values || []).map(value => value === null ? NaN : value);
  if (!column.float32 && !column.float24 && !column.at) {
    return () => values[0];
  }
  if (column.float24) {
    let numbers = null;
    return row => (numbers = numbers || decodeFloats24(column.float24))[row];
  }
  const Cells = column.float32 ? Float32Array : {8: Uint8Array, 16: Uint16Array, 32: Uint32Array}[column.bits];
  let cells = null;
  const decoded = () => cells = column.bits === 6 ? decodeLetters(column.at)
                                                  : new Cells(decodeBytes(column.float32 || column.at));
  return column.float32 ? row => (cells || decoded())[row] : row => values[(cells || decoded())[row]];
}

function decodeTable(table) {
  const decoded = {aspect: table.aspect, rows: table.rows, text: {}, number: {}, resolution: {}};
  for (const name in table.texts) {
    decoded.text[name] = decodeColumn(table.texts[name]);
  }
  for (const name in table.numbers) {
    decoded.number[name] = decodeColumn(table.numbers[name]);
    decoded.resolution[name] = resolutionOf(table.numbers[name]);
  }
  return decoded;
}

export const textOf = (table, name, row) => table.text[name] ? table.text[name](row) : "";
export const numberOf = (table, name, row) => table.number[name] ? table.number[name](row) : NaN;

// "2+7" are two taps and seven modes: nine of something.
export const tapsNumber = (taps, samples, longest) =>
  taps === "full" ? samples || longest * 1.7 : d3.sum(taps.split("+"), part => /^\d+$/.test(part) ? Number(part) : NaN) || NaN;

const wholeSignal = signal => !signal.includes(",");  // the amplitude sweep is another question

/// What each kernel does at each order and length of one file, whatever the signal: cases[order][kernel][taps] =
/// {kernel, order, taps, at: number of taps, accuracy: table, signals: {signal: its row}, host, m7: {aspect of an emulated core: counters}, fault}.
export function joinFile(file, ofTheClock) {
  const tables = file.tables.map(decodeTable);
  const accuracy = tables.find(table => table.aspect === "accuracy");
  const samples = file.context.n_samples;
  const cases = new Map();
  const allTaps = new Set();
  const host = new Map();  // by kernel and taps: one order serves all
  const kernels = new Set();
  for (const table of tables) {
    for (let row = 0; row < table.rows && table.text.taps; ++row) {
      allTaps.add(table.text.taps(row));
    }
  }
  const longest = d3.max([...allTaps].filter(taps => taps !== "full"), taps => tapsNumber(taps)) || 1;
  const lengths = new Map([...allTaps].map(taps => [taps, tapsNumber(taps, samples, longest)]).sort((a, b) => a[1] - b[1]));
  const caseOf = (table, row) => {
    const order = table.text.order(row), kernel = table.text.kernel(row), taps = table.text.taps(row);
    if (!cases.has(order)) cases.set(order, new Map());
    const byKernel = cases.get(order);
    if (!byKernel.has(kernel)) byKernel.set(kernel, new Map());
    const byTaps = byKernel.get(kernel);
    if (!byTaps.has(taps)) {
      byTaps.set(taps, {kernel, order, taps, at: lengths.get(taps), accuracy, signals: {}, m7: {}, fault: ""});
    }
    kernels.add(kernel);
    return byTaps.get(taps);
  };
  for (const table of tables) {
    if (!table.text.kernel) continue;
    const names = Object.keys(table.number);
    const counters = row => {
      const found = {};
      for (const name of names) {
        const value = table.number[name](row);
        if (!Number.isNaN(value)) found[name] = value;
      }
      return found;
    };
    for (let row = 0; row < table.rows; ++row) {
      const fault = textOf(table, "fault", row);
      if (table.aspect === "host") {
        const key = table.text.kernel(row) + "/" + table.text.taps(row);
        if (!host.has(key)) host.set(key, {repetitions: [], fault: ""});
        if (fault) host.get(key).fault = fault; else host.get(key).repetitions.push(counters(row));
        kernels.add(table.text.kernel(row));
        continue;
      }
      const found = caseOf(table, row);
      if (fault) {
        found.fault = table.aspect + ": " + fault;
      } else if (table.aspect === "accuracy") {
        found.signals[textOf(table, "signal", row)] = row;
      } else {
        found.m7[table.aspect] = counters(row);
      }
    }
  }
  for (const byKernel of cases.values()) {
    for (const byTaps of byKernel.values()) {
      for (const found of byTaps.values()) {
        const timed = host.get(found.kernel + "/" + found.taps);
        if (!timed) continue;
        if (timed.fault) found.fault = found.fault || "host: " + timed.fault;
        if (timed.repetitions.length > 0) {
          found.host = {...timed.repetitions[0]};
          for (const counter of ofTheClock) {
            const value = d3.median(timed.repetitions, repetition => repetition[counter]);
            if (value !== undefined) found.host[counter] = value;
          }
        }
      }
    }
  }
  return {name: file.name, context: file.context, bounds: file.bounds, tables, cases, kernels: [...kernels], lengths,
          samples};
}

/// A counter of a case at a signal; undefined without it.
export function accuracyOf(found, signal, counter) {
  const row = found.signals[signal], cells = found.accuracy && found.accuracy.number[counter];
  const value = row === undefined || !cells ? NaN : cells(row);
  return Number.isNaN(value) ? undefined : value;
}

/// The error of a case for one signal, or the worst of the signals: {value, signal}; undefined if there is none.
export function errorOf(found, counter, signal) {
  if (signal !== "worst") {
    const value = accuracyOf(found, signal, counter);
    return value === undefined ? undefined : {value, signal};
  }
  let worst;
  for (const name in found.signals) {
    const value = accuracyOf(found, name, counter);
    if (wholeSignal(name) && value !== undefined && (!worst || value > worst.value)) {
      worst = {value, signal: name};
    }
  }
  return worst;
}

// What does not depend on the signal, at the first one.
export const atFirstSignal = (found, counter) => accuracyOf(found, Object.keys(found.signals)[0], counter);

// State and coefficients, on the target where the kernel runs there.
export function bytesOf(found) {
  for (const counters of [...Object.values(found.m7), found.host || {}]) {
    if (counters.state_bytes !== undefined && counters.coefficient_bytes !== undefined) {
      return counters.state_bytes + counters.coefficient_bytes;
    }
  }
  const [state, coefficients] = [atFirstSignal(found, "state_bytes"), atFirstSignal(found, "coefficient_bytes")];
  return state === undefined || coefficients === undefined ? undefined : state + coefficients;
}

/// What an error is drawn against: {id, title, unit, aspect, cost(case), band(case)}.
export function axesOf(files) {
  // The Cortex-M7's first, where there are others too.
  const aspects = [...new Set(files.flatMap(file => file.tables.map(table => table.aspect)))].filter(a => /^m[0-9]+:/.test(a))
    .sort((a, b) => d3.descending(a.slice(0, 2), b.slice(0, 2)));
  const has = (aspect, counter) =>
    files.some(file => file.tables.some(table => table.aspect === aspect && table.number[counter]));
  const axes = [{id: "taps", title: "memory length", unit: "taps", cost: found => found.at}];
  if (files.some(file => file.tables.some(table => table.aspect === "host"))) {
    axes.push({id: "host", aspect: "host", title: "host time", unit: "ns per sample", cost: found => found.host && found.host.real_time});
    if (has("host", "cycles_per_sample")) {
      axes.push({id: "host-cycles", aspect: "host", title: "host cycles", unit: "cycles per sample", extra: true,
                 cost: found => found.host && found.host.cycles_per_sample});
    }
  }
  for (const aspect of aspects) {
    if (has(aspect, "model_cycles_per_sample")) {
      axes.push({id: "cycles-" + aspect, aspect, title: "modelled cycles, " + aspect.slice(3), unit: "model cycles per sample",
                 cost: found => found.m7[aspect] && found.m7[aspect].model_cycles_per_sample,
                 band: found => found.m7[aspect] && found.m7[aspect].model_cycles_low !== undefined &&
                   found.m7[aspect].model_cycles_high !== undefined &&
                   [found.m7[aspect].model_cycles_low, found.m7[aspect].model_cycles_high]});
    }
  }
  const counted = aspects.find(aspect => has(aspect, "instructions_per_sample"));
  if (counted) {
    const core = counted.slice(0, 3);
    axes.push({id: "instructions", aspect: counted, title: "instructions, emulated Cortex-" + core.slice(0, 2).toUpperCase(),
               unit: "instructions per sample, not cycles",
               cost: found => {
                 const row = Object.entries(found.m7).filter(([aspect]) => aspect.startsWith(core)).map(([, counters]) => counters)
                   .find(counters => counters.instructions_per_sample !== undefined);
                 return row && row.instructions_per_sample;
               }});
  }
  axes.push({id: "bytes", title: "bytes", unit: "bytes of state and coefficients", cost: bytesOf});
  return axes;
}
