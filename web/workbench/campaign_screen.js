/** A campaign: its map fills while it runs, a row opens its report. */
import {html, nothing} from './lit-html.js';
import {loadResult, openReport, resultOf, runJob, startJob} from './actions.js';
import {getJson} from './api.js';
import {countOf, failedShare, filtered, histogram, mapOf, parseRows, verdicts, verdictText} from './campaign_rows.js';
import {command, errorOf, progressOf} from './job_parts.js';
import {quantity, significant} from './numbers.js';
import {figures, queryOf, recordOf, runPlots, stemOf, summary} from './run_parts.js';
import {Panels} from './panels.js';
import {activeJob, changed, lastJob, state, tellError} from './state.js';

/** @type {{job: number, columns: string[], total: number, runs: number, rows: import('./campaign_rows.js').Row[], asking: boolean, whole: boolean}} whole: asked after its end, all are here */
let got = {job: 0, columns: [], total: 0, runs: 0, rows: [], asking: false, whole: false};
/** @type {import('./campaign_rows.js').Filter} */
let filter = {set: null, load: null, verdict: null, from: null, to: null};
let page = 0;
/** @type {{row: number, job: number, result: any}|null} the row that was opened */
let opened = null;
/** @type {Panels|null} */
let panels = null;

/** @param {string} file */
export async function openCampaign(file) {
  got = {job: 0, columns: [], total: 0, runs: 0, rows: [], asking: false, whole: false};
  filter = {set: null, load: null, verdict: null, from: null, to: null};
  page = 0;
  opened = null;
  panels?.clear();
  clearTimeout(timer);
  timer = 0;
  await loadResult('campaign', file);
}

/** Asks for the rows that are new. @param {number} job @param {boolean} ended whether the job had ended before */
async function more(job, ended) {
  if (got.asking) return;
  if (got.job !== job) got = {job, columns: [], total: 0, runs: 0, rows: [], asking: false, whole: false};
  got.asking = true;
  try {
    const answer = await getJson(`/api/rows?job=${job}&from=${got.rows.length}`);
    if (got.job === job) {
      if (answer.columns.length > 0) got.columns = answer.columns;
      got.rows.push(...parseRows(answer.rows, got.columns));
      got.total = answer.total;
      got.runs = answer.runs;
      got.whole = ended && got.rows.length >= got.total;
      if (answer.rows.length > 0 || got.whole) changed();
    }
  } catch (error) {
    tellError(error);
  }
  got.asking = false;
}

let timer = 0;
/** While it runs every second, afterwards until all are there. @param {import('./state.js').Job} job */
function follow(job) {
  const runs = job.state === 'running' || job.state === 'queued';
  if (got.job !== job.id || (!runs && !got.whole)) void more(job.id, !runs);
  if (!runs) return;
  got.whole = false;
  // Progress is told, and drawn, more often than that: what waits goes on waiting.
  timer ||= setTimeout(() => {
    timer = 0;
    void more(job.id, false).then(changed);
  }, 1000);
}

/** Runs a row again with its record and report. @param {string} file @param {number} row */
async function openRow(file, row) {
  opened = {row, job: 0, result: null};
  panels?.clear();
  changed();
  const job = await runJob({command: 'row', campaign: file, row});
  if (!job || job.state !== 'done' || opened?.row !== row) return;
  const answer = await getJson(`/api/jobs/${job.id}/result`);
  opened = {row, job: job.id, result: answer};
  changed();
}

/** @param {{sets: string[], loads: number[], cells: Map<string, import('./campaign_rows.js').Cell>}} map */
function mapTable(map) {
  return html`<div class="scroll" tabindex="0" role="region" aria-label="map"><table class="misfit map"><caption>Runs that did not stay up, of all of the cell. A click filters the rows.</caption>
    <thead><tr><th scope="col">set \\ load</th>${map.loads.map((l) => html`<th scope="col">${Number.isNaN(l) ? '-' : significant(l, 3)}</th>`)}</tr></thead>
    <tbody>${map.sets.map((set) => html`<tr><th scope="row">${set}</th>${map.loads.map((load) => {
      const cell = map.cells.get(`${set}|${load}`);
      if (!cell) return html`<td></td>`;
      const failed = cell.total - (cell.counts.up ?? 0), pressed = filter.set === set && filter.load === load;
      return html`<td class="cell level${Math.ceil(5 * failedShare(cell))}"><button aria-pressed=${pressed ? 'true' : 'false'}
        aria-label="${set}, load ${load}: ${failed}/${cell.total} did not stay up" @click=${() => {
          filter = pressed ? {...filter, set: null, load: null} : {...filter, set, load};
          page = 0;
          changed();
        }}>${failed}/${cell.total}</button></td>`;
    })}</tr>`)}</tbody></table></div>`;
}

/** @param {import('./campaign_rows.js').Row[]} rows */
function orbitBars(rows) {
  const h = histogram(rows, 20);
  const most = Math.max(...h.counts, 1);
  if (h.most === 0) return nothing;
  return html`<figure class="trend"><figcaption>Largest orbit, 0 to ${quantity(h.most, 'm')}; a bar filters</figcaption><div class="bars">${h.counts.map((n, k) => {
    const from = (k / 20) * h.most, to = ((k + 1) / 20) * h.most, pressed = filter.from === from;
    return html`<button class="bar" aria-pressed=${pressed ? 'true' : 'false'} aria-label="${n} runs from ${quantity(from, 'm')} to ${quantity(to, 'm')}" @click=${() => {
      filter = pressed ? {...filter, from: null, to: null} : {...filter, from, to};
      page = 0;
      changed();
    }}><svg viewBox="0 0 10 40" preserveAspectRatio="none" aria-hidden="true"><rect x="1" width="8" y=${40 - (40 * n) / most} height=${(40 * n) / most}></rect></svg></button>`;
  })}</div></figure>`;
}

/** @param {import('./campaign_rows.js').Row[]} rows @param {string} file */
function rowTable(rows, file) {
  const size = 50;
  const shown = rows.slice(page * size, (page + 1) * size);
  return html`<p>${rows.length} of ${got.rows.length} rows ${Object.values(filter).some((v) => v !== null) ? html`<button @click=${() => {
    filter = {set: null, load: null, verdict: null, from: null, to: null};
    page = 0;
    changed();
  }}>all rows</button>` : nothing} ${rows.length > size ? html`<button ?disabled=${page === 0} @click=${() => {
    --page;
    changed();
  }}>&lt;</button> page ${page + 1} of ${Math.ceil(rows.length / size)} <button ?disabled=${(page + 1) * size >= rows.length} @click=${() => {
    ++page;
    changed();
  }}>&gt;</button>` : nothing}</p>
  <div class="scroll" tabindex="0" role="region" aria-label="rows"><table class="rows"><thead><tr>${['row', 'set', 'kind', 'speed [rad/s]', 'load', 'verdict', 'orbit', 'detected after', ''].map((t) => html`<th scope="col">${t}</th>`)}</tr></thead>
    <tbody>${shown.map((r) => html`<tr aria-current=${opened?.row === r.run ? 'true' : nothing}><td class="number">${r.run}</td><td>${r.set}</td><td>${r.kind}</td><td class="number">${significant(r.speed, 4)}</td>
      <td class="number">${Number.isNaN(r.load) ? '-' : significant(r.load, 3)}</td><td>${verdictText(r.verdict)}</td><td class="number">${Number.isNaN(r.orbit) ? '-' : quantity(r.orbit, 'm')}</td>
      <td class="number">${Number.isNaN(r.delay) ? '-' : quantity(r.delay, 's')}</td><td><button @click=${() => openRow(file, r.run)} aria-label="open row ${r.run}">open</button></td></tr>`)}</tbody></table></div>`;
}

/** @param {string} file */
function rowPart(file) {
  if (!opened) return nothing;
  const o = opened;
  return html`<section class="adopt" aria-label="row"><h2>Row ${o.row}</h2>${!o.result ? html`<p>Running it again, with its record.</p>` : html`
    ${summary(o.result)}<p><button @click=${() => openReport(o.job)}>Report</button></p><p class="marks"></p><div class="panels" id="panels"></div>
    ${recordOf(o.job, `${stemOf(file)}_row_${o.row}`) ? nothing : html`<p>Reading the record.</p>`}${figures(o.result)}`}</section>`;
}

export function campaignScreen() {
  const file = state.view.file;
  const job = activeJob('campaign', file);
  const last = lastJob('campaign', file);
  const found = resultOf('campaign', file);
  if (last) follow(last);
  const counts = countOf(got.rows);
  const again = last && (last.state === 'stopped' || last.state === 'interrupted');
  const rows = filtered(got.rows, filter);
  return html`<h1>${file}</h1>
    ${job ? progressOf(job, 'campaign') : html`<p><button class="main" @click=${() => startJob({command: 'campaign', campaign: file})}>${again ? 'Resume' : found ? 'Run again' : 'Run the campaign'}</button>
      ${found ? html`<button @click=${() => openReport(found.job)}>Report</button>` : nothing} ${last ? command(last) : nothing}</p>`}
    ${!job && last?.state === 'failed' ? errorOf(last.error) : nothing}
    ${found && !found.fresh ? html`<p class="note">Older than ${found.stale.join(', ')}.</p>` : nothing}
    ${got.rows.length === 0 ? html`<p>No row yet.</p>` : html`<p>${got.rows.length} of ${got.runs} runs: ${verdicts.filter((v) => counts[v]).map((v) => html`<button aria-pressed=${filter.verdict === v ? 'true' : 'false'} @click=${() => {
      filter = {...filter, verdict: filter.verdict === v ? null : v};
      page = 0;
      changed();
    }}>${verdictText(v)} ${counts[v]}</button> `)}</p>
      <div class="columns wide-right"><div>${mapTable(mapOf(got.rows))}${orbitBars(got.rows)}</div><div>${rowPart(file)}${rowTable(rows, file)}</div></div>`}`;
}

/** After the screen was drawn: the panels of the opened row. @param {(change: object) => void} go */
export function drawCampaign(go) {
  const place = document.getElementById('panels');
  if (!place || !opened?.result) return;
  const stem = `${stemOf(state.view.file)}_row_${opened.row}`;
  const record = recordOf(opened.job, stem);
  if (!record || record.channels.length === 0) return;
  if (!panels || panels.place !== place) panels = new Panels(place, (moved) => go(moved));
  const plots = runPlots(record, []);
  if (plots.length > 0) void panels.show({query: queryOf(opened.job, stem), name: `row ${opened.row}`, plots, from: state.view.from, to: state.view.to, marks: state.view.marks});
}
