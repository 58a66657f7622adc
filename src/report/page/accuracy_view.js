// Work-precision diagram: the largest error of every run over its wall time, one line per method.

class AccuracyView {
  constructor(file) {
    this.file = file;
    this.figure = element("div", { class: "chart accuracy", role: "img", "aria-label": "Error against time" });
    this.work = "wall_time";
    this.options = { wall_time: "wall time, s", factorizations: "complex LU factorizations", points: "points" };
    this.node = element("section", { class: "study" }, element("h2", { text: `Accuracy and cost: ${file.title || file.name}` }),
      element("div", { class: "controls" }, selectControl("Work as", this.options, this.work, (work) => { this.work = work; this.draw(); })), this.figure,
      element("p", { class: "note", text: "Down and to the left is better. Open marks: runs that ended early." }));
  }

  start() { this.draw(); }

  draw() {
    const { file, work } = this;
    const nameOf = (run) => (file.order[run] > 0 ? `${file.method[run]}, order ${file.order[run]}` : file.method[run]);
    const traces = grouped(file.method.map((_, run) => run), nameOf).map((runs, i) => {
      const shown = runs.filter((k) => file.error[k] > 0 && file[work][k] > 0).sort((a, b) => file[work][a] - file[work][b]);
      const symbol = SYMBOLS[i % SYMBOLS.length];
      return { type: "scatter", mode: "lines+markers", name: plotText(nameOf(runs[0])), x: shown.map((k) => file[work][k]), y: shown.map((k) => file.error[k]),
        text: shown.map((k) => `${file.run_tolerance[k] === null ? "" : `tolerance ${number(file.run_tolerance[k])}<br>`}${file.points[k]} points, ${file.factorizations[k]} LU, ${file.spectra[k]} spectra` +
          (file.status[k] === "completed" ? "" : `<br>${plotText(file.status[k])}`)),
        hovertemplate: "error %{y:.2e}<br>%{x:.3g}<br>%{text}<extra>%{fullData.name}</extra>",
        line: { color: COLOURS[i % COLOURS.length], width: 2, dash: ["solid", "6px,3px", "2px,2px"][Math.floor(i / COLOURS.length) % 3] },
        marker: { size: 8, symbol: shown.map((k) => symbol + (file.status[k] === "completed" ? "" : "-open")), color: COLOURS[i % COLOURS.length] } };
    });
    const log = (values) => {
      const range = [Math.floor(Math.log10(Math.min(...values))), Math.ceil(Math.log10(Math.max(...values)))];
      return { type: "log", exponentformat: "power", minexponent: 0, dtick: range[1] - range[0] > 6 ? 2 : 1, ...(values.length ? { range: padded(range, 0.03) } : {}) };
    };
    const seen = (key) => traces.flatMap((trace) => trace[key]);
    // On a narrow page the names stand below the axis, one per line, and the figure grows by their height.
    const names = isNarrow() ? 19 * traces.length + 12 : 0;
    this.figure.style.height = isNarrow() ? `${400 + names}px` : "";
    const below = { orientation: "v", x: 0, yref: "container", y: 0, yanchor: "bottom", font: { size: 11 } };
    Plotly.react(this.figure, traces, figureLayout({ hovermode: "closest", margin: { l: 66, r: 16, t: 16, b: 46 + names },
      legend: isNarrow() ? below : { orientation: "v", x: 1.01, y: 1, font: { size: 12 } },
      xaxis: figureAxis(this.options[work], log(seen("x"))), yaxis: figureAxis("largest error, relative", log(seen("y"))) }), figureConfig("accuracy"));
  }
}
