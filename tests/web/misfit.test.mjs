import assert from 'node:assert/strict';
import test from 'node:test';
import {barOf, columnsOf, freeName, levelOf, recordName, rowsOf, worstCell} from '../../web/workbench/misfit.js';

const records = [
  {data: 'practice/record-1.h5', scenario: 's', use: 'fit', ratio: 2, channels: {'A.i1': {ratio: 1.1}, 'A.x': {ratio: 7}}, blocks: {}},
  {data: 'x/log.2.csv', scenario: 's', use: 'validate', ratio: 2, channels: {'A.x': {ratio: null}, 'A.y': {ratio: 'inf'}, 'A.s2': {ratio: 1}}, blocks: {}},
];

test('records are named as the groups of --series', () => {
  assert.equal(recordName('practice/record-1.h5'), 'record-1');
  assert.equal(recordName('x/log.2.csv'), 'log_2');
});

test('positions stand before coils, a channel that a record lacks is an empty cell', () => {
  const columns = columnsOf(records);
  assert.deepEqual(columns, ['A.x', 'A.y', 'A.i1', 'A.s2']);
  assert.deepEqual(rowsOf(records, columns)[0].cells.map((c) => c.ratio), [7, null, 1.1, null]);
});

test('infinite is the worst, unknown never', () => {
  assert.deepEqual(worstCell(records), {record: 'log_2', channel: 'A.y', ratio: Infinity});
  assert.deepEqual(worstCell(records.slice(0, 1)), {record: 'record-1', channel: 'A.x', ratio: 7});
  assert.equal(worstCell([]), null);
});

test('colours rise with the ratio', () => {
  const levels = [1, 1.5, 3, 6, 12, 'inf'].map(levelOf);
  assert.deepEqual(levels, [0, 1, 2, 3, 4, 5]);
});

test('a new file takes the first free name', () => {
  assert.equal(freeName('p/rig.toml', []), 'p/rig_2.toml');
  assert.equal(freeName('p/rig.toml', ['p/rig_2.toml', 'p/rig_3.toml']), 'p/rig_4.toml');
  assert.equal(freeName('p/rig_2.toml', ['p/rig_2.toml']), 'p/rig_3.toml');
});

test('bars: noise alone is low, the largest is full, nothing is none', () => {
  assert.equal(barOf(null, 10), 0);
  assert.ok(Math.abs(barOf(1, 10) - 0.06) < 1e-12);
  assert.equal(barOf(10, 10), 1);
  assert.equal(barOf('inf', 10), 1);
  assert.ok(barOf(3, 10) > barOf(2, 10));
});
