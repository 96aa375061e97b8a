/** One case: where the model fails, panels, data faults, explain, adopt, the ladder of rigs. */
import {html, nothing} from './lit-html.js';
import {commandLine, loadResult, mend, openReport, resultOf, startJob, stopJob} from './actions.js';
import {explanation} from './explanation.js';
import {ladder} from './ladder.js';
import {freeName, recordName, worstCell} from './misfit.js';
import {misfitTable} from './misfit_table.js';
import {probability, ratio} from './numbers.js';
import {Panels} from './panels.js';
import {activeJob, changed, lastJob, state} from './state.js';

/** @type {Panels|null} */
let panels = null;
/** @type {any} the effect that is about to be adopted */
let proposal = null;

/** Cases whose first comparison was started by this page. @type {Set<string>} */
const started = new Set();

/** Asks for what is known of a case, and starts its first comparison. @param {string} file */
export async function openCase(file) {
  proposal = null;
  panels?.clear();
  await Promise.all([loadResult('compare', file), loadResult('explain', file), loadResult('adopt', file)]);
  if (!resultOf('compare', file) && !activeJob('compare', file) && !started.has(file)) {
    started.add(file);
    await startJob({command: 'compare', case: file});
  }
}

/** @param {string} record @param {string} channel @param {boolean} more @param {(change: object) => void} go */
function choose(record, channel, more, go) {
  const view = state.view;
  const add = more && record === view.record && !view.channels.includes(channel);
  const channels = add ? [...view.channels, channel].slice(-8) : [channel];
  go({record, channels, ...(record === view.record ? {} : {from: null, to: null})});
}

/** @param {any[]} faults @param {string} file */
function dataFaults(faults, file) {
  if (!faults || faults.length === 0) return nothing;
  return html`<section class="faults" aria-label="data faults"><h2>The data</h2><ul>${faults.map((f) => html`<li>
    <strong>${f.record}, ${f.channel || 'all channels'}: ${f.fault}</strong> (probability ${probability(f.probability)})
    ${f.mend ? html` <code>${f.mend}</code> <button class="main" @click=${() => mend(file, f)}>Write this line into the case</button>` : nothing}</li>`)}</ul></section>`;
}

/** Names that the adoption will write. @param {string} file */
function newNames(file) {
  const files = /** @type {string[]} */ (state.folder.files.map((/** @type {any} */ f) => f.name));
  const known = state.folder.cases.find((/** @type {any} */ c) => c.name === file);
  const folder = file.slice(0, file.lastIndexOf('/') + 1);
  return {rig: freeName(folder + (known?.rig || 'rig.toml'), files), new_case: freeName(file, files)};
}

/** @param {string} file @param {(change: object) => void} go */
function adoption(file, go) {
  const job = activeJob('adopt', file);
  if (job) {
    const p = state.progress.get(job.id);
    return html`<section class="adopt"><h2>Adopt</h2><progress max="100" value=${Math.round(100 * (p?.share ?? 0))} aria-label="adopt"></progress>
      ${p?.text ?? ''} <button class="stop" @click=${() => stopJob(job.id)}>Stop</button></section>`;
  }
  const done = lastJob('adopt', file);
  const found = resultOf('adopt', file);
  const ask = proposal === null ? nothing : question(file);
  if (!done || done.state !== 'done' || !found) return ask;
  const [rig, next] = done.new_files;
  return html`${ask}<section class="adopt" aria-label="adopted"><h2>Adopted</h2>
    <p>Written ${rig} and ${next}. <button class="main" @click=${() => go({screen: 'case', file: next, record: '', channels: [], from: null, to: null})}>Open ${next}</button></p>
    ${ladder(found.result.ladder ?? [], `The error fell to ${ratio(found.result.ratio_validate)} times the noise`)}</section>`;
}

/** @param {string} file */
function question(file) {
  const names = newNames(file);
  return html`<section class="adopt" aria-label="adopt"><h2>Adopt ${proposal.effect} at ${proposal.target}</h2>
    <p>Writes <code>${names.rig}</code>, the rig file with the effect and the fitted values, and <code>${names.new_case}</code>, this case with it. Nothing else changes.</p>
    <p><button class="main" @click=${() => {
      const effect = proposal;
      proposal = null;
      void startJob({command: 'adopt', case: file, effect: effect.effect, target: effect.target, ...names});
    }}>Write and compare again</button> <button @click=${() => {
      proposal = null;
      changed();
    }}>Not now</button></p></section>`;
}

/** The chosen cell, else the worst. @param {any} comparison */
function chosenCell(comparison) {
  const view = state.view;
  const known = comparison.records.find((/** @type {any} */ r) => recordName(r.data) === view.record);
  if (known && view.channels.length > 0) return {record: view.record, channels: view.channels};
  const worst = worstCell(comparison.records);
  return worst ? {record: worst.record, channels: [worst.channel]} : {record: '', channels: []};
}

/** @param {any} found @param {string} file @param {{record: string, channels: string[]}} chosen @param {(change: object) => void} go */
function misfit(found, file, chosen, go) {
  const r = found.result;
  return html`<section class="misfit-part ${found.fresh ? '' : 'stale'}" aria-label="misfit"><h2>Where does the model fail?</h2>
    ${found.fresh ? nothing : html`<p class="note">Older than ${found.stale.join(', ')}. <button @click=${() => startJob({command: 'compare', case: file})}>Compare again</button></p>`}
    <p>All records <strong>${ratio(r.ratio)}</strong> times the noise; fitted ${ratio(r.ratio_fit)}, unseen ${ratio(r.ratio_validate)}.
      <button @click=${() => openReport(found.job)}>Report</button></p>
    ${misfitTable(r, chosen, (record, channel, more) => choose(record, channel, more, go))}</section>`;
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
    ${job ? html`<p><progress aria-label="compare"></progress> Comparing model and records. <code>${commandLine(job)}</code></p>` : nothing}
    ${!job && !found && last?.state === 'failed' ? html`<p class="bad">${last.error}</p><button @click=${() => startJob({command: 'compare', case: file})}>Compare again</button>` : nothing}
    ${dataFaults(found?.result.data, file)}
    ${found && chosen ? misfit(found, file, chosen, go) : nothing}
    ${chosen ? html`<section aria-label="panels"><h2>${chosen.channels.join(', ')} in ${chosen.record}</h2>
      <p class="note">Drag or wheel zooms, double click shows all; on a panel + - 0, arrows, A and B.</p><p class="marks"></p>` : nothing}
    <div class="panels" id="panels"></div>${chosen ? html`</section>` : nothing}
  </div><div>${adoption(file, go)}${explanation(file, explained, (effect) => {
    proposal = effect;
    changed();
  })}</div></div>`;
}

/** After the screen was drawn: the panels, which are no templates. @param {(change: object) => void} go */
export function drawPanels(go) {
  const place = document.getElementById('panels');
  const found = resultOf('compare', state.view.file);
  if (!place || !found) return;
  if (!panels || panels.place !== place)
    panels = new Panels(place, (from, to) => go({...chosenCell(resultOf('compare', state.view.file).result), from, to}));
  const chosen = chosenCell(found.result);
  if (!chosen.record) return;
  const high = chosen.channels.length > 1 ? 120 : 190;
  const plots = chosen.channels.flatMap((c) => [
    {title: c, height: high, lines: [{channel: c + '.measured', label: 'measured', tone: 'measured'}, {channel: c + '.model', label: 'model', tone: 'model'}]},
    {title: `${c}: error over noise`, height: Math.round(high * 0.75), lines: [{channel: c + '.error', label: 'error over noise', tone: 'error'}]},
  ]);
  const query = `job=${found.job}&record=${encodeURIComponent(chosen.record)}`;
  void panels.show({query, name: chosen.record, plots, from: state.view.from, to: state.view.to});
}
