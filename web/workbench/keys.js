/** Keys of the whole page: help, find, the next worst cell; and their dialogs. */
import {html, nothing} from './lit-html.js';
import {emptyView, formatAddress} from './address.js';
import {changed, state} from './state.js';

/** @type {''|'help'|'find'} which dialog is open */
let open = '';
let words = '';
/** @type {HTMLElement|null} where the focus was */
let before = null;

const keys = [
  ['Ctrl-K', 'find a file and open it'], ['?', 'this list'], ['W', 'next worst cell of a case'], ['Escape', 'close'],
  ['Tab', 'next thing; Enter or space presses it'], ['on a panel', ''], ['arrows', 'move the cursor, its values are spoken; Alt: by a sample'],
  ['+ - 0', 'zoom in, out, all'], ['A, B', 'set a cursor'], ['Y', 'hold the y axis'], ['N', 'next event'], ['on a coil', ''], ['Enter', 'break or mend it'], ['M', 'every fault of it'],
  ['in a comparison', ''], ['[ ]', 'shift the second run in time'],
];

/** What each kind of file opens. */
const screens = /** @type {Record<string, string>} */ ({case: 'case', scenario: 'run', campaign: 'campaign', rig: 'rig', broken: 'file', record: 'record'});

/** Files whose name holds all the words. @param {any[]} files @param {string} text */
export function matching(files, text) {
  const all = text.toLowerCase().split(/\s+/).filter((w) => w);
  return files.filter((f) => screens[f.kind] && all.every((w) => f.name.toLowerCase().includes(w)));
}

/** @param {'help'|'find'} which */
export function openDialog(which) {
  before = /** @type {HTMLElement|null} */ (document.activeElement);
  open = which;
  words = '';
  changed();
  requestAnimationFrame(() => requestAnimationFrame(() => /** @type {HTMLElement|null} */ (document.querySelector('[role="dialog"] input, [role="dialog"] button'))?.focus()));
}

function close() {
  open = '';
  changed();
  before?.focus();
}

/** @param {(change: object) => void} go @param {() => void} nextWorst */
export function listenToKeys(go, nextWorst) {
  addEventListener('keydown', (e) => {
    if ((e.ctrlKey || e.metaKey) && e.key.toLowerCase() === 'k') {
      e.preventDefault();
      openDialog('find');
      return;
    }
    if (e.key === 'Escape' && open) close();
    const at = /** @type {HTMLElement} */ (e.target);
    if (e.ctrlKey || e.metaKey || e.altKey || open || ['INPUT', 'SELECT', 'TEXTAREA'].includes(at.tagName)) return;
    if (e.key === '?') openDialog('help');
    else if (e.key.toLowerCase() === 'w' && state.view.screen === 'case') nextWorst();
    else if ((e.key === '[' || e.key === ']') && (state.view.screen === 'compare' || state.view.screen === 'record')) go({shift: Number((state.view.shift + (e.key === ']' ? 0.001 : -0.001)).toFixed(6))});
    else return;
    e.preventDefault();
  });
}

export function dialog() {
  if (open === 'help')
    return html`<div class="veil"><div role="dialog" aria-modal="true" aria-label="keys"><h2>Keys</h2><dl>${keys.map(([k, text]) =>
      text ? html`<div><dt><kbd>${k}</kbd></dt><dd>${text}</dd></div>` : html`<div class="group"><dt>${k}</dt><dd></dd></div>`)}</dl><button @click=${close}>Close</button></div></div>`;
  if (open !== 'find') return nothing;
  const found = matching(state.folder?.files ?? [], words).slice(0, 12);
  const take = (/** @type {any} */ f) => {
    location.hash = formatAddress({...emptyView(), screen: screens[f.kind], file: f.name});
    close();
  };
  return html`<div class="veil"><div role="dialog" aria-modal="true" aria-label="find"><label>Find <input type="search" .value=${words} @input=${(/** @type {Event} */ e) => {
      words = /** @type {HTMLInputElement} */ (e.target).value;
      changed();
    }} @keydown=${(/** @type {KeyboardEvent} */ e) => {
      // What is typed fast is not drawn yet: the list on the screen may be that of the letter before.
      const first = matching(state.folder?.files ?? [], /** @type {HTMLInputElement} */ (e.target).value)[0];
      if (e.key === 'Enter' && first) take(first);
    }}></label>
    <ul class="found">${found.map((f) => html`<li><button @click=${() => take(f)}>${f.name}</button> <span class="note">${f.kind}</span></li>`)}</ul>
    ${found.length === 0 ? html`<p>No file of this name.</p>` : nothing}<button @click=${close}>Close</button></div></div>`;
}
