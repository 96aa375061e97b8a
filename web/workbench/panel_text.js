/** What is said of panels: the cursors A and B, statistics between them, values at the cursor. */
import {prefixFor, significant} from './numbers.js';

/** Indices of the values in [from, to] of ascending times. @param {number[]} time @param {number} from @param {number} to */
export function within(time, from, to) {
  const lower = (/** @type {number} */ t) => {
    let lo = 0, hi = time.length;
    while (lo < hi) {
      const middle = (lo + hi) >> 1;
      if (time[middle] < t) lo = middle + 1;
      else hi = middle;
    }
    return lo;
  };
  return {first: lower(from), last: lower(to + 1e-12)};
}

/** Index of the time next to t. @param {number[]} time ascending @param {number} t */
export function indexNear(time, t) {
  const {first} = within(time, t, t);
  if (first === 0) return 0;
  return first < time.length && time[first] - t < t - time[first - 1] ? first : first - 1;
}

/** A line of a panel, said once. @param {string} title of the panel @param {string} label */
export function lineName(title, label) {
  return title.endsWith(label) ? title : `${title} ${label}`;
}

/** @param {(number|null)[]} values @param {number} first @param {number} last */
export function statistics(values, first, last) {
  let n = 0, sum = 0, square = 0, peak = 0;
  for (let k = first; k < last; ++k) {
    const v = values[k];
    if (v === null || v === undefined) continue;
    ++n;
    sum += v;
    square += v * v;
    peak = Math.max(peak, Math.abs(v));
  }
  return n === 0 ? null : {mean: sum / n, rms: Math.sqrt(square / n), peak};
}

/** @param {Record<string, number>} marks [s] */
export function marksText(marks) {
  const texts = Object.entries(marks).map(([n, at]) => `${n} ${at.toFixed(5)} s`);
  const {A, B} = marks;
  if (A !== undefined && B !== undefined && A !== B) texts.push(`dt ${significant(B - A, 4)} s, 1/dt ${significant(Math.abs(1 / (B - A)), 4)} Hz`);
  return texts.join('   ');
}

/**
 * Of every line between the marks: difference, and where the samples themselves are shown mean, rms and peak.
 * @param {Record<string, number>} marks @param {number[]} time @param {{label: string, values: (number|null)[], unit: string}[]} lines @param {boolean} samples
 */
export function betweenText(marks, time, lines, samples) {
  const {A, B} = marks;
  if (A === undefined || B === undefined || A === B || time.length === 0) return '';
  const {first, last} = within(time, Math.min(A, B), Math.max(A, B));
  return lines.map((l) => {
    const p = prefixFor(Math.max(...l.values.slice(first, last).map((v) => Math.abs(v ?? 0)), 0), l.unit);
    const shown = (/** @type {number} */ v) => significant(v * p.factor, 3);
    const s = statistics(l.values, first, last);
    if (!s) return `${l.label}: no sample counts`;
    const a = l.values[Math.min(first, l.values.length - 1)], b = l.values[Math.max(0, last - 1)];
    const dy = a !== null && b !== null ? `dy ${shown(B > A ? b - a : a - b)}, ` : '';
    return `${l.label}: ${samples ? `${dy}mean ${shown(s.mean)}, rms ${shown(s.rms)}, ` : ''}peak ${shown(s.peak)}${p.unit ? ' ' + p.unit : ''}`;
  }).join('; ');
}

/** Values of another time base at these times: the nearest sample, never one between. @param {number[]} time @param {number[]} from @param {(number|null)[]} values */
export function nearest(time, from, values) {
  let k = 0;
  const reach = from.length > 1 ? (from[from.length - 1] - from[0]) / (from.length - 1) : 0;
  return time.map((t) => {
    while (k + 1 < from.length && Math.abs(from[k + 1] - t) <= Math.abs(from[k] - t)) ++k;
    return Math.abs(from[k] - t) <= reach ? values[k] : null;
  });
}
