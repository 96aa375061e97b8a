/** Where the error of a channel lies in the visible range: by frequency, and by the value of another channel of the record. */
import {html, nothing, svg} from './lit-html.js';
import {getBytes} from './api.js';
import {prefixFor, significant} from './numbers.js';
import {decodeSeries} from './series.js';
import {errorByFrequency, errorByValue, peaks} from './spectrum.js';
import {changed} from './state.js';

/**
 * @typedef {{query: string, channel: string, others: string[], from: number|null, to: number|null}} Of
 * @typedef {{key: string, spectrum: {frequency: number[], ratio: number[]}, places: {value: number[], ratio: (number|null)[], count: number[]},
 *            against: string, unit: string, error: string}} Seen
 */
const most = 20000;  // [px], so that up to 40 000 samples come as they are
const bins = 30;

/** @type {Seen} */
let seen = {key: '', spectrum: {frequency: [], ratio: []}, places: {value: [], ratio: [], count: []}, against: '', unit: '', error: ''};
/** Of whose value the error is drawn; "": the channel itself. */
let against = '';
/** The frequency that the pointer or an arrow key chose. @type {number|null} */
let chosen = null;

/** @param {Of} of */
async function look(of) {
  const other = of.others.includes(against) ? against : of.channel;
  const key = JSON.stringify([of, other]);
  if (seen.key === key) return;
  seen = {...seen, key};
  try {
    let path = `/api/series?${of.query}&c=${encodeURIComponent(of.channel)}.error,${encodeURIComponent(other)}.measured&px=${most}`;
    if (of.from !== null && of.to !== null) path += `&t0=${of.from}&t1=${of.to}`;
    const s = decodeSeries(await getBytes(path));
    if (seen.key !== key) return;
    seen = s.head.mode === 'samples'
      ? {key, spectrum: errorByFrequency(s.values[0], s.head.rate), places: errorByValue(s.values[1], s.values[0], bins), against: other, unit: s.head.channels[1].unit, error: ''}
      : {...seen, key, error: 'More than 40 000 samples are in view: zoom in.'};
  } catch (error) {
    seen = {...seen, key, error: error instanceof Error ? error.message : String(error)};
  }
  changed();
}

const wide = 420, high = 110;

/** @param {number} r */
const heightOf = (r) => Math.min(high, (Math.log10(Math.max(r, 0.5) / 0.5) / 3) * high);

/** @param {Of} of */
export function misfitViews(of) {
  void look(of);
  const s = seen.spectrum;
  if (seen.error) return html`<p class="note">${seen.error}</p>`;
  if (s.frequency.length === 0) return nothing;
  const end = s.frequency[s.frequency.length - 1];
  const found = peaks(s, 3);
  const at = chosen === null ? -1 : Math.round((chosen / end) * (s.frequency.length - 1));
  const pick = (/** @type {MouseEvent} */ e) => {
    const box = /** @type {Element} */ (e.currentTarget).getBoundingClientRect();
    chosen = Math.max(0, Math.min(end, ((e.clientX - box.left) / box.width) * end));
    changed();
  };
  const key = (/** @type {KeyboardEvent} */ e) => {
    if (e.key !== 'ArrowLeft' && e.key !== 'ArrowRight') return;
    e.preventDefault();
    const step = end / (s.frequency.length - 1);
    chosen = Math.max(0, Math.min(end, (chosen ?? found[0]?.frequency ?? 0) + (e.key === 'ArrowRight' ? step : -step)));
    changed();
  };
  const points = s.ratio.map((r, k) => `${((k / (s.ratio.length - 1)) * wide).toFixed(1)},${(high - heightOf(r)).toFixed(1)}`).join(' ');
  const words = found.length === 0 ? 'no frequency stands out' : 'stands out at ' + found.map((p) => `${significant(p.frequency, 3)} Hz (${significant(p.ratio, 2)})`).join(', ');
  return html`<div class="views"><figure class="view"><figcaption>${of.channel}: error over noise by frequency, 0 to ${significant(end, 3)} Hz; ${words}${at < 0 ? nothing :
      html`; <strong>${significant(s.frequency[at], 4)} Hz: ${significant(s.ratio[at], 3)}</strong>`}</figcaption>
    <svg viewBox="0 0 ${wide} ${high}" preserveAspectRatio="none" tabindex="0" role="img" aria-label="error of ${of.channel} by frequency: ${words}"
      @mousemove=${pick} @click=${pick} @keydown=${key}><line class="one" x1="0" x2=${wide} y1=${high - heightOf(1)} y2=${high - heightOf(1)}></line>
      <polyline points=${points}></polyline>${at < 0 ? nothing : svg`<line class="cursor" x1=${(at / (s.ratio.length - 1)) * wide} x2=${(at / (s.ratio.length - 1)) * wide} y1="0" y2=${high}></line>`}</svg></figure>
    ${byValue(of)}</div>`;
}

/** @param {Of} of */
function byValue(of) {
  const p = seen.places;
  if (p.value.length === 0) return nothing;
  const {factor, unit} = prefixFor(Math.max(...p.value.map(Math.abs)), seen.unit);
  const worst = p.ratio.reduce((/** @type {number} */ best, r, k) => ((r ?? 0) > (p.ratio[best] ?? 0) ? k : best), 0);
  const words = `worst ${significant(p.ratio[worst] ?? NaN, 3)} at ${significant(p.value[worst] * factor, 3)} ${unit}`;
  return html`<figure class="view"><figcaption><label>${of.channel}: error over noise by the value of <select @change=${(/** @type {Event} */ e) => {
      against = /** @type {HTMLSelectElement} */ (e.target).value;
      changed();
    }}>${of.others.map((o) => html`<option value=${o} ?selected=${o === seen.against}>${o}</option>`)}</select></label>,
      ${significant(p.value[0] * factor, 3)} to ${significant(p.value[p.value.length - 1] * factor, 3)} ${unit}; ${words}</figcaption>
    <svg viewBox="0 0 ${wide} ${high}" preserveAspectRatio="none" role="img" aria-label="error of ${of.channel} by the value of ${seen.against}: ${words}">
      <line class="one" x1="0" x2=${wide} y1=${high - heightOf(1)} y2=${high - heightOf(1)}></line>
      ${p.ratio.map((r, k) => r === null ? nothing : svg`<rect x=${(k / bins) * wide + 1} width=${wide / bins - 2} y=${high - heightOf(r)} height=${heightOf(r)}></rect>`)}</svg></figure>`;
}
