// A record of many samples as a MAT file of version 5.
import {closeSync, openSync, writeSync} from 'node:fs';

/** `rate`, and single-precision vectors with a tone, noise and one peak each. @param {string} path @param {string[]} channels @param {number} samples */
export function writeRecord(path, channels, samples) {
  const file = openSync(path, 'w');
  const header = Buffer.alloc(128, ' ');
  header.write('MATLAB 5.0 MAT-file, made by tests/workbench/budgets.mjs');
  header.writeUInt16LE(0x0100, 124);
  header.write('IM', 126);
  writeSync(file, header);
  const vector = (label, kind, bytes, count, fill) => {
    const text = Buffer.alloc(Math.ceil(label.length / 8) * 8);
    text.write(label);
    const data = Buffer.alloc(Math.ceil((bytes * count) / 8) * 8);
    fill(data);
    const head = Buffer.alloc(8 + 16 + 16 + 8 + text.length + 8);
    head.writeUInt32LE(14, 0);
    head.writeUInt32LE(head.length - 8 + data.length, 4);
    head.writeUInt32LE(6, 8);
    head.writeUInt32LE(8, 12);
    head.writeUInt32LE(kind === 'single' ? 7 : 6, 16);
    head.writeUInt32LE(5, 24);
    head.writeUInt32LE(8, 28);
    head.writeInt32LE(count, 32);
    head.writeInt32LE(1, 36);
    head.writeUInt32LE(1, 40);
    head.writeUInt32LE(label.length, 44);
    text.copy(head, 48);
    head.writeUInt32LE(kind === 'single' ? 7 : 9, 48 + text.length);
    head.writeUInt32LE(bytes * count, 52 + text.length);
    writeSync(file, head);
    writeSync(file, data);
  };
  vector('rate', 'double', 8, 1, (d) => d.writeDoubleLE(1e5, 0));
  channels.forEach((c, n) => vector(c.replace('.', '_'), 'single', 4, samples, (d) => {
    const v = new Float32Array(d.buffer, d.byteOffset, samples);
    let s = 1 + n;
    for (let k = 0; k < samples; ++k) {
      s = (s * 1664525 + 1013904223) >>> 0;
      v[k] = 1e-5 * Math.sin(k * 1e-3 * (n + 1)) + 2e-6 * (s / 4294967296 - 0.5);
    }
    v[7654321] = 3e-5;  // one sample that must not be lost
  }));
  closeSync(file);
}
