// Critical speeds: where a frequency of the diagram equals n times the excitation, found on the dense output.

/** The excitation frequency, rad/s, at any parameter value: cubic interpolation of the stored places. */
function excitationAt({ parameter, frequency }, p) {
  const n = parameter.length, step = (parameter[n - 1] - parameter[0]) / (n - 1);
  const first = Math.min(Math.max(Math.floor((p - parameter[0]) / step) - 1, 0), n - 4);
  let sum = 0;
  for (let i = first; i < first + 4; ++i) {
    let weight = 1;
    for (let j = first; j < first + 4; ++j)
      if (j !== i) weight *= (p - parameter[j]) / (parameter[i] - parameter[j]);
    sum += weight * frequency[i];
  }
  return Math.abs(sum);  // a rotor that turns the other way is excited as often
}

/** All critical speeds of the files: { file, mode, harmonic, place, parameter, s }, by files, harmonics and speeds. */
function findCrossings(files, settings) {
  const source = files.find((file) => file.data.excitation);
  if (!source || !settings.harmonics.length) return [];
  const found = files.flatMap((file) => file.path.modes.flatMap((stretches, mode) =>
    stretches.flatMap((stretch) => stretchCrossings(file, mode, stretch, source.data.excitation, settings))));
  return found.sort((a, b) => a.file.index - b.file.index || a.harmonic - b.harmonic || a.parameter - b.parameter);
}

function stretchCrossings(file, mode, stretch, excitation, settings) {
  const found = [];
  const at = (place) => {
    const s = stretch.at(place);
    return { s, frequency: settings.frequency === "abs" ? Math.hypot(...s) : Math.abs(s[1]), exciting: excitationAt(excitation, file.path.parameterAt(place)) };
  };
  const samples = stretch.samples(), values = samples.map(at);
  for (const harmonic of settings.harmonics) {
    const miss = ({ frequency, exciting }) => frequency - harmonic * exciting;
    for (let i = 0; i + 1 < samples.length; ++i) {
      const before = miss(values[i]), after = miss(values[i + 1]);
      if (before * after > 0 || after === 0) continue;  // a zero at a sample belongs to the interval after it
      const place = rootBetween((where) => miss(at(where)), samples[i], samples[i + 1]);
      if (place === null) continue;
      const { s, exciting } = at(place);
      if (stretch.isReal(s) || !(exciting > 0)) continue;
      found.push({ file, mode, harmonic, place, s, parameter: file.parameterValue(file.path.parameterAt(place)) });
    }
  }
  return found;
}

/** 1/(2 zeta); infinite without damping and for modes that grow. */
function amplificationFactor(s) {
  const ratio = dampingRatio(...s);
  return ratio > 0 ? 1 / (2 * ratio) : Infinity;
}

/** The separation margin of API RP 684, SP6.8.2.10, as a fraction of the nearer end of the range (operating_range.hpp). */
function apiMargin(amplification, below) {
  if (!(amplification >= 2.5)) return 0;
  const grows = 0.17 * (1 - 1 / (amplification - 1.5));
  return below ? Math.min(0.16, grows) : Math.min(0.26, 0.1 + grows);
}

/** The operating range to which most distance is wanting, in either sense of rotation: { range, distance, wanted, inside, close }; null if there is none. */
function separationOf(crossing) {
  const { operating } = crossing.file;
  const list = operating.ranges.map((range) => {
    const [from, to] = range, p = Math.abs(crossing.parameter), below = p < from, above = p > to;
    const distance = below ? (from - p) / from : above ? (to > 0 ? (p - to) / to : Infinity) : 0;
    const wanted = operating.margin ?? apiMargin(amplificationFactor(crossing.s), !above);
    return { range, distance, wanted, below, above, inside: !below && !above, close: wanted > 0 && distance < wanted };
  });
  return list.length ? leastOf(list, ({ distance, wanted }) => distance - wanted) : null;
}

const percent = (fraction, digits = 3) => `${number(100 * fraction, digits)} %`;

function separationText(crossing) {
  const found = separationOf(crossing);
  if (!found) return "–";
  if (found.inside) return found.close ? "in the operating range" : "in the operating range, allowed by its damping";
  return `${percent(found.distance)}, ${percent(found.wanted)} wanted`;
}

/** Strips of the parameter beside the operating ranges that critical speeds must not enter: [from, to]. */
function marginStrips(files, crossings) {
  return files.flatMap((file) => {
    const { operating } = file;
    return operating.ranges.flatMap(([from, to]) => {
      const widest = (isThere, below) => operating.margin ?? Math.max(0, ...crossings.filter((c) => c.file === file && isThere(Math.abs(c.parameter)))
        .map((c) => apiMargin(amplificationFactor(c.s), below)));
      return [[from * (1 - widest((p) => p < from, true)), from], [to, to * (1 + widest((p) => p > to, false))]];
    });
  });
}

/** Table of the critical speeds; `choose` shows one. */
function criticalSpeedTable(crossings, settings, choose) {
  if (!crossings.length) return element("p", { class: "note", text: settings.harmonics.length ? "No ray crosses a mode on the traced range." : "Type harmonics to find critical speeds." });
  const files = new Set(crossings.map(({ file }) => file));
  const some = (test) => [...files].some(test);
  const whirls = some((file) => file.data.whirl), ranges = crossings.some((crossing) => separationOf(crossing));
  const { name, unit } = crossings[0].file.data.parameter;
  const rows = crossings.map((crossing, i) => {
    const { file, mode, place, s } = crossing, separation = separationOf(crossing);
    return element("tr", { class: separation && separation.close ? "close" : null },
      cell(element("button", { type: "button", text: `C${i + 1}`, title: "show it", click: () => choose(crossing) })),
      ...(files.size > 1 ? [cell(file.data.name)] : []),
      cell(`${number(crossing.harmonic)}×`), cell(number(crossing.parameter, 8), "value"), cell(number(frequencyOf(s, settings), 6), "value"),
      cell(`${number(100 * dampingRatio(...s), 4)} %`, "value"), cell(number(logDecrement(...s), 4), "value"), cell(file.modeText(mode), "words"),
      ...(whirls ? [cell(file.whirlText(mode, place) || "–")] : []), ...(ranges ? [cell(separationText(crossing), "words")] : []),
      cell(file.isCertified(mode, place) ? "yes" : "no"));
  });
  return table(["", ...(files.size > 1 ? ["file"] : []), "harmonic", withUnit(name, unit === "1" ? "" : `(${unit})`), `frequency (${settings.unit})`, "damping", "log. decrement", "mode",
    ...(whirls ? ["whirl"] : []), ...(ranges ? ["from the operating range"] : []), "certified"], rows, "Critical speeds");
}
