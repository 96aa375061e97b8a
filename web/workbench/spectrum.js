/** Where an error lies: by frequency and by the value of another channel. What is computed; misfit_views.js draws it. */

/** In place, radix 2. @param {Float64Array} re @param {Float64Array} im of one length, a power of two */
export function fft(re, im) {
  const n = re.length;
  for (let i = 1, j = 0; i < n; ++i) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      [re[i], re[j]] = [re[j], re[i]];
      [im[i], im[j]] = [im[j], im[i]];
    }
  }
  for (let size = 2; size <= n; size <<= 1) {
    const angle = (-2 * Math.PI) / size;
    for (let from = 0; from < n; from += size)
      for (let k = 0; k < size / 2; ++k) {
        const c = Math.cos(angle * k), s = Math.sin(angle * k), a = from + k, b = a + size / 2;
        const x = re[b] * c - im[b] * s, y = re[b] * s + im[b] * c;
        re[b] = re[a] - x;
        im[b] = im[a] - y;
        re[a] += x;
        im[a] += y;
      }
  }
}

/**
 * Of an error in units of its noise: 1 at frequencies where it is what white noise of that size would be. Mean of the periodograms of
 * half-overlapping Hann windows; samples that do not count are zero.
 * @param {(number|null)[]} error @param {number} rate [Hz]
 * @returns {{frequency: number[], ratio: number[]}} empty for fewer than 16 samples
 */
export function errorByFrequency(error, rate) {
  if (error.length < 16) return {frequency: [], ratio: []};
  const length = 2 ** Math.min(11, Math.floor(Math.log2(error.length / 2)));
  const power = new Float64Array(length / 2);
  const window = Float64Array.from({length}, (_, k) => 0.5 - 0.5 * Math.cos((2 * Math.PI * k) / length));
  const scale = window.reduce((sum, w) => sum + w * w, 0);
  let count = 0;
  for (let from = 0; from + length <= error.length; from += length / 2, ++count) {
    const re = Float64Array.from({length}, (_, k) => (error[from + k] ?? 0) * window[k]);
    const im = new Float64Array(length);
    fft(re, im);
    for (let k = 0; k < length / 2; ++k) power[k] += (re[k] * re[k] + im[k] * im[k]) / scale;
  }
  return {frequency: Array.from(power, (_, k) => (k * rate) / length), ratio: Array.from(power, (p) => Math.sqrt(p / count))};
}

/**
 * rms of an error in bins of equal width of another channel's value; a bin with fewer than 5 samples says nothing.
 * @param {(number|null)[]} value @param {(number|null)[]} error @param {number} bins
 * @returns {{value: number[], ratio: (number|null)[], count: number[]}} value: middle of each bin
 */
export function errorByValue(value, error, bins) {
  let least = Infinity, most = -Infinity;
  for (const v of value)
    if (v !== null) {
      least = Math.min(least, v);
      most = Math.max(most, v);
    }
  if (!(most > least)) return {value: [], ratio: [], count: []};
  const square = new Float64Array(bins), count = new Array(bins).fill(0);
  for (let k = 0; k < Math.min(value.length, error.length); ++k) {
    const v = value[k], e = error[k];
    if (v === null || e === null) continue;
    const bin = Math.min(bins - 1, Math.floor(((v - least) / (most - least)) * bins));
    square[bin] += e * e;
    ++count[bin];
  }
  return {
    value: count.map((_, k) => least + ((k + 0.5) / bins) * (most - least)),
    ratio: count.map((n, k) => (n < 5 ? null : Math.sqrt(square[k] / n))), count,
  };
}

/** Frequencies where the error stands out, largest first. @param {{frequency: number[], ratio: number[]}} s @param {number} most */
export function peaks(s, most) {
  const found = [];
  for (let k = 1; k + 1 < s.ratio.length; ++k)
    if (s.ratio[k] > 2 && s.ratio[k] >= s.ratio[k - 1] && s.ratio[k] > s.ratio[k + 1]) found.push({frequency: s.frequency[k], ratio: s.ratio[k]});
  return found.sort((a, b) => b.ratio - a.ratio).slice(0, most);
}
