/** The questions of `ambrig new` and what may be answered. */
import {significant} from './numbers.js';

/**
 * @typedef {{key: string, unit: string, doc: string, lo: number, hi: number, fallback: number|null}} Question
 * @typedef {{name: string, doc: string, numbers: Question[]}} Template
 */

/** What is wrong with an answer; "": nothing. @param {Question} q @param {string} text */
export function complaint(q, text) {
  if (text.trim() === '') return q.fallback === null ? 'is needed' : '';
  const v = Number(text);
  if (!Number.isFinite(v)) return 'is no number';
  return v < q.lo || v > q.hi ? `allowed: ${significant(q.lo, 3)} to ${significant(q.hi, 3)} ${q.unit}` : '';
}
