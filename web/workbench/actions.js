/** What a click does: requests, and what they change in the state. */
import {getJson, getText, post, put, remove} from './api.js';
import {changed, state, tell, tellError} from './state.js';

/** The command that a job is, as a person would type it. @param {import('./state.js').Job} job */
export function commandLine(job) {
  const hidden = new Set(['--json', '--events', '--html', '--series', '--resume', '--out']);
  const words = [];
  for (let k = 0; k < job.argv.length; ++k) {
    if (job.argv[k] === '--quiet' || job.argv[k] === '--no-traces') continue;
    if (hidden.has(job.argv[k]) && (job.argv[k] !== '--out' || job.argv[k + 1].startsWith('.ambrig/'))) ++k;
    else words.push(job.argv[k]);
  }
  return 'ambrig ' + words.join(' ');
}

export async function loadFolder() {
  try {
    state.folder = await getJson('/api/folder');
    await loadJobs();
    state.watched = await getJson('/api/watched');
  } catch (error) {
    tellError(error);
  }
  changed();
}

/** How many states of jobs were told one by one. */
let told = 0;

/** All jobs as the server knows them. A list that was asked for before a job's state was told may be older than that: it is asked for again. */
async function loadJobs() {
  for (;;) {
    const before = told;
    const jobs = await getJson('/api/jobs');
    if (told !== before) continue;
    state.jobs = jobs;
    for (const look of [...waiting]) look();
    return;
  }
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

/** @param {{command: string} & Record<string, any>} order @returns {Promise<number>} the job's number, 0 where it was refused */
export async function startJob(order) {
  // What the person starts clears what was said before; runs that the playground starts by itself do not.
  if (order.command !== 'play' && state.notice?.steps.length === 0) state.notice = null;
  return followUp(order);
}

/** Starts a job that nobody asked for: what was just said stays. @param {{command: string} & Record<string, any>} order @returns {Promise<number>} the job's number, 0 where it was refused */
export async function followUp(order) {
  try {
    const job = await post('/api/jobs', order);
    // Its events may have come before this answer: they know more.
    if (!state.jobs.some((j) => j.id === job.id)) takeJob(job);
    return job.id;
  } catch (error) {
    tellError(error);
    return 0;
  }
}

/** Starts a job and waits until it has ended. @param {{command: string} & Record<string, any>} order @returns {Promise<import('./state.js').Job|null>} null: refused */
export async function runJob(order) {
  const id = await startJob(order);
  if (id === 0) return null;
  return new Promise((done) => {
    const look = () => {
      const job = state.jobs.find((j) => j.id === id);
      if (!job || job.state === 'queued' || job.state === 'running') return false;
      waiting.delete(look);
      done(job);
      return true;
    };
    if (!look()) waiting.add(look);
  });
}

/** Who waits for a job's end. @type {Set<() => boolean>} */
const waiting = new Set();

/** The result of a job. @param {number} job @returns {Promise<any>} */
export async function resultOfJob(job) {
  return getJson(`/api/jobs/${job}/result`);
}

/** Writes a text file that is not there yet or is replaced, with Undo. @param {string} name @param {string} text @param {string} hash of the version seen, "" for a new one */
export async function writeText(name, text, hash = '') {
  const done = await put('/api/file?p=' + encodeURIComponent(name), text, hash ? {'If-Match': hash} : {});
  tell(`written ${name}`, false, [done.step]);
  await loadFolder();
}

/** Changes a text file by a function of its text. @param {string} name @param {(text: string) => string} how @param {string} said */
export async function changeText(name, how, said) {
  const {text, hash} = await getText('/api/file?p=' + encodeURIComponent(name));
  const done = await put('/api/file?p=' + encodeURIComponent(name), how(text), {'If-Match': hash});
  tell(said, false, [done.step]);
  await loadFolder();
}

/** Takes text files away. @param {string[]} names */
export async function removeFiles(names) {
  try {
    const steps = [];
    for (const name of names) {
      const {hash} = await getText('/api/file?p=' + encodeURIComponent(name));
      steps.push((await remove('/api/file?p=' + encodeURIComponent(name), {'If-Match': hash})).step);
    }
    tell(`taken away: ${names.join(', ')}`, false, steps);
    await loadFolder();
  } catch (error) {
    tellError(error);
  }
}

/** @param {string} file the case @param {string} folder of a logger @param {boolean} on */
export async function watchFolder(file, folder, on) {
  try {
    state.watched = await post('/api/watched', {case: file, folder, on});
    tell(on ? `${folder} is looked at every few seconds; each new record is examined` : `${folder} is no longer watched`);
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
  ++told;
  const at = state.jobs.findIndex((j) => j.id === job.id);
  if (at < 0) state.jobs.push(job);
  else state.jobs[at] = job;
  if (job.state !== 'running' && job.state !== 'queued') state.progress.delete(job.id);
  for (const look of [...waiting]) look();
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
    folderSoon();
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

let folderTimer = 0;
/** Many files that arrive together are one reading of the folder. */
function folderSoon() {
  clearTimeout(folderTimer);
  folderTimer = setTimeout(() => void loadFolder(), 200);
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
  if (job.state === 'stopped' && job.command !== 'play') tell(`${job.command} stopped; started again, it goes on where it was`);
  if (job.state === 'done' && job.command !== 'play') void loadResult(job.command, job.subject);
  void loadFolder();
}

/** Writes the line that mends a data fault into the case. @param {string} file @param {{record: string, mend: string}} fault */
export async function mend(file, fault) {
  try {
    const done = await post('/api/mend', {case: file, record: fault.record, mend: fault.mend});
    tell(`written into ${file}, line ${done.line}: ${done.text}`, false, [done.step]);
    await followUp({command: 'compare', case: file});
  } catch (error) {
    tellError(error);
  }
}

/** @param {number[]} steps the last one first */
export async function undo(steps) {
  try {
    const files = [];
    for (const step of [...steps].reverse()) files.push((await post(`/api/undo/${step}`)).file);
    tell(`${files.join(', ')} ${files.length > 1 ? 'are as they were' : 'is as it was'}`);
    await loadFolder();
    if (state.view.screen === 'case') await followUp({command: 'compare', case: state.view.file});
  } catch (error) {
    tellError(error);
  }
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

/** @param {FileList|null} files @param {string} folder "" or "practice/" @returns {Promise<string[]>} the names of those that came */
export async function upload(files, folder) {
  const came = [], steps = [];
  for (const file of files ?? []) {
    try {
      steps.push((await put('/api/upload?p=' + encodeURIComponent(folder + file.name), file)).step);
      came.push(folder + file.name);
      tell(`${came.join(', ')} ${came.length > 1 ? 'are' : 'is'} here`, false, steps);
    } catch (error) {
      tellError(error);
    }
  }
  await loadFolder();
  return came;
}
