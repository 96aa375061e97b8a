/** The ladder of cases: what was adopted, step by step, so that one can go back. */

/**
 * @typedef {{file: string, added: string, rig: string, job: number}} Step  added: "" for the first case
 */

/**
 * The steps that led to a case and those that were made from it: the line through it.
 * @param {string} file @param {import('./state.js').Job[]} jobs @param {string[]} files that are there
 * @returns {Step[]}
 */
export function stepsThrough(file, jobs, files) {
  const made = jobs.filter((j) => j.state === 'done' && (j.command === 'adopt' || j.command === 'refine') && j.new_files.length === 2 &&
    files.includes(j.new_files[1]));
  const up = /** @type {Step[]} */ ([]);
  let at = file;
  for (let k = 0; k < 100; ++k) {
    const job = made.find((j) => j.new_files[1] === at);
    if (!job) break;
    up.unshift(stepOf(job));
    at = job.subject;
  }
  const steps = [{file: at, added: '', rig: '', job: 0}, ...up];
  for (at = file; steps.length < 100;) {
    const next = made.filter((j) => j.subject === at).at(-1);
    if (!next) break;
    steps.push(stepOf(next));
    at = next.new_files[1];
  }
  return steps;
}

/** @param {import('./state.js').Job} job @returns {Step} */
function stepOf(job) {
  const target = job.argv.indexOf('--target');
  const effect = job.argv[2] ?? '';
  const where = target > 0 ? job.argv[target + 1] : '';
  return {file: job.new_files[1], added: (job.command === 'refine' ? 'refined ' : '+ ') + effect.replace('@', ' at ') + (where ? ' at ' + where : ''),
          rig: job.new_files[0], job: job.id};
}
