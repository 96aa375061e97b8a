/** A scenario: its run with verdict, events and channels; and the playground where a click breaks a coil. */
import {html, nothing} from './lit-html.js';
import {followUp, loadResult, openReport, resultOf, startJob} from './actions.js';
import {emptyView, formatAddress} from './address.js';
import {command, errorOf, progressOf} from './job_parts.js';
import {quantity} from './numbers.js';
import {Panels} from './panels.js';
import {openPlayground, play} from './playground.js';
import {playgroundPart} from './playground_part.js';
import {eventTimes, figures, queryOf, recordOf, runPlots, stemOf, summary} from './run_parts.js';
import {shareBar} from './share.js';
import {activeJob, changed, lastJob, state, tellError} from './state.js';
import {orbit} from './stator.js';

/** @type {Panels|null} */
let panels = null;

/** @param {string} file */
export async function openRun(file) {
  panels?.clear();
  await loadResult('run', file);
  try {
    await openPlayground(file);
    await loadResult('rig', play.rig);
    const known = resultOf('rig', play.rig);
    if (!known || !known.fresh) await followUp({command: 'rig', rig: play.rig});
  } catch (error) {
    tellError(error);
  }
  changed();
}

/** The run that is drawn: that of the playground, else the scenario's own. */
function shown() {
  const played = play.file === state.view.file ? play.runs.get('run') : undefined;
  if (played) return {job: played.job, stem: played.stem, result: played.result};
  const found = resultOf('run', state.view.file);
  return found ? {job: found.job, stem: stemOf(state.view.file), result: found.result} : null;
}

/** @param {import('./run_parts.js').RunRecord} record @param {any} rig */
function orbits(record, rig) {
  const healthy = play.runs.get('healthy');
  const beside = healthy && play.runs.has('run') ? recordOf(healthy.job, healthy.stem) : null;
  const first = [...record.orbits.values()][0];
  const count = first ? first[0].length : 0;
  const index = play.at === null ? null : Math.round(play.at * Math.max(0, count - 1));
  return html`<div class="stators">${[...record.orbits].map(([plane, [x, y]]) => {
    const g = beside?.orbits.get(plane);
    return orbit(plane, x, y, rig?.result.bearings.find((/** @type {any} */ b) => b.name === plane)?.clearance ?? null, g ? {x: g[0], y: g[1]} : null, index);
  })}</div>${count > 0 ? playback(count) : nothing}`;
}

let playing = 0;
/** 100 times slower than the rotor. @param {number} count of samples */
function playback(count) {
  const start = () => {
    cancelAnimationFrame(playing);
    let last = performance.now();
    if (play.at === null || play.at >= 1) play.at = 0;
    const step = (/** @type {number} */ now) => {
      play.at = Math.min(1, (play.at ?? 0) + (now - last) / 1000 / (100 * (play.duration || 1)));
      last = now;
      changed();
      playing = play.at < 1 ? requestAnimationFrame(step) : 0;
    };
    playing = requestAnimationFrame(step);
  };
  const stop = () => {
    cancelAnimationFrame(playing);
    playing = 0;
    changed();
  };
  const move = (/** @type {number} */ by) => () => {
    play.at = Math.min(1, Math.max(0, (play.at ?? 0) + by / count));
    changed();
  };
  return html`<p class="playback"><button @click=${playing ? stop : start}>${playing ? 'Pause' : 'Play 1/100'}</button>
    <button aria-label="a sample back" @click=${move(-1)}>&lt;</button> <button aria-label="a sample on" @click=${move(1)}>&gt;</button>
    <input type="range" min="0" max="1" step="0.001" .value=${String(play.at ?? 0)} aria-label="time of the orbits" @input=${(/** @type {Event} */ e) => {
      play.at = Number(/** @type {HTMLInputElement} */ (e.target).value);
      changed();
    }}> ${play.at === null ? '' : `t ${quantity(play.at * play.duration, 's', 5)}`}</p>`;
}

/** @param {(change: object) => void} go */
export function runScreen(go) {
  const file = state.view.file;
  const job = activeJob('run', file);
  const found = resultOf('run', file);
  const last = lastJob('run', file);
  const rig = play.rig ? resultOf('rig', play.rig) : null;
  const now = shown();
  const record = now && !job ? recordOf(now.job, now.stem) : null;
  const failedPlay = state.jobs.filter((j) => j.command === 'play' && j.subject === file).at(-1);
  return html`<h1>${file}</h1><div class="columns"><div>
    ${job ? progressOf(job, 'run') : html`<p><button class="main" @click=${() => {
      play.runs.clear();
      void startJob({command: 'run', scenario: file});
    }}>${found ? 'Run again' : 'Run'}</button>
      ${found ? html` <button @click=${() => openReport(found.job)}>Report</button>` : nothing} ${last ? command(last) : nothing}</p>`}
    ${last?.state === 'failed' && !job ? errorOf(last.error) : nothing}
    ${failedPlay?.state === 'failed' && !play.running ? errorOf(failedPlay.error) : nothing}
    ${found && !found.fresh ? html`<p class="note">Older than ${found.stale.join(', ')}.</p>` : nothing}
    ${play.runs.has('run') ? html`<p class="note">Shown: the playground's run${play.runs.size > 1 ? '; dashed: beside it' : ''}. The scenario's own: Run again.</p>` : nothing}
    ${now ? summary(now.result) : html`<p>Not run yet: press Run, or break a coil.</p>`}
    <p class="marks"></p><div class="panels" id="panels"></div>${record ? shareBar(() => panels) : nothing}
    ${now ? figures(now.result) : nothing}
    <p><a href=${formatAddress({...emptyView(), screen: 'compare', file})}>Compare with another run</a></p></div>
    <div>${record ? orbits(record, rig) : nothing}
    ${rig ? playgroundPart(rig.result, go) : html`<p>Reading the rig.</p>`}</div></div>`;
}

/** After the screen was drawn: positions and coil currents of every plane. @param {(change: object) => void} go */
export function drawRun(go) {
  const place = document.getElementById('panels');
  const now = shown();
  if (!place || !now) return;
  const record = recordOf(now.job, now.stem);
  if (!record || record.channels.length === 0) return;
  if (!panels || panels.place !== place) panels = new Panels(place, (moved) => go(moved));
  const ghosts = [];
  for (const [name, label] of [['healthy', 'healthy'], ['off', 'tolerance off']]) {
    const run = play.runs.get(name);
    if (run && play.runs.get('run')?.job === now.job && recordOf(run.job, run.stem)) ghosts.push({label, query: queryOf(run.job, run.stem)});
  }
  const plots = runPlots(record, ghosts);
  if (plots.length > 0) void panels.show({query: record.query, name: state.view.file, plots, from: state.view.from, to: state.view.to, marks: state.view.marks, events: eventTimes(now.result)});
}
