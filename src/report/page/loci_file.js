/** What moves most: "surge" of "surge 48 %, surge velocity 44 %". Other names stay as they are. */
const mainMotion = (name) => name.replace(/^(.*?) \d+ %.*$/, "$1");

// Orbits whose short axis is below a twentieth of the long one are lines; a mode is mixed if nodes that go round the
// other way have that share of all (as in the engine's names of modes).
const CLEAR_WHIRL = 0.05, NOTABLE_REVERSE = 0.05;

/** A loci file as the page uses it. */
class LociFile {
  constructor(data, index, firstEvent) {
    Object.assign(this, { data, index, firstEvent, path: new Path({ ...data.curves }), colour: COLOURS[index % COLOURS.length] });
    this.reference = Number(data.attributes.reference) || 0;
    /** Per mode bounds of the errors of the data per step, 1/s; null if there are none. */
    this.errors = data.modes.map((mode) => (mode.errors ? float64(mode.errors) : null));
    this.whirl = data.whirl && { measure: float32(data.whirl.measure), reverse: float32(data.whirl.reverse) };
  }
  /** Operating ranges in the unit of the parameter, and the separation margin; null: that of API 684. */
  get operating() { return (this.data.excitation || {}).operating || { ranges: [], margin: null }; }
  modeText(mode) {
    const { label, name } = this.data.modes[mode] || { label: `mode ${mode + 1}` };
    return name ? `${label}, ${mainMotion(name)}` : label;
  }
  /** The short name of a mode, for the end of its line. */
  shortText(mode) { return [mode + 1, mainMotion(this.data.modes[mode].name)].filter(Boolean).join(": "); }
  eventNumber(event) { return `E${this.firstEvent + this.data.events.indexOf(event) + 1}`; }

  /** An eigenvalue as text, without rounding. */
  eigenvalueText(re, im, digits) { return complexText(re, im, digits, this.reference); }
  /** A frequency in the unit of the settings, without rounding. */
  frequency(s, settings) { return frequencyOf(withoutRounding(...s, this.reference), settings); }
  /** A value of the parameter in which what is zero but for rounding is zero: places are known to 1e-12 of the range. */
  parameterValue(p) { return Math.abs(p) < 1e-12 * (this.path.highest - this.path.lowest) ? 0 : p; }

  /** Whether some mode has a frequency somewhere. */
  oscillates() {
    return this.path.modes.some((stretches) => stretches.some((stretch) => stretch.samples().some((place) => !stretch.isReal(stretch.at(place)))));
  }

  /** Whether a mode has no frequency at a place, or does not exist there. */
  isReal(mode, place) {
    const stretch = this.path.stretchAt(mode, place);
    return !stretch || stretch.isReal(stretch.at(place));
  }

  isCertified(mode, place) {
    return !this.data.modes[mode].uncertified.some(([a, b]) => place >= this.path.places[a] && place <= this.path.places[b]);
  }

  /** "forward", "backward", "mixed" or "" (lines, or nothing spins) at a place; between two stored points the values are interpolated. */
  whirlText(mode, place) {
    if (!this.whirl) return "";
    const step = this.path.stepOf(place), { places } = this.path, modes = this.data.modes.length;
    const share = (place - places[step]) / (places[step + 1] - places[step]);
    const between = (values) => {
      const a = values[step * modes + mode], b = values[(step + 1) * modes + mode];
      return Number.isNaN(a) ? b : Number.isNaN(b) ? a : a + share * (b - a);
    };
    const measure = between(this.whirl.measure);
    if (between(this.whirl.reverse) > NOTABLE_REVERSE) return "mixed";
    return measure > CLEAR_WHIRL ? "forward" : measure < -CLEAR_WHIRL ? "backward" : "";
  }
}
