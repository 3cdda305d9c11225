// The table of counters, as the page's data bring it from counters.def, by what the page asks of it.

/// \param table  [{name, family, is_time, unit, layer, better, compared, drawn, title, meaning}]
export function countersOf(table) {
  const names = wanted => table.filter(wanted).map(counter => counter.name);
  const times = table.filter(counter => counter.is_time);
  return {
    compared: names(counter => counter.compared),
    ofTheClock: names(counter => counter.layer === "host_time"),
    drawn: table.filter(counter => counter.drawn).map(counter => ({id: counter.name, title: counter.title, text: counter.meaning})),
    /// Which way is better: "lower", "higher", "equal" or "neither".
    betterOf: name => (table.find(counter => counter.name === name) || {better: "neither"}).better,
    stall: table.find(counter => counter.family).name,
    /// A time of a row of another aspect than the host's is none.
    isTold: (name, aspect) => aspect === "host" || !times.some(counter => counter.name === name),
    titleOf: name => times.filter(counter => counter.name === name).map(counter => `${name} (${counter.unit})`)[0] || name
  };
}
