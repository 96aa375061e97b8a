/** A bearing drawn from its coils: each coil is a button that breaks it. And the orbit in its clearance. */
import {html, nothing, svg} from './lit-html.js';
import {polar, polyline} from './geometry.js';

/** @typedef {{name: string, angle_deg: number, turns: number, gap: number}} Coil */

/**
 * @param {{name: string, coils: Coil[]}} bearing as `ambrig rig --json` tells
 * @param {(coil: string) => string|null} faultOf kind of its fault
 * @param {(coil: string) => void} toggle @param {(coil: string, name: string) => void} menu
 */
export function stator(bearing, faultOf, toggle, menu) {
  return html`<figure class="stator-figure"><figcaption>Bearing ${bearing.name}</figcaption>
    <svg class="stator" viewBox="-60 -60 120 120" role="group" aria-label="coils of bearing ${bearing.name}">
      <circle class="shaft" r="20"></circle><circle class="shaft" r="52"></circle>
      ${bearing.coils.map((c, k) => coilOf(bearing, c, k, faultOf(c.name), toggle, menu))}
    </svg></figure>`;
}

/** @param {{name: string, coils: Coil[]}} bearing @param {Coil} c @param {number} k @param {string|null} fault @param {(coil: string) => void} toggle @param {(coil: string, name: string) => void} menu */
function coilOf(bearing, c, k, fault, toggle, menu) {
  const turn = -c.angle_deg;
  const at = polar(45, c.angle_deg);
  const wide = Math.min(16, 90 / bearing.coils.length);
  const name = `${bearing.name}${k + 1}`;
  const pressed = (/** @type {KeyboardEvent} */ e) => {
    if (e.key === 'm' || e.key === 'M') menu(c.name, name);
    else if (e.key === 'Enter' || e.key === ' ') toggle(c.name);
    else return;
    e.preventDefault();
    e.stopPropagation();
  };
  const asked = (/** @type {MouseEvent} */ e) => {
    e.preventDefault();
    menu(c.name, name);
  };
  return svg`<g transform="rotate(${turn})"><rect class="pole ${fault ? 'broken' : ''}" x="24" y=${-wide / 2} width="26" height=${wide} rx="1.5"
      tabindex="0" role="button" aria-pressed=${fault ? 'true' : 'false'} aria-label="${name}, ${fault ?? 'healthy'}"
      @click=${() => toggle(c.name)} @contextmenu=${asked} @keydown=${pressed}></rect></g>
    <text x=${(at.x * 37) / 45} y=${(at.y * 37) / 45 + 3} text-anchor="middle" aria-hidden="true">${k + 1}${fault ? '\u00d7' : ''}</text>`;
}

/**
 * @param {string} name @param {(number|null)[]} x [m] @param {(number|null)[]} y [m] @param {number|null} clearance [m]
 * @param {{x: (number|null)[], y: (number|null)[]}|null} ghost of another run @param {number|null} at index that a dot marks
 */
export function orbit(name, x, y, clearance, ghost = null, at = null) {
  let most = clearance ?? 0;
  if (clearance === null) for (const v of [...x, ...y]) if (v !== null && Math.abs(v) > most) most = Math.abs(v);
  const scale = most > 0 ? 50 / most : 1;
  const dot = at === null ? null : {x: x[Math.min(at, x.length - 1)], y: y[Math.min(at, y.length - 1)]};
  return html`<figure class="stator-figure"><figcaption>Orbit ${name}${clearance === null ? '' : ', circle: its clearance'}</figcaption>
    <svg class="stator" viewBox="-60 -60 120 120" role="img" aria-label="orbit of ${name}">
      <circle class="shaft" r=${clearance === null ? 0 : 50}></circle>
      ${ghost ? svg`<polyline class="orbit ghost" points=${polyline(ghost.x, ghost.y, scale)}></polyline>` : nothing}
      <polyline class="orbit" points=${polyline(x, y, scale)}></polyline>
      ${dot && dot.x !== null && dot.y !== null ? svg`<circle class="dot" r="2.5" cx=${dot.x * scale} cy=${-dot.y * scale}></circle>` : nothing}</svg></figure>`;
}
