/** The answer of `ambrig explain`: names with their probabilities, closure, remainder, ladder; and its stages while it runs. */
import {html, nothing} from './lit-html.js';
import {openReport, startJob, stopJob} from './actions.js';
import {command, errorOf, secondsLeft} from './job_parts.js';
import {ladder} from './ladder.js';
import {recordName} from './misfit.js';
import {duration, probability, ratio, uncertain} from './numbers.js';
import {activeJob, lastJob, state} from './state.js';

const stages = /** @type {[string, string][]} */ ([
  ['noise', 'noise'], ['data', 'data'], ['parameters', 'parameters'], ['screening', 'screening'],
  ['fits', 'fits'], ['remainder', 'what is left'],
]);

/** Effects whose law `ambrig refine` can fit. */
const refinable = new Set(['saturation', 'iron-reluctance', 'eddy-currents', 'hysteresis', 'side-pull', 'cross-coupling', 'windage']);

/** @param {import('./state.js').Job} job */
function running(job) {
  const p = state.progress.get(job.id);
  const left = p ? secondsLeft(p) : null;
  const reached = p ? stages.findIndex(([name]) => name === p.stage) : -1;
  const percent = Math.round(100 * (p?.share ?? 0));
  return html`<div class="running"><ol class="stages">${stages.map(([, text], k) =>
      html`<li class=${k < reached ? 'past' : k === reached ? 'now' : ''} aria-current=${k === reached ? 'step' : nothing}>${text}</li>`)}</ol>
    <progress max="100" value=${percent} aria-label="explain"></progress>
    <span>${job.state === 'queued' ? 'waits for another job' : `${percent} %  ${p?.text ?? ''}`}${left === null ? '' : `, ${duration(left)} left`}</span>
    <button class="stop" @click=${() => stopJob(job.id)}>Stop</button></div>
    ${p?.partial ? html`<div class="partial">${candidates(p.partial, 'so far')}</div>` : nothing}`;
}

/** @param {any} e the JSON of explain @param {string} title */
function candidates(e, title) {
  const ranking = e.ranking ?? [];
  if (ranking.length === 0 && (e.screened ?? []).length === 0) return nothing;
  if (ranking.length === 0)
    return html`<p>Screened ${title}: ${e.screened.slice(0, 5).map((/** @type {any} */ s) => `${s.effect} at ${s.target} ${ratio(s.ratio_validate)}`).join(', ')}</p>`;
  return html`<table class="ranking"><caption>Candidates ${title}</caption>
    <thead><tr><th scope="col">effect</th><th scope="col">where</th><th scope="col">fitted</th><th scope="col">unseen</th><th scope="col">parameters</th></tr></thead>
    <tbody>${ranking.slice(0, 6).map((/** @type {any} */ r) => html`<tr><th scope="row">${r.effect}</th><td>${r.target}</td>
      <td class="number">${ratio(r.ratio_fit)}</td><td class="number">${ratio(r.ratio_validate)}</td><td>${parameters(r)}</td></tr>`)}</tbody></table>`;
}

/** @param {any} effect */
function parameters(effect) {
  return Object.entries(effect.parameters ?? {})
    .map(([name, p]) => `${name} ${uncertain(/** @type {any} */ (p).value, /** @type {any} */ (p).sd, /** @type {any} */ (p).unit)}`).join(', ');
}

const words = /** @type {Record<string, string>} */ ({
  effect: 'An effect is missing from the model', parameters: 'Moving the rig\u2019s parameters within their tolerance explains all',
  none: 'The model agrees with the records within the noise', unknown: 'Something is missing that no effect of the catalogue explains',
  data: 'The data are wrong; mend them first', unfinished: 'not finished',
});

/** The verdict in words; a 95 % set with several effects is no identification. @param {any} e */
function verdictOf(e) {
  const sets = [e.set ?? [], ...(e.adopted ?? []).map((/** @type {any} */ a) => a.set ?? [])];
  const several = sets.some((set) => set.filter((/** @type {any} */ m) => m.target).length > 1);
  return `${words[e.verdict] ?? e.verdict}${e.verdict === 'effect' && several ? '; more than one name remains' : ''}`;
}

/** @param {any} e */
function names(e) {
  const set = e.set ?? [];
  return html`<h3>Names, 95 % set</h3><ul class="names">${set.map((/** @type {any} */ m) => html`<li>
    <span class="name">${m.effect === 'unknown' ? 'none of these' : m.effect === 'data' ? 'wrong data' : m.effect}${m.target ? ` at ${m.target}` : ''}</span>
    <meter min="0" max="1" value=${m.probability} aria-label="probability"></meter><span class="number">${probability(m.probability)}</span></li>`)}</ul>`;
}

/** @param {any} e */
function closure(e) {
  const c = e.closure;
  if (!c) return nothing;
  const before = ratio(c.floors_before), after = ratio(c.floors_after);
  const test = typeof c.test?.before === 'number' ? html`; unseen records ${ratio(c.test.before)} \u2192 ${ratio(c.test.after)}` : nothing;
  return html`<h3>Closure</h3><p>${c.explained > 0.99 ? '> 99' : Math.round(100 * c.explained)} % of the error above the noise is explained: ${before} \u2192 ${after} floors${test}.</p>
    <h3>Remainder</h3><p>${e.remainder?.text ?? ''}</p>
    ${(e.remainder?.where ?? []).length > 0 ? html`<ul>${e.remainder.where.slice(0, 6).map((/** @type {any} */ w) =>
      html`<li>${w.channel} in ${recordName(w.record)}: ${ratio(w.ratio)} times the noise</li>`)}</ul>` : nothing}`;
}

/**
 * @param {string} file the case
 * @param {any} found /api/result of explain
 * @param {(effect: any, refine?: boolean) => void} adopt
 */
export function explanation(file, found, adopt) {
  const job = activeJob('explain', file);
  if (job) return html`<section class="explain" aria-label="explain"><h2>Explain</h2>${running(job)}</section>`;
  const last = lastJob('explain', file);
  const again = last && (last.state === 'stopped' || last.state === 'interrupted');
  const start = html`<button class="main" @click=${() => startJob({command: 'explain', case: file})}>${again ? 'Resume explain' : found ? 'Explain again' : 'Explain'}</button>`;
  if (!found) return html`<section class="explain" aria-label="explain"><h2>Explain</h2>
    ${last?.state === 'failed' ? errorOf(last.error) : nothing}
    <p>Which effect is missing? The command tries the catalogue on these records; it takes a minute or some.</p>${start}</section>`;
  const e = found.result;
  return html`<section class="explain ${found.fresh ? '' : 'stale'}" aria-label="explain"><h2>Explain</h2>
    ${found.fresh ? nothing : html`<p class="note">Older than ${found.stale.join(', ')}.</p>`}
    <p class="verdict">${verdictOf(e)}</p>
    ${names(e)}
    ${(e.adopted ?? []).map((/** @type {any} */ a) => html`<p><button class="main" @click=${() => adopt(a)}>Adopt ${a.effect} at ${a.target}</button>
      ${refinable.has(a.effect) ? html`<button @click=${() => adopt(a, true)}>Refine its law</button>` : nothing} ${parameters(a)}</p>`)}
    ${closure(e)}
    ${(e.ladder ?? []).length > 0 ? ladder(e.ladder, 'Ladder: error over noise, step by step') : nothing}
    ${e.unexplained ? html`<p>${e.unexplained.text}</p>` : nothing}
    <details><summary>Candidates, warnings, the command</summary>${candidates(e, 'fitted')}
      ${(e.warnings ?? []).map((/** @type {string} */ w) => html`<p class="note">${w}</p>`)}
      ${last ? html`<p>${command(last)}</p>` : nothing}</details>
    <p>${start} <button @click=${() => openReport(found.job)}>Report</button></p></section>`;
}
