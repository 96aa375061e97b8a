/** The page: address, screens, the strip of jobs. */
import {html, nothing, render} from './lit-html.js';
import {loadFolder, stopJob, takeEvent, undo, upload} from './actions.js';
import {formatAddress, parseAddress} from './address.js';
import {listen, takeToken} from './api.js';
import {folderScreen, offerWizard} from './folder_screen.js';
import {dialog, listenToKeys, openDialog} from './keys.js';
import {screenNow, screenOf} from './screens.js';
import {changed, drawWith, state, tellError} from './state.js';

/** When the address last changed. */
const held = {since: 0};

/** Changes the view and the address; a view that was held is a step of the browser's history. @param {object} change */
function go(change) {
  const before = state.view;
  state.view = {...state.view, ...change};
  const address = formatAddress(state.view);
  if (address === location.hash) return;
  // A view that was held is a step of the browser's history; what a wheel passes is none.
  const other = isOther(before, state.view) || before.record !== state.view.record || before.channels.join() !== state.view.channels.join();
  if (!other && Date.now() - held.since < 400) history.replaceState(null, '', address);
  else history.pushState(null, '', address);
  held.since = Date.now();
  if (isOther(before, state.view)) opened();
  changed();
}

/** Whether something else is opened. @param {import('./address.js').View} a @param {import('./address.js').View} b */
function isOther(a, b) {
  return a.file !== b.file || a.screen !== b.screen || ((a.screen === 'compare' || a.screen === 'record') && a.vs !== b.vs);
}

function opened() {
  window.scrollTo(0, 0);
  const {screen, file, vs} = state.view;
  if (screen === 'folder') void loadFolder();
  screenOf(screen).then((s) => s?.open(file, vs), tellError).then(changed);
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
  dispatchEvent(new Event('theme'));
}

function notice() {
  const n = state.notice;
  if (!n) return nothing;
  return html`<div class="notice ${n.bad ? 'bad' : ''}"><span>${n.text}</span>
    ${n.steps.length === 0 ? nothing : html`<button @click=${() => undo(n.steps)}>Undo</button>`}
    <button @click=${() => {
      state.notice = null;
      changed();
    }} aria-label="close">\u00d7</button></div>`;
}

/** Screens of one file of the folder. */
const ofFiles = new Set(['case', 'run', 'campaign', 'rig', 'trend']);

/** @param {string} name */
function shown(name) {
  if (name === 'folder') return folderScreen();
  const file = state.view.file;
  if (ofFiles.has(name) && state.folder && !state.folder.files.some((/** @type {any} */ f) => f.name === file))
    return html`<h1>${file}</h1><p class="bad" role="alert">There is no file ${file} in this folder. <a href="#/">What is there</a></p>`;
  return screenNow(name)?.view(go) ?? html`<p>Loading.</p>`;
}

function draw() {
  const page = document.getElementById('page');
  if (!page) return;
  render(html`${strip()}${notice()}<main>${shown(state.view.screen)}</main>${dialog()}`, page);
  screenNow(state.view.screen)?.draw?.(go);
}

/** A record dropped on a case is offered to it; elsewhere the wizard asks what it is. @param {FileList|null} files */
async function takeDropped(files) {
  if (state.view.screen === 'case') {
    const {takeRecords} = await import('./plan_part.js');
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
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => dispatchEvent(new Event('theme')));
  listenToKeys(go, () => screenNow(state.view.screen)?.next?.(go));
  void listen(takeEvent, () => {
    void loadFolder();
    opened();
  });
  void loadFolder().then(followAddress);
}

begin();
