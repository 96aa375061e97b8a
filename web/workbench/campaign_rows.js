/** The rows of a campaign: parsed, counted by set and load, filtered. What is computed; campaign_screen.js draws it. */

/**
 * @typedef {{run: number, set: string, kind: string, speed: number, load: number, verdict: string, orbit: number, delay: number, note: string, scenario: string}} Row
 */

/** Rows of the journal. @param {string[]} lines CSV @param {string[]} columns @returns {Row[]} */
export function parseRows(lines, columns) {
  const at = (/** @type {string} */ name) => columns.findIndex((c) => c === name || c.startsWith(name + ' ['));
  const [run, set, kind, speed, given, load, verdict, orbit, delay, note, scenario] =
    ['run', 'set', 'kind', 'speed', 'load_given', 'load', 'verdict', 'peak_orbit', 'detection_delay', 'note', 'scenario'].map(at);
  return lines.map((line) => {
    const c = line.split(',');
    const number = (/** @type {number} */ k) => (k >= 0 && c[k] !== '' ? Number(c[k]) : NaN);
    return {run: number(run), set: c[set] ?? '', kind: c[kind] ?? '', speed: number(speed),
            load: Number.isNaN(number(given)) ? number(load) : number(given), verdict: c[verdict] ?? '', orbit: number(orbit),
            delay: number(delay), note: c[note] ?? '', scenario: c[scenario] ?? ''};
  });
}

/** Worst first. */
export const verdicts = ['drop', 'error', 'touchdown', 'up'];

/** A verdict as sign and word. @param {string} verdict */
export function verdictText(verdict) {
  return {drop: '\u2716 dropped', error: '? not finished', touchdown: '! touched', up: '\u2714 up'}[verdict] ?? verdict;
}

/**
 * @typedef {{set: string, load: number, total: number, counts: Record<string, number>}} Cell
 * @param {Row[]} rows @returns {{sets: string[], loads: number[], cells: Map<string, Cell>}} cells by "set|load"
 */
export function mapOf(rows) {
  const cells = new Map();
  const sets = new Set(), loads = new Set();
  for (const r of rows) {
    sets.add(r.set);
    loads.add(r.load);
    const key = `${r.set}|${r.load}`;
    let cell = cells.get(key);
    if (!cell) cells.set(key, (cell = {set: r.set, load: r.load, total: 0, counts: {}}));
    ++cell.total;
    cell.counts[r.verdict] = (cell.counts[r.verdict] ?? 0) + 1;
  }
  const bySize = (/** @type {string} */ a, /** @type {string} */ b) => a.split('+').length - b.split('+').length || a.localeCompare(b, 'en', {numeric: true});
  return {sets: [...sets].sort(bySize), loads: [...loads].sort((a, b) => a - b), cells};
}

/** @param {Row[]} rows */
export function countOf(rows) {
  const counts = /** @type {Record<string, number>} */ ({});
  for (const r of rows) counts[r.verdict] = (counts[r.verdict] ?? 0) + 1;
  return counts;
}

/**
 * @typedef {{set: string|null, load: number|null, verdict: string|null, from: number|null, to: number|null}} Filter  from, to: of the orbit [m]
 * @param {Row[]} rows @param {Filter} f
 */
export function filtered(rows, f) {
  return rows.filter((r) => (f.set === null || r.set === f.set) && (f.load === null || r.load === f.load) &&
    (f.verdict === null || r.verdict === f.verdict) && (f.from === null || r.orbit >= f.from) && (f.to === null || r.orbit <= f.to));
}

/** Counts of the orbits in equal bins. @param {Row[]} rows @param {number} bins */
export function histogram(rows, bins) {
  let most = 0;
  for (const r of rows) if (r.orbit > most) most = r.orbit;
  const counts = new Array(bins).fill(0);
  if (most > 0) for (const r of rows) if (r.orbit >= 0) ++counts[Math.min(bins - 1, Math.floor((r.orbit / most) * bins))];
  return {most, counts};
}

/** Share of a cell that did not stay up, 0 to 1. @param {Cell} cell */
export function failedShare(cell) {
  return cell.total === 0 ? 0 : 1 - (cell.counts.up ?? 0) / cell.total;
}
