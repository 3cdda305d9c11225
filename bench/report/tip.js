// The tip: what is told of a point or a bar, beside it.

/// What the tip says: [title, [[name, value]...]], at a place of the window.
export function showTip([title, rows], x, y) {
  const tip = d3.select("#tip").attr("hidden", null);
  tip.selectAll("*").remove();
  tip.append("strong").text(title);
  const list = tip.append("dl");
  for (const [name, value] of rows) {
    list.append("dt").text(name);
    list.append("dd").text(value);
  }
  const box = tip.node().getBoundingClientRect();
  const left = x + 16 + box.width < document.documentElement.clientWidth ? x + 16 : Math.max(4, x - 16 - box.width);
  const top = Math.max(4, Math.min(y - box.height / 2, document.documentElement.clientHeight - box.height - 4));
  tip.style("left", left + "px").style("top", top + "px");
}

export const hideTip = () => d3.select("#tip").attr("hidden", true);
