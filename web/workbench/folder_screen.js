/** The folder: what is there, and how fresh what is known of it. */
import {html, nothing} from './lit-html.js';
import {upload} from './actions.js';
import {formatAddress, emptyView} from './address.js';
import {ratio} from './numbers.js';
import {state} from './state.js';

/** @param {string} screen @param {string} file */
function link(screen, file) {
  return html`<a href=${formatAddress({...emptyView(), screen, file})}>${file}</a>`;
}

/** @param {any} c a case of /api/folder */
function caseRow(c) {
  const compare = c.compare, explain = c.explain;
  const verdict = !explain ? '-' : (explain.adopted ?? []).length > 0 ? explain.adopted.join(', ') : explain.verdict;
  return html`<tr><th scope="row">${link('case', c.name)}</th><td class="number">${c.records}</td>
    <td>${!compare ? '-' : html`${ratio(compare.ratio)}${compare.fresh ? nothing : html` <em>stale</em>`}`}
      ${explain ? html` \u2192 ${ratio(explain.final_ratio_validate)}` : nothing}</td>
    <td>${verdict}${explain && !explain.fresh ? html` <em>stale</em>` : nothing}</td></tr>`;
}

/** @param {string} kind @param {string} title @param {string} screen "" where nothing opens */
function list(kind, title, screen) {
  const files = state.folder.files.filter((/** @type {any} */ f) => f.kind === kind);
  if (files.length === 0) return nothing;
  return html`<section><h2>${title}</h2><ul class="files">${files.map((/** @type {any} */ f) =>
    html`<li>${screen ? link(screen, f.name) : f.name}</li>`)}</ul></section>`;
}

export function folderScreen() {
  if (!state.folder) return html`<p>Reading the folder.</p>`;
  const {cases, folder} = state.folder;
  return html`<h1>${folder}</h1>
    <section><h2>Cases</h2>
    ${cases.length === 0 ? html`<p>No case yet: a case file names a rig and its records. To practise on one, type
      <code>ambrig hide cross-coupling@A --rig rig.toml -o practice</code> in this folder; it appears here.</p>`
    : html`<table><thead><tr><th scope="col">case</th><th scope="col">records</th><th scope="col">error over noise</th><th scope="col">what explain found</th></tr></thead>
      <tbody>${cases.map(caseRow)}</tbody></table>`}</section>
    <div class="columns"><div>${list('rig', 'Rigs', 'rig')}${list('scenario', 'Scenarios', 'run')}</div>
    <div>${list('campaign', 'Campaigns', '')}${list('broken', 'Files that cannot be read', '')}
    <section class="drop"><h2>Add files</h2><label>A record, rig or scenario, or drop it on the page
      <input type="file" multiple @change=${(/** @type {Event} */ e) => upload(/** @type {HTMLInputElement} */ (e.target).files, '')}></label></section></div></div>`;
}
