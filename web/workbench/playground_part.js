/** The playground as it is drawn: coils, faults, loads, speed, and the runs beside each other. */
import {html, nothing} from './lit-html.js';
import {quantity, significant} from './numbers.js';
import {clearPlayground, faultOf, play, runAll, saveScenario, setFault, soon, sweep, touched, toggleGhost} from './playground.js';
import {faultKinds, speedOf} from './scenario_text.js';
import {changed} from './state.js';
import {stator} from './stator.js';

/** @param {string} on coil, axis or rig */
const kindsOn = (on) => faultKinds.filter((k) => k.on === on);

/** @param {string} target @param {string} name */
function faultMenu(target, name) {
  return html`<div class="menu" role="group" aria-label="faults of ${name}"><strong>${name}</strong>
    ${kindsOn('coil').map((k) => html`<button aria-pressed=${faultOf(target) === k.kind ? 'true' : 'false'} @click=${() => {
      play.menu = null;
      setFault(target, k.kind);
    }}>${k.kind}: ${k.text}</button>`)}
    <button @click=${() => {
      play.menu = null;
      changed();
    }} aria-label="close the menu">\u00d7</button></div>`;
}

/** Faults of the position sensors and the supply. @param {any} rig */
function otherFaults(rig) {
  const axes = rig.bearings.flatMap((/** @type {any} */ b) => b.axes);
  const button = (/** @type {string} */ target, /** @type {string} */ kind) => html`<button aria-pressed=${faultOf(target) === kind ? 'true' : 'false'} @click=${() => setFault(target, kind)}>${target}</button>`;
  return html`<details><summary>Sensors and supply</summary><p>position sensor freezes: ${axes.map((/** @type {string} */ a) => button(a, 'position-sensor'))}</p>
    <p>supply falls to 0.8: ${button('rig', 'bus-sag')}</p></details>`;
}

/** @param {any} b a bearing */
function loadOf(b) {
  const l = play.loads.get(b.name) ?? {fx: 0, fy: 0};
  const set = (/** @type {'fx'|'fy'} */ key) => (/** @type {Event} */ e) => {
    play.loads.set(b.name, {...l, [key]: Number(/** @type {HTMLInputElement} */ (e.target).value)});
    soon();
  };
  return html`<p class="sliders">load on ${b.name}: <label>x <input type="range" min="-200" max="200" step="5" .value=${String(l.fx)} @input=${set('fx')} aria-label="load on ${b.name} in x [N]"> ${l.fx} N</label>
    <label>y <input type="range" min="-200" max="200" step="5" .value=${String(l.fy)} @input=${set('fy')} aria-label="load on ${b.name} in y [N]"> ${l.fy} N</label></p>`;
}

function speedSlider() {
  const now = play.speed ?? speedOf(play.text) ?? 0;
  const rpm = Math.round((now * 30) / Math.PI);
  return html`<p class="sliders"><label>speed <input type="range" min="0" max="12000" step="100" .value=${String(rpm)} aria-label="speed [rpm]" @input=${(/** @type {Event} */ e) => {
    play.speed = Number(((Number(/** @type {HTMLInputElement} */ (e.target).value) * Math.PI) / 30).toFixed(2));
    soon();
  }}> ${rpm} rpm (${significant(now, 3)} rad/s)</label></p>`;
}

/** What came of each run, beside each other. */
export function runTable() {
  if (play.runs.size === 0) return nothing;
  const names = /** @type {[string, string][]} */ ([['run', 'as chosen'], ['healthy', 'healthy'], ['off', 'without fault tolerance']]);
  const columns = names.filter(([n]) => play.runs.has(n));
  const planes = Object.keys(play.runs.get('run')?.result.metrics?.max_orbit ?? {});
  const delay = (/** @type {any} */ r) => (r.metrics.detection_delay > 0 ? quantity(r.metrics.detection_delay, 's') : '-');
  const row = (/** @type {string} */ title, /** @type {(r: any) => string} */ text) => html`<tr><th scope="row">${title}</th>${columns.map(([n]) => html`<td class="number">${text(play.runs.get(n)?.result)}</td>`)}</tr>`;
  return html`<div class="scroll" tabindex="0" role="region" aria-label="runs beside each other"><table class="beside"><thead><tr><th></th>${columns.map(([, title]) => html`<th scope="col">${title}</th>`)}</tr></thead><tbody>
    ${row('verdict', (r) => (r.drop ? '\u2716 dropped' : r.touchdown ? '! touched' : '\u2714 up'))}${planes.map((p) => row(`largest orbit ${p}`, (r) => quantity(r.metrics.max_orbit[p] ?? NaN, 'm')))}
    ${row('peak current', (r) => quantity(r.metrics.peak_current, 'A'))}${row('detected after', delay)}</tbody></table></div>`;
}

/** @param {any} rig the JSON of `ambrig rig` @param {(change: object) => void} go */
export function playgroundPart(rig, go) {
  const currents = play.runs.get('run');
  return html`<section aria-label="fault playground"><h2>Break a coil</h2>
    <p><label>A click makes it <select @change=${(/** @type {Event} */ e) => {
      play.kind = /** @type {HTMLSelectElement} */ (e.target).value;
    }}>${kindsOn('coil').map((k) => html`<option value=${k.kind} ?selected=${k.kind === play.kind}>${k.kind}</option>`)}</select></label>
    <label>at <input class="time" type="number" min="0" step="0.01" .value=${String(play.time)} @change=${(/** @type {Event} */ e) => {
      play.time = Math.max(0, Number(/** @type {HTMLInputElement} */ (e.target).value) || 0);
      play.faults = play.faults.map((f) => ({...f, time: play.time}));
      if (play.faults.length > 0) soon();
    }}> s</label></p>
    <p class="note">Click a coil, or M on it for every fault. Each picture is a run of its own.</p>
    <div class="stators">${rig.bearings.map((/** @type {any} */ b) => stator(b, faultOf, (coil) => setFault(coil, faultOf(coil) ?? play.kind), (coil, name) => {
      play.menu = {coil, name};
      changed();
    }))}</div>
    ${runTable()}
    ${play.menu ? faultMenu(play.menu.coil, play.menu.name) : nothing}
    ${otherFaults(rig)}${speedSlider()}${rig.bearings.filter((/** @type {any} */ b) => b.axes.length === 2).map(loadOf)}
    ${play.faults.length === 0 ? nothing : html`<ul class="faults-list">${play.faults.map((f) => html`<li>${f.target} ${f.kind}, ${quantity(f.time, 's')}
      <button aria-label="take back ${f.target} ${f.kind}" @click=${() => setFault(f.target, f.kind)}>\u00d7</button></li>`)}</ul>`}
    <p>beside it: <button aria-pressed=${play.ghosts.has('healthy') ? 'true' : 'false'} @click=${() => toggleGhost('healthy')}>healthy run</button>
      <button aria-pressed=${play.ghosts.has('off') ? 'true' : 'false'} @click=${() => toggleGhost('off')}>without fault tolerance</button>
      ${play.running ? html`<span role="status">running: ${play.running}</span>` : currents ? html`<span class="note">in ${significant(currents.seconds, 2)} s</span>` : nothing}</p>
    <p class="actions">${touched() ? html`<button class="main" @click=${() => saveScenario(go, false)}>Save as scenario</button>
      <button ?disabled=${!play.runs.has('run')} @click=${() => saveScenario(go, true)}>Make it a test</button>
      <button ?disabled=${!play.faults.some((f) => f.target.includes('.coil'))} @click=${() => sweep(go)}>Sweep</button>
      <button @click=${clearPlayground}>Clear</button>` : html`<button @click=${() => runAll()}>Run it unchanged</button>`}</p></section>`;
}
