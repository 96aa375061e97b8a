/** A record as it is: its channels over time, as the file has them; another file beside it. */
import {html, nothing} from './lit-html.js';
import {getJson} from './api.js';
import {emptyView, formatAddress} from './address.js';
import {significant} from './numbers.js';
import {Panels} from './panels.js';
import {shareBar} from './share.js';
import {changed, state} from './state.js';

/** @type {Panels|null} */
let panels = null;
/** @type {{file: string, about: any, error: string, vs: string, other: any}} */
let open = {file: '', about: null, error: '', vs: '', other: null};

const query = (/** @type {string} */ file) => 'p=' + encodeURIComponent(file);

/** @param {string} file @param {string} vs */
export async function openRecord(file, vs) {
  panels?.clear();
  open = {file, about: null, error: '', vs, other: null};
  try {
    const about = await getJson('/api/series?' + query(file));
    const other = vs ? await getJson('/api/series?' + query(vs)) : null;
    if (open.file === file && open.vs === vs) open = {...open, about, other};
  } catch (error) {
    if (open.file === file) open.error = error instanceof Error ? error.message : String(error);
  }
  changed();
}

/** The chosen channels, at first the first four. */
function chosen() {
  const names = open.about.channels.map((/** @type {any} */ c) => c.name);
  const asked = state.view.channels.filter((c) => names.includes(c));
  return asked.length > 0 ? asked : names.slice(0, 4);
}

/** @param {(change: object) => void} go */
export function recordScreen(go) {
  const file = state.view.file;
  if (open.error) return html`<h1>${file}</h1><p class="bad" role="alert">${open.error}</p>`;
  if (!open.about) return html`<h1>${file}</h1><p>Reading the record.</p>`;
  const now = chosen();
  const toggle = (/** @type {string} */ name) => go({channels: now.includes(name) ? now.filter((/** @type {string} */ c) => c !== name) : [...now, name].slice(-8)});
  const others = state.folder?.files.filter((/** @type {any} */ f) => f.kind === 'record' && f.name !== file) ?? [];
  return html`<h1>${file}</h1><p>${open.about.rows} rows at ${significant(open.about.rate, 5)} Hz from ${significant(open.about.start, 4)} s on.
      <a href=${formatAddress({...emptyView(), screen: 'new', file})}>Make a bench of it</a>
      <label>beside it <select @change=${(/** @type {Event} */ e) => go({vs: /** @type {HTMLSelectElement} */ (e.target).value})}><option value="">-</option>${others.map((/** @type {any} */ f) =>
        html`<option value=${f.name} ?selected=${f.name === state.view.vs}>${f.name}</option>`)}</select></label></p>
    <p class="channels">${open.about.channels.map((/** @type {any} */ c) => html`<button aria-pressed=${now.includes(c.name) ? 'true' : 'false'} @click=${() => toggle(c.name)}>${c.name}</button> `)}</p>
    <p class="marks"></p><div class="panels" id="panels"></div>${shareBar(() => panels)}
    ${(open.about.notes ?? []).map((/** @type {string} */ n) => html`<p class="note">${n}</p>`)}${nothing}`;
}

/** After the screen was drawn. @param {(change: object) => void} go */
export function drawRecord(go) {
  const place = document.getElementById('panels');
  const {file, vs, shift} = state.view;
  if (!place || !open.about || open.file !== file) return;
  if (!panels || panels.place !== place) panels = new Panels(place, (moved) => go({...moved, channels: chosen()}));
  const has = new Set(open.other?.channels.map((/** @type {any} */ c) => c.name) ?? []);
  const plots = chosen().map((/** @type {string} */ c) => ({title: c, height: 110, lines: [{channel: c, label: c, tone: 'measured'},
    ...(has.has(c) ? [{channel: c, label: vs, tone: 'error', dash: [4, 3], query: query(vs), shift}] : [])]}));
  if (plots.length > 0) void panels.show({query: query(file), name: file, plots, from: state.view.from, to: state.view.to, marks: state.view.marks});
}
