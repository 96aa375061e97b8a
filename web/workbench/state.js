/** What the page shows, in one place: whoever changes it calls `changed`. */
import {emptyView} from './address.js';

/**
 * @typedef {{id: number, command: string, subject: string, argv: string[], new_files: string[], state: string,
 *            error: string, started: string, code: number, seconds: number}} Job
 * @typedef {{share: number, text: string, stage: string, stages: string[], partial: any, seconds: number}} Progress
 */

export const state = {
  /** @type {import('./address.js').View} */
  view: emptyView(),
  /** @type {any} the answer of /api/folder */
  folder: null,
  /** @type {Job[]} */
  jobs: [],
  /** @type {Map<number, Progress>} of running jobs */
  progress: new Map(),
  /** @type {Map<string, any>} "compare practice/case.toml" -> /api/result */
  results: new Map(),
  /** @type {{case: string, folder: string}[]} folders of loggers that the server looks after */
  watched: [],
  /** @type {{text: string, steps: number[], bad: boolean}|null} what was just done or refused; steps: of its undo */
  notice: null,
};

/** @type {() => void} */
let draw = () => {};

/** @param {() => void} how */
export function drawWith(how) {
  draw = how;
}

let waiting = false;
/** Draws once, soon. */
export function changed() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    draw();
  });
}

/** Tells the person, also one who does not see. @param {string} text @param {boolean} bad @param {number[]} steps of an undo */
export function tell(text, bad = false, steps = []) {
  state.notice = {text, steps, bad};
  const said = document.getElementById('said');
  if (said) said.textContent = text;
  changed();
}

/** @param {unknown} error */
export function tellError(error) {
  tell(error instanceof Error ? error.message : String(error), true);
}

/** The running or waiting job of a command about a file. @param {string} command @param {string} subject */
export function activeJob(command, subject) {
  return state.jobs.find((j) => j.command === command && j.subject === subject &&
                                (j.state === 'running' || j.state === 'queued')) ?? null;
}

/** The newest job of a command about a file. @param {string} command @param {string} subject */
export function lastJob(command, subject) {
  return state.jobs.filter((j) => j.command === command && j.subject === subject).at(-1) ?? null;
}
