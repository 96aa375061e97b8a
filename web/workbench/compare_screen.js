/** Two runs, or two rigs, beside each other: only what differs. */
import {html, nothing} from './lit-html.js';
import {loadResult, openReport, resultOf, resultOfJob, runJob, startJob} from './actions.js';
import {errorOf} from './job_parts.js';
import {prefixFor, quantity, significant} from './numbers.js';
import {Panels} from './panels.js';
import {eventTimes, queryOf, recordOf, runPlots, stemOf, verdictText} from './run_parts.js';
import {shareBar} from './share.js';
import {activeJob, changed, state} from './state.js';

/** @type {Panels|null} */
let panels = null;
/** @type {{key: string, result: any, error: string, job: number}} of `ambrig diff` */
let difference = {key: '', result: null, error: '', job: 0};

/** @param {string} name */
const kindOf = (name) => state.folder?.files.find((/** @type {any} */ f) => f.name === name)?.kind ?? '';

/** @param {string} file @param {string} vs */
export async function openCompare(file, vs) {
  panels?.clear();
  if (kindOf(file) !== 'scenario' && kindOf(file) !== '') return;
  for (const name of [file, vs]) if (name) await loadResult('run', name);
}

/** @param {string} key @param {{command: string} & Record<string, any>} order */
async function compare(key, order) {
  if (difference.key === key) return;
  difference = {key, result: null, error: '', job: 0};
  const job = await runJob(order);
  if (difference.key !== key) return;
  if (!job || (job.state !== 'done')) difference = {...difference, error: job?.error || 'refused'};
  else difference = {...difference, result: await resultOfJob(job.id), job: job.id};
  changed();
}

/** @param {(change: object) => void} go */
function chooser(go) {
  const {file, vs} = state.view;
  const kind = kindOf(file) || 'scenario';
  const names = state.folder.files.filter((/** @type {any} */ f) => f.kind === kind).map((/** @type {any} */ f) => f.name);
  const select = (/** @type {string} */ label, /** @type {string} */ value, /** @type {'file'|'vs'} */ key) => html`<label>${label} <select @change=${(/** @type {Event} */ e) =>
    go({[key]: /** @type {HTMLSelectElement} */ (e.target).value, from: null, to: null, marks: {}, shift: 0})}>
    ${key === 'vs' ? html`<option value="" ?selected=${!value}>-</option>` : nothing}${names.map((/** @type {string} */ n) => html`<option value=${n} ?selected=${n === value}>${n}</option>`)}</select></label>`;
  return html`<p>${select(kind === 'rig' ? 'rig' : 'run', file, 'file')} ${select('beside', vs, 'vs')}</p>`;
}

/** @param {(change: object) => void} go */
export function compareScreen(go) {
  if (!state.folder) return nothing;
  const {file, vs} = state.view;
  const rigs = kindOf(file) === 'rig';
  return html`<h1>Only what differs</h1>${chooser(go)}${!vs ? html`<p>Choose the second ${rigs ? 'rig' : 'run'}.</p>` : rigs ? twoRigs(file, vs) : twoRuns(file, vs, go)}`;
}

/** @param {string} file @param {string} vs */
function twoRigs(file, vs) {
  void compare(`rig ${file} ${vs}`, {command: 'diff', a: file, b: vs});
  const d = difference;
  if (d.error) return errorOf(d.error);
  if (!d.result) return html`<p>Comparing.</p>`;
  if (d.result.identical) return html`<p>\u2714 The same rig: no value differs.</p>`;
  const text = (/** @type {any} */ v, /** @type {string} */ unit) => {
    if (v === null || v === undefined || v === '') return '-';
    if (!Number.isFinite(Number(v)) || !unit) return String(v);
    const p = prefixFor(Number(v), unit);
    return `${Number((Number(v) * p.factor).toPrecision(6))} ${p.unit}`.trim();
  };
  const change = (/** @type {any} */ x) => {
    if (typeof x.sds === 'number' && x.sds !== 0) return `${significant(x.sds, 2)} sd`;
    return typeof x.a === 'number' && typeof x.b === 'number' && x.a !== 0 ? `${significant(100 * (x.b / x.a - 1), 3)} %` : '';
  };
  return html`<table><thead><tr><th scope="col">what</th><th scope="col">${file}</th><th scope="col">${vs}</th><th scope="col">change</th></tr></thead>
    <tbody>${d.result.differences.map((/** @type {any} */ x) => html`<tr><th scope="row">${x.what}</th><td class="number">${text(x.a, x.unit)}</td><td class="number">${text(x.b, x.unit)}</td>
      <td class="number">${change(x)}</td></tr>`)}</tbody></table>`;
}

/** @param {string} file @param {string} vs @param {(change: object) => void} go */
function twoRuns(file, vs, go) {
  const a = resultOf('run', file), b = resultOf('run', vs);
  const missing = [[file, a], [vs, b]].filter(([, r]) => !r).map(([n]) => /** @type {string} */ (n));
  if (missing.length > 0) return html`${missing.map((n) => html`<p>${n} was not run yet. ${activeJob('run', n) ? 'It runs.' : html`<button class="main" @click=${() => startJob({command: 'run', scenario: n})}>Run it</button>`}</p>`)}`;
  void compare(`run ${a.job} ${b.job}`, {command: 'difference', a: a.job, b: b.job});
  const step = (/** @type {number} */ by) => go({shift: Number((state.view.shift + by).toFixed(6))});
  return html`<p class="marks"></p><p>${vs} dashed, shifted by ${quantity(state.view.shift, 's')} <button aria-label="shift earlier" @click=${() => step(-0.001)}>[</button>
      <button aria-label="shift later" @click=${() => step(0.001)}>]</button></p>
    <div class="panels" id="panels"></div>${shareBar(() => panels)}${figures(file, a.result, vs, b.result)}${channels()}`;
}

/** Verdict and numbers that differ. @param {string} file @param {any} a @param {string} vs @param {any} b */
function figures(file, a, vs, b) {
  const rows = /** @type {[string, string, string][]} */ ([['verdict', verdictText(a), verdictText(b)]]);
  const units = /** @type {Record<string, string>} */ ({peak_current: 'A', copper_loss: 'W', detection_delay: 's', redistribution_delay: 's', longest_contact: 's', late_orbit: 'm', min_clearance_left: 'm'});
  for (const plane of Object.keys(a.metrics.max_orbit ?? {})) rows.push([`largest orbit ${plane}`, quantity(a.metrics.max_orbit[plane], 'm'), quantity(b.metrics.max_orbit?.[plane] ?? NaN, 'm')]);
  for (const [key, unit] of Object.entries(units))
    if (typeof a.metrics[key] === 'number' || typeof b.metrics[key] === 'number') rows.push([key.replaceAll('_', ' '), quantity(a.metrics[key] ?? NaN, unit), quantity(b.metrics[key] ?? NaN, unit)]);
  const differ = rows.filter(([, x, y]) => x !== y);
  if (differ.length === 0) return html`<p>\u2714 Verdict and figures are the same.</p>`;
  return html`<table><thead><tr><th></th><th scope="col">${file}</th><th scope="col">${vs}</th></tr></thead>
    <tbody>${differ.map(([name, x, y]) => html`<tr><th scope="row">${name}</th><td class="number">${x}</td><td class="number">${y}</td></tr>`)}</tbody></table>`;
}

function channels() {
  const d = difference;
  if (d.error) return errorOf(d.error);
  if (!d.result) return html`<p>Comparing channel by channel.</p>`;
  if (d.result.identical) return html`<p>\u2714 Not one bit of the records differs.</p>`;
  const differ = d.result.channels.filter((/** @type {any} */ c) => c.verdict !== 'same');
  return html`${d.result.length ? html`<p>${d.result.length}</p>` : nothing}<table><caption>Channels that differ; all others have the same bits.</caption>
    <thead><tr><th scope="col">channel</th><th scope="col">largest difference</th><th scope="col">at</th><th scope="col">rms</th></tr></thead>
    <tbody>${differ.map((/** @type {any} */ c) => html`<tr><th scope="row">${c.channel}</th><td class="number">${valueOf(c.worst, c.unit)}</td><td class="number">${quantity(c.worst_at ?? NaN, 's', 5)}</td><td class="number">${valueOf(c.rms, c.unit)}</td></tr>`)}</tbody></table>
    <p>${(d.result.events ?? []).length} events differ. <button @click=${() => openReport(d.job)}>Report</button></p>`;
}

/** @param {number|null} v @param {string} unit */
function valueOf(v, unit) {
  if (typeof v !== 'number') return '-';
  const p = prefixFor(v, unit);
  return `${significant(v * p.factor, 3)} ${p.unit}`;
}

/** @param {(change: object) => void} go */
export function drawCompare(go) {
  const place = document.getElementById('panels');
  const {file, vs, shift} = state.view;
  const a = resultOf('run', file), b = resultOf('run', vs);
  if (!place || !a || !b) return;
  const first = recordOf(a.job, stemOf(file)), second = recordOf(b.job, stemOf(vs));
  if (!first || !second) return;
  if (!panels || panels.place !== place) panels = new Panels(place, (moved) => go(moved));
  const plots = runPlots(first, [{label: stemOf(vs), query: queryOf(b.job, stemOf(vs)), shift}], true).map((plot) => ({...plot, lines: plot.lines.filter((l) => !l.query || second.channels.includes(l.channel))}));
  if (plots.length > 0) void panels.show({query: first.query, name: `${file} and ${vs}`, plots, from: state.view.from, to: state.view.to, marks: state.view.marks, events: eventTimes(a.result)});
}
