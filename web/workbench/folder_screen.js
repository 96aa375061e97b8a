/** The folder: what is there, how fresh it is, and what came of it. */
import {html, nothing} from './lit-html.js';
import {startJob, upload} from './actions.js';
import {practiceBar} from './practice.js';
import {formatAddress, emptyView} from './address.js';
import {quantity, ratio} from './numbers.js';
import {activeJob, changed, lastJob, state} from './state.js';

/** Chosen to be compared, at most two of one kind. @type {string[]} */
let picked = [];
/** Whether a long list is shown whole. */
let all = false;

/** @param {string} screen @param {string} file @param {string} [text] */
function link(screen, file, text = file) {
  return html`<a href=${formatAddress({...emptyView(), screen, file})}>${text}</a>`;
}

/** @param {any} summary */
const staleMark = (summary) => (summary && !summary.fresh ? html` <em>stale</em>` : nothing);

/** @param {any} c a case of /api/folder */
function caseRow(c) {
  const compare = c.compare, explain = c.explain;
  const verdict = !explain ? '-' : (explain.adopted ?? []).length > 0 ? explain.adopted.join(', ') : explain.verdict;
  return html`<tr><th scope="row">${link('case', c.name)}</th><td class="number">${c.records}</td>
    <td>${!compare ? '-' : html`${ratio(compare.ratio)}${staleMark(compare)}`}
      ${explain ? html` \u2192 ${ratio(explain.final_ratio_validate)}` : nothing}</td>
    <td>${verdict}${staleMark(explain)}</td>
    <td>${!c.watch ? nothing : link('trend', c.name, c.watch.left === 0 ? `\u2714 ${c.watch.records} records` : `! ${c.watch.left} of ${c.watch.records} records`)}</td></tr>`;
}

/** @param {string} name */
function pick(name) {
  const box = () => {
    picked = picked.includes(name) ? picked.filter((n) => n !== name) : [...picked, name].slice(-2);
    changed();
  };
  return html`<input type="checkbox" aria-label="compare ${name}" .checked=${picked.includes(name)} @change=${box}>`;
}

/** @param {string} kind */
function comparePicked(kind) {
  const of = picked.filter((n) => state.folder.files.find((/** @type {any} */ f) => f.name === n)?.kind === kind);
  return of.length < 2 ? html`<p class="note">Mark two to see only what differs.</p>` :
    html`<p><a class="main" href=${formatAddress({...emptyView(), screen: 'compare', file: of[0], vs: of[1]})}>Compare ${of[0]} and ${of[1]}</a></p>`;
}

/** @param {any} s a scenario */
function scenarioRow(s) {
  const r = s.run;
  const job = activeJob('run', s.name);
  const last = lastJob('run', s.name);
  const verdict = !r ? (last?.state === 'failed' ? '\u2716 failed' : '-') : r.drop ? '\u2716 dropped' : r.touchdown ? '! touched' : '\u2714 up';
  const orbit = r?.max_orbit ? Math.max(...Object.values(r.max_orbit).map(Number)) : NaN;
  return html`<tr><td>${pick(s.name)}</td><th scope="row">${link('run', s.name)}</th><td>${job ? (job.state === 'queued' ? 'waits' : `${Math.round(100 * (state.progress.get(job.id)?.share ?? 0))} %`) : html`${verdict}${staleMark(r)}`}</td>
    <td class="number">${Number.isNaN(orbit) ? '-' : quantity(orbit, 'm')}</td><td class="number">${r?.fault !== undefined && r?.detected !== undefined ? quantity(r.detected - r.fault, 's') : '-'}</td>
    <td>${job ? nothing : html`<button aria-label="run ${s.name}" @click=${() => startJob({command: 'run', scenario: s.name})}>Run</button>`}</td></tr>`;
}

/** @param {any} c a campaign */
function campaignRow(c) {
  const r = c.campaign;
  const job = activeJob('campaign', c.name);
  const last = lastJob('campaign', c.name);
  const share = job ? `${Math.round(100 * (state.progress.get(job.id)?.share ?? 0))} %` : last && last.state !== 'done' ? last.state : '-';
  return html`<tr><th scope="row">${link('campaign', c.name)}</th><td>${r && !job ? html`${r.done} of ${r.runs} runs: ${r.up} up, ${r.touchdown} touched, ${r.drop} dropped${staleMark(r)}` : share}</td></tr>`;
}

/** @param {string} kind @param {string} title @param {string} screen "" where nothing opens */
function list(kind, title, screen) {
  const files = state.folder.files.filter((/** @type {any} */ f) => f.kind === kind);
  if (files.length === 0) return nothing;
  return html`<section><h2>${title}</h2><ul class="files ${kind === 'rig' ? 'marked' : ''}">${files.map((/** @type {any} */ f) =>
    html`<li>${kind === 'rig' ? pick(f.name) : nothing} ${screen ? link(screen, f.name) : f.name}</li>`)}</ul>${kind === 'rig' ? comparePicked('rig') : nothing}</section>`;
}

/** Records, folded: there may be many. */
function records() {
  const files = state.folder.files.filter((/** @type {any} */ f) => f.kind === 'record');
  if (files.length === 0) return nothing;
  return html`<section><h2>Records</h2><details><summary>${files.length} records; Ctrl-K finds one</summary><ul class="files">${files.slice(0, 200).map((/** @type {any} */ f) => html`<li>${link('record', f.name)}</li>`)}</ul></details></section>`;
}

/** @param {any[]} scenarios */
function scenarioTable(scenarios) {
  if (scenarios.length === 0) return nothing;
  return html`<section><h2>Scenarios</h2><table class="scenarios"><thead><tr><th></th><th scope="col">scenario</th><th scope="col">verdict</th><th scope="col">largest orbit</th><th scope="col">detected after</th><th></th></tr></thead>
    <tbody>${scenarios.slice(0, all ? scenarios.length : 100).map(scenarioRow)}</tbody></table>${all || scenarios.length <= 100 ? nothing : html`<p>The first 100 of ${scenarios.length}; Ctrl-K finds any. <button @click=${() => {
    all = true;
    changed();
  }}>Show all</button></p>`}${comparePicked('scenario')}</section>`;
}

export function folderScreen() {
  if (!state.folder) return html`<p>Reading the folder.</p>`;
  const {cases, folder, scenarios, campaigns} = state.folder;
  return html`<h1>${folder}</h1>
    <section><h2>Cases</h2>
    ${cases.length === 0 ? html`<p>No case yet: a case file names a rig and its records. To make one of a record and some numbers of your bench: ${link('new', '-', 'a bench of your own')}.</p>`
    : html`<table class="cases"><thead><tr><th scope="col">case</th><th scope="col">records</th><th scope="col">error over noise</th><th scope="col">what explain found</th><th scope="col">watched</th></tr></thead>
      <tbody>${cases.map(caseRow)}</tbody></table>`}${practiceBar()}</section>
    <div class="columns"><div>${scenarioTable(scenarios)}</div>
    <div>${campaigns.length === 0 ? nothing : html`<section><h2>Campaigns</h2><table><tbody>${campaigns.map(campaignRow)}</tbody></table></section>`}
    ${list('rig', 'Rigs', 'rig')}${records()}${list('broken', 'Files that cannot be read', 'file')}
    <section class="drop"><h2>Add files</h2><label>A record, rig or scenario, or drop it on the page
      <input type="file" multiple @change=${async (/** @type {Event} */ e) => {
        const came = await upload(/** @type {HTMLInputElement} */ (e.target).files, '');
        offerWizard(came);
      }}></label><p>${link('new', '-', 'A bench of your own')}: rig, scenario and case of some numbers and a record.</p></section></div></div>`;
}

/** A record that belongs to no case yet: the wizard asks what it is. @param {string[]} names */
export function offerWizard(names) {
  const record = names.find((n) => /\.(csv|h5|hdf5|mat|uff|unv|tdms|lvm|dat)$/i.test(n));
  if (record) location.hash = formatAddress({...emptyView(), screen: 'new', file: record});
}
