import assert from 'node:assert/strict';
import test from 'node:test';
import {emptyView, formatAddress, parseAddress} from '../../web/workbench/address.js';

test('a view survives the address, with names that need quoting', () => {
  const view = {screen: 'case', file: 'a b/\u00e4?#/case.toml', record: 'record-4', channels: ['A.y', 'B.i3'], from: 0.29, to: 0.340001, marks: {A: 0.3, B: 0.31}, vs: 'b/c.toml', shift: -0.002};
  assert.deepEqual(parseAddress(formatAddress(view)), view);
});

test('the folder is the empty address', () => {
  assert.equal(formatAddress(emptyView()), '#/');
  for (const hash of ['', '#', '#/', '#nonsense']) assert.deepEqual(parseAddress(hash), emptyView());
});

test('a time range that is none is left out', () => {
  for (const t of ['1,0', 'x,2', '5', 'NaN,NaN', '1,1']) {
    const view = parseAddress('#/case/c.toml?t=' + t);
    assert.equal(view.from, null);
    assert.equal(view.file, 'c.toml');
  }
});

test('a name with a broken code is taken as it stands', () => {
  assert.deepEqual([parseAddress('#/case/50%/c%20d.toml').file, parseAddress('#/case/%E0%A4%A').file], ['50%/c d.toml', '%E0%A4%A']);
});
