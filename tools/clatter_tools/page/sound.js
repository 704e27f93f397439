// SPDX-License-Identifier: GPL-3.0-or-later
// A signal of a cycle as sound: its lines added up, repeated, written as a WAV file.

const SOUND_RATE = 48000;
const SOUND_SECONDS = 5;
const SOUND_FROM_HZ = 20;

/** One cycle at a rate that has a whole number of samples, from complex peak amplitudes of lines k / duration. */
function cycleSamples(frequency, re, im, duration) {
  const count = Math.round(SOUND_RATE * duration),
    found = new Float32Array(count);
  for (let line = 0; line < frequency.length; ++line) {
    const harmonic = Math.round(frequency[line] * duration);
    if (frequency[line] < SOUND_FROM_HZ || 2 * harmonic >= count) continue;
    const turn = (2 * Math.PI * harmonic) / count,
      [c, s] = [Math.cos(turn), Math.sin(turn)];
    let [a, b] = [re[line], im[line]];
    for (let k = 0; k < count; ++k) {
      found[k] += a;
      [a, b] = [a * c - b * s, a * s + b * c];
    }
  }
  return { samples: found, rate: Math.round(count / duration) };
}

/** A mono WAV file of 16-bit samples. */
function wavFile(samples, rate, repeats, full) {
  const count = samples.length * repeats,
    view = new DataView(new ArrayBuffer(44 + 2 * count));
  const text = (at, value) => [...value].forEach((letter, k) => view.setUint8(at + k, letter.charCodeAt(0)));
  text(0, "RIFF");
  view.setUint32(4, 36 + 2 * count, true);
  text(8, "WAVEfmt ");
  view.setUint32(16, 16, true);
  view.setUint16(20, 1, true);
  view.setUint16(22, 1, true);
  view.setUint32(24, rate, true);
  view.setUint32(28, 2 * rate, true);
  view.setUint16(32, 2, true);
  view.setUint16(34, 16, true);
  text(36, "data");
  view.setUint32(40, 2 * count, true);
  for (let k = 0; k < count; ++k)
    view.setInt16(44 + 2 * k, Math.round(32767 * Math.max(-1, Math.min(1, samples[k % samples.length] / full))), true);
  return new Blob([view], { type: "audio/wav" });
}
