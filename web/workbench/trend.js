/** The records of a watched folder as lines over time. What is computed; trend_screen.js draws it. */

/**
 * @typedef {{value: number, sd: number, unit: string, was?: number, least?: number, greatest?: number, sds?: number}} Parameter
 * @typedef {{data: string, of: string, changed: number, state: string, ratio?: number, ratio_fitted?: number, explained?: number,
 *            parameters?: Record<string, Parameter>, left: {kind: string, name: string, text: string}[], error?: string,
 *            data_faults?: {text: string, mend: string}[], explanation?: {verdict: string, text: string, of?: string,
 *            adopted?: {effect: string, target: string}[]}}} WatchedRecord
 */

/** Largest change of every parameter in sd, those that moved most first. @param {WatchedRecord[]} records */
export function moved(records) {
  const most = new Map();
  for (const r of records)
    for (const [path, p] of Object.entries(r.parameters ?? {})) most.set(path, Math.max(most.get(path) ?? 0, Math.abs(p.sds ?? 0)));
  return [...most].map(([path, sds]) => ({path, sds})).sort((a, b) => b.sds - a.sds);
}

/**
 * Points of one number of the records; those that have none are left out.
 * @param {WatchedRecord[]} records @param {(r: WatchedRecord) => number|undefined|null} of
 */
export function pointsOf(records, of) {
  return records.flatMap((r, k) => {
    const v = of(r);
    return typeof v === 'number' && Number.isFinite(v) ? [{k, v, r}] : [];
  });
}

/**
 * Where values stand in a drawing of this height, the least below. @param {number[]} values @param {number} height
 * @returns {{y: (v: number) => number, least: number, most: number}}
 */
export function scaleFor(values, height) {
  let least = Math.min(...values), most = Math.max(...values);
  const room = most > least ? 0.08 * (most - least) : Math.max(Math.abs(most), 1) * 0.1;
  least -= room;
  most += room;
  return {y: (v) => height * (1 - (v - least) / (most - least)), least, most};
}

/** What a person should look at, newest first. @param {WatchedRecord[]} records */
export function alarms(records) {
  return records.filter((r) => r.state !== 'ok').reverse();
}
