// View of stability over two parameters: maps with boundaries drawn on them.

const MAP_QUANTITIES = { unstable: "growing modes", margin: "margin −max Re s, 1/s", damping_ratio: "least damping ratio" };
const CELL_KINDS = [["unknown", "#bdbdbd"], ["stable", "#dff0e8"], ["marginal", "#fbf3d3"], ["1", "#f6c08a"], ["2", "#e08a3c"], ["3", "#b3531c"], ["4+", "#6d2a0c"]];

/** Index into CELL_KINDS for a cell with this number of growing modes (-1: unknown) and this margin. */
function cellKind(growing, margin) {
  if (growing < 0) return 0;
  return growing > 0 ? 2 + Math.min(growing, 4) : margin > 0 ? 1 : 2;
}

class PlaneView {
  /** Files (boundaries and maps) over the same two parameters. */
  constructor(files) {
    this.maps = files.filter((file) => file.kind === "map");
    this.boundaries = files.filter((file) => file.kind === "boundary");
    [this.first, this.second] = [files[0].first, files[0].second];
    this.quantity = "unstable";
    this.figure = element("div", { class: "chart plane", role: "img", "aria-label": "Stability over two parameters" });
    this.node = element("section", { class: "planes" }, element("h2", { text: `Stability over ${this.first.name} and ${this.second.name}` }),
      this.maps.length ? element("div", { class: "controls" }, selectControl("Map of", MAP_QUANTITIES, this.quantity, (quantity) => { this.quantity = quantity; this.draw(); })) : "", this.figure, this.note(), ...this.tables());
  }

  start() { this.draw(); }

  note() {
    const lines = this.boundaries.length ? ["thick: bounds the stable region", "dashed: others grow already"] : [];
    const dots = this.maps.some((map) => map.axis_points.line.length) ? ["dots: located events on the lines of the map"] : [];
    return element("div", { class: "key" }, ...[...lines, ...dots].map((text) => element("span", { text })));
  }

  mapTraces(map) {
    const x = map.first.values, y = map.second.values, columns = x.length;
    const rows = (values) => y.map((_, i) => Array.from(values.subarray(i * columns, (i + 1) * columns)));
    const counts = rows(int32(map.unstable)), margins = rows(float32(map.margin)), ratios = rows(float32(map.damping_ratio));
    const text = counts.map((row, i) => row.map((count, j) =>
      (count < 0 ? "unknown" : `${count} growing<br>margin ${number(margins[i][j], 5)} 1/s<br>least damping ratio ${number(ratios[i][j], 5)}`)));
    const hover = { text, hovertemplate: `${plotText(this.first.name)} %{x}<br>${plotText(this.second.name)} %{y}<br>%{text}<extra></extra>` };
    const common = { type: "heatmap", x, y, ...hover };
    if (this.quantity === "unstable") return [{ ...common, z: counts.map((row, i) => row.map((n, j) => cellKind(n, margins[i][j]))), ...kindScale() }];
    const values = this.quantity === "margin" ? margins : ratios;
    const limit = Math.max(...values.flat().filter(Number.isFinite).map(Math.abs), Number.MIN_VALUE);
    const scale = [[0, "#b35806"], [0.25, "#f1a340"], [0.5, "#f7f7f7"], [0.75, "#67a9cf"], [1, "#2166ac"]];
    const finite = values.map((row) => row.map((value) => (Number.isFinite(value) ? value : null)));
    return [{ ...common, z: finite, zmin: -limit, zmax: limit, colorscale: scale, colorbar: { title: { text: MAP_QUANTITIES[this.quantity], side: "right" }, thickness: 12, outlinewidth: 0 } },
      { type: "contour", x, y, z: finite, contours: { start: 0, end: 0, size: 1, coloring: "none" }, line: { color: INK, width: 1.5 }, showscale: false, hoverinfo: "skip", showlegend: false }];
  }

  axisPointTrace(map) {
    const { line, parameter, kind, frequency } = map.axis_points;
    return {
      type: "scatter", mode: "markers", x: parameter, y: line.map((i) => map.second.values[i]), marker: { size: 4, color: INK }, name: "located events", showlegend: false,
      text: kind.map((name, i) => `${plotText(name)}, Im s ${number(frequency[i], 6)} rad/s`), hovertemplate: "%{text}<br>%{x}, %{y}<extra></extra>",
    };
  }

  boundaryTraces(boundary, index) {
    const dashes = this.boundaries.length > 1 ? ["solid", "longdash", "dashdot"][index % 3] : "solid";
    return boundary.curves.flatMap((curve, i) => {
      const colour = { flutter: "#0072b2", divergence: "#d55e00", damping_ratio: "#009e73" }[curve.kind] || INK;
      const of = (bounds) => curve.steps.filter((step) => step.bounds === bounds);
      return [true, false].filter((bounds) => of(bounds).length).map((bounds) => {
        const steps = of(bounds), x = [], y = [], text = [];
        for (const step of steps) {
          const goesOn = x.length && x[x.length - 1] === step.first[0] && y[y.length - 1] === step.second[0];
          if (x.length && !goesOn) { x.push(null); y.push(null); text.push(""); }
          x.push(...step.first); y.push(...step.second);
          text.push(...step.real.map((re, k) => `${plotText(curve.kind)}, ${plotText(curve.mode)}<br>s = ${complexText(re, step.imag[k], 6)} 1/s`));
        }
        return { type: "scatter", mode: "lines", x, y, text, line: { color: colour, width: bounds ? 3 : 1.6, dash: bounds ? dashes : "4px,4px" },
          name: plotText(`${curve.kind} ${i + 1}${this.boundaries.length > 1 ? `, ${boundary.name}` : ""}`), legendgroup: `${index}/${i}`,
          showlegend: bounds || !of(true).length, hovertemplate: `%{text}<br>${plotText(this.first.name)} %{x}<br>${plotText(this.second.name)} %{y}<extra></extra>` };
      });
    });
  }

  cornerTrace(boundary) {
    return { type: "scatter", mode: "markers", x: boundary.corners.map((c) => c.first), y: boundary.corners.map((c) => c.second), name: "corner",
      text: boundary.corners.map((c) => plotText(c.kind)), hovertemplate: "%{text}<br>%{x}, %{y}<extra></extra>", showlegend: boundary.corners.length > 0,
      marker: { symbol: "diamond-open", size: 11, color: INK, line: { width: 2 } } };
  }

  draw() {
    const traces = [...this.maps.flatMap((map) => [...this.mapTraces(map), this.axisPointTrace(map)]),
      ...this.boundaries.flatMap((boundary, i) => [...this.boundaryTraces(boundary, i), this.cornerTrace(boundary)])];
    const range = (file, axis) => (file.window ? { range: padded(file.window[axis].map(Number).sort((a, b) => a - b), 0.02) } : {});
    const boundary = this.maps.length ? {} : this.boundaries[0] || {};
    Plotly.react(this.figure, traces, figureLayout({ hovermode: "closest", margin: { l: 58, r: 16, t: 40, b: 46 },
      xaxis: figureAxis(axisName(this.first), range(boundary, "first")), yaxis: figureAxis(axisName(this.second), range(boundary, "second")) }), figureConfig("stability"));
  }

  tables() {
    const rows = this.boundaries.flatMap((boundary) => boundary.curves.map((curve, i) => element("tr", {},
      ...[boundary.name, String(i + 1), curve.kind, curve.mode, `${number(curve.extent[0], 8)} … ${number(curve.extent[1], 8)}`,
        `${number(curve.extent[2], 8)} … ${number(curve.extent[3], 8)}`, `${curve.begin}, ${curve.end}`].map((text) => cell(text)))));
    if (!this.boundaries.length) return [];
    if (!rows.length) return [element("p", { class: "note", text: "There is no boundary in the window." })];
    return [table(["file", "curve", "kind", "mode", this.first.name, this.second.name, "ends"], rows, "Boundary curves")];
  }
}

/** A colour for each of CELL_KINDS. */
function kindScale() {
  const n = CELL_KINDS.length;
  const colorscale = CELL_KINDS.flatMap(([, colour], i) => [[i / n, colour], [(i + 1) / n, colour]]);
  return { zmin: -0.5, zmax: n - 0.5, colorscale, colorbar: { title: { text: "growing modes", side: "right" }, thickness: 12, outlinewidth: 0,
    tickvals: CELL_KINDS.map((_, i) => i), ticktext: CELL_KINDS.map(([name]) => name) } };
}
