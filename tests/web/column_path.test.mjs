import assert from 'node:assert/strict';
import test from 'node:test';
const {barsOf, columnPath, inGap} = await import('../../web/workbench/column_path.js');

test('a column has its least and its greatest, and half the way to its neighbours', () => {
  assert.deepEqual(barsOf([10.2, 10.4, 10.9, 11.1, 11.5], [5, 9, 4, 8, 7]),
                   [{x: 10, to: 11, top: 4, bottom: 9}, {x: 11, to: 12, top: 6, bottom: 8}]);
});

test('a line that rises has no holes, neither upright nor between columns', () => {
  const bars = barsOf([0, 2.5, 4], [0, 100, 40]);
  assert.deepEqual(bars, [{x: 0, to: 2, top: 0, bottom: 50}, {x: 2, to: 4, top: 50, bottom: 100}, {x: 4, to: 5, top: 40, bottom: 70}]);
});

test('a value that does not count breaks the line', () => {
  assert.deepEqual(barsOf([0, 1, 2, 3], [5, null, 8, 8]),
                   [{x: 0, to: 1, top: 5, bottom: 5}, {x: 2, to: 3, top: 8, bottom: 8}, {x: 3, to: 4, top: 8, bottom: 8}]);
});

test('no sample is lost and nothing is drawn beyond the samples', () => {
  const xs = Array.from({length: 5000}, (_, k) => k / 50), ys = xs.map((x, k) => 50 + 40 * Math.sin(x / 7) + ((k * 7919) % 13));
  const bars = barsOf(xs, ys);
  assert.equal(bars.length, 100);
  xs.forEach((x, k) => assert.ok(bars[Math.floor(x)].top <= ys[k] && ys[k] <= bars[Math.floor(x)].bottom));
  for (const b of bars) {
    const near = ys.filter((_, k) => Math.abs(Math.floor(xs[k]) - b.x) <= 1);
    assert.ok(b.top >= Math.min(...near) && b.bottom <= Math.max(...near));
  }
});

test('dashes leave out columns', () => {
  assert.deepEqual([0, 3, 4, 6, 7].map((x) => inGap(x, [4, 3])), [false, false, true, true, false]);
});

/** A plot of 10 by 10 pixels from (0, 0) on whose scales are pixels, with a canvas that keeps what is filled. */
function plot(ys, more = {}) {
  const filled = [];
  const ctx = {fillStyle: 'before', fillRect(...box) { filled.push([this.fillStyle, ...box]); }};
  return {filled, u: {ctx, bbox: {left: 0, top: 0, width: 10, height: 10}, data: [ys.map((_, k) => (k * 10) / ys.length), ys],
                      valToPos: (v) => v, series: [{}, {width: 2, stroke: () => 'ink', ...more}]}};
}
globalThis.devicePixelRatio = 1;

test('dense points are filled as bars of the line\'s width within the plot, few points are a line', () => {
  const path = columnPath(() => 'a line');
  const few = plot([1, 2, 3]);
  assert.equal(path(few.u, 1, 0, 2), 'a line');
  assert.deepEqual(few.filled, []);
  const many = plot(Array(20).fill(5));
  assert.equal(path(many.u, 1, 0, 19), null);
  assert.equal(many.filled.length, 10);
  assert.deepEqual(many.filled[3], ['ink', 3, 4, 1, 2]);
  assert.equal(many.u.ctx.fillStyle, 'before');
  const high = plot(Array(20).fill(0));
  path(high.u, 1, 0, 19);
  assert.deepEqual(high.filled[0], ['ink', 0, 0, 1, 1]);  // what is above the plot is cut
  const dashed = plot(Array(20).fill(5), {dash: [3, 2]});
  path(dashed.u, 1, 0, 19);
  assert.deepEqual(dashed.filled.map((f) => f[1]), [0, 1, 2, 5, 6, 7]);
});
