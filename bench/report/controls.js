// The page's controls: what they show is the state's, and what a reader does with them changes it.

import {costsOf, limits, limitText} from "./answer.js";
import {listOf} from "./state.js";

const plain = values => values.map(value => ({id: value, text: value}));

function chips(state, id, name, values, off) {  // off: the state lists what is not shown
  const chosen = value => listOf(state.now, name).includes(value.id) !== off;
  const labels = d3.select("#" + id).selectAll("label").data(values, value => value.id);
  const fresh = labels.enter().append("label").attr("class", "chip");
  fresh.append("input").attr("type", "checkbox").attr("value", value => value.id).on("change", value => state.flip(name, value.id));
  fresh.append("span").text(value => value.text);
  fresh.merge(labels).select("input").property("checked", chosen);
}

function options(state, id, name, values) {
  const select = d3.select("#" + id);
  select.selectAll("option").data(values, value => value.id).enter().append("option")
    .attr("value", value => value.id).text(value => value.text);
  select.property("value", state.now[name]).on("change", function() { state.change({[name]: this.value}); });
}

/// The question on top.
export function drawQuestion(all, state) {
  options(state, "ask-order", "ask-order", plain(all.orders));
  options(state, "ask-error", "ask-error", limits.map(id => ({id, text: limitText(id)})));
  options(state, "ask-target", "ask-target", costsOf(all).map(axis => ({id: axis.id, text: axis.title})));
}

export function drawControls(all, state) {
  options(state, "error", "error", all.errors.map(error => ({id: error.id, text: error.title})));
  options(state, "signal", "signal", [{id: "worst", text: "worst of the signals"}, ...plain(all.signals)]);
  chips(state, "orders", "orders", plain(all.orders), false);
  chips(state, "axes", "axes", all.axes.map(axis => ({id: axis.id, text: axis.title})), false);
  chips(state, "targets", "no-targets", plain(all.targets), true);
  chips(state, "taps", "no-taps", plain([...all.taps].sort((a, b) => all.lengths.get(a) - all.lengths.get(b))), true);
  for (const word in all.words) chips(state, "words-" + word, "no-" + word, plain(all.words[word]), true);
  d3.select("#colour").property("value", state.now.colour).on("change", function() { state.change({colour: this.value}); });
  d3.select("#find").property("value", state.now.find).on("input", function() { state.change({find: this.value.trim()}); });
  for (const name of ["linear", "fronts"]) {
    d3.select("#" + name).property("checked", state.now[name] === "yes")
      .on("change", function() { state.change({[name]: this.checked ? "yes" : ""}); });
  }
  d3.select("#reset").on("click", () => state.reset("theme"));
}

/// The case of the stalls, the counter of the differences, and the table of the rows.
export const drawStallCase = (state, cases) => options(state, "stall-case", "stall", cases);
export const drawCounter = (state, counters) => options(state, "counter", "counter", [{id: "largest", text: "any"}, ...plain(counters)]);

export function drawTabs(state, ids) {
  const tabs = d3.select("#row-aspects").selectAll("button").data(ids, id => id);
  tabs.exit().remove();
  tabs.enter().append("button").attr("type", "button").text(id => id).on("click", id => state.change({rows: id}))
    .merge(tabs).attr("aria-pressed", id => String(id === state.now.rows));
}

const schemes = {system: "light", light: "dark", dark: "system"};

export function drawTheme(state) {
  document.documentElement.dataset.theme = state.now.theme;
  d3.select("#theme").text("Scheme: " + state.now.theme).on("click", () => state.change({theme: schemes[state.now.theme]}));
}
