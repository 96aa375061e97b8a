/** The text of a scenario, changed as its user would: faults, loads and speed of the playground; a test, a sweep. */
import {quoted, withTopValue} from './case_text.js';

/**
 * @typedef {{target: string, kind: string, time: number, parameters: Record<string, number|boolean>}} Fault
 * @typedef {{plane: string, fx: number, fy: number, start: number}} Load
 */

/** The kinds of faults and what each needs. `on`: what it is a fault of. */
export const faultKinds = /** @type {{kind: string, on: string, text: string, parameters: Record<string, number|boolean>}[]} */ ([
  {kind: 'open', on: 'coil', text: 'the wire breaks', parameters: {}},
  {kind: 'partial-short', on: 'coil', text: 'half of the turns are shorted', parameters: {fraction: 0.5, short_resistance: 0.05}},
  {kind: 'amplifier-off', on: 'coil', text: 'the amplifier switches off', parameters: {}},
  {kind: 'switch-stuck-on', on: 'coil', text: 'full bus voltage for good', parameters: {}},
  {kind: 'current-sensor', on: 'coil', text: 'the current sensor reads half', parameters: {gain: 0.5}},
  {kind: 'position-sensor', on: 'axis', text: 'the position sensor freezes', parameters: {stuck: true}},
  {kind: 'bus-sag', on: 'rig', text: 'the supply falls to 0.8', parameters: {}},
]);

/** A number that TOML takes for one with a point. @param {number} v */
export function decimal(v) {
  const text = String(v);
  return /[.e]/.test(text) ? text : text + '.0';
}

/** @param {number|boolean} v */
const literal = (v) => (typeof v === 'number' ? decimal(v) : String(v));

/** @param {Record<string, number|boolean>} parameters */
function parametersOf(parameters) {
  const all = Object.entries(parameters);
  return all.length === 0 ? '' : `parameters = { ${all.map(([k, v]) => `${k} = ${literal(v)}`).join(', ')} }\n`;
}

/** @param {string} text @param {Fault[]} faults */
export function withFaults(text, faults) {
  let out = text.replace(/\n*$/, '\n');
  for (const f of faults)
    out += `\n[[fault]]\ntime = ${decimal(f.time)}\ntarget = ${quoted(f.target)}\nkind = ${quoted(f.kind)}\n${parametersOf(f.parameters)}`;
  return out;
}

/** @param {string} text @param {Load[]} loads */
export function withLoads(text, loads) {
  let out = text.replace(/\n*$/, '\n');
  for (const l of loads.filter((one) => one.fx !== 0 || one.fy !== 0))
    out += `\n[[load]]\nplane = ${quoted(l.plane)}\nforce = [${decimal(l.fx)}, ${decimal(l.fy)}]\nstart = ${decimal(l.start)}\n`;
  return out;
}

/** The text without tables of these names. @param {string} text @param {string[]} names "expect", "speed" */
export function withoutTables(text, names) {
  const kept = [];
  let inside = false;
  for (const l of text.split('\n')) {
    const head = /^\s*\[+\s*([^\].\s]+)/.exec(l);
    if (head) inside = names.includes(head[1]);
    if (!inside) kept.push(l);
  }
  return kept.join('\n');
}

/** At one speed all the time. @param {string} text @param {number} speed [rad/s] */
export function withSpeed(text, speed) {
  return withoutTables(text, ['speed']).replace(/\n*$/, '\n') + `\n[speed]\nprofile = [[0.0, ${decimal(speed)}]]\n`;
}

/** @param {string} text @param {boolean} on */
export function withTolerance(text, on) {
  return withTopValue(text, 'fault_tolerance', String(on));
}

/** The speed at the start; null: a profile that changes or none. @param {string} text [rad/s] */
export function speedOf(text) {
  const found = /^\s*profile\s*=\s*\[\s*\[\s*[\d.e+-]+\s*,\s*([\d.e+-]+)\s*\]\s*\]/m.exec(text);
  return found ? Number(found[1]) : null;
}

/** Rounded up to two digits: what a value may reach. @param {number} v */
export function limitAbove(v) {
  if (!(v > 0)) return v;
  const size = 10 ** (Math.floor(Math.log10(v)) - 1);
  return Number((Math.ceil((v * 1.1) / size) * size).toPrecision(2));
}

/** [expect] of what a run did, with a tenth of room. @param {string} text @param {any} result the JSON of `ambrig run` */
export function withExpectations(text, result) {
  let out = withoutTables(text, ['expect']).replace(/\n*$/, '\n') + '\n[expect]\n';
  // What is expected of a fault is expected of each.
  const targets = result.events.filter((/** @type {any} */ e) => e.kind === 'fault').map((/** @type {any} */ e) => e.target);
  const of = (/** @type {string} */ kind) => targets.map((/** @type {string} */ t) => result.events.find((/** @type {any} */ e) => e.kind === kind && e.target === t));
  const classes = new Set(of('classified').map((/** @type {any} */ e) => e?.class ?? ''));
  if (targets.length > 0 && of('detected').every((/** @type {any} */ e) => e) && result.metrics.detection_delay > 0) out += `detected_within = ${decimal(limitAbove(result.metrics.detection_delay))}\n`;
  if (classes.size === 1 && !classes.has('')) out += `classified = ${quoted([...classes][0])}\n`;
  if (result.events.some((/** @type {any} */ e) => e.kind === 'redistributed')) out += 'redistributed = true\n';
  out += `touchdown = ${Boolean(result.touchdown)}\ndrop = ${Boolean(result.drop)}\n`;
  const most = Math.max(...Object.values(result.metrics.max_orbit ?? {}).map(Number));
  if (!result.touchdown && most > 0) out += `max_orbit = ${decimal(limitAbove(most))}\n`;
  return out;
}

/**
 * A campaign of faults of the coils of one bearing, at three speeds and three loads.
 * @param {{name: string, rig: string, duration: number, speed: number, faults: Fault[]}} of
 */
export function sweepText(of) {
  const coils = of.faults.map((f) => /^(.+)\.coil(\d+)$/.exec(f.target)).filter((f) => f !== null);
  const bearing = coils[0]?.[1] ?? '';
  const numbers = coils.filter((c) => c[1] === bearing).map((c) => Number(c[2])).sort((a, b) => a - b);
  const first = of.faults.find((f) => f.target.startsWith(bearing + '.coil'));
  if (!first) return '';
  const speeds = [...new Set([0, of.speed, 2 * of.speed])].map(decimal).join(', ');
  return `name = ${quoted(of.name)}\nrig = ${quoted(of.rig)}\nduration = ${decimal(of.duration)}\nseeds = 2\n\n` +
    `[faults]\nbearings = [${quoted(bearing)}]\nhealthy = true\nsets = [[${numbers.join(', ')}]]\ntime = ${decimal(first.time)}\n` +
    `[[faults.kind]]\nkind = ${quoted(first.kind)}\n${parametersOf(first.parameters)}\n` +
    `[operation]\nspeeds = [${speeds}]   # rad/s\nload_unit = "capacity"\nloads = [0.0, 0.5, 0.8]\n`;
}
