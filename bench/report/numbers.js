// Numbers as a person reads them.

const superscript = text => String(text).replace(/[-\d]/g, c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]);
export const grouped = d3.format(",");

export function show(value) {
  if (value === undefined || Number.isNaN(value)) return "";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e9) return value.toExponential(3);
  if (Number.isInteger(value)) return grouped(value);
  return size >= 1000 ? grouped(Number(value.toFixed(1))) : String(Number(value.toPrecision(4)));
}

export function tick(value) {
  if (value === 0) return "0";
  if (value >= 1e6) return Number((value / 1e6).toPrecision(3)) + "M";
  if (value >= 1e3) return Number((value / 1e3).toPrecision(3)) + "k";
  return value >= 0.01 ? String(Number(value.toPrecision(3))) : value.toExponential(0);
}

export const tenTo = exponent => exponent === 0 ? "1" : "10" + superscript(exponent);
