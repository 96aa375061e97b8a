/** A bench of one's own: the questions of `ambrig new`, and which column of a dropped record is which channel. */
import {html, nothing} from './lit-html.js';
import {loadFolder, resultOfJob, runJob} from './actions.js';
import {emptyView, formatAddress} from './address.js';
import {errorOf} from './job_parts.js';
import {significant} from './numbers.js';
import {complaint} from './questions.js';
import {changed, state, tellError} from './state.js';

/** @typedef {import('./questions.js').Template} Template */
const form = {
  record: '', folder: '', template: '', error: '', busy: '',
  /** @type {Record<string, string>} */
  answers: {},
  /** @type {Record<string, string>} channel -> "column:unit:gain", what the person says otherwise */
  columns: {},
  /** @type {Template[]} */
  templates: [],
  /** @type {{name: string, unit: string, min: number, max: number}[]} */
  found: [],
  /** @type {{channel: string, column: string, unit: string, gain: number, reason: string}[]} */
  chosen: [],
};

/** @param {string} record a file of the folder, "" for none yet */
export async function openWizard(record) {
  Object.assign(form, {record, error: '', busy: 'Reading the questions.', columns: {}, chosen: [], found: [], folder: freeFolder(record)});
  changed();
  try {
    if (form.templates.length === 0) {
      const job = await runJob({command: 'questions'});
      if (job?.state === 'done') form.templates = (await resultOfJob(job.id)).templates;
    }
    form.template ||= form.templates[0]?.name ?? '';
    if (record) {
      const job = await runJob({command: 'channels', file: record});
      if (job?.state === 'done') form.found = (await resultOfJob(job.id)).files[0].record.channels;
      else form.error = job?.error ?? '';
    }
  } catch (error) {
    tellError(error);
  }
  form.busy = '';
  changed();
}

/** @param {string} record */
function freeFolder(record) {
  const stem = record.slice(record.lastIndexOf('/') + 1).replace(/\.[^.]*$/, '').replaceAll(/[^\w-]/g, '_') || 'bench';
  const taken = (/** @type {string} */ name) => state.folder?.files.some((/** @type {any} */ f) => f.name.startsWith(name + '/'));
  let name = stem;
  for (let k = 2; taken(name); ++k) name = `${stem}_${k}`;
  return name;
}

async function make() {
  const template = form.templates.find((t) => t.name === form.template);
  if (!template) return;
  const numbers = Object.fromEntries(template.numbers.filter((q) => (form.answers[q.key] ?? '').trim() !== '').map((q) => [q.key, Number(form.answers[q.key])]));
  form.busy = 'Writing rig, scenario and case.';
  form.error = '';
  changed();
  const order = {command: 'new', template: form.template, numbers, folder: form.folder,
                 ...(form.record ? {record: form.record} : {}), ...(Object.keys(form.columns).length > 0 ? {columns: form.columns} : {})};
  const job = await runJob(order);
  form.busy = '';
  if (job?.state === 'done') {
    await loadFolder();
    location.hash = formatAddress(form.record ? {...emptyView(), screen: 'case', file: form.folder + '/case.toml'} : {...emptyView(), screen: 'run', file: form.folder + '/levitation.toml'});
  } else {
    form.error = job?.error ?? '';
  }
  changed();
}

/** @param {Template} template */
function questions(template) {
  return html`<table class="questions"><tbody>${template.numbers.map((q) => {
    const text = form.answers[q.key] ?? '';
    const wrong = text.trim() === '' ? '' : complaint(q, text);
    return html`<tr><th scope="row"><label for="q-${q.key}">${q.key.replaceAll('_', ' ')}</label></th>
      <td><input id="q-${q.key}" inputmode="decimal" size="10" .value=${text} aria-invalid=${wrong ? 'true' : 'false'} @input=${(/** @type {Event} */ e) => {
        form.answers[q.key] = /** @type {HTMLInputElement} */ (e.target).value;
        changed();
      }}> ${q.unit === '-' ? '' : q.unit}</td><td>${q.doc}${q.fallback === null ? nothing : html` <span class="note">(nothing: ${q.fallback})</span>`}
      ${wrong ? html`<span class="bad">${wrong}</span>` : nothing}</td></tr>`;
  })}</tbody></table>`;
}

/** Columns of the record; what the names do not say can be said. */
function columns() {
  if (form.found.length === 0) return nothing;
  const channelOf = (/** @type {string} */ column) => Object.entries(form.columns).find(([, c]) => c.split(':')[0] === column)?.[0] ?? '';
  return html`<h2>Columns of ${form.record}</h2><p class="note">Names and units say which column is which channel; say it where they do not: A.x, A.i1 (current), A.s1 (set-point), A.d1 (duty), bus.
      A unit or a sign behind the channel: A.x um -1.</p>
    <table><thead><tr><th scope="col">column</th><th scope="col">range</th><th scope="col">is the channel</th></tr></thead><tbody>${form.found.map((c) => html`<tr><th scope="row">${c.name}</th>
      <td class="number">${significant(c.min, 3)} to ${significant(c.max, 3)} ${c.unit}</td>
      <td><input aria-label="channel of ${c.name}" size="12" placeholder="by its name" .value=${channelOf(c.name)} @change=${(/** @type {Event} */ e) => {
        const [channel, ...more] = /** @type {HTMLInputElement} */ (e.target).value.trim().split(/\s+/);
        for (const [k, v] of Object.entries(form.columns)) if (v.split(':')[0] === c.name) delete form.columns[k];
        if (channel) form.columns[channel] = [c.name, ...more].join(':');
        changed();
      }}></td></tr>`)}</tbody></table>`;
}

export function wizardScreen() {
  const template = form.templates.find((t) => t.name === form.template);
  const records = state.folder?.files.filter((/** @type {any} */ f) => f.kind === 'record') ?? [];
  const open = template?.numbers.filter((q) => complaint(q, form.answers[q.key] ?? '') !== '') ?? [];
  return html`<h1>A bench of your own</h1>${form.busy ? html`<p role="status">${form.busy}</p>` : nothing}${form.error ? errorOf(form.error) : nothing}
    <p><label>Record <select @change=${(/** @type {Event} */ e) => {
      location.hash = formatAddress({...emptyView(), screen: 'new', file: /** @type {HTMLSelectElement} */ (e.target).value || '-'});
    }}><option value="" ?selected=${!form.record}>none yet: does it hover?</option>${records.map((/** @type {any} */ f) => html`<option value=${f.name} ?selected=${f.name === form.record}>${f.name}</option>`)}</select></label>
      or drop one on this page.</p>
    <p><label>Kind of bench <select @change=${(/** @type {Event} */ e) => {
      form.template = /** @type {HTMLSelectElement} */ (e.target).value;
      changed();
    }}>${form.templates.map((t) => html`<option value=${t.name} ?selected=${t.name === form.template}>${t.name}: ${t.doc}</option>`)}</select></label></p>
    ${template ? questions(template) : nothing}${columns()}
    <p><label>Folder <input size="20" .value=${form.folder} @input=${(/** @type {Event} */ e) => {
      form.folder = /** @type {HTMLInputElement} */ (e.target).value;
      changed();
    }}></label>
      <button class="main" ?disabled=${open.length > 0 || form.folder === '' || form.busy !== ''} @click=${make}>Write rig, scenario and case</button>
      ${open.length > 0 ? html`<span class="note">still needed: ${open.map((q) => q.key.replaceAll('_', ' ')).join(', ')}</span>` : nothing}</p>`;
}
