// The traces that Plotly draws: Campbell diagram (frequency above, damping below) and root locus.

const PARAMETER_COLOURS = 24;
const MOST_MARKED = 14;    // modes with five marks on their lines; more have two

/** The three charts: their axes, and the coordinates of an eigenvalue s at a value p of the parameter. `settings`: those of LociView. */
const CHARTS = {
  frequency: { xaxis: "xaxis", yaxis: "yaxis", at: (p, s, settings) => [p, onFrequencyAxis(frequencyOf(s, settings), settings)] },
  damping: { xaxis: "xaxis", yaxis: "yaxis2", at: (p, s, settings) => [p, settings.damping === "real" ? s[0] : dampingRatio(...s)] },
  locus: { xaxis: "xaxis", yaxis: "yaxis", at: (p, [re, im], settings) => [re, Math.abs(im) * settings.unitFactor] },
};

/** The coordinates in a chart of an eigenvalue at a place of the path of a file. */
const projection = (chart, file, settings) => (place, s) => CHARTS[chart].at(file.path.parameterAt(place), s, settings);

const LEAST_FREQUENCY = 1e-12;  // in the unit of the axis; smaller ones are drawn there on a logarithmic axis

/** The coordinate of a frequency on its axis: itself, or its decimal logarithm. */
const onFrequencyAxis = (value, settings) => (settings.logarithmic ? Math.log10(Math.max(value, LEAST_FREQUENCY)) : value);

function dampingRatio(re, im) {
  const ratio = -re / Math.max(Math.hypot(re, im), Number.MIN_VALUE);
  return Math.abs(ratio) < SAME_AS_ZERO ? 0 : ratio;
}

/** How much a coordinate of a chart changes at most per change of s. */
function errorScale(chart, settings) {
  if (chart === "frequency") return () => settings.unitFactor;
  return settings.damping === "real" ? () => 1 : (s) => 1 / Math.max(Math.hypot(...s), Number.MIN_VALUE);
}

/**
 * Lines of all modes in one chart: { file, mode, stretch, points, parts }. A part { points, kind } looks alike; its kind
 * has "r" if the eigenvalue is real, "d" if the identity of the mode is not certified, "b" if it whirls backward.
 * Campbell diagrams are without real eigenvalues unless the settings ask for them.
 */
function chartLines(files, chart, settings, view, spacing) {
  const hidesReal = chart !== "locus" && !settings.realRoots, lines = [];
  for (const file of files) {
    const project = projection(chart, file, settings);
    file.path.modes.forEach((stretches, mode) => {
      const cuts = file.data.modes[mode].uncertified.flatMap((ends) => ends.map((end) => file.path.places[end]));
      for (const stretch of stretches) {
        const points = drawnLine(stretch, project, view, spacing), kindAt = kindOn(file, mode, stretch);
        const plain = !cuts.length && !file.whirl && !points.some((point) => point.real);
        const parts = plain ? [{ points, kind: "" }] : partsOf(points, cuts, kindAt, pointOn(stretch, project));
        lines.push(...runsOf(parts, hidesReal).map((run) => ({ file, mode, stretch, ...run })));
      }
    });
  }
  return lines;
}

const kindOn = (file, mode, stretch) => (place) => (stretch.isReal(stretch.at(place)) ? "r" : "") +
  (file.isCertified(mode, place) ? "" : "d") + (file.whirlText(mode, place) === "backward" ? "b" : "");

/** Neighbouring parts as runs { points, parts }, without the real ones if they are hidden. */
function runsOf(parts, hidesReal) {
  const runs = [];
  let last = null;
  for (const part of parts) {
    if (hidesReal && part.kind.includes("r")) { last = null; continue; }
    if (!last) runs.push(last = { points: [], parts: [] });
    last.points.push(...(last.points.length ? part.points.slice(1) : part.points));
    last.parts.push(part);
  }
  return runs;
}

const lineTrace = (lines, line, more = {}) =>
  ({ ...joined(lines), type: "scatter", mode: "lines", line, hoverinfo: "skip", showlegend: false, ...more });

/** A trace of marks at points { x, y }. */
const pointTrace = (points, marker, more = {}) =>
  ({ x: points.map(({ x }) => x), y: points.map(({ y }) => y), type: "scatter", mode: "markers", marker, hoverinfo: "skip", showlegend: false, ...more });

const pointsOf = (lines, test) => lines.flatMap((line) => line.parts.filter(test).map((part) => part.points));
const isDoubtful = ({ kind }) => kind.includes("d");
const isBackward = ({ kind }) => kind.includes("b");

/** Faint lines of the modes that are not isolated, and pale bands under those whose identity is not certified. */
function underTraces(lines, isActive, axes) {
  const faint = pointsOf(lines.filter((line) => !isActive(line)), () => true), doubtful = pointsOf(lines.filter(isActive), isDoubtful);
  return [...(faint.length ? [lineTrace(faint, { color: FAINT, width: 1 }, axes)] : []),
    ...(doubtful.length ? [lineTrace(doubtful, { color: DOUBT, width: 9 }, { ...axes, meta: { doubtful: true } })] : [])];
}

/** Traces of the lines in the colour and dash of their mode or file. If some modes are isolated, all others are faint. */
function modeTraces(lines, isActive, style, axes) {
  const traces = underTraces(lines, isActive, axes);
  for (const list of grouped(lines.filter(isActive), ({ file, mode }) => [file.index, mode])) {
    const [{ file, mode }] = list, { colour, width, dash } = style(file, mode);
    for (const backward of [false, true]) {
      const points = pointsOf(list, (part) => isBackward(part) === backward);
      const meta = { file: file.index, mode, backward };
      if (points.length) traces.push(lineTrace(points, { color: colour, width, dash: backward ? BACKWARD_DASH : dash }, { ...axes, meta }));
    }
  }
  return traces;
}

/** Bands in which the eigenvalues lie as far as the errors of the data tell, one trace per mode. `scale` turns an error of s into one of the chart. */
function bandTraces(lines, isActive, style, axes, scale, logarithmic) {
  const shifted = (y, by) => (logarithmic ? Math.log10(Math.max(10 ** y + by, LEAST_FREQUENCY)) : y + by);
  const traces = [];
  for (const line of lines.filter(isActive)) {
    const errors = line.file.errors[line.mode];
    if (!errors || line.points.length < 2) continue;
    const above = [], below = [];
    const add = ({ x, y, place }, step) => {
      const error = errors[step] * scale(line.file.path.eigenvalue(line.mode, place));
      if (!Number.isFinite(error)) return;
      above.push({ x, y: shifted(y, error) });
      below.push({ x, y: shifted(y, -error) });
    };
    for (let i = 0; i + 1 < line.points.length; ++i) {
      const step = line.file.path.stepOf(0.5 * (line.points[i].place + line.points[i + 1].place));
      add(line.points[i], step);
      add(line.points[i + 1], step);
    }
    const outline = above.concat(below.reverse());
    if (outline.length)
      traces.push(lineTrace([outline], { width: 0 }, { fill: "toself", fillcolor: faded(style(line.file, line.mode).colour), meta: { band: line.mode }, ...axes }));
  }
  return traces;
}

const faded = (colour) => `rgba(${[1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)).join(",")},0.15)`;

/** Bars from end to end of the intervals in which events lie as far as the errors of the data tell. */
function intervalTrace(files, chart, settings, isActive, axes) {
  const bars = files.flatMap((file) => file.data.events.filter((event) => event.interval && isShown(event, file, isActive)).map((event) => {
    const [, y] = eventPoint(event, chart, settings);
    return event.interval.map((x) => ({ x, y }));
  }));
  const marker = { symbol: "line-ns-open", size: 9, color: INK };
  return bars.length ? [lineTrace(bars, { color: INK, width: 1.4 }, { mode: "lines+markers", marker, meta: { intervals: true }, ...axes })] : [];
}

/** A few marks on every line, by which lines can be distinguished without colours. */
function markTrace(lines, isActive, style, axes) {
  const active = lines.filter(isActive), n = active.length > MOST_MARKED ? 2 : 5;
  const marks = active.flatMap((line) => {
    const point = pointOn(line.stretch, projection(axes.chart, line.file, axes.settings)), look = style(line.file, line.mode);
    const from = line.points[0].place, to = line.points[line.points.length - 1].place;
    return Array.from({ length: n }, (_, i) => ({ ...look, ...point(from + (to - from) * ((i + 0.5 + 0.13 * ((line.mode * 3 + line.file.index) % 5 - 2)) / n)) }));
  });
  return pointTrace(marks, { symbol: marks.map(({ symbol }) => symbol), color: marks.map(({ colour }) => colour), size: n === 2 ? 6 : 7 }, { meta: { marks: true }, ...axes.plot });
}

const RANGE_COLOURS = { stable: "rgba(0,158,115,0.13)", marginal: "rgba(230,159,0,0.16)", undecided: "rgba(110,110,110,0.16)" };
const PARTIAL_COLOUR = "rgba(0,114,178,0.10)"; // known of the followed modes only
const STRIP_OPACITY = { stable: 1, marginal: 0.4, undecided: 0.15 };

/** Shaded stable ranges of the parameter: of the whole height for one file, a strip at the top for each of several files. */
function rangeShapes(files) {
  const several = files.length > 1;
  return files.flatMap((file, row) => (file.data.ranges || []).flatMap((range) => {
    const strip = several ? { y0: 1.006 + row * 0.018, y1: 1.019 + row * 0.018, fillcolor: file.colour, opacity: STRIP_OPACITY[range.kind] }
      : { y0: 0, y1: 1, fillcolor: range.whole_model ? RANGE_COLOURS[range.kind] : PARTIAL_COLOUR };
    return (several ? ["y"] : ["y", "y2"]).map((axis) =>
      ({ type: "rect", xref: "x", yref: `${axis} domain`, x0: range.from.parameter, x1: range.to.parameter, line: { width: 0 }, layer: "below", ...strip }));
  }));
}

/** Lines of the harmonics n times the excitation frequency. */
function rayTraces(files, settings) {
  const source = files.find((file) => file.data.excitation);
  if (!source) return [];
  const { excitation } = source.data, [from, to] = [excitation.parameter[0], excitation.parameter[excitation.parameter.length - 1]];
  // Rays from rest are curved on a logarithmic axis, most near their beginnings.
  const n = settings.logarithmic ? 240 : 64, power = settings.logarithmic ? 3 : 1;
  const x = Array.from({ length: n + 1 }, (_, i) => from + (to - from) * (i / n) ** power), frequency = x.map((p) => excitationAt(excitation, p));
  return settings.harmonics.map((harmonic) => lineTrace([], { color: "#666", width: 1.2, dash: "2px,3px" },
    { x, y: frequency.map((value) => onFrequencyAxis(harmonic * value * settings.unitFactor, settings)), xaxis: "x", yaxis: "y", meta: { harmonic } }));
}

/** Operating ranges (between lines) and the strips beside them that critical speeds must not enter, in the frequency chart. */
function operatingShapes(files, crossings) {
  const strip = ([x0, x1], fillcolor, line) => ({ type: "rect", xref: "x", yref: "y domain", x0, x1, y0: 0, y1: 1, fillcolor, line, layer: "below" });
  const ranges = files.flatMap((file) => file.operating.ranges);
  return [...ranges.map((range) => strip(range, OPERATING_FILL, { color: "#0072b2", width: 1.2 })),
    ...marginStrips(files, crossings).filter(([from, to]) => to > from).map((range) => strip(range, MARGIN_FILL, { width: 0 }))];
}

/** The root locus coloured by the parameter: one trace per colour, and one for the colour scale. */
function parameterTraces(lines, isActive, range) {
  const traces = underTraces(lines, isActive, {});
  for (const backward of [false, true]) {
    const bins = Array.from({ length: PARAMETER_COLOURS }, () => []);
    for (const line of lines.filter(isActive)) {
      for (const { points } of line.parts.filter((part) => isBackward(part) === backward)) {
        let current = null, bin = -1;
        for (let i = 0; i + 1 < points.length; ++i) {
          const p = line.file.path.parameterAt(0.5 * (points[i].place + points[i + 1].place));
          const next = Math.min(Math.floor(((p - range[0]) / (range[1] - range[0])) * PARAMETER_COLOURS), PARAMETER_COLOURS - 1);
          if (next !== bin) bins[(bin = Math.max(next, 0))].push((current = [points[i]]));
          current.push(points[i + 1]);
        }
      }
    }
    bins.forEach((list, bin) => {
      if (list.length) traces.push(lineTrace(list, { color: parameterColour((bin + 0.5) / PARAMETER_COLOURS), width: 2.6, dash: backward ? BACKWARD_DASH : "solid" }));
    });
  }
  return traces;
}

/** The colour map Cividis without its lightest fifth: uniform in lightness, suitable for colour-blind readers. */
const CIVIDIS = [[0, 34, 78], [18, 53, 112], [59, 73, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120], [165, 156, 116], [195, 179, 105]];

function parameterColour(share) {
  const at = Math.min(Math.max(share, 0), 1) * (CIVIDIS.length - 1), i = Math.min(Math.floor(at), CIVIDIS.length - 2);
  const mix = CIVIDIS[i].map((low, k) => Math.round(low + (at - i) * (CIVIDIS[i + 1][k] - low)));
  return `rgb(${mix.join(",")})`;
}

function parameterScale(range, title) {
  const colorscale = Array.from({ length: 17 }, (_, i) => [i / 16, parameterColour(i / 16)]);
  const colorbar = { title: { text: title, side: "right" }, thickness: 12, outlinewidth: 0, len: 0.9, x: 1.02, xpad: 4, exponentformat: "power", minexponent: 4 };
  return pointTrace([{ x: null, y: null }], { color: [range[0]], cmin: range[0], cmax: range[1], colorscale, showscale: true, colorbar });
}

const endPoints = (lines, isActive) => lines.filter(isActive).flatMap(({ points }) => [points[0], points[points.length - 1]]);

/** The beginning (a ring) and the end (a dot) of every line, which show its direction. */
function endTraces(lines, isActive) {
  const shown = lines.filter(isActive), many = shown.length > 40;
  return [[0, "circle-open"], [-1, "circle"]].map(([end, symbol]) => pointTrace(shown.map(({ points }) => points.at(end)),
    { symbol, size: many ? 4 : 7, color: INK, line: { width: many ? 1 : 1.5, color: INK } }));
}
