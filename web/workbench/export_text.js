/** What is taken away: samples as CSV, panels as a drawing. */

/** Numbers of 17 digits in SI. @param {import('./series.js').Series} series */
export function csvOf(series) {
  const head = ['t [s]', ...series.head.channels.map((c) => `${c.name} [${c.unit}]`)].join(',');
  const rows = series.time.map((t, k) => [t, ...series.values.map((v) => v[k] ?? '')].join(','));
  return [head, ...rows].join('\n') + '\n';
}

const escaped = (/** @type {string} */ s) => s.replaceAll('&', '&amp;').replaceAll('<', '&lt;');

/**
 * Lines over time as a drawing. @param {{title: string, time: number[], values: (number|null)[][], tones: string[]}[]} panels @param {number} width
 */
export function svgOf(panels, width = 900) {
  const high = 150, left = 60;
  let body = '';
  panels.forEach((p, n) => {
    const all = p.values.flat().filter((v) => v !== null);
    const least = Math.min(...all), most = Math.max(...all), from = p.time[0], to = p.time.at(-1) ?? 1;
    const x = (/** @type {number} */ t) => left + ((t - from) / (to - from || 1)) * (width - left - 10);
    const y = (/** @type {number} */ v) => 30 + n * high + (high - 50) * (1 - (v - least) / (most - least || 1));
    body += `<text x="${left}" y="${20 + n * high}">${escaped(p.title)}</text><text x="2" y="${y(most) + 8}">${most.toPrecision(3)}</text>` +
      `<text x="2" y="${y(least)}">${least.toPrecision(3)}</text><text x="${left}" y="${n * high + high - 4}">${from.toPrecision(5)} s</text>` +
      `<text x="${width - 70}" y="${n * high + high - 4}">${to.toPrecision(5)} s</text>`;
    p.values.forEach((line, k) => {
      const points = line.flatMap((v, i) => (v === null ? [] : [`${x(p.time[i]).toFixed(1)},${y(v).toFixed(1)}`]));
      body += `<polyline fill="none" stroke="${p.tones[k]}" points="${points.join(' ')}"/>`;
    });
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${panels.length * high}" font-family="sans-serif" font-size="11">${body}</svg>\n`;
}
