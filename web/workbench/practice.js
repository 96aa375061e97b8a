/** Something to practise on: a rig with a secret, and before that an example rig. */
import {html} from './lit-html.js';
import {loadFolder, runJob} from './actions.js';
import {emptyView, formatAddress} from './address.js';
import {changed, state, tell} from './state.js';

/** Effects that a radial rig may hide; which one it is stands sealed beside the case. */
const secrets = ['cross-coupling', 'sensor-gain', 'sensor-rotation', 'eddy-currents', 'unbalance', 'side-pull', 'current-sensor-gain', 'saturation'];

let busy = '';

/** A folder's name that is free. @param {string} stem */
function freeFolder(stem) {
  const names = state.folder.files.map((/** @type {any} */ f) => f.name);
  for (let k = 1; ; ++k) {
    const name = k === 1 ? stem : `${stem}_${k}`;
    if (!names.some((/** @type {string} */ n) => n.startsWith(name + '/') || n === name + '.answer.toml')) return name;
  }
}

/** @param {string} what for the person @param {{command: string} & Record<string, any>} order */
async function make(what, order) {
  busy = what;
  changed();
  const job = await runJob(order);
  busy = '';
  await loadFolder();
  return job?.state === 'done';
}

/** @param {string} effect "": any @param {number} seed */
async function practise(effect, seed) {
  const rig = state.folder.files.find((/** @type {any} */ f) => f.kind === 'rig')?.name;
  if (!rig) return;
  const folder = freeFolder('practice');
  const hidden = effect || secrets[Math.floor(Math.random() * secrets.length)];
  if (!(await make('Nine records of a rig with a secret are made.', {command: 'hide', effect: hidden, rig, seed, folder}))) return;
  tell(`${folder} is a rig that does something its model does not; the answer lies sealed in ${folder}.answer.toml`);
  location.hash = formatAddress({...emptyView(), screen: 'case', file: folder + '/case.toml'});
}

export function practiceBar() {
  const rigs = state.folder.files.some((/** @type {any} */ f) => f.kind === 'rig');
  if (busy) return html`<p role="status"><progress aria-label="practice"></progress> ${busy}</p>`;
  return rigs ? html`<form @submit=${(/** @type {SubmitEvent} */ e) => {
      e.preventDefault();
      const data = new FormData(/** @type {HTMLFormElement} */ (e.target));
      void practise(String(data.get('effect')), Number(data.get('seed')));
    }}><button>Practice case</button> <label>hiding <select name="effect"><option value="">any effect</option>${secrets.map((s) => html`<option>${s}</option>`)}</select></label>
      <label>seed <input name="seed" type="number" min="0" max="100000" class="time" value="1"></label></form>`
    : html`<p><button @click=${() => make('An example rig is written.', {command: 'tour', folder: freeFolder('example')})}>Example rig and scenarios</button></p>`;
}
