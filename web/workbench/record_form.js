/** A file that was dropped on a case becomes one of its records: which scenario, which column is which channel. */
import {html, nothing} from './lit-html.js';
import {changeText, resultOfJob, runJob, startJob} from './actions.js';
import {guessColumns, relativeName, unitsFor, withRecord} from './case_text.js';
import {significant} from './numbers.js';
import {changed, state, tellError} from './state.js';

/**
 * @typedef {{file: string, data: string, scenario: string, use: string, imposed: boolean, rows: number, rate: number,
 *            columns: {name: string, unit: string, min: number, max: number}[], channels: string[], units: Record<string, string>,
 *            mapping: import('./case_text.js').Mapping[]}} Form
 * @type {Form|null}
 */
let form = null;

/** @param {string} file the case */
export function formOf(file) {
  return form && form.file === file ? form : null;
}

/** Reads what the dropped file holds. @param {string} file the case @param {string} data @param {any} comparison of the case @param {string} scenario "" or what was planned */
export async function offerRecord(file, data, comparison, scenario) {
  try {
    const job = await runJob({command: 'channels', file: data});
    if (!job || job.state !== 'done') return;
    const record = (await resultOfJob(job.id)).files[0].record;
    const channels = [...new Set(comparison?.result.records.flatMap((/** @type {any} */ r) => Object.keys(r.channels)) ?? [])];
    const names = /** @type {string[]} */ (channels);
    const noise = comparison?.result.noise ?? {};
    form = {file, data, scenario: scenario || scenariosFor(file)[0] || '', use: 'fit', imposed: false, rows: record.rows, rate: record.rate,
            columns: record.channels, channels: names, units: Object.fromEntries(names.map((n) => [n, unitOf(n, noise)])), mapping: guessColumns(names, record.channels)};
  } catch (error) {
    tellError(error);
  }
  changed();
}

/** SI unit of a channel by its name. @param {string} name @param {any} noise */
function unitOf(name, noise) {
  if (/\.[is]\d+$/.test(name)) return 'A';
  if (/\.f[xyz]$/.test(name)) return 'N';
  if (name === 'bus') return 'V';
  if (name === 'omega') return 'rad/s';
  return /\.d\d+$/.test(name) || noise === null ? '-' : 'm';
}

/** Scenarios beside the case, the newest first. @param {string} file */
function scenariosFor(file) {
  const folder = file.slice(0, file.lastIndexOf('/') + 1);
  const all = state.folder.files.filter((/** @type {any} */ f) => f.kind === 'scenario');
  const near = all.filter((/** @type {any} */ f) => f.name.startsWith(folder));
  return (near.length > 0 ? near : all).sort((/** @type {any} */ a, /** @type {any} */ b) => b.changed - a.changed).map((/** @type {any} */ f) => f.name);
}

/** @param {Form} f */
async function append(f) {
  form = null;
  try {
    await changeText(f.file, (text) => withRecord(text, {scenario: relativeName(f.file, f.scenario), data: relativeName(f.file, f.data), use: f.use, columns: f.mapping, imposed: f.imposed}),
                     `${f.data} is a record of ${f.file}`);
    await startJob({command: 'compare', case: f.file});
  } catch (error) {
    tellError(error);
  }
}

/** @param {string} file the case */
export function recordForm(file) {
  const f = formOf(file);
  if (!f) return nothing;
  const set = (/** @type {(f: Form) => void} */ how) => {
    how(f);
    changed();
  };
  const valueOf = (/** @type {Event} */ e) => /** @type {HTMLSelectElement} */ (e.target).value;
  return html`<section class="adopt" aria-label="new record"><h2>${f.data} as a record</h2>
    <p>${f.rows} rows at ${significant(f.rate, 4)} Hz. <label>It was made by the scenario <select @change=${(/** @type {Event} */ e) => set(() => (f.scenario = valueOf(e)))}>
      ${scenariosFor(file).map((/** @type {string} */ s) => html`<option value=${s} ?selected=${s === f.scenario}>${s}</option>`)}</select></label>
      <label>and is <select @change=${(/** @type {Event} */ e) => set(() => (f.use = valueOf(e)))}>
      ${['fit', 'validate'].map((u) => html`<option value=${u} ?selected=${u === f.use}>${u === 'fit' ? 'fitted' : 'kept unseen'}</option>`)}</select></label></p>
    ${columnTable(f.channels, f.units, f.columns, f.mapping, changed)}
    ${f.mapping.length === 0 ? html`<p class="bad">No column is a channel of the rig yet: choose at least one.</p>` : nothing}
    <p><button class="main" ?disabled=${f.mapping.length === 0 || !f.scenario} @click=${() => append(f)}>Append to ${f.file}</button>
      <button @click=${() => {
        form = null;
        changed();
      }}>Not now</button></p></section>`;
}

/**
 * Which column is which channel, with unit and sign.
 * @param {string[]} channels @param {Record<string, string>} units @param {{name: string, unit: string, min: number, max: number}[]} columns
 * @param {import('./case_text.js').Mapping[]} mapping changed in place @param {() => void} done
 */
export function columnTable(channels, units, columns, mapping, done) {
  const of = (/** @type {string} */ c) => mapping.find((m) => m.channel === c);
  const set = (/** @type {string} */ channel, /** @type {Partial<import('./case_text.js').Mapping>} */ change) => {
    const at = mapping.findIndex((m) => m.channel === channel);
    const next = {channel, column: '', unit: '', gain: 1, ...(at < 0 ? {} : mapping[at]), ...change};
    if (at >= 0) mapping.splice(at, 1);
    if (next.column) mapping.push(next);
    mapping.sort((a, b) => channels.indexOf(a.channel) - channels.indexOf(b.channel));
    done();
  };
  const range = (/** @type {string} */ name) => {
    const c = columns.find((one) => one.name === name);
    return c ? `${significant(c.min, 3)} to ${significant(c.max, 3)}${c.unit ? ' ' + c.unit : ''}` : '';
  };
  return html`<div class="scroll" tabindex="0" role="region" aria-label="columns"><table><thead><tr><th scope="col">channel</th><th scope="col">column</th><th scope="col">unit</th><th scope="col">sign</th><th scope="col">range</th></tr></thead>
    <tbody>${channels.map((c) => {
      const m = of(c);
      return html`<tr><th scope="row">${c}</th>
        <td><select aria-label="column of ${c}" @change=${(/** @type {Event} */ e) => set(c, {column: /** @type {HTMLSelectElement} */ (e.target).value})}>
          <option value="" ?selected=${!m}>-</option>${columns.map((o) => html`<option value=${o.name} ?selected=${m?.column === o.name}>${o.name}</option>`)}</select></td>
        <td>${m ? html`<select aria-label="unit of ${c}" @change=${(/** @type {Event} */ e) => set(c, {unit: /** @type {HTMLSelectElement} */ (e.target).value})}>
          <option value="">as given</option>${unitsFor(units[c] ?? '').map((u) => html`<option value=${u} ?selected=${m.unit === u}>${u}</option>`)}</select>` : nothing}</td>
        <td>${m ? html`<button aria-pressed=${m.gain < 0 ? 'true' : 'false'} aria-label="sign of ${c}" @click=${() => set(c, {gain: -m.gain})}>${m.gain < 0 ? '-' : '+'}</button>` : nothing}</td>
        <td class="number">${m ? range(m.column) : ''}</td></tr>`;
    })}</tbody></table></div>`;
}

/** Files that are records. @param {string} name */
export function isRecord(name) {
  return /\.(csv|h5|hdf5|mat|uff|unv|tdms|lvm|dat|txt)$/i.test(name);
}

