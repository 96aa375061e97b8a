/** A scenario run: start it, its verdict and its channels. */
import {html, nothing} from './lit-html.js';
import {commandLine, loadResult, openReport, resultOf, startJob, stopJob} from './actions.js';
import {quantity} from './numbers.js';
import {activeJob, lastJob, state} from './state.js';

/** @param {string} file */
export async function openRun(file) {
  await loadResult('run', file);
}

/** @param {any} r the JSON of `ambrig run` */
function verdict(r) {
  const text = r.drop ? 'The rotor dropped' : r.touchdown ? 'Touched down, did not drop' : 'The rotor stayed up';
  return html`<p class="verdict">${text}</p><table><tbody>
    ${Object.entries(r.metrics?.max_orbit ?? {}).map(([plane, orbit]) => html`<tr><th scope="row">largest orbit ${plane}</th><td class="number">${quantity(/** @type {number} */ (orbit), 'm')}</td></tr>`)}
    <tr><th scope="row">peak current</th><td class="number">${quantity(r.metrics?.peak_current ?? NaN, 'A')}</td></tr></tbody></table>
    <h2>Events</h2><ol>${(r.events ?? []).slice(0, 40).map((/** @type {any} */ e) => html`<li>${quantity(e.t, 's', 5)} ${e.kind} ${e.target} ${e.class ?? ''}</li>`)}</ol>`;
}

export function runScreen() {
  const file = state.view.file;
  const job = activeJob('run', file);
  const found = resultOf('run', file);
  const last = lastJob('run', file);
  return html`<h1>${file}</h1>
    ${job ? html`<p><progress max="100" value=${Math.round(100 * (state.progress.get(job.id)?.share ?? 0))} aria-label="run"></progress>
      <code>${commandLine(job)}</code> <button class="stop" @click=${() => stopJob(job.id)}>Stop</button></p>`
    : html`<p><button class="main" @click=${() => startJob({command: 'run', scenario: file})}>${found ? 'Run again' : 'Run'}</button>
      ${found ? html`<button @click=${() => openReport(found.job)}>Report</button>` : nothing}</p>`}
    ${last?.state === 'failed' && !job ? html`<p class="bad">${last.error}</p>` : nothing}
    ${found ? html`<section class=${found.fresh ? '' : 'stale'}>${verdict(found.result)}</section>` : nothing}`;
}

export function drawRun() {}
