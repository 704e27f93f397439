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

function largest(values) {
  let most = 0;
  for (const value of values) most = Math.max(most, Math.abs(value));
  return most || 1;
}

/** A card that plays a cycle; the file is made when the card is seen. */
class Player {
  constructor() {
    this.element = card("To hear");
    this.wake = whenVisible(this.element, () => this.make?.());
  }

  replace(...children) {
    this.element.replaceChildren(element("h3", {}, "To hear"), ...children);
  }

  refuse(text) {
    this.make = null;
    this.replace(element("p", { class: "note" }, text));
  }

  /** What is heard: text, note, name of the file, and load(), which gives { cycle, duration, full }. */
  show({ text, note, file, load }) {
    const audio = element("audio", {
      controls: true,
      loop: true,
      preload: "none",
      style: "width:100%",
      "aria-label": text,
    });
    const link = element("a", { download: fileName(file, "wav") }, "WAV file");
    this.replace(element("p", {}, text), audio, link, element("p", { class: "note" }, note));
    this.make = async () => {
      this.make = null;
      const { cycle, duration, full } = await load();
      audio.src = link.href = URL.createObjectURL(
        wavFile(cycle.samples, cycle.rate, Math.ceil(SOUND_SECONDS / duration), full),
      );
    };
    this.wake();
  }
}
