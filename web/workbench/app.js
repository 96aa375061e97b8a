/** The page: address, screens, the strip of jobs. */
import {html, nothing, render} from './lit-html.js';
import {loadFolder, loadResult, resultOf, startJob, stopJob, takeEvent, undo, upload} from './actions.js';
import {formatAddress, parseAddress} from './address.js';
import {listen, takeToken} from './api.js';
import {caseScreen, drawPanels, openCase} from './case_screen.js';
import {folderScreen} from './folder_screen.js';
import {drawRun, openRun, runScreen} from './run_screen.js';
import {changed, drawWith, state} from './state.js';

/** Changes the view and the address; a view that was held is a step of the browser's history. @param {object} change */
function go(change) {
  const before = state.view;
  state.view = {...state.view, ...change};
  const address = formatAddress(state.view);
  if (address === location.hash) return;
  history.pushState(null, '', address);
  if (before.file !== state.view.file || before.screen !== state.view.screen) opened();
  changed();
}

function opened() {
  window.scrollTo(0, 0);
  if (state.view.screen === 'case') void openCase(state.view.file);
  if (state.view.screen === 'run') void openRun(state.view.file);
  if (state.view.screen === 'folder') void loadFolder();
}

function followAddress() {
  if (location.hash.startsWith('#token=')) takeToken();  // the printed address, opened in this tab again
  const before = state.view;
  state.view = parseAddress(location.hash);
  if (before.file !== state.view.file || before.screen !== state.view.screen) opened();
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
  return folderScreen();
}

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
    <tbody>${values.map(([path, v]) => html`<tr><th scope="row">${path}</th><td class="number">${/** @type {any} */ (v).value}</td>
      <td class="number">${/** @type {any} */ (v).sd ?? ''}</td><td class="number">${/** @type {any} */ (v).fitted ?? ''}</td><td>${/** @type {any} */ (v).unit}</td></tr>`)}</tbody></table>`;
}

function draw() {
  const page = document.getElementById('page');
  if (!page) return;
  render(html`${strip()}${notice()}<main>${shown(state.view.screen)}</main>`, page);
  if (state.view.screen === 'case') drawPanels(go);
  if (state.view.screen === 'run') drawRun();
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
    void upload(e.dataTransfer?.files ?? null, state.view.file.slice(0, state.view.file.lastIndexOf('/') + 1));
  });
  void listen(takeEvent, () => {
    void loadFolder();
    opened();
  });
  void loadFolder().then(followAddress);
}

begin();
