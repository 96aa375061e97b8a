/** The page: address, screens, the strip of jobs. */
import {html, nothing, render} from './lit-html.js';
import {loadFolder, loadResult, resultOf, startJob, stopJob, takeEvent, undo, upload} from './actions.js';
import {formatAddress, parseAddress} from './address.js';
import {listen, takeToken} from './api.js';
import {campaignScreen, drawCampaign, openCampaign} from './campaign_screen.js';
import {caseScreen, drawPanels, nextWorst, openCase} from './case_screen.js';
import {compareScreen, drawCompare, openCompare} from './compare_screen.js';
import {fileScreen, openFile} from './file_screen.js';
import {folderScreen, offerWizard} from './folder_screen.js';
import {dialog, listenToKeys, openDialog} from './keys.js';
import {takeRecords} from './plan_part.js';
import {drawRun, openRun, runScreen} from './run_screen.js';
import {changed, drawWith, state} from './state.js';
import {openTrend, trendScreen} from './trend_screen.js';
import {openWizard, wizardScreen} from './wizard_screen.js';

/** Changes the view and the address; a view that was held is a step of the browser's history. @param {object} change */
function go(change) {
  const before = state.view;
  state.view = {...state.view, ...change};
  const address = formatAddress(state.view);
  if (address === location.hash) return;
  history.pushState(null, '', address);
  if (isOther(before, state.view)) opened();
  changed();
}

/** Whether something else is opened. @param {import('./address.js').View} a @param {import('./address.js').View} b */
function isOther(a, b) {
  return a.file !== b.file || a.screen !== b.screen || (a.screen === 'compare' && a.vs !== b.vs);
}

function opened() {
  window.scrollTo(0, 0);
  const {screen, file, vs} = state.view;
  if (screen === 'case') void openCase(file);
  if (screen === 'run') void openRun(file);
  if (screen === 'campaign') void openCampaign(file);
  if (screen === 'compare') void openCompare(file, vs);
  if (screen === 'trend') void openTrend(file);
  if (screen === 'new') void openWizard(file === '-' ? '' : file);
  if (screen === 'file') void openFile(file);
  if (screen === 'folder') void loadFolder();
}

function followAddress() {
  if (location.hash.startsWith('#token=')) takeToken();  // the printed address, opened in this tab again
  const before = state.view;
  state.view = parseAddress(location.hash);
  if (isOther(before, state.view)) opened();
  changed();
}

function strip() {
  const active = state.jobs.filter((j) => j.state === 'running' || j.state === 'queued');
  return html`<header><nav aria-label="ambrig"><a href="#/" class="home">ambrig</a>
    ${state.view.screen === 'folder' ? nothing : html`<span aria-hidden="true">/</span><span>${state.view.file}</span>`}</nav>
    <ul class="jobs" aria-label="jobs">${active.map((j) => {
      const p = state.progress.get(j.id);
      return html`<li>job ${j.id}: ${j.command} ${j.state === 'queued' ? 'waits' : `${Math.round(100 * (p?.share ?? 0))} %`}
        <button class="stop" @click=${() => stopJob(j.id)} aria-label="stop job ${j.id}">stop</button></li>`;
    })}</ul>
    <button @click=${() => openDialog('find')} aria-label="find, Ctrl-K">find</button> <button @click=${() => openDialog('help')} aria-label="keys">?</button>
    <button @click=${switchTheme} aria-label="light or dark">\u25d0</button></header>`;
}

function switchTheme() {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  root.dataset.theme = dark ? 'light' : 'dark';
}

function notice() {
  const n = state.notice;
  if (!n) return nothing;
  const step = n.step;
  return html`<div class="notice ${n.bad ? 'bad' : ''}"><span>${n.text}</span>
    ${step === null ? nothing : html`<button @click=${() => undo(step)}>Undo</button>`}
    <button @click=${() => {
      state.notice = null;
      changed();
    }} aria-label="close">\u00d7</button></div>`;
}

/** @param {string} screen */
function shown(screen) {
  if (screen === 'case') return caseScreen(go);
  if (screen === 'run') return runScreen(go);
  if (screen === 'rig') return rigScreen();
  if (screen === 'campaign') return campaignScreen();
  if (screen === 'compare') return compareScreen(go);
  if (screen === 'trend') return trendScreen();
  if (screen === 'new') return wizardScreen();
  if (screen === 'file') return fileScreen();
  return folderScreen();
}

/** Three digits more than a person needs, none that the file did not have. @param {any} v */
const figure = (v) => (typeof v === 'number' ? String(Number(v.toPrecision(6))) : v ?? '');

function rigScreen() {
  const found = resultOf('rig', state.view.file);
  if (found === undefined) {
    state.results.set('rig ' + state.view.file, null);
    void startJob({command: 'rig', rig: state.view.file});
    void loadResult('rig', state.view.file);
  }
  if (!found) return html`<h1>${state.view.file}</h1><p>Reading the rig.</p>`;
  const values = Object.entries(found.result.values);
  return html`<h1>${state.view.file}</h1><table><thead><tr><th scope="col">number</th><th scope="col">value</th><th scope="col">sd</th><th scope="col">fitted</th><th scope="col">unit</th></tr></thead>
    <tbody>${values.map(([path, v]) => html`<tr><th scope="row">${path}</th><td class="number">${figure(/** @type {any} */ (v).value)}</td>
      <td class="number">${figure(/** @type {any} */ (v).sd)}</td><td class="number">${figure(/** @type {any} */ (v).fitted)}</td><td>${/** @type {any} */ (v).unit}</td></tr>`)}</tbody></table>`;
}

function draw() {
  const page = document.getElementById('page');
  if (!page) return;
  render(html`${strip()}${notice()}<main>${shown(state.view.screen)}</main>${dialog()}`, page);
  if (state.view.screen === 'case') drawPanels(go);
  if (state.view.screen === 'run') drawRun(go);
  if (state.view.screen === 'compare') drawCompare(go);
  if (state.view.screen === 'campaign') drawCampaign(go);
}

/** A record dropped on a case is offered to it; elsewhere the wizard asks what it is. @param {FileList|null} files */
async function takeDropped(files) {
  if (state.view.screen === 'case') {
    await takeRecords(files, state.view.file);
    return;
  }
  const file = state.view.screen === 'new' ? '' : state.view.file;
  const came = await upload(files, file.slice(0, file.lastIndexOf('/') + 1));
  if (state.view.screen === 'folder' || state.view.screen === 'new') offerWizard(came);
}

function begin() {
  const page = document.getElementById('page');
  page?.replaceChildren();
  if (!takeToken()) {
    if (page) render(html`<main><h1>No key</h1><p>Open the address that <code>ambrig serve</code> printed: it ends with the key of this session.</p></main>`, page);
    return;
  }
  drawWith(draw);
  addEventListener('hashchange', followAddress);
  addEventListener('popstate', followAddress);
  addEventListener('dragover', (e) => e.preventDefault());
  addEventListener('drop', (e) => {
    e.preventDefault();
    void takeDropped(e.dataTransfer?.files ?? null);
  });
  listenToKeys(go, nextWorst);
  void listen(takeEvent, () => {
    void loadFolder();
    opened();
  });
  void loadFolder().then(followAddress);
}

begin();
