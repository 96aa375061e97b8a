/** Parts of a run: verdict, events, its record's channels as panels and orbits. */
import {html, nothing} from './lit-html.js';
import {getBytes, getJson} from './api.js';
import {quantity} from './numbers.js';
import {decodeSeries} from './series.js';
import {changed, tellError} from './state.js';

/**
 * @typedef {{job: number, query: string, channels: string[], orbits: Map<string, (number|null)[][]>}} RunRecord
 */

/** The record of a job's run. @param {number} job @param {string} stem of its file */
export function queryOf(job, stem) {
  return `job=${job}&run=${encodeURIComponent(stem + '.h5')}`;
}

/** @param {string} file "a/b.toml" -> "b" */
export function stemOf(file) {
  return file.slice(file.lastIndexOf('/') + 1).replace(/\.toml$/, '');
}

/** Records that were read or are being read. @type {Map<string, RunRecord|null>} */
const records = new Map();

/** The channels and orbits of a finished run, once they are read. @param {number} job @param {string} stem @returns {RunRecord|null} */
export function recordOf(job, stem) {
  const query = queryOf(job, stem);
  if (!records.has(query)) {
    if (records.size > 30) records.clear();
    records.set(query, null);
    void readRecord(job, query);
  }
  return records.get(query) ?? null;
}

/** @param {number} job @param {string} query */
async function readRecord(job, query) {
  try {
    const about = await getJson('/api/series?' + query);
    const channels = about.channels.map((/** @type {any} */ c) => c.name);
    const orbits = new Map();
    for (const x of channels.filter((/** @type {string} */ c) => /^[^.]+\.x$/.test(c))) {
      const plane = x.slice(0, -2);
      if (!channels.includes(plane + '.y')) continue;
      const series = decodeSeries(await getBytes(`/api/series?${query}&c=${x},${plane}.y&px=10000`));
      if (series.head.mode === 'samples') orbits.set(plane, series.values);
    }
    records.set(query, {job, query, channels, orbits});
  } catch (error) {
    tellError(error);
  }
  changed();
}

/** @param {any} r the JSON of `ambrig run` */
export function verdictText(r) {
  return r.drop ? '\u2716 The rotor dropped' : r.touchdown ? '! Touched down, did not drop' : '\u2714 The rotor stayed up';
}

/** Verdict and what was done about the first fault, in a line. @param {any} r the JSON of `ambrig run` */
export function summary(r) {
  const all = /** @type {any[]} */ (r.events ?? []);
  const fault = all.find((e) => e.kind === 'fault');
  const after = fault ? ['detected', 'classified', 'redistributed'].map((kind) => all.find((e) => e.kind === kind && e.t >= fault.t)).filter((e) => e) : [];
  return html`<p class="verdict">${verdictText(r)}${!fault ? nothing : html`<span class="note">: ${fault.target} ${fault.class ?? ''} at ${quantity(fault.t, 's')}${after.length === 0 ? ', not detected' :
    after.map((e) => `, ${e.kind} +${quantity(e.t - fault.t, 's')}`).join('')}</span>`}</p>`;
}

/** Figures and events. @param {any} r the JSON of `ambrig run` */
export function figures(r) {
  return html`<table><tbody>
    ${Object.entries(r.metrics?.max_orbit ?? {}).map(([plane, most]) => html`<tr><th scope="row">largest orbit ${plane}</th><td class="number">${quantity(/** @type {number} */ (most), 'm')}</td></tr>`)}
    <tr><th scope="row">peak current</th><td class="number">${quantity(r.metrics?.peak_current ?? NaN, 'A')}</td></tr>
    ${Object.entries(r.expect ?? {}).map(([key, e]) => html`<tr><th scope="row">expects ${key} ${/** @type {any} */ (e).wanted}</th><td>${/** @type {any} */ (e).met ? '\u2714' : '\u2716'} ${/** @type {any} */ (e).got}</td></tr>`)}</tbody></table>
    <h2>Events</h2>${events(r)}`;
}

/** @param {any} r */
export function events(r) {
  const all = r.events ?? [];
  if (all.length === 0) return html`<p>None.</p>`;
  const fault = all.find((/** @type {any} */ e) => e.kind === 'fault')?.t;
  return html`<ol class="events">${all.slice(0, 40).map((/** @type {any} */ e) =>
    html`<li>${quantity(e.t, 's', 6)}${fault !== undefined && e.t > fault ? ` (+${quantity(e.t - fault, 's')})` : nothing} ${e.kind} ${e.target} ${e.class ?? ''}</li>`)}</ol>`;
}

/** Of x and y of the runs beside. */
const ghostTones = [['noise', 'coil4'], ['error', 'coil7']];

/**
 * Panels of positions and currents of every plane; other runs of the same kind dashed over them.
 * @param {RunRecord} record @param {{label: string, query: string, shift?: number}[]} ghosts @param {boolean} allOf the ghosts' currents too
 * @returns {import('./panels.js').Plot[]}
 */
export function runPlots(record, ghosts, allOf = false) {
  const plots = [];
  for (const plane of record.orbits.keys()) {
    plots.push({title: `${plane}: position x, y`, height: 130, lines: [
      {channel: plane + '.x', label: 'x', tone: 'measured'}, {channel: plane + '.y', label: 'y', tone: 'model'},
      ...ghosts.flatMap((g, n) => ['x', 'y'].map((axis, k) => ({channel: `${plane}.${axis}`, label: `${axis} ${g.label}`, tone: ghostTones[n % 2][k], query: g.query, dash: [4, 3], shift: g.shift}))) ]});
    const currents = record.channels.filter((c) => c.startsWith(plane + '.i') && /\.i\d+$/.test(c));
    if (currents.length > 0)
      plots.push({title: `${plane}: coil currents`, height: 130,
                  lines: [{label: '', query: undefined, shift: undefined}, ...(allOf ? ghosts : [])].flatMap((g, n) => currents.map((c, k) => ({
                    channel: c, label: `${c.slice(plane.length + 1)} ${g.label}`.trim(), tone: `coil${(k % 8) + 1}`, ...(n === 0 ? {} : {query: g.query, dash: [4, 3], shift: g.shift})})))});
  }
  if (record.channels.includes('bus')) plots.push({title: 'bus', height: 90, lines: [{channel: 'bus', label: 'bus', tone: 'measured'}]});
  return plots;
}

/** Times at which something happened, in order. @param {any} r @returns {number[]} */
export function eventTimes(r) {
  return [...new Set(/** @type {number[]} */ ((r?.events ?? []).map((/** @type {any} */ e) => e.t)))].sort((a, b) => a - b);
}
