/** The rig over months: the records of a logger's folder, floors, closure and every fitted parameter. */
import {html, nothing, svg} from './lit-html.js';
import {changeText, loadResult, openReport, resultOf, startJob, watchFolder} from './actions.js';
import {emptyView, formatAddress} from './address.js';
import {recordCopied, relativeName} from './case_text.js';
import {errorOf, progressOf} from './job_parts.js';
import {prefixFor, significant, uncertain} from './numbers.js';
import {activeJob, lastJob, state, tellError} from './state.js';
import {alarms, moved, pointsOf, scaleFor} from './trend.js';

/** @param {string} file the case */
function watchedOf(file) {
  return state.watched.filter((w) => w.case === file);
}

/** Folders of records that may be a logger's, not the case's own. @param {string} file */
function foldersFor(file) {
  const own = file.slice(0, file.lastIndexOf('/'));
  const found = new Set();
  for (const f of state.folder?.files ?? [])
    if (f.kind === 'record' && f.name.includes('/')) found.add(f.name.slice(0, f.name.lastIndexOf('/')));
  return [...found].filter((f) => f !== own).sort();
}

/** On the case's screen: which folder a logger writes to. @param {string} file */
export function watchPart(file) {
  const watched = watchedOf(file);
  const folders = foldersFor(file);
  const about = state.folder?.cases.find((/** @type {any} */ c) => c.name === file)?.watch;
  return html`<section class="watch" aria-label="watch"><h2>Watch a folder</h2>
    ${watched.map((w) => html`<p>${w.folder} is watched. <button @click=${() => watchFolder(file, w.folder, false)}>Stop watching</button></p>`)}
    ${about ? html`<p>${about.records} records examined, ${about.left === 0 ? '\u2714 all within their bands' : `! ${about.left} to look at`}.</p>` : nothing}
    ${about || watched.length > 0 ? html`<p><a href=${formatAddress({...emptyView(), screen: 'trend', file})}>Trend of the records</a></p>` : nothing}
    ${watched.length > 0 ? nothing : folders.length === 0
      ? html`<p class="note">A folder beside the case that a logger writes records to can be watched: each new record is compared and fitted, and what changed is told.
        A file there repeats the record of the case whose name its own begins with.</p>`
      : html`<form @submit=${(/** @type {SubmitEvent} */ e) => {
        e.preventDefault();
        void watchFolder(file, String(new FormData(/** @type {HTMLFormElement} */ (e.target)).get('folder')), true);
      }}><label>Folder of the logger <select name="folder">${folders.map((f) => html`<option>${f}</option>`)}</select></label> <button>Watch</button></form>`}</section>`;
}

/** @param {string} file */
export async function openTrend(file) {
  await loadResult('watch', file);
}

const wide = 640, high = 110;

/**
 * @param {string} title @param {string} unit
 * @param {{k: number, v: number, sd?: number, least?: number, greatest?: number, r: import('./trend.js').WatchedRecord}[]} points @param {number} count of records
 * @param {number[]} shown values that the scale holds in any case
 */
function line(title, unit, points, count, shown = []) {
  if (points.length === 0) return nothing;
  const p = prefixFor(Math.max(...points.map((q) => Math.abs(q.v))), unit);
  const all = points.flatMap((q) => [q.v - (q.sd ?? 0), q.v + (q.sd ?? 0), q.least ?? q.v, q.greatest ?? q.v]).concat(shown).map((v) => v * p.factor);
  const scale = scaleFor(all, high);
  const x = (/** @type {number} */ k) => 50 + ((k + 0.5) / Math.max(count, 1)) * (wide - 60);
  const y = (/** @type {number} */ v) => scale.y(v * p.factor);
  const half = Math.min(14, (wide - 60) / Math.max(count, 1) / 2);
  const last = points[points.length - 1];
  const out = (/** @type {{v: number, least?: number, greatest?: number}} */ q) => q.least !== undefined && q.greatest !== undefined && (q.v < q.least || q.v > q.greatest);
  const words = `${title}: ${points.length} records, last ${last.sd ? uncertain(last.v, last.sd, unit) : significant(last.v * p.factor, 3) + ' ' + p.unit}`;
  return html`<figure class="trend"><figcaption>${title}${p.unit ? ` [${p.unit}]` : ''}${points.some(out) ? ' \u2013 ! left its band' : ''}</figcaption>
    <svg viewBox="0 0 ${wide} ${high + 8}" role="img" tabindex="0" aria-label=${words}>
      ${Math.max(...all) > Math.min(...all) ? svg`<text x="2" y=${scale.y(Math.max(...all)) + 6}>${significant(Math.max(...all), 4)}</text>` : nothing}<text x="2" y=${scale.y(Math.min(...all)) + 2}>${significant(Math.min(...all), 4)}</text>
      ${points.map((q) => q.least === undefined || q.greatest === undefined ? nothing
        : svg`<rect class="band" x=${x(q.k) - half} width=${2 * half} y=${y(q.greatest)} height=${Math.max(1, y(q.least) - y(q.greatest))}></rect>`)}
      <polyline points=${points.map((q) => `${x(q.k)},${y(q.v)}`).join(' ')}></polyline>
      ${points.map((q) => svg`${q.sd ? svg`<line x1=${x(q.k)} x2=${x(q.k)} y1=${y(q.v - q.sd)} y2=${y(q.v + q.sd)}></line>` : nothing}
        <circle class=${out(q) ? 'out' : ''} cx=${x(q.k)} cy=${y(q.v)} r=${out(q) ? 5 : 3}><title>${q.r.data}: ${significant(q.v * p.factor, 4)} ${p.unit}</title></circle>`)}</svg></figure>`;
}

/** @param {import('./trend.js').WatchedRecord[]} records @param {string} path */
function parameterLine(records, path) {
  const points = pointsOf(records, (r) => r.parameters?.[path]?.value).map((p) => {
    const q = /** @type {import('./trend.js').Parameter} */ (p.r.parameters?.[path]);
    return {...p, sd: q.sd, least: q.least, greatest: q.greatest};
  });
  return line(path, points[0]?.r.parameters?.[path]?.unit ?? '', points, records.length);
}

/** Makes a record of the folder one of the case, to go on in the main flow. @param {string} file @param {any} r @param {string} folder */
async function addToCase(file, r, folder) {
  try {
    await changeText(file, (text) => recordCopied(text, r.of, relativeName(file, folder + '/' + r.data)), `${r.data} is a record of ${file}`);
    location.hash = formatAddress({...emptyView(), screen: 'case', file});
    await startJob({command: 'compare', case: file});
  } catch (error) {
    tellError(error);
  }
}

/** @param {import('./trend.js').WatchedRecord[]} records @param {string} file @param {string} folder */
function alarmList(records, file, folder) {
  const found = alarms(records);
  if (found.length === 0) return html`<p class="verdict">\u2714 All records stay within their bands.</p>`;
  return html`<p class="verdict">! ${found.length} of ${records.length} records need a look</p><ul class="alarms">${found.slice(0, 20).map((r) => html`<li><strong>${r.data}</strong>
    ${r.error ? html`<span class="bad">${r.error}</span>` : nothing}
    ${(r.data_faults ?? []).map((f) => html`<div>the data are wrong: ${f.text}</div>`)}
    ${r.left.map((b) => html`<div>${b.text}</div>`)}
    ${r.explanation ? html`<div><em>${r.explanation.text}</em>${r.explanation.of ? html` (as ${r.explanation.of})` : nothing}</div>` : nothing}
    ${r.state === 'left' ? html`<button @click=${() => addToCase(file, r, folder)}>Add it to the case</button>` : nothing}</li>`)}</ul>`;
}

export function trendScreen() {
  const file = state.view.file;
  const found = resultOf('watch', file);
  const job = activeJob('watch', file);
  const last = lastJob('watch', file);
  const folder = found?.result.folder ?? watchedOf(file)[0]?.folder;
  const partial = job ? state.progress.get(job.id)?.partial : null;
  const doc = partial ?? found?.result;
  /** @type {import('./trend.js').WatchedRecord[]} */
  const records = doc?.records ?? [];
  return html`<h1>Trend of <a href=${formatAddress({...emptyView(), screen: 'case', file})}>${file}</a></h1>
    ${job ? progressOf(job, 'watch') : nothing}${!job && last?.state === 'failed' ? errorOf(last.error) : nothing}
    ${(doc?.warnings ?? []).map((/** @type {string} */ w) => html`<p class="note">${w}</p>`)}
    ${records.length === 0 ? html`<p>No record was examined yet. ${folder ? html`Files in ${folder} are taken when they have not changed for some seconds.` : html`Choose the folder of the logger on the case's page.`}</p>`
    : html`<div class="columns"><div>
        ${line('error over noise, parameters of the reference', '-', pointsOf(records, (r) => r.ratio), records.length, [0, 1])}
        ${line('error over noise, its own parameters', '-', pointsOf(records, (r) => r.ratio_fitted), records.length, [0, 1])}
        ${line('closure: share that its own parameters explain', '-', pointsOf(records, (r) => ((r.ratio ?? 0) > 1 ? r.explained : undefined)), records.length, [0, 1])}
        <p class="note">${dayOf(records[0])} to ${dayOf(records[records.length - 1])}, one point a record</p><h2>Parameters, the most moved first</h2>${moved(records).map((m) => parameterLine(records, m.path))}</div>
      <div>${alarmList(records, file, folder ?? '')}${recordTable(records)}</div></div>`}
    <p>${folder && !job ? html`<button @click=${() => startJob({command: 'watch', case: file, folder})}>Look now</button>` : nothing}
      ${found ? html`<button @click=${() => openReport(found.job)}>Report</button>` : nothing}</p>`;
}

/** When a record was written, UTC. @param {import('./trend.js').WatchedRecord} r */
function dayOf(r) {
  return new Date(1000 * r.changed).toISOString().slice(0, 16).replace('T', ' ');
}

/** @param {import('./trend.js').WatchedRecord[]} records */
function recordTable(records) {
  return html`<div class="scroll" tabindex="0" role="region" aria-label="records"><table><thead><tr><th scope="col">record</th><th scope="col">as</th><th scope="col">written</th><th scope="col">error</th><th scope="col">own</th><th scope="col">state</th></tr></thead>
    <tbody>${records.map((r) => html`<tr><th scope="row">${r.data}</th><td>${r.of ?? ''}</td><td>${dayOf(r)}</td>
      <td class="number">${r.ratio === undefined ? '-' : significant(r.ratio, 3)}</td><td class="number">${r.ratio_fitted === undefined ? '-' : significant(r.ratio_fitted, 3)}</td>
      <td>${{ok: '\u2714 in its bands', left: '! left', data: '! wrong data', refused: '\u2716 refused'}[r.state] ?? r.state}</td></tr>`)}</tbody></table></div>`;
}
