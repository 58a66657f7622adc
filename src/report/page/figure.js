// Colours, marks and layout that all figures share.

/** Okabe and Ito's colours without yellow, which is too light for lines on white. */
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"];
const SYMBOLS = ["circle", "square", "diamond", "triangle-up", "triangle-down", "cross", "x", "star", "pentagon", "hexagram"];
/** Modes beyond the seventh have other dashes, unless dashes tell the sense of whirl. */
const DASHES = ["solid", "12px,4px", "10px,3px,2px,3px", "3px,3px"];
const BACKWARD_DASH = "7px,4px";
const DOUBT = "rgba(120,120,120,0.32)";
const OPERATING_FILL = "rgba(0,114,178,0.10)";
const MARGIN_FILL = "rgba(196,0,70,0.13)";
const FAINT = "#d4d4d4";
const GRID = "#e8e8e8";
const INK = "#1a1a1a";

/** Frequency units that can be chosen: how many are in one rad/s. */
const FREQUENCY_UNITS = { "rad/s": 1, Hz: 0.5 / Math.PI, rpm: 30 / Math.PI };

/** Ticks of an axis of decimal logarithms: at 1, 2, 5 times powers of ten, or at round numbers where it is short. */
function logTicks([low, high]) {
  const values = [];
  if (high - low > 0.8) {
    const digits = high - low > 3 ? [1] : high - low > 2.2 ? [1, 3] : [1, 2, 5];
    for (let power = Math.floor(low); power <= high; ++power) values.push(...digits.map((digit) => digit * 10 ** power));
  } else {
    const size = 10 ** high - 10 ** low, power = 10 ** Math.floor(Math.log10(size / 4)), step = [1, 2, 5, 10].find((n) => n * power >= size / 5) * power;
    for (let n = Math.ceil(10 ** low / step); n * step <= 10 ** high; ++n) values.push(n * step);
  }
  const seen = values.filter((value) => value > 0 && Math.log10(value) >= low && Math.log10(value) <= high);
  return { tickmode: "array", tickvals: seen.map(Math.log10), ticktext: seen.map((value) => number(value, 4)) };
}

const isNarrow = () => window.innerWidth < 700;
const isTouch = () => window.matchMedia("(pointer: coarse)").matches;

function figureConfig(name) {
  return {
    responsive: true, displaylogo: false, doubleClick: "reset", displayModeBar: !isNarrow(),
    modeBarButtons: [["zoom2d", "pan2d"], ["zoomIn2d", "zoomOut2d", "resetScale2d"], [{
      name: "save", title: "Save as SVG", icon: Plotly.Icons.camera,
      click: (figure) => Plotly.downloadImage(figure, { format: "svg", filename: name }),
    }]],
  };
}

function figureAxis(title, more = {}) {
  return {
    title: { text: title, standoff: 8 }, gridcolor: GRID, zerolinecolor: "#9a9a9a", linecolor: "#555", showline: true,
    ticks: "outside", tickcolor: "#555", ticklen: 4, automargin: true, exponentformat: "power", minexponent: 4, ...more,
  };
}

function figureLayout(more) {
  return {
    font: { family: "system-ui, sans-serif", size: isNarrow() ? 11 : 12.5, color: INK },
    paper_bgcolor: "#fff", plot_bgcolor: "#fff", hovermode: false, dragmode: isTouch() ? false : "zoom",
    margin: { l: 56, r: 16, t: 34, b: 44 },
    legend: { orientation: "h", x: 0, y: 1.01, yanchor: "bottom", font: { size: 11.5 } },
    ...more,
  };
}

/** The range of the values, without a few that are far larger than all others, as where a mode goes to infinity. */
function usualRange(values) {
  if (!values.length) return [0, 1];
  const sorted = Float64Array.from(values).sort(), n = sorted.length;
  let low = sorted[0], high = sorted[n - 1];
  const quantile = (share) => sorted[Math.min(Math.floor(share * n), n - 1)];
  const most = Math.max(quantile(0.97) - quantile(0.03), 1e-12 * Math.max(Math.abs(low), Math.abs(high)));
  if (n > 60 && high - quantile(0.97) > 25 * most) high = quantile(0.97) + 0.5 * most;
  if (n > 60 && quantile(0.03) - low > 25 * most) low = quantile(0.03) - 0.5 * most;
  return low < high ? [low, high] : [low - (0.05 * Math.abs(low) || 0.05), high + (0.05 * Math.abs(high) || 0.05)];
}

function padded([low, high], share) {
  return [low - share * (high - low), high + share * (high - low)];
}

/** The position in pixels, from the upper left corner of the figure, of data coordinates. */
function toPixels(figure, xaxis, yaxis, x, y) {
  const { [xaxis]: ax, [yaxis]: ay } = figure._fullLayout;
  return [ax._offset + ax.l2p(ax.d2l ? ax.d2l(x) : x), ay._offset + ay.l2p(ay.d2l ? ay.d2l(y) : y)];
}

function insideAxes(figure, xaxis, yaxis, [px, py]) {
  const { [xaxis]: ax, [yaxis]: ay } = figure._fullLayout;
  return px >= ax._offset - 1 && px <= ax._offset + ax._length + 1 && py >= ay._offset - 1 && py <= ay._offset + ay._length + 1;
}

function svgElement(tag, attributes, ...children) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

/** A small picture of a line with its mark, for tables. */
function swatch(colour, symbol, dash = "solid") {
  const dashes = dash === "solid" ? {} : { "stroke-dasharray": dash.replaceAll("px", "") };
  const line = svgElement("line", { x1: 0, x2: 30, y1: 6, y2: 6, stroke: colour, "stroke-width": 2, ...dashes });
  const paths = {
    circle: "M10.5 6a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0", square: "M11 2h8v8h-8z", diamond: "M15 1l5 5l-5 5l-5 -5z",
    "triangle-up": "M15 1l5 9h-10z", "triangle-down": "M15 11l5 -9h-10z", cross: "M13.5 1h3v3.5h3.5v3h-3.5v3.5h-3v-3.5h-3.5v-3h3.5z",
    x: "M11 3.5l1.5 -1.5l2.5 2.5l2.5 -2.5l1.5 1.5l-2.5 2.5l2.5 2.5l-1.5 1.5l-2.5 -2.5l-2.5 2.5l-1.5 -1.5l2.5 -2.5z",
    star: "M15 0.5l1.6 3.7l4 .3l-3 2.6l1 3.9l-3.6 -2.1l-3.6 2.1l1 -3.9l-3 -2.6l4 -.3z",
    pentagon: "M15 1l5 4l-2 6h-6l-2 -6z", hexagram: "M15 0.5l1.6 2.8h3.4l-1.8 2.7l1.8 2.7h-3.4l-1.6 2.8l-1.6 -2.8h-3.4l1.8 -2.7l-1.8 -2.7h3.4z",
  };
  const mark = symbol ? [svgElement("path", { d: paths[symbol], fill: colour })] : [];
  return svgElement("svg", { width: 30, height: 12, viewBox: "0 0 30 12", "aria-hidden": "true" }, line, ...mark);
}

/** A broad translucent band along a line given by pixels "x,y x,y", cut at the axes of the figure. */
function overlayLine(figure, points, colour) {
  const { xaxis, yaxis, yaxis2 } = figure._fullLayout, lowest = yaxis2 || yaxis;
  const left = xaxis._offset, top = yaxis._offset, width = xaxis._length, height = lowest._offset + lowest._length - top;
  return svgElement("svg", { class: "overlay-line", style: `left:${left}px;top:${top}px`, width, height, viewBox: `${left} ${top} ${width} ${height}`, "aria-hidden": "true" },
    svgElement("polyline", { points, fill: "none", stroke: colour, "stroke-width": 8, "stroke-opacity": 0.3, "stroke-linejoin": "round" }));
}
