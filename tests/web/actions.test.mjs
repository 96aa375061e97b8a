import assert from 'node:assert/strict';
import test from 'node:test';
import {answered, element, server, settled} from './page.mjs';
const {commandLine, loadFolder, loadResult, mend, resultOf, runJob, startJob, takeEvent, undo, upload} = await import('../../web/workbench/actions.js');
const {activeJob, changed, drawWith, lastJob, state} = await import('../../web/workbench/state.js');

const job = (id, more = {}) => ({id, command: 'compare', subject: 'p/case.toml', argv: [], new_files: [], state: 'running', error: '', code: 0, ...more});
const pathOf = (k) => server.asked.at(k)?.path;

function fresh() {
  Object.assign(state, {jobs: [], folder: null, notice: null});
  state.progress.clear();
  state.results.clear();
  server.asked = [];
  server.answer = null;
}

test('many changes are drawn once', async () => {
  let drawn = 0;
  drawWith(() => ++drawn);
  changed();
  changed();
  await settled();
  assert.equal(drawn, 1);
  changed();
  await settled();
  assert.equal(drawn, 2);
});

test('a job is active while it waits or runs; the newest of a command is the last', () => {
  fresh();
  state.jobs = [job(1, {state: 'done'}), job(2, {state: 'queued'}), job(3, {subject: 'other.toml'})];
  assert.equal(activeJob('compare', 'p/case.toml').id, 2);
  assert.equal(activeJob('explain', 'p/case.toml'), null);
  state.jobs.push(job(4, {state: 'failed'}));
  assert.equal(lastJob('compare', 'p/case.toml').id, 4);
  assert.equal(lastJob('run', 'p/case.toml'), null);
});

test('a command is shown as a person would type it', () => {
  const argv = ['explain', 'case.toml', '--json', 'out/e.json', '--quiet', '--events', 'x', '--seed', '3', '--resume', 'f'];
  assert.equal(commandLine(job(1, {argv})), 'ambrig explain case.toml --seed 3');
});

test('events of a running job: stages once each, share, candidates so far', () => {
  fresh();
  takeEvent({event: 'stage', job: 7, stage: 'noise'});
  takeEvent({event: 'stage', job: 7, stage: 'fits'});
  takeEvent({event: 'stage', job: 7, stage: 'noise'});
  takeEvent({event: 'progress', job: 7, share: 0.4, text: 'fit 3', seconds: 12});
  takeEvent({event: 'partial', job: 7, result: {ranking: []}});
  assert.deepEqual(state.progress.get(7),
                   {share: 0.4, text: 'fit 3', stage: 'noise', stages: ['noise', 'fits'], partial: {ranking: []}, seconds: 12});
  takeEvent({event: 'unknown'});
  assert.equal(state.progress.size, 1);
});

test('a job that ends forgets its progress, says why it failed, and its answer is read', async () => {
  fresh();
  state.jobs = [job(1), job(2)];
  state.progress.set(1, {share: 1});
  server.answer = (path) => answered(path.startsWith('/api/result') ? {fresh: true, result: {ratio: 2}} : []);
  takeEvent({event: 'job', job: job(1, {state: 'done'})});
  await settled();
  assert.equal(state.progress.has(1), false);
  assert.deepEqual(state.jobs, []);  // as the server told them last
  assert.deepEqual(resultOf('compare', 'p/case.toml'), {fresh: true, result: {ratio: 2}});
  takeEvent({event: 'job', job: job(2, {state: 'failed', error: 'record 3 is empty'})});
  assert.deepEqual([state.notice.text, state.notice.bad], ['compare: record 3 is empty', true]);
  takeEvent({event: 'job', job: job(2, {state: 'failed', code: 137})});
  assert.equal(state.notice.text, 'compare: failed, exit code 137');
  await settled();
});

test('the answer to a new job does not undo what its events have told already', async () => {
  fresh();
  server.answer = () => {
    takeEvent({event: 'job', job: job(5, {state: 'running'})});
    return answered(job(5, {state: 'queued'}));
  };
  await startJob({command: 'compare', case: 'p/case.toml'});
  assert.deepEqual(state.jobs.map((j) => [j.id, j.state]), [[5, 'running']]);
});

test('a list of jobs that is older than an event does not take the event back', async () => {
  fresh();
  let lists = 0;
  server.answer = async (path) => {
    if (path !== '/api/jobs') return answered({});
    if (++lists > 1) return answered([job(6, {state: 'done'})]);
    const old = answered([]);  // made before the job was, but under way for long
    takeEvent({event: 'job', job: job(6, {state: 'running'})});
    return old;
  };
  await loadFolder();
  assert.deepEqual([lists, state.jobs.map((j) => [j.id, j.state])], [2, [[6, 'done']]]);
});

test('who waits for a job learns of its end from the list, where the event was lost', async () => {
  fresh();
  server.answer = (path, options) => answered(path === '/api/jobs' && options.method === 'POST' ? job(8) : path === '/api/jobs' ? [job(8, {state: 'done', code: 1})] : {});
  const waiting = runJob({command: 'run', scenario: 's.toml'});
  await settled();
  await loadFolder();
  assert.deepEqual([(await waiting).state, (await waiting).code], ['done', 1]);
  server.answer = () => answered({error: 'no such scenario'}, {status: 400});
  assert.equal(await runJob({command: 'run', scenario: 'none.toml'}), null);
});

test('a file that changed is read again, with what is known of it', async () => {
  fresh();
  state.results.set('compare p/case.toml', {}).set('run p/other.toml', {});
  takeEvent({event: 'file', file: 'p/case.toml'});
  takeEvent({event: 'file', file: 'p/new.toml'});
  await settled();
  const asked = server.asked.map((a) => a.path);
  assert.ok(asked.includes('/api/result?kind=compare&p=p%2Fcase.toml') && !asked.includes('/api/folder'));
  await new Promise((resume) => setTimeout(resume, 250));
  assert.equal(server.asked.filter((a) => a.path === '/api/folder').length, 1);  // many files that arrive together are one reading
  assert.ok(!asked.some((p) => p.includes('other')));
});

test('a mended line can be undone, and both compare again', async () => {
  fresh();
  const said = element('said');
  state.view = {...state.view, screen: 'case', file: 'p/case.toml'};
  const answers = {'POST /api/mend': {line: 4, text: 'delay = 2e-4', step: 11}, 'POST /api/undo/11': {file: 'p/case.toml'},
                   'POST /api/jobs': job(1), 'GET /api/jobs': [], 'GET /api/folder': {}, 'GET /api/watched': []};
  server.answer = (path, options) => answered(answers[`${options.method ?? 'GET'} ${path}`]);
  await mend('p/case.toml', {record: 'r1', mend: 'delay'});
  assert.deepEqual(state.notice, {text: 'written into p/case.toml, line 4: delay = 2e-4', bad: false, steps: [11]});
  assert.equal(said.textContent, state.notice.text);
  assert.deepEqual(JSON.parse(server.asked[0].body), {case: 'p/case.toml', record: 'r1', mend: 'delay'});
  assert.deepEqual(JSON.parse(server.asked[1].body), {command: 'compare', case: 'p/case.toml'});
  await undo([11]);
  assert.equal(pathOf(-1), '/api/jobs');
  assert.equal(said.textContent, 'p/case.toml is as it was');
  assert.equal(state.notice?.text, said.textContent);  // the comparison that follows does not take it away
});

test('a file that is refused does not stop the others', async () => {
  fresh();
  server.answer = (path) => path.endsWith('bad.h5') ? answered({error: 'too large'}, {status: 413}) : answered({});
  await upload([{name: 'bad.h5'}, {name: 'a b.csv'}], 'practice/');
  assert.deepEqual(server.asked.slice(0, 2).map((a) => a.path),
                   ['/api/upload?p=practice%2Fbad.h5', '/api/upload?p=practice%2Fa%20b.csv']);
  assert.equal(state.notice.text, 'practice/a b.csv is here');
  assert.deepEqual([pathOf(-3), pathOf(-2), pathOf(-1)], ['/api/folder', '/api/jobs', '/api/watched']);
});

test('an answer that cannot be had is told, and what was known stays', async () => {
  fresh();
  state.results.set('run a.toml', {fresh: true});
  server.answer = () => answered({error: 'no such file'}, {status: 404});
  await loadResult('run', 'a.toml');
  assert.deepEqual([state.notice.text, state.notice.bad], ['no such file', true]);
  assert.deepEqual(resultOf('run', 'a.toml'), {fresh: true});
  assert.equal(resultOf('run', 'never asked'), undefined);
});
