import assert from 'node:assert/strict';
import test from 'node:test';
import {polar, polyline} from '../../web/workbench/geometry.js';

test('angles turn counter-clockwise, up on the screen', () => {
  const p = polar(2, 90);
  assert.ok(Math.abs(p.x) < 1e-12 && Math.abs(p.y + 2) < 1e-12);
  assert.ok(Math.abs(polar(1, 180).x + 1) < 1e-12);
});

test('an orbit leaves out what does not count', () => {
  assert.equal(polyline([1e-6, null, -2e-6], [0, 1, 3e-6], 1e6), '1.00,0.00 -2.00,-3.00');
});
