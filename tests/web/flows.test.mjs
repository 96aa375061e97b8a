import assert from 'node:assert/strict';
import test from 'node:test';
import {stepsThrough} from '../../web/workbench/history.js';
import {worstCells} from '../../web/workbench/misfit.js';
import {betweenText, marksText, nearest, statistics, within} from '../../web/workbench/panel_text.js';
import {alarms, moved, pointsOf, scaleFor} from '../../web/workbench/trend.js';

const job = (id, subject, rig, next, effect = 'cross-coupling') => ({id, command: 'adopt', subject, argv: ['adopt', subject, effect, '--target', 'A'], new_files: [rig, next], state: 'done'});

test('the ladder of cases goes through the one that is shown', () => {
  const jobs = [job(1, 'c.toml', 'r2.toml', 'c_2.toml'), job(2, 'c_2.toml', 'r3.toml', 'c_3.toml', 'windage'), job(3, 'other.toml', 'r4.toml', 'o_2.toml'), {...job(4, 'c.toml', 'r5.toml', 'c_4.toml'), state: 'failed'}];
  const files = ['c.toml', 'c_2.toml', 'c_3.toml', 'o_2.toml'];
  for (const file of ['c.toml', 'c_2.toml', 'c_3.toml'])
    assert.deepEqual(stepsThrough(file, jobs, files).map((s) => s.file + s.added), ['c.toml', 'c_2.toml+ cross-coupling at A', 'c_3.toml+ windage at A']);
  // A step that was taken back is none.
  assert.deepEqual(stepsThrough('c.toml', jobs, ['c.toml', 'o_2.toml']).map((s) => s.file), ['c.toml']);
});

test('cells go from the worst down, unknown ones are left out', () => {
  const records = [{data: 'a/r-1.h5', channels: {'A.x': {ratio: 2}, 'A.y': {ratio: 'inf'}}}, {data: 'r-2.h5', channels: {'A.x': {ratio: 5}, bus: {ratio: null}}}];
  assert.deepEqual(worstCells(records).map((c) => c.record + ' ' + c.channel), ['r-1 A.y', 'r-2 A.x', 'r-1 A.x']);
});

test('between the cursors: difference, mean, rms and peak of stored samples', () => {
  const time = [0, 1, 2, 3, 4], values = [9, 1, -3, null, 9];
  assert.deepEqual(within(time, 1, 3), {first: 1, last: 4});
  assert.deepEqual(statistics(values, 1, 4), {mean: -1, rms: Math.sqrt(5), peak: 3});
  assert.equal(statistics([null], 0, 1), null);
  assert.match(marksText({A: 1, B: 3}), /dt 2\.000 s, 1\/dt 0\.5000 Hz/);
  assert.equal(betweenText({A: 1, B: 2}, time, [{label: 'x', values, unit: '-'}], true), 'x: dy -4.00, mean -1.00, rms 2.24, peak 3.00');
  assert.equal(betweenText({A: 1, B: 2}, time, [{label: 'x', values, unit: '-'}], false), 'x: peak 3.00');
  assert.equal(betweenText({A: 1}, time, [], true), '');
});

test('another time base shows its nearest sample, nothing beyond its end', () => {
  assert.deepEqual(nearest([0, 0.4, 0.6, 1, 3], [0, 1], [5, 7]), [5, 5, 7, 7, null]);
});

test('what moved most comes first, a band that was left is an alarm', () => {
  const records = [{data: 'a', state: 'ok', left: [], ratio: 1, parameters: {gap: {value: 1, sds: -0.5}, mass: {value: 2, sds: 1}}},
                   {data: 'b', state: 'left', left: [], ratio: null, parameters: {gap: {value: 1, sds: -9}}}];
  assert.deepEqual(moved(records).map((m) => m.path), ['gap', 'mass']);
  assert.deepEqual(pointsOf(records, (r) => r.ratio).map((p) => p.k), [0]);
  assert.deepEqual(alarms(records).map((r) => r.data), ['b']);
  const s = scaleFor([2, 2], 100);
  assert.ok(s.y(2) > 0 && s.y(2) < 100);
});
