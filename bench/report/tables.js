
// ---- Tables: sorted by a click on a head, shown in parts.

const pageRows = 100;

/// columns: {title, text(row), number(row) or none}; rows: any list; the order of the list stands until a head is clicked.
function drawTable(node, label, columns, rows) {
  const root = d3.select(node);
  root.selectAll("*").remove();
  const scroll = root.append("div").attr("class", "scroll").attr("tabindex", 0).attr("role", "region").attr("aria-label", label);
  const table = scroll.append("table");
  const head = table.append("thead").append("tr");
  const body = table.append("tbody");
  const more = root.append("p").attr("class", "more");
  let shown = pageRows, sorted = null, down = false, list = rows;
  const sort = index => {
    const column = columns[index];
    down = sorted === index ? !down : Boolean(column.number);
    sorted = index;
    const value = column.number || column.text;
    const direction = down ? d3.descending : d3.ascending;
    const known = v => v !== undefined && !Number.isNaN(v);
    list = [...rows].sort((a, b) => {
      const [p, q] = [value(a), value(b)];
      return known(p) && known(q) ? direction(p, q) : known(q) - known(p);
    });
    draw();
  };
  columns.forEach((column, index) => {
    head.append("th").attr("scope", "col").attr("class", column.number ? "number" : null)
      .append("button").attr("type", "button").text(column.title).on("click", () => sort(index));
  });
  function draw() {
    head.selectAll("th").attr("aria-sort", (_, index) => index !== sorted ? null : down ? "descending" : "ascending");
    body.selectAll("*").remove();
    for (const row of list.slice(0, shown)) {
      const line = body.append("tr").attr("class", row.mark || null);
      for (const column of columns) {
        line.append("td").attr("class", column.number ? "number" : null).text(column.text(row));
      }
    }
    more.selectAll("*").remove();
    more.append("span").text(`${grouped(Math.min(shown, list.length))} of ${grouped(list.length)} `);
    if (shown < list.length) {
      more.append("button").attr("type", "button").text(`Show ${grouped(Math.min(pageRows * 5, list.length - shown))} more`)
        .on("click", () => { shown += pageRows * 5; draw(); });
    }
  }
  draw();
}

// ---- Two files, row by row.

const comparable = ["error_max", "error_rms", "rounding_error_max", "truncation_error_max", "discretisation_error_max", "saturations",
  "effective_taps", "real_time", "cycles_per_sample", "instructions_per_sample", "worst_instructions", "loads_per_sample",
  "stores_per_sample", "branches_per_sample", "model_cycles_per_sample", "worst_model_cycles", "code_bytes", "stack_bytes",
  "state_bytes", "coefficient_bytes"];

// The rows of a file by what they measure: key -> {parts, counters, fault}; of repetitions the median.
function rowsByKey(file) {
  const byKey = new Map();
  for (const table of file.tables) {
    const names = comparable.filter(name => table.number[name] && (name !== "real_time" || table.aspect === "host"));
    for (let row = 0; row < table.rows; ++row) {
      const parts = {aspect: table.aspect, kernel: textOf(table, "kernel", row) || textOf(table, "name", row),
                     order: textOf(table, "order", row), taps: textOf(table, "taps", row), signal: textOf(table, "signal", row)};
      const key = Object.values(parts).join("\n");
      if (!byKey.has(key)) byKey.set(key, {...parts, counters: {}, fault: ""});
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
function differences(a, b) {
  const [rowsA, rowsB] = [rowsByKey(a), rowsByKey(b)];
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
      if (p === q) continue;
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
