// Tables: sorted by a click on a head, shown in parts.

import {grouped} from "./numbers.js";

const pageRows = 100;

// A narrow screen breaks a kernel's name between its words.
function write(cell, text) {
  String(text ?? "").split(/(?<=_)/).forEach((word, index) => cell.append(...(index ? [document.createElement("wbr"), word] : [word])));
}

/// columns: {title, text(row), number(row) or none}; rows: any list; the order of the list stands until a head is clicked.
export function drawTable(node, label, columns, rows) {
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
        write(line.append("td").attr("class", column.number ? "number" : null).node(), column.text(row));
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
