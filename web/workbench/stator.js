/** A bearing drawn from its coils: each coil is a button that breaks it. And the orbit in its clearance. */
import {html, nothing, svg} from './lit-html.js';
import {polar, polyline} from './geometry.js';

/** @typedef {{name: string, angle_deg: number, turns: number, gap: number}} Coil */

/**
 * @param {{name: string, kind?: string, coils: Coil[]}} bearing as `ambrig rig --json` tells
 * @param {(coil: string) => string|null} faultOf kind of its fault
 * @param {(coil: string) => void} toggle @param {(coil: string, name: string) => void} menu
 */
export function stator(bearing, faultOf, toggle, menu) {
  const iron = bearing.kind === 'thrust'
    ? svg`<rect class="shaft" x="-58" y="-9" width="116" height="18"></rect><rect class="shaft" x="-12" y="-50" width="24" height="100"></rect>`
    : svg`<circle class="shaft" r="20"></circle><circle class="shaft" r="52"></circle>`;
  return html`<figure class="stator-figure"><figcaption>Bearing ${bearing.name}${bearing.kind === 'thrust' ? ', its collar from the side' : ''}</figcaption>
    <svg class="stator" viewBox="-60 -60 120 120" role="group" aria-label="coils of bearing ${bearing.name}">
      ${iron}
      ${bearing.coils.map((c, k) => coilOf(bearing, k, faultOf(c.name), toggle, menu))}
    </svg></figure>`;
}

/** How far a coil is moved aside where several have one angle, as on a collar or on poles wound twice. @param {Coil[]} coils @param {number} k @param {number} wide @param {boolean} thrust */
export function asideOf(coils, k, wide, thrust) {
  const same = coils.map((c, n) => ({...c, n})).filter((c) => Math.abs(((c.angle_deg - coils[k].angle_deg + 540) % 360) - 180) < 0.5);
  const place = same.findIndex((c) => c.n === k) - (same.length - 1) / 2;
  return place * (thrust ? 90 / same.length : wide + 2);
}

/** @param {{name: string, kind?: string, coils: Coil[]}} bearing @param {number} k @param {string|null} fault @param {(coil: string) => void} toggle @param {(coil: string, name: string) => void} menu */
function coilOf(bearing, k, fault, toggle, menu) {
  const c = bearing.coils[k], thrust = bearing.kind === 'thrust';
  const wide = Math.min(16, (thrust ? 60 : 90) / bearing.coils.length);
  const aside = asideOf(bearing.coils, k, wide, thrust);
  const out = polar(37, c.angle_deg), over = polar(aside, c.angle_deg - 90);
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
  return svg`<g transform="rotate(${-c.angle_deg})"><rect class="pole ${fault ? 'broken' : ''}" x="24" y=${aside - wide / 2} width="26" height=${wide} rx="1.5"
      tabindex="0" role="button" aria-pressed=${fault ? 'true' : 'false'} aria-label="${name}, ${fault ?? 'healthy'}"
      @click=${() => toggle(c.name)} @contextmenu=${asked} @keydown=${pressed}></rect></g>
    <text x=${out.x + over.x} y=${out.y + over.y + 3} text-anchor="middle" aria-hidden="true">${k + 1}${fault ? '\u00d7' : ''}</text>`;
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
