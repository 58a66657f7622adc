"use strict";
// The traces that Plotly draws: Campbell diagram (frequency above, damping below) and root locus.

const PARAMETER_COLOURS = 24;
const MOST_LABELLED = 14;  // modes with marks and names on their lines
const MOST_EVENT_NAMES = 12;

/** The three charts: their axes and the coordinates of an eigenvalue in them. `settings`: those of LociView. */
const CHARTS = {
  frequency: {
    xaxis: "xaxis", yaxis: "yaxis",
    project: (file, settings) => (place, [re, im]) =>
      [file.path.parameterAt(place), (settings.frequency === "abs" ? Math.hypot(re, im) : Math.abs(im)) * settings.unitFactor],
  },
  damping: {
    xaxis: "xaxis", yaxis: "yaxis2",
    project: (file, settings) => (place, [re, im]) =>
      [file.path.parameterAt(place), settings.damping === "real" ? re : dampingRatio(re, im)],
  },
  locus: { xaxis: "xaxis", yaxis: "yaxis", project: () => (place, [re, im]) => [re, im] },
};

function dampingRatio(re, im) {
  const ratio = -re / Math.max(Math.hypot(re, im), Number.MIN_VALUE);
  return Math.abs(ratio) < SAME_AS_ZERO ? 0 : ratio;
}

/** How much a coordinate of a chart changes at most per change of s. */
function errorScale(chart, settings) {
  if (chart === "frequency") return () => settings.unitFactor;
  return settings.damping === "real" ? () => 1 : (s) => 1 / Math.max(Math.hypot(...s), Number.MIN_VALUE);
}

/** Lines of all modes in one chart: { file, mode, points, outside (certified), inside (not certified) }. */
function chartLines(files, chart, settings, view, spacing) {
  const lines = [];
  for (const file of files) {
    const project = CHARTS[chart].project(file, settings);
    file.path.modes.forEach((stretches, mode) => {
      const doubtful = file.data.modes[mode].uncertified.map(([a, b]) => [file.path.places[a], file.path.places[b]]);
      for (const stretch of stretches) {
        const points = drawnLine(stretch, project, view, spacing);
        const pointAt = (place) => {
          const [x, y] = project(place, stretch.at(place));
          return { place, x, y };
        };
        const parts = doubtful.length ? splitLine(points, doubtful, pointAt) : { inside: [], outside: [points] };
        lines.push({ file, mode, points, certified: parts.outside, uncertified: parts.inside });
      }
    });
  }
  return lines;
}

const lineTrace = (lines, line, more = {}) =>
  ({ ...joined(lines), type: "scatter", mode: "lines", line, hoverinfo: "skip", showlegend: false, ...more });

/** Traces of the lines in the colour of their mode or file. If some modes are isolated, all others are faint. */
function modeTraces(lines, isActive, style, axes) {
  const traces = [];
  const faint = lines.filter((line) => !isActive(line)).flatMap((line) => line.certified.concat(line.uncertified));
  if (faint.length) traces.push(lineTrace(faint, { color: FAINT, width: 1 }, axes));
  const byMode = new Map();
  for (const line of lines.filter(isActive)) {
    const key = `${line.file.index}/${line.mode}`;
    if (!byMode.has(key)) byMode.set(key, { line, certified: [], uncertified: [] });
    byMode.get(key).certified.push(...line.certified);
    byMode.get(key).uncertified.push(...line.uncertified);
  }
  for (const { line, certified, uncertified } of byMode.values()) {
    const { colour, width } = style(line.file, line.mode);
    const meta = { file: line.file.index, mode: line.mode };
    if (certified.length) traces.push(lineTrace(certified, { color: colour, width }, { ...axes, meta }));
    if (uncertified.length) traces.push(lineTrace(uncertified, { color: colour, width, dash: "6px,4px" }, { ...axes, meta }));
  }
  return traces;
}

/** Bands in which the eigenvalues lie as far as the errors of the data tell, one trace per mode. `scale` turns an error of s into one of the chart. */
function bandTraces(lines, isActive, style, axes, scale) {
  const traces = [];
  for (const line of lines.filter(isActive)) {
    const errors = line.file.errors(line.mode);
    if (!errors || line.points.length < 2) continue;
    const above = [], below = [];
    const add = ({ x, y, place }, step) => {
      const error = errors[step] * scale(line.file.path.eigenvalue(line.mode, place));
      if (!Number.isFinite(error)) return;
      above.push([x, y + error]);
      below.push([x, y - error]);
    };
    for (let i = 0; i + 1 < line.points.length; ++i) {
      const step = line.file.path.stepOf(0.5 * (line.points[i].place + line.points[i + 1].place));
      add(line.points[i], step);
      add(line.points[i + 1], step);
    }
    const outline = above.concat(below.reverse());
    if (!outline.length) continue;
    traces.push({ x: outline.map(([x]) => x), y: outline.map(([, y]) => y), type: "scatter", mode: "lines", fill: "toself", line: { width: 0 },
      fillcolor: faded(style(line.file, line.mode).colour), hoverinfo: "skip", showlegend: false, meta: { band: line.mode }, ...axes });
  }
  return traces;
}

const faded = (colour) => `rgba(${[1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)).join(",")},0.15)`;

/** Bars from end to end of the intervals in which events lie as far as the errors of the data tell. */
function intervalTrace(files, chart, settings, isActive, axes) {
  const x = [], y = [];
  for (const file of files) {
    for (const event of file.data.events) {
      if (!event.interval || event.real === null || (event.modes.length && !event.modes.some((mode) => isActive({ file, mode })))) continue;
      const height = eventPoint(event, chart, settings)[1];
      x.push(event.interval[0], event.interval[1], null);
      y.push(height, height, null);
    }
  }
  return x.length ? [{ x, y, type: "scatter", mode: "lines+markers", line: { color: INK, width: 1.4 }, marker: { symbol: "line-ns-open", size: 9, color: INK },
    hoverinfo: "skip", showlegend: false, meta: { intervals: true }, ...axes }] : [];
}

/** A few marks on every line, by which lines can be distinguished without colours. */
function markTrace(lines, isActive, style, axes) {
  const x = [], y = [], symbol = [], color = [];
  for (const line of lines.filter(isActive)) {
    const project = CHARTS[axes.chart].project(line.file, axes.settings);
    const { colour, symbol: mark } = style(line.file, line.mode);
    const stretch = line.file.path.modes[line.mode].find((s) => s.covers(line.points[0].place) && s.covers(line.points[line.points.length - 1].place));
    for (let i = 0; stretch && i < 5; ++i) {
      const place = stretch.from + (stretch.to - stretch.from) * ((i + 0.5 + 0.13 * ((line.mode * 3 + line.file.index) % 5 - 2)) / 5);
      const [px, py] = project(place, stretch.at(place));
      x.push(px); y.push(py); symbol.push(mark); color.push(colour);
    }
  }
  return { x, y, type: "scatter", mode: "markers", marker: { symbol, color, size: 7 }, hoverinfo: "skip", showlegend: false, ...axes.plot };
}

/** Names at the right ends of lines, shifted where they would overlap. */
function nameTrace(lines, isActive, style, view, short) {
  const ends = new Map();
  for (const line of lines.filter(isActive)) {
    for (const point of line.points) {
      if (!(point.x >= view.x[0] && point.x <= view.x[1] && point.y >= view.y[0] && point.y <= view.y[1])) continue;
      const key = `${line.file.index}/${line.mode}`, before = ends.get(key);
      if (!before || point.x > before.point.x) ends.set(key, { line, point });
    }
  }
  const list = [...ends.values()].sort((a, b) => a.point.y - b.point.y);
  const gap = 14 / view.perY;
  let last = -Infinity;
  const heights = list.map(({ point }) => (last = Math.max(point.y, last + gap)));
  for (let i = list.length - 1, next = view.y[1]; i >= 0; --i) next = (heights[i] = Math.min(heights[i], next)) - gap;
  return {
    x: list.map(() => view.x[1]), y: heights, type: "scatter", mode: "text", textposition: "middle right", cliponaxis: false,
    text: list.map(({ line }) => " " + plotText(short ? line.mode + 1 : line.file.shortText(line.mode))),
    textfont: { color: list.map(({ line }) => style(line.file, line.mode).colour), size: 11.5 },
    hoverinfo: "skip", showlegend: false, xaxis: "x", yaxis: "y",
  };
}

/** Coordinates of an event in a chart. */
function eventPoint(event, chart, settings) {
  const size = Math.hypot(event.real, event.imag);
  if (chart === "locus") return [event.real, Math.abs(event.imag)];
  if (chart === "damping") return [event.parameter, settings.damping === "real" ? event.real : dampingRatio(event.real, event.imag)];
  return [event.parameter, (settings.frequency === "abs" ? size : Math.abs(event.imag)) * settings.unitFactor];
}

/** The marks of events: one trace per kind. */
function eventTraces(files, chart, settings, isActive, axes, showLegend) {
  const kinds = new Map();
  for (const file of files) {
    for (const event of file.data.events) {
      if (event.real === null || event.imag === null) continue;
      if (event.modes.length && !event.modes.some((mode) => isActive({ file, mode }))) continue;
      if (!kinds.has(event.kind)) kinds.set(event.kind, []);
      kinds.get(event.kind).push({ file, event });
    }
  }
  for (const list of kinds.values())
    for (const mark of list) [mark.x, mark.y] = eventPoint(mark.event, chart, settings);
  const marks = [...kinds.values()].flat();
  const named = settings.eventNames && marks.length <= MOST_EVENT_NAMES && chart !== "damping";
  if (named) placeNames(marks, axes.view);
  const { view, ...plot } = axes;
  return [...kinds].map(([kind, list]) => {
    const { symbol } = list[0].event;
    return {
      x: list.map(({ x }) => x), y: list.map(({ y }) => y), type: "scatter", mode: named ? "markers+text" : "markers",
      text: named ? list.map(({ name }) => plotText(name)) : undefined,
      textposition: named ? list.map(({ side }) => side) : undefined, textfont: { size: 11, color: INK }, cliponaxis: true,
      marker: { symbol, size: marks.length > 60 ? 7 : 11, color: INK, line: { width: symbol.includes("-open") ? 2 : 0.5, color: INK } },
      name: kind, legendgroup: kind, showlegend: showLegend, hoverinfo: "skip", ...plot, marks: list,
    };
  });
}

const SIDES = { "top center": [0, -1], "bottom center": [0, 1], "middle right": [1, 0], "middle left": [-1, 0], "top right": [1, -1],
  "top left": [-1, -1], "bottom right": [1, 1], "bottom left": [-1, 1] };

/** Sets the `name` of every mark and the `side` on which it covers no other name or mark; the name is empty if there is no such side. */
function placeNames(marks, view) {
  const at = (mark) => [mark.x * view.perX, -mark.y * view.perY];
  const taken = marks.map((mark) => { const [x, y] = at(mark); return [x - 6, x + 6, y - 6, y + 6]; });
  const overlaps = ([a, b, c, d]) => taken.some(([e, f, g, h]) => a < f && b > e && c < h && d > g);
  for (const mark of marks) {
    const { file, event } = mark, [x, y] = at(mark);
    const number = file.eventNumber(event), long = event.labelled ? `${event.kind} ${number}` : number;
    mark.name = "";
    mark.side = "top center";
    for (const [name, side] of [long, number].flatMap((text) => Object.keys(SIDES).map((key) => [text, key]))) {
      const width = 6.3 * name.length, [dx, dy] = SIDES[side];
      const left = x - width / 2 + dx * (width / 2 + 8), top = y - 6 + dy * 13;
      const box = [left, left + width, top, top + 12];
      const right = view.x[1] * view.perX, leftEnd = view.x[0] * view.perX;
      if (overlaps(box) || box[1] > right || box[0] < leftEnd) continue;
      taken.push(box);
      Object.assign(mark, { name, side });
      break;
    }
  }
}

const RANGE_COLOURS = { stable: "rgba(0,158,115,0.13)", marginal: "rgba(230,159,0,0.16)", undecided: "rgba(110,110,110,0.16)" };
const STRIP_OPACITY = { stable: 1, marginal: 0.4, undecided: 0.15 };

/** Shaded stable ranges of the parameter: of the whole height for one file, a strip at the top for each of several files. */
function rangeShapes(files) {
  const shapes = [];
  files.forEach((file, row) => {
    for (const range of file.data.ranges || []) {
      const colour = RANGE_COLOURS[range.kind];
      const several = files.length > 1;
      const strip = several ? { y0: 1.006 + row * 0.018, y1: 1.019 + row * 0.018, fillcolor: file.colour, opacity: STRIP_OPACITY[range.kind] }
        : { y0: 0, y1: 1, fillcolor: colour };
      for (const axis of several ? ["y"] : ["y", "y2"])
        shapes.push({ type: "rect", xref: "x", yref: `${axis} domain`, x0: range.from.parameter, x1: range.to.parameter, line: { width: 0 }, layer: "below", ...strip });
    }
  });
  return shapes;
}

/** Lines of the harmonics n times the excitation frequency, each with its name at its end in the window. */
function rayTraces(files, settings, view) {
  const source = files.find((file) => file.data.excitation);
  if (!source) return [];
  const { parameter, frequency } = source.data.excitation;
  return settings.harmonics.map((n) => {
    const points = parameter.map((p, i) => [p, n * frequency[i] * settings.unitFactor]);
    const top = view.y[1] - 16 / view.perY, right = view.x[1] - 8 / view.perX;
    const seen = points.filter(([x, y]) => x >= view.x[0] && x <= right && y >= view.y[0] && y <= top);
    const end = seen.length ? seen.reduce((a, b) => (b[0] > a[0] ? b : a)) : null;
    const last = points.findIndex((point) => point === end);
    return {
      x: points.map(([x]) => x), y: points.map(([, y]) => y), type: "scatter", mode: "lines+text", hoverinfo: "skip", showlegend: false,
      line: { color: "#777", width: 1.2, dash: "2px,3px" }, xaxis: "x", yaxis: "y", meta: { harmonic: n },
      text: points.map((_, i) => (i === last ? plotText(`${number(n)}\u00d7`) : "")), textposition: "middle left", textfont: { color: "#555", size: 11.5 },
    };
  });
}

/** The root locus coloured by the parameter: one trace per colour, and one for the colour scale. */
function parameterTraces(lines, isActive, range) {
  const traces = [];
  const faint = lines.filter((line) => !isActive(line)).flatMap((line) => line.certified.concat(line.uncertified));
  if (faint.length) traces.push(lineTrace(faint, { color: FAINT, width: 1 }));
  for (const [part, dash] of [["certified", "solid"], ["uncertified", "6px,4px"]]) {
    const bins = Array.from({ length: PARAMETER_COLOURS }, () => []);
    for (const line of lines.filter(isActive)) {
      for (const points of line[part]) {
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
      if (list.length) traces.push(lineTrace(list, { color: parameterColour((bin + 0.5) / PARAMETER_COLOURS), width: 2.6, dash }));
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
  return {
    x: [null], y: [null], type: "scatter", mode: "markers", hoverinfo: "skip", showlegend: false,
    marker: { color: [range[0]], cmin: range[0], cmax: range[1], colorscale, showscale: true,
      colorbar: { title: { text: title, side: "right" }, thickness: 12, outlinewidth: 0, len: 0.9, x: 1.02, xpad: 4 } },
  };
}

/** The beginning (a ring) and the end (a dot) of every line, which show its direction. */
function endTraces(lines, isActive) {
  const shown = lines.filter(isActive);
  const marks = (pick, symbol) => ({
    x: shown.map((line) => pick(line).x), y: shown.map((line) => pick(line).y), type: "scatter", mode: "markers", hoverinfo: "skip",
    showlegend: false, marker: { symbol, size: shown.length > 40 ? 4 : 7, color: INK, line: { width: shown.length > 40 ? 1 : 1.5, color: INK } },
  });
  return [marks((line) => line.points[0], "circle-open"), marks((line) => line.points[line.points.length - 1], "circle")];
}
