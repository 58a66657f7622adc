// Marks of events and critical speeds, and all names inside of the charts.

const MOST_NAMES = 14;  // events, or critical speeds, with names beside their marks

/** Coordinates of an event in a chart. */
const eventPoint = (event, chart, settings) => CHARTS[chart].at(event.parameter, [event.real, event.imag], settings);

const isShown = (event, file, isActive) => event.real !== null && event.imag !== null &&
  (!event.modes.length || event.modes.some((mode) => isActive({ file, mode })));

/** The marks { file, event, x, y } of the events that are shown. */
function eventMarks(files, chart, settings, isActive) {
  return files.flatMap((file) => file.data.events.filter((event) => isShown(event, file, isActive)).map((event) => {
    const [x, y] = eventPoint(event, chart, settings);
    return { file, event, x, y };
  }));
}

/** One trace of marks per kind of event. */
function eventTraces(marks, plot, showLegend) {
  return grouped(marks, ({ event }) => event.kind).map((list) => {
    const { symbol, kind } = list[0].event;
    return pointTrace(list, { symbol, size: marks.length > 60 ? 7 : 11, color: INK, line: { width: symbol.includes("-open") ? 2 : 0.5, color: INK } },
      { name: kind, legendgroup: kind, showlegend: showLegend, ...plot });
  });
}

/** Whether a critical speed is an event of the file as well, which has its own mark. */
function isEvent({ file, mode, harmonic, parameter }) {
  const near = 1e-6 * (file.path.highest - file.path.lowest);
  return file.data.events.some((event) => event.kind === "resonance" && event.value === harmonic && event.modes.includes(mode) && Math.abs(event.parameter - parameter) <= near);
}

/** The marks { file, crossing, name, x, y } of the critical speeds that are shown and no events. */
function crossingMarks(crossings, settings, isActive) {
  return crossings.map((crossing, i) => ({ file: crossing.file, crossing, name: `C${i + 1}`, x: crossing.parameter, y: onFrequencyAxis(frequencyOf(crossing.s, settings), settings) }))
    .filter(({ crossing }) => isActive(crossing) && !isEvent(crossing));
}

function crossingTrace(marks, plot) {
  return pointTrace(marks, { symbol: "diamond-open", size: 10, color: "#b3004b", line: { width: 2, color: "#b3004b" } },
    { name: "critical speed", showlegend: marks.length > 0, meta: { crossings: true }, ...plot });
}

/** "flutter E2", "1× E3" of a critical speed, "C2"; kinds that are not labelled have their number only. */
function longName({ event }, short) {
  if (!event || !event.labelled) return short;
  return `${event.kind === "resonance" ? `${number(event.value)}×` : event.kind} ${short}`;
}

/** Labels of marks; those of many are left out. */
function markLabels(marks, view) {
  if (marks.length > MOST_NAMES) return [];
  const { fromX, fromY } = viewPixels(view);
  return marks.map((mark) => {
    const short = mark.event ? mark.file.eventNumber(mark.event) : mark.name;
    return { texts: [longName(mark, short), short], colour: mark.event ? INK : "#b3004b",
      middles: (width) => besideMark(fromX(mark.x), fromY(mark.y), width) };
  });
}

const markBoxes = (marks, view) => marks.map(({ x, y }) => boxAbout(viewPixels(view).fromX(x), viewPixels(view).fromY(y), MARK_SIZE, MARK_SIZE));

function rayPixels(traces, view) {
  const { fromX, fromY } = viewPixels(view);
  return traces.map((trace) => trace.x.map((x, i) => [fromX(x), fromY(trace.y[i])]));
}

/** Names of the rays, beside them near their ends in the window. */
function rayLabels(traces, view) {
  const { area } = viewPixels(view), lines = rayPixels(traces, view);
  return traces.map((trace, k) => {
    const pixels = lines[k];
    const spots = pixels.slice(1).flatMap(([x, y], i) => [0.25, 0.5, 0.75, 1].map((t) => [pixels[i][0] + t * (x - pixels[i][0]), pixels[i][1] + t * (y - pixels[i][1])]));
    const seen = spots.filter(([x, y]) => x > area.left && x < area.right && y > area.top && y < area.bottom).reverse();
    return { texts: [`${number(trace.meta.harmonic)}×`], size: 11.5, colour: "#444",
      middles: (width) => seen.flatMap(([x, y]) => [[x - width / 2 - 3, y - 8], [x + width / 2 + 3, y + 8]]) };
  });
}

/** Names of the operating ranges, at the top of their strips. */
function operatingLabels(files, view) {
  const { fromX, area } = viewPixels(view);
  const ranges = files.flatMap((file) => file.operating.ranges);
  return ranges.map(([from, to]) => ({ texts: ["operating range", "operation"], colour: "#005a8c",
    middles: () => [0, 1, 2].map((row) => [Math.min(Math.max(fromX(0.5 * (from + to)), area.left + 46), area.right - 46), area.top + 9 + 15 * row]) }));
}

/** The last point { line, point } in the window of every mode. */
function lineEnds(lines, { x, y }) {
  const isSeen = (point) => point.x >= x[0] && point.x <= x[1] && point.y >= y[0] && point.y <= y[1];
  return grouped(lines, ({ file, mode }) => [file.index, mode]).flatMap((list) => {
    const seen = list.flatMap((line) => line.points.filter(isSeen).map((point) => ({ line, point })));
    return seen.length ? [leastOf(seen, ({ point }) => -point.x)] : [];
  });
}

/** Names of lines that end before the right edge, beside their ends; those of others stand at the edge (nameTrace). */
function innerNames(lines, style, view, nameOf) {
  const { fromX, fromY } = viewPixels(view);
  return lineEnds(lines, view).filter(({ point }) => !isAtEdge(point, view)).map(({ line, point }) => ({ texts: [nameOf(line), String(line.mode + 1)],
    size: 11.5, colour: style(line.file, line.mode).colour, middles: (width) => besideMark(fromX(point.x), fromY(point.y), width) }));
}

const isAtEdge = (point, view) => (view.x[1] - point.x) * view.perX < 30;

/** Names at the right ends of lines, one column beside the chart. */
function nameTrace(lines, style, view, nameOf) {
  const { fromX, fromY, area } = viewPixels(view);
  const ends = lineEnds(lines, view).filter(({ point }) => isAtEdge(point, view));
  const heights = spreadLabels(ends.map(({ point }) => fromY(point.y)), LABEL_HEIGHT, area.top, area.bottom);
  const list = ends.map(({ line }, i) => ({ x: fromX(view.x[1]), y: heights[i], text: ` ${nameOf(line)}`, size: 11.5, colour: style(line.file, line.mode).colour }));
  return { ...labelTrace(list.filter(({ y }) => y !== null), view, { xaxis: "x", yaxis: "y" }, "modes"), textposition: "middle right" };
}
