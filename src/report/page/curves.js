// Evaluates eigenvalues anywhere on a path. A place on the path is given by the distance from its beginning.

/** Chebyshev-Lobatto points on [0, 1] and their barycentric weights. */
function chebyshevPlaces(degree) {
  const places = Array.from({ length: degree + 1 }, (_, j) => 0.5 * (1 - Math.cos((Math.PI * j) / degree)));
  return { places, weights: places.map((_, j) => (j % 2 ? -1 : 1) * (j === 0 || j === degree ? 0.5 : 1)) };
}

/** Number of the interval between ascending places that holds a place, by bisection; the first or the last one beyond them. */
function intervalOf(places, place) {
  let low = 0, high = places.length - 2;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (places[middle] <= place) low = middle; else high = middle - 1;
  }
  return low;
}

/**
 * A piecewise polynomial (src/report/piecewise.hpp) with `width` components. The pieces lie between `knots` and have
 * the given degree. `value(i)` is the i-th of degree * pieces + 1 values.
 */
class Piecewise {
  constructor(knots, degree, width, value) {
    Object.assign(this, { knots, degree, width, value }, chebyshevPlaces(degree));
  }
  get from() { return this.knots[0]; }
  get to() { return this.knots[this.knots.length - 1]; }
  covers(place) { return place >= this.from && place <= this.to; }

  at(place) {
    const piece = intervalOf(this.knots, place), begin = this.knots[piece];
    const u = Math.min(Math.max((place - begin) / (this.knots[piece + 1] - begin), 0), 1);
    const first = piece * this.degree, above = new Array(this.width).fill(0);
    let below = 0;
    for (let j = 0; j <= this.degree; ++j) {
      const distance = u - this.places[j];
      if (distance === 0) return this.value(first + j);
      const weight = this.weights[j] / distance, value = this.value(first + j);
      for (let k = 0; k < this.width; ++k) above[k] += weight * value[k];
      below += weight;
    }
    return above.map((sum) => sum / below);
  }

  /** Places for drawing the function: those of its values, or fewer if there are many pieces. */
  samples() {
    const n = this.knots.length - 1, list = [this.from];
    const inner = n > 600 ? [1] : n > 200 ? [0.5, 1] : this.places.slice(1);
    for (let i = 0; i < n; ++i)
      for (const u of inner) list.push(this.knots[i] + u * (this.knots[i + 1] - this.knots[i]));
    return list;
  }
}

/** Imaginary parts below this share of the largest abs(s) of a stretch are none: stored curves are known to 1e-8 of their range. */
const SAME_AS_REAL = 1e-7;

/** Eigenvalues [Re s, Im s] of a mode on a stretch of the path. */
class ModeStretch extends Piecewise {
  constructor(data, degree) {
    const numbers = int32(data.values), [a, unitA, b, unitB] = data.scale;
    super(float64(data.knots), degree, 2, (i) => [a + unitA * numbers[2 * i], b + unitB * numbers[2 * i + 1]]);
    this.largest = 0;
    for (let i = 0; 2 * i < numbers.length; ++i) this.largest = Math.max(this.largest, Math.hypot(...this.value(i)));
  }
  isReal([, im]) { return Math.abs(im) <= SAME_AS_REAL * this.largest; }
}

/** The path of a loci file: its parameter and its modes at every place. */
class Path {
  constructor(data) {
    this.places = float64(data.nodes.place);
    this.nodes = float64(data.nodes.parameter);
    const values = float64(data.parameter.values);
    this.parameter = new Piecewise(float64(data.parameter.knots), data.parameter.degree, 1, (i) => [values[i]]);
    this.modes = data.modes.map((list) => list.map((stretch) => new ModeStretch(stretch, data.degree)));
    this.lowest = Math.min(...values);
    this.highest = Math.max(...values);
  }
  get length() { return this.places[this.places.length - 1]; }
  get turnsBack() {
    const up = this.nodes[1] > this.nodes[0];
    return this.nodes.some((value, i) => i > 0 && value > this.nodes[i - 1] !== up);
  }
  parameterAt(place) { return this.parameter.at(place)[0]; }

  /** The stretch of a mode at a place; none where the mode does not exist or is too large to show. */
  stretchAt(mode, place) { return this.modes[mode].find((candidate) => candidate.covers(place)); }

  /** [Re s, Im s] of a mode at a place; null where it has none. */
  eigenvalue(mode, place) {
    const stretch = this.stretchAt(mode, place);
    return stretch ? stretch.at(place) : null;
  }

  /** The places at which the path passes a value of the parameter, ascending; several if the path folds. */
  placesOf(value) {
    const found = [], samples = this.parameter.samples();
    const miss = (place) => this.parameterAt(place) - value;
    for (let i = 0; i + 1 < samples.length; ++i) {
      const place = rootBetween(miss, samples[i], samples[i + 1]);
      if (place === null) continue;
      const last = found[found.length - 1];
      if (last === undefined || place - last > 1e-12 * this.length) found.push(place);
    }
    return found;
  }

  /** Number of the step of the trace that holds a place. */
  stepOf(place) { return intervalOf(this.places, place); }
}

/** The zero of a monotonic function by secants and bisection in turn; null if it does not change its sign. */
function rootBetween(f, from, to) {
  let low = f(from), high = f(to);
  if (low === 0) return from;
  if (high === 0) return to;
  if (low * high > 0) return null;
  for (let i = 0; i < 80; ++i) {
    const secant = from - (low * (to - from)) / (high - low);
    const middle = i % 2 && secant > from && secant < to ? secant : 0.5 * (from + to);
    const value = f(middle);
    if (value === 0 || middle === from || middle === to) return middle;
    if (low * value < 0) [to, high] = [middle, value]; else [from, low] = [middle, value];
  }
  return 0.5 * (from + to);
}
