/** The ladder: the error that each step of the model left, fitted and unseen records. */
import {html, svg as svgPart} from './lit-html.js';
import {barOf, sizeOf} from './misfit.js';
import {ratio} from './numbers.js';

/** @typedef {{added: string, ratio_fit: number|string|null, ratio_validate: number|string|null}} Step */

/** @param {Step[]} steps @param {string} title */
export function ladder(steps, title) {
  const most = Math.max(...steps.flatMap((s) => [sizeOf(s.ratio_fit), sizeOf(s.ratio_validate)]).filter(Number.isFinite), 2);
  const width = 84;
  return html`<figure class="ladder"><figcaption>${title} <span class="small">(logarithmic; shortest: noise alone)</span></figcaption>
    <svg viewBox="0 0 ${Math.max(4, steps.length) * width} 150" role="img"
      aria-label="${steps.map((s) => `${s.added || 'rig file'}: fitted ${ratio(s.ratio_fit)}, unseen ${ratio(s.ratio_validate)}`).join('; ')}">
      ${steps.map((s, k) => bars(s, k * width, most))}
    </svg></figure>
    <table class="steps"><caption class="hidden">the ladder as a table</caption>
    <thead><tr><th scope="col">step</th><th scope="col">fitted</th><th scope="col">unseen</th></tr></thead>
    <tbody>${steps.map((s) => html`<tr><th scope="row">${s.added || 'rig file'}</th>
      <td class="number">${ratio(s.ratio_fit)}</td><td class="number">${ratio(s.ratio_validate)}</td></tr>`)}</tbody></table>`;
}

/** @param {Step} s @param {number} x @param {number} most */
function bars(s, x, most) {
  const high = 112;
  const one = (/** @type {number|string|null} */ r, /** @type {number} */ dx, /** @type {string} */ kind) => {
    const h = high * barOf(r, most);
    return svg(kind, x + dx, 130 - h, h, ratio(r));
  };
  return [one(s.ratio_fit, 8, 'fit'), one(s.ratio_validate, 42, 'unseen')];
}

/** @param {string} kind @param {number} x @param {number} y @param {number} h @param {string} text */
function svg(kind, x, y, h, text) {
  return svgPart`<rect class=${kind} x=${x} y=${y} width="28" height=${h}></rect>
    <text x=${x + 14} y=${y - 4} text-anchor="middle">${text}</text>
    <text class="small" x=${x + 14} y="144" text-anchor="middle">${kind}</text>`;
}
