/** The ladder of cases as a table: every step, its error, and the way back. */
import {html, nothing} from './lit-html.js';
import {removeFiles} from './actions.js';
import {emptyView, formatAddress} from './address.js';
import {stepsThrough} from './history.js';
import {ladder} from './ladder.js';
import {ratio} from './numbers.js';
import {state} from './state.js';

/** @param {string} file the case that is shown */
export function historyPart(file) {
  const files = state.folder?.files.map((/** @type {any} */ f) => f.name) ?? [];
  const steps = stepsThrough(file, state.jobs, files);
  if (steps.length < 2) return nothing;
  const known = steps.map((s) => ({...s, about: state.folder.cases.find((/** @type {any} */ c) => c.name === s.file)}));
  const bars = known.filter((s) => s.about?.compare).map((s) => ({added: s.added || 'first case', ratio_fit: s.about.compare.ratio_fit, ratio_validate: s.about.compare.ratio_validate}));
  return html`<section class="history" aria-label="history"><h2>Steps</h2>
    ${bars.length > 1 ? ladder(bars, 'Error over noise of every step') : nothing}
    <table><thead><tr><th scope="col">step</th><th scope="col">case</th><th scope="col">error over noise</th><th></th></tr></thead><tbody>
    ${known.map((s, k) => html`<tr aria-current=${s.file === file ? 'step' : nothing}><th scope="row">${s.added || 'first case'}</th>
      <td>${s.file === file ? html`<strong>${s.file}</strong>` : html`<a href=${formatAddress({...emptyView(), screen: 'case', file: s.file})}>${s.file}</a>`}</td>
      <td class="number">${ratio(s.about?.compare?.ratio)}</td>
      <td>${k === 0 ? nothing : html`<a href=${formatAddress({...emptyView(), screen: 'compare', file: rigBefore(known, k), vs: s.rig})}>what differs</a>
        ${k === steps.length - 1 ? html`<button @click=${() => {
          void removeFiles([s.rig, s.file]);
          location.hash = formatAddress({...emptyView(), screen: 'case', file: steps[k - 1].file});
        }}>Take this step back</button>` : nothing}`}</td></tr>`)}</tbody></table></section>`;
}

/** The rig of the step before. @param {{file: string, rig: string, about: any}[]} steps @param {number} k */
function rigBefore(steps, k) {
  if (steps[k - 1].rig) return steps[k - 1].rig;
  const file = steps[k - 1].file;
  return file.slice(0, file.lastIndexOf('/') + 1) + (steps[k - 1].about?.rig || 'rig.toml');
}
