"use strict";

/** What moves most: "surge" of "surge 48 %, surge velocity 44 %". Other names stay as they are. */
const mainMotion = (name) => name.replace(/^(.*?) \d+ %.*$/, "$1");

/** A loci file as the page uses it. */
class LociFile {
  constructor(data, index, firstEvent) {
    Object.assign(this, { data, index, firstEvent, path: new Path({ ...data.curves }), colour: COLOURS[index % COLOURS.length] });
  }
  modeText(mode) {
    const { label, name } = this.data.modes[mode] || { label: `mode ${mode + 1}` };
    return name ? `${label}, ${mainMotion(name)}` : label;
  }
  /** The short name of a mode, for the end of its line. */
  shortText(mode) { return [mode + 1, mainMotion(this.data.modes[mode].name)].filter(Boolean).join(": "); }
  /** Bounds of the errors of the data of a mode per step, 1/s; null if there are none. */
  errors(mode) {
    const coded = this.data.modes[mode].errors;
    this.decoded = this.decoded || {};
    return coded ? (this.decoded[mode] = this.decoded[mode] || float64(coded)) : null;
  }
  eventNumber(event) { return `E${this.firstEvent + this.data.events.indexOf(event) + 1}`; }
}
