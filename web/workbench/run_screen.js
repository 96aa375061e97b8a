/** A scenario: its run with verdict, events and channels; and a playground where a click breaks a coil. */
import {html, nothing} from './lit-html.js';
import {commandLine, loadResult, openReport, resultOf, startJob, stopJob} from './actions.js';
import {getBytes, getJson, getText, put} from './api.js';
import {withFaults, withoutExpectations} from './geometry.js';
import {freeName} from './misfit.js';
import {quantity} from './numbers.js';
import {Panels} from './panels.js';
import {decodeSeries} from './series.js';
import {activeJob, changed, lastJob, state, tell, tellError} from './state.js';
import {orbit, stator} from './stator.js';

/** @type {Panels|null} */
let panels = null;
/** @type {{file: string, rig: string, faults: Map<string, string>, kind: string, time: number}} what the person chose */
let play = {file: '', rig: '', faults: new Map(), kind: 'open', time: 0.1};
/** @type {{job: number, channels: string[], orbits: Map<string, (number|null)[][]>}|null} of the run that is shown */
let record = null;

/** The rig that a scenario names, beside it. @param {string} text @param {string} file */
function rigOf(text, file) {
  const found = /^\s*rig\s*=\s*"([^"]+)"/m.exec(text);
  const parts = (file.slice(0, file.lastIndexOf('/') + 1) + (found?.[1] ?? '')).split('/');
  const out = /** @type {string[]} */ ([]);
  for (const p of parts) {
    if (p === '..') out.pop();
    else if (p !== '' && p !== '.') out.push(p);
  }
  return out.join('/');
}

/** @param {string} file */
export async function openRun(file) {
  play = {file, rig: '', faults: new Map(), kind: play.kind, time: play.time};
  record = null;
  panels?.clear();
  await loadResult('run', file);
  try {
    const {text} = await getText('/api/file?p=' + encodeURIComponent(file));
    const rig = rigOf(text, file);
    await loadResult('rig', rig);
    play.rig = rig;
    const known = resultOf('rig', rig);
    if (!known || !known.fresh) await startJob({command: 'rig', rig});
  } catch (error) {
    tellError(error);
  }
  changed();
}

/** The record of a finished run: its channels and orbits. @param {number} job @param {string} file */
async function readRecord(job, file) {
  record = {job, channels: [], orbits: new Map()};
  const query = recordQuery(job, file);
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
    record = {job, channels, orbits};
  } catch (error) {
    tellError(error);
  }
  changed();
}

/** @param {number} job @param {string} file */
function recordQuery(job, file) {
  return `job=${job}&run=${encodeURIComponent(file.slice(file.lastIndexOf('/') + 1).replace(/\.toml$/, '.h5'))}`;
}

/** @param {string} coil */
function toggle(coil) {
  if (play.faults.has(coil)) play.faults.delete(coil);
  else play.faults.set(coil, play.kind);
  changed();
}

/** Writes a scenario with the chosen faults beside this one, and runs it. @param {(change: object) => void} go */
async function breakCoils(go) {
  try {
    const files = state.folder.files.map((/** @type {any} */ f) => f.name);
    const name = freeName(play.file, files);
    const {text} = await getText('/api/file?p=' + encodeURIComponent(play.file));
    const done = await put('/api/file?p=' + encodeURIComponent(name), withFaults(withoutExpectations(text), play.faults, play.time));
    tell(`written ${name}`, false, done.step);
    await startJob({command: 'run', scenario: name});
    go({screen: 'run', file: name});
  } catch (error) {
    tellError(error);
  }
}

/** @param {any} r the JSON of `ambrig run` */
function verdict(r) {
  const text = r.drop ? '\u2716 The rotor dropped' : r.touchdown ? '! Touched down, did not drop' : '\u2714 The rotor stayed up';
  return html`<p class="verdict">${text}</p><table><tbody>
    ${Object.entries(r.metrics?.max_orbit ?? {}).map(([plane, most]) => html`<tr><th scope="row">largest orbit ${plane}</th><td class="number">${quantity(/** @type {number} */ (most), 'm')}</td></tr>`)}
    <tr><th scope="row">peak current</th><td class="number">${quantity(r.metrics?.peak_current ?? NaN, 'A')}</td></tr></tbody></table>
    <h2>Events</h2>${(r.events ?? []).length === 0 ? html`<p>None.</p>` : html`<ol class="events">${r.events.slice(0, 40).map((/** @type {any} */ e) =>
      html`<li>${quantity(e.t, 's', 6)} ${e.kind} ${e.target} ${e.class ?? ''}</li>`)}</ol>`}`;
}

/** @param {any} rig the JSON of `ambrig rig` @param {(change: object) => void} go */
function playground(rig, go) {
  return html`<section aria-label="fault playground"><h2>Break a coil</h2>
    <p><label>Fault <select @change=${(/** @type {Event} */ e) => {
      play.kind = /** @type {HTMLSelectElement} */ (e.target).value;
    }}>${['open', 'partial-short', 'amplifier-off'].map((k) => html`<option value=${k} ?selected=${k === play.kind}>${k}</option>`)}</select></label>
    <label>at <input class="time" type="number" min="0" step="0.01" .value=${String(play.time)} @change=${(/** @type {Event} */ e) => {
      play.time = Math.max(0, Number(/** @type {HTMLInputElement} */ (e.target).value) || 0);
    }}> s</label></p>
    <div class="stators">${rig.bearings.map((/** @type {any} */ b) => stator(b, play.faults, toggle))}</div>
    <p>${play.faults.size === 0 ? 'Click the coils that are to fail.' : html`<button class="main" @click=${() => breakCoils(go)}>
      Write a scenario with ${play.faults.size === 1 ? 'this fault' : `these ${play.faults.size} faults`} and run it</button>`}</p></section>`;
}

/** @param {(change: object) => void} go */
export function runScreen(go) {
  const file = state.view.file;
  const job = activeJob('run', file);
  const found = resultOf('run', file);
  const last = lastJob('run', file);
  const rig = play.rig ? resultOf('rig', play.rig) : null;
  if (found && !job && record?.job !== found.job) void readRecord(found.job, file);
  return html`<h1>${file}</h1><div class="columns"><div>
    ${job ? html`<p><progress max="100" value=${Math.round(100 * (state.progress.get(job.id)?.share ?? 0))} aria-label="run"></progress>
      <code>${commandLine(job)}</code> <button class="stop" @click=${() => stopJob(job.id)}>Stop</button></p>`
    : html`<p><button class="main" @click=${() => startJob({command: 'run', scenario: file})}>${found ? 'Run again' : 'Run'}</button></p>`}
    ${last?.state === 'failed' && !job ? html`<p class="bad">${last.error}</p>` : nothing}
    ${found && !found.fresh ? html`<p class="note">Older than ${found.stale.join(', ')}.</p>` : nothing}
    <p class="marks"></p><div class="panels" id="panels"></div></div>
    <div>${found ? verdict(found.result) : html`<p>Not run yet.</p>`}
    <div class="stators">${record ? [...record.orbits].map(([plane, [x, y]]) => orbit(plane, x, y, clearanceOf(rig, plane))) : nothing}</div>
    ${rig ? playground(rig.result, go) : nothing}</div></div>`;
}

/** @param {any} rig @param {string} plane */
function clearanceOf(rig, plane) {
  return rig?.result.bearings.find((/** @type {any} */ b) => b.name === plane)?.clearance ?? null;
}

/** After the screen was drawn: positions and coil currents of every plane. */
export function drawRun() {
  const place = document.getElementById('panels');
  const found = resultOf('run', state.view.file);
  if (!place || !found || !record || record.job !== found.job || record.channels.length === 0) return;
  if (!panels || panels.place !== place) panels = new Panels(place, () => {});
  const plots = [];
  for (const plane of record.orbits.keys()) {
    plots.push({title: `${plane}: position x, y`, height: 130, lines: [
      {channel: plane + '.x', label: 'x', tone: 'measured'}, {channel: plane + '.y', label: 'y', tone: 'model'}]});
    const currents = record.channels.filter((c) => c.startsWith(plane + '.i') && /\.i\d+$/.test(c));
    if (currents.length > 0)
      plots.push({title: `${plane}: coil currents`, height: 130,
                  lines: currents.map((c, k) => ({channel: c, label: c.slice(plane.length + 1), tone: `coil${(k % 8) + 1}`}))});
  }
  if (plots.length > 0) void panels.show({query: recordQuery(found.job, state.view.file), name: state.view.file, plots, from: panels.from, to: panels.to});
}
