/** The misfit table: a real table whose cells are buttons. */
import {html, nothing} from './lit-html.js';
import {columnsOf, levelOf, recordName, rowsOf} from './misfit.js';
import {ratio} from './numbers.js';

/**
 * @param {any} comparison the JSON of `ambrig compare`
 * @param {{record: string, channels: string[]}} chosen
 * @param {(record: string, channel: string, more: boolean) => void} choose
 */
export function misfitTable(comparison, chosen, choose) {
  const columns = columnsOf(comparison.records);
  const rows = rowsOf(comparison.records, columns);
  return html`<div class="scroll" tabindex="0" role="region" aria-label="misfit table"><table class="misfit">
    <caption>Error over noise: 1.0 is noise alone. A cell opens its record; with Shift it is added below.</caption>
    <thead><tr><th scope="col">record</th><th scope="col">use</th><th scope="col">all</th>
      ${columns.map((c) => html`<th scope="col">${c}</th>`)}</tr></thead>
    <tbody>${rows.map((row) => html`<tr>
      <th scope="row" title=${row.title}>${row.record}<small> ${row.title}</small></th>
      <td>${row.use === 'fit' ? 'fit' : 'unseen'}</td><td class="number">${ratio(row.ratio)}</td>
      ${row.cells.map((cell) => cell.ratio === null ? html`<td></td>` : html`<td class="cell level${levelOf(cell.ratio)}">
        <button aria-pressed=${row.record === chosen.record && chosen.channels.includes(cell.channel) ? 'true' : 'false'}
          aria-label="${row.record}, ${cell.channel}: ${ratio(cell.ratio)} times the noise"
          @click=${(/** @type {MouseEvent} */ e) => choose(row.record, cell.channel, e.shiftKey)}>${ratio(cell.ratio)}</button></td>`)}
    </tr>`)}</tbody></table></div>
    ${blocks(comparison)}`;
}

/** Parts of the model fed with measured inputs: where the error arises. @param {any} comparison */
function blocks(comparison) {
  const names = /** @type {string[]} */ ([...new Set(comparison.records.flatMap((/** @type {any} */ r) => Object.keys(r.blocks)))]);
  if (names.length === 0) return nothing;
  return html`<details><summary>By block: parts of the model fed with measured inputs</summary>
    <table class="misfit"><thead><tr><th scope="col">record</th>${names.map((n) => html`<th scope="col">${n}</th>`)}</tr></thead>
    <tbody>${comparison.records.map((/** @type {any} */ r) => html`<tr><th scope="row">${recordName(r.data)}</th>
      ${names.map((n) => r.blocks[n] === undefined ? html`<td></td>` : html`<td class="cell level${levelOf(r.blocks[n])}">${ratio(r.blocks[n])}</td>`)}</tr>`)}
    </tbody></table></details>`;
}
