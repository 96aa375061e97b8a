import assert from 'node:assert/strict';
import test from 'node:test';
import {errorByFrequency, errorByValue, fft, peaks} from '../../web/workbench/spectrum.js';

// xorshift: the same noise every time.
function noise(count) {
  let s = 12345;
  const uniform = () => {
    s ^= s << 13;
    s ^= s >>> 17;
    s ^= s << 5;
    return (s >>> 0) / 4294967296;
  };
  return Array.from({length: count}, () => Math.sqrt(-2 * Math.log(uniform() + 1e-12)) * Math.cos(2 * Math.PI * uniform()));
}

test('the transform agrees with its definition', () => {
  const x = noise(16), y = noise(32).slice(16);
  const re = Float64Array.from(x), im = Float64Array.from(y);
  fft(re, im);
  for (let k = 0; k < 16; ++k) {
    let a = 0, b = 0;
    for (let n = 0; n < 16; ++n) {
      const c = Math.cos((-2 * Math.PI * k * n) / 16), s = Math.sin((-2 * Math.PI * k * n) / 16);
      a += x[n] * c - y[n] * s;
      b += x[n] * s + y[n] * c;
    }
    assert.ok(Math.abs(a - re[k]) < 1e-12 && Math.abs(b - im[k]) < 1e-12);
  }
});

test('white noise of its own size is 1 at all frequencies', () => {
  const s = errorByFrequency(noise(65536), 1000);
  // The mean of some 63 half-overlapping periodograms errs by about 1/sqrt(63) in power.
  const mean = Math.sqrt(s.ratio.slice(2).reduce((sum, r) => sum + r * r, 0) / (s.ratio.length - 2));
  assert.ok(Math.abs(mean - 1) < 0.02, `${mean}`);
  assert.equal(peaks(s, 3).length, 0);
});

test('a tone stands out at its frequency', () => {
  const tone = noise(8192).map((v, k) => v + 5 * Math.sin((2 * Math.PI * 87 * k) / 2000));
  const found = peaks(errorByFrequency(tone, 2000), 3);
  assert.ok(Math.abs(found[0].frequency - 87) <= 2000 / 2048, `${found[0].frequency}`);
  assert.ok(found[0].ratio > 10);
});

test('too few samples say nothing, gaps count as no error', () => {
  assert.deepEqual(errorByFrequency([1, 2, 3], 10), {frequency: [], ratio: []});
  assert.ok(errorByFrequency(new Array(64).fill(null), 10).ratio.every((r) => r === 0));
});

test('an error that grows with the position is seen there', () => {
  const value = Array.from({length: 1000}, (_, k) => k / 999), error = value.map((v) => 3 * v);
  const p = errorByValue(value, error, 10);
  assert.equal(p.value.length, 10);
  p.value.forEach((v, k) => assert.ok(Math.abs(p.ratio[k] - 3 * v) < 0.05));
  assert.deepEqual(errorByValue([1, 1, null], [1, 2, 3], 5), {value: [], ratio: [], count: []});
  assert.equal(errorByValue([0, 1, 1, 1, 1, 1], [9, 2, 2, 2, 2, 2], 2).ratio[0], null);  // one sample is no rms
});
