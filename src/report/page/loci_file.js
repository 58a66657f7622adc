"use strict";

/** A loci file as the page uses it. */
class LociFile {
  constructor(data, index, firstEvent) {
    Object.assign(this, { data, index, firstEvent, path: new Path({ ...data.curves }), colour: COLOURS[index % COLOURS.length] });
  }
  modeText(mode) {
    const { label, name } = this.data.modes[mode] || { label: `mode ${mode + 1}` };
    return name ? `${label}, ${name}` : label;
  }
  /** The short name of a mode, for the end of its line. */
  shortText(mode) { return [mode + 1, this.data.modes[mode].name].filter(Boolean).join(": "); }
  eventNumber(event) { return `E${this.firstEvent + this.data.events.indexOf(event) + 1}`; }
}
