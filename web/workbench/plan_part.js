/** The next record: what it would tell apart, its scenario to take away, and what came of it. */
import {html, nothing} from './lit-html.js';
import {openReport, removeFiles, resultOf, startJob, upload} from './actions.js';
import {getText} from './api.js';
import {emptyView, formatAddress} from './address.js';
import {errorOf, progressOf} from './job_parts.js';
import {freeName} from './misfit.js';
import {probability, quantity} from './numbers.js';
import {isRecord, offerRecord, recordForm} from './record_form.js';
import {download} from './share.js';
import {activeJob, lastJob, state} from './state.js';

/** @param {string} file the case */
function planName(file) {
  const files = state.folder.files.map((/** @type {any} */ f) => f.name);
  const name = file.slice(0, file.lastIndexOf('/') + 1) + 'next_record.toml';
  return files.includes(name) ? freeName(name, files) : name;
}

/** @param {string} scenario */
async function takeAway(scenario) {
  const {text} = await getText('/api/file?p=' + encodeURIComponent(scenario));
  download(new Blob([text], {type: 'application/toml'}), scenario.slice(scenario.lastIndexOf('/') + 1));
}

/** Files that came by a drop or the button: each record is offered to the case. @param {FileList|null} files @param {string} file the case */
export async function takeRecords(files, file) {
  const folder = file.slice(0, file.lastIndexOf('/') + 1);
  for (const name of await upload(files, folder))
    if (isRecord(name)) await offerRecord(file, name, resultOf('compare', file), resultOf('plan', file)?.result.scenario ?? '');
}

/** @param {any} found */
function card(found) {
  const r = found.result;
  return html`<div class=${found.fresh ? '' : 'stale'}><p class="verdict">${r.title}</p>
    <ul>${(r.separates ?? []).map((/** @type {any} */ s) => html`<li>${s.a} or ${s.b}: told apart with probability ${probability(s.probability)}${s.of ? `, ${s.right} of ${s.draws ?? s.of} simulated records` : ''}</li>`)}</ul>
    <p>largest orbit ${quantity(r.largest_orbit ?? NaN, 'm')}, largest current ${quantity(r.largest_current ?? NaN, 'A')}, ${quantity(r.duration ?? NaN, 's')}</p>
    <p>${state.folder.files.some((/** @type {any} */ f) => f.name === r.scenario) ? html`<button @click=${() => takeAway(r.scenario)}>Take ${r.scenario} away</button>
      <a href=${formatAddress({...emptyView(), screen: 'run', file: r.scenario})}>simulate it</a> <button @click=${() => removeFiles([r.scenario])}>Take it back</button>` : html`${r.scenario} is no longer there; plan again.`}
      <button @click=${() => openReport(found.job)}>Card as a report</button></p></div>`;
}

/** @param {string} file the case */
export function planPart(file) {
  const job = activeJob('plan', file);
  const last = lastJob('plan', file);
  const found = resultOf('plan', file);
  return html`<section class="plan" aria-label="next record"><h2>Next record</h2>
    ${job ? progressOf(job, 'plan') : nothing}
    ${!job && last?.state === 'failed' ? errorOf(last.error) : nothing}
    ${found ? card(found) : html`<p>Which record would tell apart what is still open, without danger for the rig?</p>`}
    ${job ? nothing : html`<button @click=${() => startJob({command: 'plan', case: file, scenario: planName(file)})}>${found ? 'Plan again' : 'Plan the next record'}</button>`}
    <div class="drop"><label>Drop its record on this page, or choose it <input type="file" multiple @change=${(/** @type {Event} */ e) => {
      void takeRecords(/** @type {HTMLInputElement} */ (e.target).files, file);
    }}></label></div>
    ${recordForm(file)}</section>`;
}

