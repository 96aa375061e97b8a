import assert from 'node:assert/strict';
import test from 'node:test';
import {duration, prefixFor, probability, quantity, ratio, significant, uncertain} from '../../web/workbench/numbers.js';

test('one prefix, three digits', () => {
  assert.equal(quantity(6.2e-6, 'm'), '6.20 \u00b5m');
  assert.equal(quantity(-30954, 'N/m'), '-31.0 kN/m');
  assert.equal(quantity(2, '-'), '2.00');
  assert.equal(quantity(0, 'A'), '0 A');
  assert.equal(quantity(1e-12, 'm'), '0.00100 nm');
  assert.equal(prefixFor(0.9999, 'm').unit, 'm');  // rounds to 1.00
});

test('an uncertain value has two digits of its sd', () => {
  assert.equal(uncertain(-30954.4, 126, 'N/m'), '-30.95 \u00b1 0.13 kN/m');
  assert.equal(uncertain(0.0102, 0, 'rad'), '0.01020 rad');
  assert.equal(uncertain(4.20477, 0.0023, 'kg'), '4.2048 \u00b1 0.0023 kg');
});

test('a probability is never certain', () => {
  assert.equal(probability(1), '> 0.99');
  assert.equal(probability(0), '< 0.01');
  assert.equal(probability(0.5), '0.50');
});

test('ratios of JSON, which has no infinity', () => {
  assert.equal(ratio('inf'), 'infinite');
  assert.equal(ratio(null), '-');
  assert.equal(ratio(45.3), '45');
  assert.equal(ratio(9.94), '9.9');
  assert.equal(ratio(9.96), '10');
});

test('significant digits and durations', () => {
  assert.equal(significant(NaN), '-');
  assert.equal(significant(1234567), '1.23e+6');
  assert.equal(significant(999.6), '1000');
  assert.equal(significant(9.9996), '10.0');  // as many digits as 9.99
  assert.equal(significant(9.9996, 5), '9.9996');
  assert.equal(duration(42.4), '42 s');
  assert.equal(duration(150), '3 min');
});
