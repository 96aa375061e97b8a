/** The fault playground: what the person breaks and pushes, and the runs that show it. Only `.ambrig` is written before something is saved. */
import {loadFolder, resultOfJob, runJob, stopJob, writeText} from './actions.js';
import {getText} from './api.js';
import {namedFile, topText} from './case_text.js';
import {freeName} from './misfit.js';
import {faultKinds, speedOf, sweepText, withExpectations, withFaults, withLoads, withoutTables, withSpeed, withTolerance} from './scenario_text.js';
import {changed, state, tell, tellError} from './state.js';

/**
 * @typedef {{job: number, stem: string, text: string, result: any, seconds: number}} Shown  text: the scenario that was run
 */

export const play = {
  file: '', rig: '', text: '', duration: 0,
  kind: 'open', time: 0.1,
  /** @type {import('./scenario_text.js').Fault[]} */
  faults: [],
  /** @type {Map<string, {fx: number, fy: number}>} [N] by bearing */
  loads: new Map(),
  /** @type {number|null} [rad/s]; null: as the scenario says */
  speed: null,
  /** What is drawn: the run, and beside it the healthy run and the one without fault tolerance. @type {Map<string, Shown>} */
  runs: new Map(),
  ghosts: new Set(['healthy']),
  /** @type {string} what runs now, for who does not see */
  running: '',
  /** @type {number|null} [s] of the record that the orbits show; null: all of it */
  at: null,
  /** @type {{coil: string, name: string}|null} whose faults are offered */
  menu: null,
};

/** @param {string} file the scenario */
export async function openPlayground(file) {
  clearTimeout(timer);
  ++asked;  // what still runs is of another file
  Object.assign(play, {file, rig: '', text: '', faults: [], loads: new Map(), speed: null, runs: new Map(), running: '', at: null, menu: null});
  const {text} = await getText('/api/file?p=' + encodeURIComponent(file));
  play.text = text;
  play.rig = namedFile(file, topText(text, 'rig'));
  play.duration = Number(/^\s*duration\s*=\s*([\d.e+-]+)/m.exec(text)?.[1] ?? 0);
  play.time = play.duration > 0 && play.duration <= 0.1 ? Number((play.duration / 2).toPrecision(2)) : 0.1;
}

/** @param {string} target "A.coil3" @returns {string|null} kind of its fault */
export function faultOf(target) {
  return play.faults.find((f) => f.target === target)?.kind ?? null;
}

/** Breaks a coil or mends it. @param {string} target @param {string} kind */
export function setFault(target, kind) {
  const now = faultOf(target);
  play.faults = play.faults.filter((f) => f.target !== target);
  if (kind && now !== kind) {
    const k = /** @type {typeof faultKinds[0]} */ (faultKinds.find((one) => one.kind === kind));
    play.faults.push({target, kind, time: play.time, parameters: {...k.parameters}});
  }
  soon();
}

/** @returns {boolean} whether anything differs from the scenario */
export function touched() {
  return play.faults.length > 0 || play.speed !== null || [...play.loads.values()].some((l) => l.fx !== 0 || l.fy !== 0);
}

/** The scenario as the person made it. @param {boolean} broken with the faults @param {boolean} tolerant */
function textOf(broken, tolerant) {
  let text = withoutTables(play.text, ['expect']);
  if (play.speed !== null) text = withSpeed(text, play.speed);
  text = withLoads(text, [...play.loads].map(([plane, l]) => ({plane, ...l, start: 0})));
  if (broken) text = withFaults(text, play.faults);
  else text = withoutTables(text, ['fault']);
  return tolerant ? text : withTolerance(text, false);
}

let timer = 0, asked = 0;
const runNames = {run: 'the run', healthy: 'the healthy run', off: 'the run without fault tolerance'};

/** After the last change of a drag. */
export function soon() {
  clearTimeout(timer);
  timer = setTimeout(() => void runAll(), 60);
  play.running = runNames.run;
  changed();
}

/** Runs that are superseded give way; a new one must not share one that is about to be stopped. */
async function stopOlder() {
  await Promise.all(state.jobs.filter((j) => j.command === 'play' && (j.state === 'running' || j.state === 'queued')).map((j) => stopJob(j.id)));
}

/** The run first, then its ghosts. */
export async function runAll() {
  clearTimeout(timer);
  const number = ++asked;
  await stopOlder();
  if (number !== asked) return;
  const file = play.file, stem = file.slice(file.lastIndexOf('/') + 1).replace(/\.toml$/, '');
  const kinds = /** @type {['run'|'healthy'|'off', boolean, boolean][]} */ ([['run', true, true], ['healthy', false, true], ['off', true, false]]);
  for (const [name, broken, tolerant] of kinds) {
    if (name !== 'run' && !play.ghosts.has(name)) {
      play.runs.delete(name);
      continue;
    }
    play.running = runNames[name];
    changed();
    const begin = performance.now(), text = textOf(broken, tolerant);
    const job = await runJob({command: 'play', scenario: {beside: file, text}});
    if (number !== asked) return;
    if (!job || job.state !== 'done') break;
    try {
      const result = await resultOfJob(job.id);
      if (number !== asked) return;
      play.runs.set(name, {job: job.id, stem, text, result, seconds: (performance.now() - begin) / 1000});
    } catch (error) {
      tellError(error);
    }
    changed();
  }
  play.running = '';
  changed();
}

/** Back to the scenario as it stands. */
export function clearPlayground() {
  clearTimeout(timer);
  ++asked;
  Object.assign(play, {faults: [], loads: new Map(), speed: null, runs: new Map(), running: '', menu: null});
  changed();
}

/** @param {string} name */
export function toggleGhost(name) {
  if (play.ghosts.has(name)) play.ghosts.delete(name);
  else play.ghosts.add(name);
  void runAll();
}

/** A free name beside the scenario. */
function nameFor(/** @type {string} */ name) {
  const files = state.folder.files.map((/** @type {any} */ f) => f.name);
  return files.includes(name) ? freeName(name, files) : name;
}

/** @param {(change: object) => void} go @param {boolean} asTest with [expect] of what the run did */
export async function saveScenario(go, asTest) {
  try {
    const name = nameFor(freeName(play.file, state.folder.files.map((/** @type {any} */ f) => f.name)));
    let text = textOf(true, true);
    if (asTest) {
      // What is expected is what this text does, not what the one before the last change did.
      if (play.runs.get('run')?.text !== text) await runAll();
      const run = play.runs.get('run');
      if (run?.text !== text) return tell('The run of this scenario has not ended; press again when it has.', true);
      text = withExpectations(text, run.result);
    }
    await writeText(name, text);
    go({screen: 'run', file: name});
    await runJob({command: 'run', scenario: name});
  } catch (error) {
    tellError(error);
  }
}

/** A campaign of the chosen faults. @param {(change: object) => void} go */
export async function sweep(go) {
  try {
    const folder = play.file.slice(0, play.file.lastIndexOf('/') + 1);
    const name = nameFor(folder + 'sweep.toml');
    const what = play.faults.map((f) => `${f.target} ${f.kind}`).join(', ');
    const text = sweepText({name: `sweep: ${what}`, rig: topText(play.text, 'rig'), duration: play.duration, speed: play.speed ?? speedOf(play.text) ?? 157.08, faults: play.faults});
    if (!text) return;
    await writeText(name, text);
    await loadFolder();
    go({screen: 'campaign', file: name});
  } catch (error) {
    tellError(error);
  }
}
