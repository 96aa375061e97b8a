/** A text file with what is wrong with it: read, mended and written, with Undo. */
import {html} from './lit-html.js';
import {writeText} from './actions.js';
import {getText} from './api.js';
import {changed, state, tellError} from './state.js';

/** @type {{file: string, text: string, hash: string}} */
let open = {file: '', text: '', hash: ''};

/** @param {string} file */
export async function openFile(file) {
  open = {file, text: '', hash: ''};
  try {
    const {text, hash} = await getText('/api/file?p=' + encodeURIComponent(file));
    open = {file, text, hash};
  } catch (error) {
    tellError(error);
  }
  changed();
}

export function fileScreen() {
  return html`<h1>${state.view.file}</h1><p><label for="text">Its text; a file that another program changed meanwhile is not overwritten.</label></p>
    <textarea id="text" rows="28" spellcheck="false" .value=${open.text} @input=${(/** @type {Event} */ e) => {
      open.text = /** @type {HTMLTextAreaElement} */ (e.target).value;
    }}></textarea>
    <p><button class="main" @click=${async () => {
      try {
        await writeText(open.file, open.text, open.hash);
        await openFile(open.file);
      } catch (error) {
        tellError(error);
      }
    }}>Write</button></p>`;
}
