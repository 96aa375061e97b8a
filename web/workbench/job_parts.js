/** Parts of screens about a job: its progress with Stop, its error with the lines around it. */
import {html, nothing} from './lit-html.js';
import {commandLine, stopJob} from './actions.js';
import {getText} from './api.js';
import {linesAround, placeOf} from './error_lines.js';
import {duration} from './numbers.js';
import {changed, state} from './state.js';

/** Left over of a share after so many seconds [s]; null: too early to say. @param {import('./state.js').Progress} p */
export function secondsLeft(p) {
  return p.share > 0.02 && p.seconds > 1 ? (p.seconds * (1 - p.share)) / p.share : null;
}

/** @param {import('./state.js').Job} job @param {string} what for who does not see */
export function progressOf(job, what) {
  const p = state.progress.get(job.id);
  const left = p ? secondsLeft(p) : null;
  const percent = Math.round(100 * (p?.share ?? 0));
  return html`<p class="running"><progress max="100" value=${percent} aria-label=${what}></progress>
    <span>${job.state === 'queued' ? 'waits for another job' : `${percent} %  ${p?.text ?? ''}`}${left === null ? '' : `, ${duration(left)} left`}</span>
    <button class="stop" @click=${() => stopJob(job.id)}>Stop</button> ${command(job)}</p>`;
}

/** The command of a job, to be copied. @param {import('./state.js').Job} job */
export function command(job) {
  const line = commandLine(job);
  return html`<span class="command"><code>$ ${line}</code> <button @click=${() => navigator.clipboard?.writeText(line)} aria-label="copy the command">copy</button></span>`;
}

/** Texts of files that errors name. @type {Map<string, string>} */
const texts = new Map();

/** @param {string} error one line of a command */
export function errorOf(error) {
  const place = placeOf(error);
  if (!place) return html`<p class="bad" role="alert">${error}</p>`;
  const key = error;
  if (!texts.has(key)) {
    texts.set(key, '');
    getText('/api/file?p=' + encodeURIComponent(place.file)).then(({text}) => {
      texts.set(key, text);
      changed();
    }, () => {});
  }
  const text = texts.get(key);
  return html`<div class="bad" role="alert"><p>${error}</p>${text ? html`<pre class="lines">${linesAround(text, place.line).map((l) =>
    html`<span class=${l.is ? 'is' : ''}>${String(l.number).padStart(4)}  ${l.text}\n</span>`)}</pre>` : nothing}</div>`;
}
