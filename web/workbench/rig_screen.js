/** A rig resolved: every number with its unit and what is known of it. */
import {html} from './lit-html.js';
import {followUp, loadResult, resultOf} from './actions.js';
import {errorOf} from './job_parts.js';
import {lastJob, state} from './state.js';

/** @param {string} file */
export async function openRig(file) {
  await loadResult('rig', file);
  const found = resultOf('rig', file);
  if (!found || !found.fresh) await followUp({command: 'rig', rig: file});
}

/** Three digits more than a person needs, none that the file did not have. @param {any} v */
const figure = (v) => (typeof v === 'number' ? String(Number(v.toPrecision(6))) : v ?? '');

export function rigScreen() {
  const file = state.view.file;
  const found = resultOf('rig', file);
  const last = lastJob('rig', file);
  if (!found) return html`<h1>${file}</h1>${last?.state === 'failed' ? errorOf(last.error) : html`<p>Reading the rig.</p>`}`;
  return html`<h1>${file}</h1><table><thead><tr><th scope="col">number</th><th scope="col">value</th><th scope="col">sd</th><th scope="col">fitted</th><th scope="col">unit</th></tr></thead>
    <tbody>${Object.entries(found.result.values).map(([path, v]) => html`<tr><th scope="row">${path}</th><td class="number">${figure(/** @type {any} */ (v).value)}</td>
      <td class="number">${figure(/** @type {any} */ (v).sd)}</td><td class="number">${figure(/** @type {any} */ (v).fitted)}</td><td>${/** @type {any} */ (v).unit}</td></tr>`)}</tbody></table>
    ${(found.result.effects ?? []).length === 0 ? html`<p>No effects: the base model alone.</p>` : html`<h2>Effects</h2><ul>${found.result.effects.map((/** @type {any} */ e) =>
      html`<li>${e.effect ?? e.name} at ${e.target}: ${Object.entries(e.parameters ?? {}).map(([k, p]) => `${k} ${figure(/** @type {any} */ (p).value)} ${/** @type {any} */ (p).unit === '-' ? '' : /** @type {any} */ (p).unit}`).join(', ')}</li>`)}</ul>`}`;
}
