import assert from 'node:assert/strict';
import test from 'node:test';
import {decodeSeries, largest} from '../../web/workbench/series.js';

/** The bytes as the server writes them: length, head, floats. */
function encode(head, floats) {
  const text = new TextEncoder().encode(JSON.stringify(head).padEnd(Math.ceil(JSON.stringify(head).length / 4) * 4));
  const bytes = new ArrayBuffer(4 + text.length + 4 * floats.length);
  new DataView(bytes).setUint32(0, text.length, true);
  new Uint8Array(bytes, 4).set(text);
  const view = new DataView(bytes);
  floats.forEach((f, k) => view.setFloat32(4 + text.length + 4 * k, f, true));
  return bytes;
}

test('samples stand at their times, gaps stay gaps', () => {
  const head = {mode: 'samples', start: 1, step: 0.5, count: 3, rate: 2, channels: [{name: 'a', unit: 'm'}, {name: 'b', unit: 'A'}]};
  const s = decodeSeries(encode(head, [1, NaN, 3, 4, 5, 6]));
  assert.deepEqual(s.time, [1, 1.5, 2]);
  assert.deepEqual(s.values, [[1, null, 3], [4, 5, 6]]);
  assert.equal(largest(s.values), 6);
});

test('extremes are two points inside their column', () => {
  const head = {mode: 'extremes', start: 0, step: 3, count: 2, rate: 100, channels: [{name: 'a', unit: 'm'}]};
  const s = decodeSeries(encode(head, [-1, 2, -5, 6]));
  assert.deepEqual(s.time, [1, 2, 4, 5]);
  assert.deepEqual(s.values, [[-1, 2, -5, 6]]);
});

test('a series that was cut off is refused', () => {
  const head = {mode: 'samples', start: 0, step: 1, count: 3, rate: 1, channels: [{name: 'a', unit: 'm'}]};
  assert.throws(() => decodeSeries(encode(head, [1, 2])), /not whole/);
});
