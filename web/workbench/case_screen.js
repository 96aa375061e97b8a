/** One case: where the model fails, panels, data faults, explain, adopt, the ladder of rigs, the next record. */
import {html, nothing} from './lit-html.js';
import {followUp, loadResult, mend, openReport, resultOf, startJob} from './actions.js';
import {adoption, forgetProposal, propose} from './adoption.js';
import {explanation} from './explanation.js';
import {stepsThrough} from './history.js';
import {historyPart} from './history_part.js';
import {errorOf, progressOf} from './job_parts.js';
import {recordName, worstCell, worstCells} from './misfit.js';
import {misfitTable} from './misfit_table.js';
import {misfitViews} from './misfit_views.js';
import {probability, ratio} from './numbers.js';
import {Panels} from './panels.js';
import {planPart} from './plan_part.js';
import {shareBar} from './share.js';
import {activeJob, changed, lastJob, state} from './state.js';
import {watchPart} from './trend_screen.js';

/** @type {Panels|null} */
let panels = null;
/** Whether the table of the step before is shown, on the same colours. */
let before = false;

/** Cases whose first comparison was started by this page. @type {Set<string>} */
const started = new Set();

/** Asks for what is known of a case, and starts its first comparison. @param {string} file */
export async function openCase(file) {
  forgetProposal();
  before = false;
  panels?.clear();
  await Promise.all(['compare', 'explain', 'adopt', 'plan', 'refine'].map((command) => loadResult(command, file)));
  if (!resultOf('compare', file) && !activeJob('compare', file) && !started.has(file)) {
    started.add(file);
    await followUp({command: 'compare', case: file});
  }
}

/** @param {string} record @param {string} channel @param {boolean} more @param {(change: object) => void} go */
function choose(record, channel, more, go) {
  const view = state.view;
  const add = more && record === view.record && !view.channels.includes(channel);
  const channels = add ? [...view.channels, channel].slice(-8) : [channel];
  go({record, channels, ...(record === view.record ? {} : {from: null, to: null, marks: {}})});
}

/** The next cell, from the worst down. @param {(change: object) => void} go */
export function nextWorst(go) {
  const found = resultOf('compare', state.view.file);
  if (!found) return;
  const cells = worstCells(found.result.records);
  const chosen = chosenCell(found.result);
  const at = cells.findIndex((c) => c.record === chosen.record && c.channel === chosen.channels[0]);
  const next = cells[(at + 1) % cells.length];
  if (next) choose(next.record, next.channel, false, go);
}

/** @param {any[]} faults @param {string} file */
function dataFaults(faults, file) {
  if (!faults || faults.length === 0) return nothing;
  return html`<section class="faults" aria-label="data faults"><h2>The data</h2><ul>${faults.map((f) => html`<li>
    <strong>${f.record}, ${f.channel || 'all channels'}: ${f.fault}</strong> (probability ${probability(f.probability)})
    ${f.mend ? html` <code>${f.mend}</code> <button class="main" @click=${() => mend(file, f)}>Write this line into the case</button>` : nothing}</li>`)}</ul></section>`;
}

/** The chosen cell, else the worst. @param {any} comparison */
function chosenCell(comparison) {
  const view = state.view;
  const known = comparison.records.find((/** @type {any} */ r) => recordName(r.data) === view.record);
  if (known && view.channels.length > 0) return {record: view.record, channels: view.channels};
  const worst = worstCell(comparison.records);
  return worst ? {record: worst.record, channels: [worst.channel]} : {record: '', channels: []};
}

/** Shows the table of the case before the last effect was added. @param {string} file */
function beforeButton(file) {
  const steps = stepsThrough(file, state.jobs, state.folder?.files.map((/** @type {any} */ f) => f.name) ?? []);
  const at = steps.findIndex((s) => s.file === file);
  if (at < 1) return nothing;
  const earlier = steps[at - 1].file;
  return html`<button aria-pressed=${before ? 'true' : 'false'} @click=${async () => {
    before = !before;
    if (before) await loadResult('compare', earlier);
    changed();
  }}>before: ${earlier}</button> ${before && resultOf('compare', earlier) ? html`<div class="before">${misfitTable(resultOf('compare', earlier).result, {record: '', channels: []}, () => {})}</div>` : nothing}`;
}

/** @param {any} found @param {string} file @param {{record: string, channels: string[]}} chosen @param {(change: object) => void} go */
function misfit(found, file, chosen, go) {
  const r = found.result;
  return html`<section class="misfit-part ${found.fresh ? '' : 'stale'}" aria-label="misfit"><h2>Where does the model fail?</h2>
    ${found.fresh ? nothing : html`<p class="note">Older than ${found.stale.join(', ')}. <button @click=${() => startJob({command: 'compare', case: file})}>Compare again</button></p>`}
    <p>All records <strong>${ratio(r.ratio)}</strong> times the noise; fitted ${ratio(r.ratio_fit)}, unseen ${ratio(r.ratio_validate)}.
      <button @click=${() => openReport(found.job)}>Report</button></p>
    ${beforeButton(file)}
    ${misfitTable(r, chosen, (record, channel, more) => choose(record, channel, more, go))}</section>`;
}

/** @param {any} found @param {{record: string, channels: string[]}} chosen */
function views(found, chosen) {
  const record = found.result.records.find((/** @type {any} */ r) => recordName(r.data) === chosen.record);
  if (!record || chosen.channels.length === 0) return nothing;
  return misfitViews({query: `job=${found.job}&record=${encodeURIComponent(chosen.record)}`, channel: chosen.channels[0],
                      others: Object.keys(record.channels), from: state.view.from, to: state.view.to});
}

/** @param {(change: object) => void} go changes the view */
export function caseScreen(go) {
  const file = state.view.file;
  const found = resultOf('compare', file);
  const explained = resultOf('explain', file);
  const job = activeJob('compare', file);
  const last = lastJob('compare', file);
  const chosen = found ? chosenCell(found.result) : null;
  return html`<h1>${file}</h1><div class="columns"><div>
    ${job ? progressOf(job, 'compare') : nothing}
    ${!job && last?.state === 'failed' ? html`${errorOf(last.error)}<button @click=${() => startJob({command: 'compare', case: file})}>Compare again</button>` : nothing}
    ${dataFaults(found?.result.data, file)}
    ${found && chosen ? misfit(found, file, chosen, go) : nothing}
    ${chosen ? html`<section aria-label="panels"><h2>${chosen.channels.join(', ')} in ${chosen.record}</h2>
      <p class="note">Drag or wheel zooms, Shift-drag pans, double click shows all; on a panel + - 0, arrows, A, B, Y; W: next worst cell.</p><p class="marks"></p>
      <div class="panels" id="panels"></div>${views(found, chosen)}${shareBar(() => panels)}</section>` : nothing}
  </div><div>${adoption(file, go)}${explanation(file, explained, propose)}${historyPart(file)}${planPart(file)}${watchPart(file)}</div></div>`;
}

/** After the screen was drawn: the panels, which are no templates. @param {(change: object) => void} go */
export function drawPanels(go) {
  const place = document.getElementById('panels');
  const found = resultOf('compare', state.view.file);
  if (!place || !found) return;
  if (!panels || panels.place !== place)
    panels = new Panels(place, (moved) => go({...chosenCell(resultOf('compare', state.view.file).result), ...moved}));
  const chosen = chosenCell(found.result);
  if (!chosen.record) return;
  const high = chosen.channels.length > 1 ? 120 : 190;
  const plots = chosen.channels.flatMap((c) => [
    {title: c, height: high, lines: [{channel: c + '.measured', label: 'measured', tone: 'measured'}, {channel: c + '.model', label: 'model', tone: 'model'}]},
    {title: `${c}: error over noise`, height: Math.round(high * 0.75), lines: [{channel: c + '.error', label: 'error over noise', tone: 'error'}]},
  ]);
  const query = `job=${found.job}&record=${encodeURIComponent(chosen.record)}`;
  void panels.show({query, name: chosen.record, plots, from: state.view.from, to: state.view.to, marks: state.view.marks});
}
