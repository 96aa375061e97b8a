/** What a click does: requests, and what they change in the state. */
import {getJson, post, put, remove} from './api.js';
import {changed, state, tell, tellError} from './state.js';

/** The command that a job is, as a person would type it. @param {import('./state.js').Job} job */
export function commandLine(job) {
  const hidden = new Set(['--json', '--events', '--html', '--series', '--resume', '--out', '--quiet']);
  const words = [];
  for (let k = 0; k < job.argv.length; ++k) {
    if (job.argv[k] === '--quiet') continue;
    if (hidden.has(job.argv[k])) ++k;
    else words.push(job.argv[k]);
  }
  return 'ambrig ' + words.join(' ');
}

export async function loadFolder() {
  try {
    state.folder = await getJson('/api/folder');
    state.jobs = await getJson('/api/jobs');
  } catch (error) {
    tellError(error);
  }
  changed();
}

/** @param {string} command @param {string} file */
export async function loadResult(command, file) {
  try {
    const found = await getJson(`/api/result?kind=${command}&p=${encodeURIComponent(file)}`);
    state.results.set(command + ' ' + file, found);
  } catch (error) {
    tellError(error);
  }
  changed();
}

/** @param {string} command @param {string} file @returns {any} {job, result, fresh, stale} or null; undefined: not asked yet */
export function resultOf(command, file) {
  return state.results.get(command + ' ' + file);
}

/** @param {{command: string} & Record<string, string|number>} order */
export async function startJob(order) {
  try {
    if (state.notice?.step === null) state.notice = null;
    const job = await post('/api/jobs', order);
    // Its events may have come before this answer: they know more.
    if (!state.jobs.some((j) => j.id === job.id)) takeJob(job);
  } catch (error) {
    tellError(error);
  }
}

/** @param {number} id */
export async function stopJob(id) {
  try {
    await remove(`/api/jobs/${id}`);
  } catch (error) {
    tellError(error);
  }
}

/** @param {import('./state.js').Job} job */
function takeJob(job) {
  const at = state.jobs.findIndex((j) => j.id === job.id);
  if (at < 0) state.jobs.push(job);
  else state.jobs[at] = job;
  if (job.state !== 'running' && job.state !== 'queued') state.progress.delete(job.id);
  changed();
}

/** An event of the server. @param {any} event */
export function takeEvent(event) {
  if (event.event === 'job') {
    takeJob(event.job);
    ended(event.job);
    return;
  }
  if (event.event === 'file') {
    void loadFolder();
    for (const key of state.results.keys()) if (key.endsWith(' ' + event.file)) void reload(key);
    return;
  }
  if (typeof event.job !== 'number') return;
  const p = state.progress.get(event.job) ?? {share: 0, text: '', stage: '', stages: [], partial: null, seconds: 0};
  if (event.event === 'stage') {
    p.stage = event.stage;
    if (!p.stages.includes(event.stage)) p.stages.push(event.stage);
  } else if (event.event === 'progress') {
    p.share = event.share;
    p.text = event.text;
    p.seconds = event.seconds;
  } else if (event.event === 'partial') {
    p.partial = event.result;
  } else if (event.event === 'warning') {
    tell(event.text, true);
  }
  state.progress.set(event.job, p);
  changed();
}

/** @param {string} key "compare practice/case.toml" */
async function reload(key) {
  const space = key.indexOf(' ');
  await loadResult(key.slice(0, space), key.slice(space + 1));
}

/** @param {import('./state.js').Job} job */
function ended(job) {
  if (job.state === 'running' || job.state === 'queued') return;
  if (job.state === 'failed') tell(`${job.command}: ${job.error || 'failed, exit code ' + job.code}`, true);
  if (job.state === 'stopped') tell(`${job.command} stopped; started again, it goes on where it was`);
  if (job.state === 'done') void loadResult(job.command, job.subject);
  void loadFolder();
}

/** Writes the line that mends a data fault into the case. @param {string} file @param {{record: string, mend: string}} fault */
export async function mend(file, fault) {
  try {
    const done = await post('/api/mend', {case: file, record: fault.record, mend: fault.mend});
    tell(`written into ${file}, line ${done.line}: ${done.text}`, false, done.step);
    await startJob({command: 'compare', case: file});
  } catch (error) {
    tellError(error);
  }
}

/** @param {number} step */
export async function undo(step) {
  try {
    const done = await post(`/api/undo/${step}`);
    tell(`${done.file} is as it was`);
    await loadFolder();
    await startJobForShown();
  } catch (error) {
    tellError(error);
  }
}

async function startJobForShown() {
  if (state.view.screen === 'case') await startJob({command: 'compare', case: state.view.file});
}

/** Opens a job's report in a page of its own, which knows nothing of this one. @param {number} job */
export async function openReport(job) {
  try {
    const ticket = await post('/api/ticket', {job});
    window.open(ticket.address, '_blank', 'noopener');
  } catch (error) {
    tellError(error);
  }
}

/** @param {FileList|null} files @param {string} folder "" or "practice/" */
export async function upload(files, folder) {
  for (const file of files ?? []) {
    try {
      await put('/api/upload?p=' + encodeURIComponent(folder + file.name), file);
      tell(`${folder}${file.name} is here`);
    } catch (error) {
      tellError(error);
    }
  }
  await loadFolder();
}
