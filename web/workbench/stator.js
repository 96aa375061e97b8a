/** A bearing drawn from its coils: each coil is a button that breaks it. And the orbit in its clearance. */
import {html, svg} from './lit-html.js';
import {polar, polyline} from './geometry.js';

/** @typedef {{name: string, angle_deg: number, turns: number, gap: number}} Coil */

/**
 * @param {{name: string, coils: Coil[]}} bearing as `ambrig rig --json` tells
 * @param {Map<string, string>} faults coil -> kind of its fault
 * @param {(coil: string) => void} toggle
 */
export function stator(bearing, faults, toggle) {
  return html`<figure class="stator-figure"><figcaption>Bearing ${bearing.name}</figcaption>
    <svg class="stator" viewBox="-60 -60 120 120" role="group" aria-label="coils of bearing ${bearing.name}">
      <circle class="shaft" r="20"></circle><circle class="shaft" r="52"></circle>
      ${bearing.coils.map((c, k) => coilOf(bearing, c, k, faults, toggle))}
    </svg></figure>`;
}

/** @param {{name: string, coils: Coil[]}} bearing @param {Coil} c @param {number} k @param {Map<string, string>} faults @param {(coil: string) => void} toggle */
function coilOf(bearing, c, k, faults, toggle) {
  const many = bearing.coils.length;
  const turn = -c.angle_deg;
  const at = polar(45, c.angle_deg);
  const wide = Math.min(16, 90 / many);
  const fault = faults.get(c.name);
  const pressed = (/** @type {KeyboardEvent} */ e) => {
    if (e.key !== 'Enter' && e.key !== ' ') return;
    e.preventDefault();
    toggle(c.name);
  };
  return svg`<g transform="rotate(${turn})"><rect class="pole ${fault ? 'broken' : ''}" x="24" y=${-wide / 2} width="26" height=${wide} rx="1.5"
      tabindex="0" role="button" aria-pressed=${fault ? 'true' : 'false'} aria-label="${bearing.name}${k + 1}, ${fault ?? 'healthy'}"
      @click=${() => toggle(c.name)} @keydown=${pressed}></rect></g>
    <text x=${(at.x * 37) / 45} y=${(at.y * 37) / 45 + 3} text-anchor="middle" aria-hidden="true">${k + 1}${fault ? '\u00d7' : ''}</text>`;
}

/**
 * @param {string} name @param {(number|null)[]} x [m] @param {(number|null)[]} y [m] @param {number|null} clearance [m]
 */
export function orbit(name, x, y, clearance) {
  let most = clearance ?? 0;
  if (clearance === null) for (const v of [...x, ...y]) if (v !== null && Math.abs(v) > most) most = Math.abs(v);
  const scale = most > 0 ? 50 / most : 1;
  return html`<figure class="stator-figure"><figcaption>Orbit ${name}${clearance === null ? '' : ', circle: its clearance'}</figcaption>
    <svg class="stator" viewBox="-60 -60 120 120" role="img" aria-label="orbit of ${name}">
      <circle class="shaft" r=${clearance === null ? 0 : 50}></circle>
      <polyline class="orbit" points=${polyline(x, y, scale)}></polyline></svg></figure>`;
}
