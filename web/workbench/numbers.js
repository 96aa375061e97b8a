/** Numbers as people read them: one prefix, digits that mean something. */

const prefixes = /** @type {[number, string][]} */ ([
  [1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, '\u00b5'], [1e-9, 'n'],
]);
/** Units that take a prefix. */
const prefixed = new Set(['m', 's', 'N', 'A', 'V', 'Hz', 'W', 'H', 'ohm', 'N/m', 'N s/m', 'N m', 'Wb', 'T']);

/**
 * The prefix for a largest value.
 * @param {number} largest in the unit @param {string} unit SI
 * @returns {{factor: number, unit: string}} value times factor is in the unit returned
 */
export function prefixFor(largest, unit) {
  if (!prefixed.has(unit) || !Number.isFinite(largest) || largest === 0) return {factor: 1, unit: unit === '-' ? '' : unit};
  for (const [size, name] of prefixes)
    if (Math.abs(largest) >= size * 0.9995) return {factor: 1 / size, unit: name + unit};
  return {factor: 1e9, unit: 'n' + unit};
}

/** @param {number} value @param {number} digits */
export function significant(value, digits = 3) {
  if (!Number.isFinite(value)) return value === Infinity ? 'infinite' : '-';
  if (value === 0) return '0';
  const size = Math.floor(Math.log10(Math.abs(Number(value.toPrecision(digits)))));  // 9.9996 is 10.00
  if (size < -4 || size > 5) return value.toExponential(digits - 1);
  return value.toFixed(Math.max(0, digits - 1 - size));
}

/** @param {number} value @param {string} unit SI @param {number} digits */
export function quantity(value, unit, digits = 3) {
  const p = prefixFor(value, unit);
  return significant(value * p.factor, digits) + (p.unit ? ' ' + p.unit : '');
}

/** Value and sd, both to two digits of the sd. @param {number} value @param {number} sd @param {string} unit */
export function uncertain(value, sd, unit) {
  if (!(sd > 0)) return quantity(value, unit, 4);
  const p = prefixFor(value, unit);
  const s = sd * p.factor;
  const places = Math.max(0, 1 - Math.floor(Math.log10(s)));
  return `${(value * p.factor).toFixed(places)} \u00b1 ${s.toFixed(places)}${p.unit ? ' ' + p.unit : ''}`;
}

/** A probability is never certain. @param {number} p */
export function probability(p) {
  if (p > 0.99) return '> 0.99';
  if (p < 0.01) return '< 0.01';
  return p.toFixed(2);
}

/** Error over noise. JSON has no infinity: it is the word "inf" there. @param {number|string|null|undefined} r */
export function ratio(r) {
  if (r === 'inf') return 'infinite';
  if (typeof r !== 'number') return '-';
  return r >= 9.95 ? r.toFixed(0) : r.toFixed(1);
}

/** @param {number} seconds */
export function duration(seconds) {
  if (seconds < 90) return `${Math.max(0, Math.round(seconds))} s`;
  return `${Math.round(seconds / 60)} min`;
}
