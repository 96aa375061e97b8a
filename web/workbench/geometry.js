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
