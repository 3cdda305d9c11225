// The page's one state: each choice as a text by its name, and the kernel that is pointed at. It changes in one way, change(), after
// which listeners are told what is new. Choices that are not as at first stand in the page's address.

/// A choice that lists several: of these the texts.
export const listOf = (now, name) => now[name] === "" ? [] : now[name].split(",");

const flipped = (list, value) => list.includes(value) ? list.filter(other => other !== value) : [...list, value];

/// first: every choice as at first. settle(now): now without choices that cannot be. usual(now): what stands in no address, where that
/// depends on other choices.
export function makeState({first, settle, usual}) {
  const listeners = [];
  const settled = values => Object.freeze(settle({...values, under: values.under || ""}));
  let now = settled(first);

  const take = next => {
    const before = now;
    now = settled(next);
    const changed = Object.keys(now).filter(name => now[name] !== before[name]);
    if (changed.length > 0) listeners.forEach(listener => listener(changed, now, before));
  };
  const state = {
    get now() { return now; },
    listen: listener => { listeners.push(listener); },
    /// Whatever else is chosen, no kernel is pointed at after it.
    change: values => take({...now, under: "", ...values}),
    flip: (name, value) => state.change({[name]: flipped(listOf(now, name), value).join(",")}),
    /// As at first, but for what is named.
    reset: kept => take({...first, [kept]: now[kept]}),
    /// What an address says, without its "#"; names that it does not know are left alone.
    read: text => {
      const said = [...new URLSearchParams(text)].filter(([name]) => Object.hasOwn(first, name));
      take({...first, ...Object.fromEntries(said)});
    },
    get address() {
      const plain = {...first, ...usual(now)};
      return new URLSearchParams(Object.keys(first).filter(name => now[name] !== plain[name]).map(name => [name, now[name]])).toString();
    }
  };
  return state;
}
