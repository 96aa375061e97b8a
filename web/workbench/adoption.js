/** Adopting or refining an effect: which files it will write, its progress, and how far the error fell. */
import {html, nothing} from './lit-html.js';
import {resultOf, startJob} from './actions.js';
import {errorOf, progressOf} from './job_parts.js';
import {ladder} from './ladder.js';
import {freeName} from './misfit.js';
import {ratio} from './numbers.js';
import {activeJob, changed, lastJob, state} from './state.js';

/** @type {any} the effect that is about to be adopted; `refine`: its law is fitted, not only its size */
let proposal = null;

export function forgetProposal() {
  proposal = null;
}

/** @param {{effect: string, target: string}} effect @param {boolean} refine */
export function propose(effect, refine = false) {
  proposal = {...effect, refine};
  changed();
}

/** Names that the adoption will write. @param {string} file */
function newNames(file) {
  const files = /** @type {string[]} */ (state.folder.files.map((/** @type {any} */ f) => f.name));
  const known = state.folder.cases.find((/** @type {any} */ c) => c.name === file);
  const folder = file.slice(0, file.lastIndexOf('/') + 1);
  return {rig: freeName(folder + (known?.rig || 'rig.toml'), files), new_case: freeName(file, files)};
}

/** @param {string} file @param {(change: object) => void} go */
export function adoption(file, go) {
  const ask = proposal === null ? nothing : question(file);
  return html`${ask}${['adopt', 'refine'].map((command) => result(command, file, go))}`;
}

/** @param {string} command adopt or refine @param {string} file @param {(change: object) => void} go */
function result(command, file, go) {
  const title = command === 'adopt' ? 'Adopt' : 'Refine';
  const job = activeJob(command, file);
  if (job) return html`<section class="adopt"><h2>${title}</h2>${progressOf(job, command)}</section>`;
  const done = lastJob(command, file);
  if (done?.state === 'failed') return html`<section class="adopt"><h2>${title}</h2>${errorOf(done.error)}</section>`;
  const found = resultOf(command, file);
  if (!done || done.state !== 'done' || !found) return nothing;
  const [rig, next] = done.new_files;
  if (!state.folder.files.some((/** @type {any} */ f) => f.name === next)) return nothing;  // the step was taken back
  const after = command === 'adopt' ? found.result.ratio_validate ?? found.result.ratio : found.result.ratio_after;
  return html`<section class="adopt" aria-label=${command === 'adopt' ? 'adopted' : 'refined'}><h2>${command === 'adopt' ? 'Adopted' : 'Refined'}</h2>
    <p>Written ${rig} and ${next}. <button class="main" @click=${() => go({screen: 'case', file: next, record: '', channels: [], from: null, to: null, marks: {}})}>Open ${next}</button></p>
    ${(found.result.ladder ?? []).length > 0 ? ladder(found.result.ladder, `The error fell to ${ratio(after)} times the noise`) : html`<p>Error over noise ${ratio(found.result.ratio_before)} \u2192 ${ratio(after)}</p>`}</section>`;
}

/** @param {string} file */
function question(file) {
  const names = newNames(file);
  const what = proposal.refine ? 'Refine' : 'Adopt';
  return html`<section class="adopt" aria-label="adopt"><h2>${what} ${proposal.effect} at ${proposal.target}</h2>
    <p>Writes <code>${names.rig}</code>, the rig file with ${proposal.refine ? 'the shape of the law that these records show' : 'the effect and the fitted values'}, and <code>${names.new_case}</code>, this case with it. Nothing else changes.</p>
    <p><button class="main" @click=${() => {
      const effect = proposal;
      proposal = null;
      void startJob(effect.refine ? {command: 'refine', case: file, effect: `${effect.effect}@${effect.target}`, ...names}
                                  : {command: 'adopt', case: file, effect: effect.effect, target: effect.target, ...names});
    }}>Write and compare again</button> <button @click=${() => {
      proposal = null;
      changed();
    }}>Not now</button></p></section>`;
}
