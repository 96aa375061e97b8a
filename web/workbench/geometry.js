/** Where drawings put things: y points up in a rig and down on a screen. */

/** @param {number} radius @param {number} degrees from the x axis, counter-clockwise */
export function polar(radius, degrees) {
  const a = (degrees * Math.PI) / 180;
  return {x: radius * Math.cos(a), y: -radius * Math.sin(a)};
}

/** Points of an SVG line, without samples that do not count. @param {(number|null)[]} x @param {(number|null)[]} y @param {number} scale */
export function polyline(x, y, scale) {
  const points = [];
  for (let k = 0; k < Math.min(x.length, y.length); ++k) {
    const a = x[k], b = y[k];
    if (a !== null && b !== null) points.push(`${(a * scale).toFixed(2)},${(-b * scale).toFixed(2)}`);
  }
  return points.join(' ');
}

/** A scenario's text with faults appended. @param {string} text @param {Map<string, string>} faults coil -> kind @param {number} time [s] */
export function withFaults(text, faults, time) {
  let out = text.replace(/\n*$/, '\n');
  for (const [coil, kind] of faults) {
    out += `\n[[fault]]\ntime = ${time}\ntarget = "${coil}"\nkind = "${kind}"\n`;
    if (kind === 'partial-short') out += 'parameters = { fraction = 0.5, short_resistance = 0.05 }\n';
  }
  return out;
}

/** Without [expect]: what holds for the healthy run need not hold for this one. @param {string} text */
export function withoutExpectations(text) {
  const lines = text.split('\n');
  const kept = [];
  let inside = false;
  for (const l of lines) {
    if (/^\s*\[/.test(l)) inside = /^\s*\[expect\]/.test(l);
    if (!inside) kept.push(l);
  }
  return kept.join('\n');
}
