// Draws the charts of a LociView: Campbell diagram and root locus.

const MOST_DECADES = 4;  // of frequency on a logarithmic axis
const SHOWN_ANYWAY = 3;  // lowest modes that are shown even if they are above rays that nobody asked for

class LociCharts {
  zoomed(figure, change) {
    const which = figure === this.campbell ? "campbell" : "locus";
    if (!Object.keys(change).some((key) => /axis2?\.(range|autorange)/.test(key))) return;
    const { xaxis, yaxis, yaxis2 } = figure._fullLayout;
    this.zoom[which] = { x: [...xaxis.range], y: [...yaxis.range], y2: yaxis2 ? [...yaxis2.range] : null };
    if (Object.keys(change).some((key) => key.endsWith("autorange"))) this.zoom[which] = null;
    this.draw(which);
  }

  laterDraw() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.draw(), 120);
  }

  /** Points [x, y] of all active modes in a chart, as far as the chart has them: a list for each mode. */
  sampledModes(chart) {
    const hidesReal = chart !== "locus" && !this.settings.realRoots;
    return this.files.flatMap((file) => {
      const project = projection(chart, file, this.settings);
      return file.path.modes.filter((_, mode) => this.isActive({ file, mode })).map((stretches) => stretches.flatMap((stretch) => {
        const samples = stretch.samples(), stride = Math.max(1, Math.floor(samples.length / 200));
        return [...samples.filter((_, i) => i % stride === 0), stretch.to].map((place) => [place, stretch.at(place)])
          .filter(([, s]) => !(hidesReal && stretch.isReal(s))).map(([place, s]) => project(place, s))
          .filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y));
      }));
    });
  }

  /** The window of a chart that shows all active modes. */
  wholeWindow(chart) {
    const points = this.sampledModes(chart).flat();
    return { x: usualRange(points.map(([x]) => x)), y: usualRange(points.map(([, y]) => y)) };
  }

  view(window, size) {
    return { x: window.x, y: window.y, perX: size[0] / Math.abs(window.x[1] - window.x[0]), perY: size[1] / Math.abs(window.y[1] - window.y[0]) };
  }

  /** Width and height in px of the axes of a figure as drawn last; `guess` before that. */
  plotSize(figure, yaxis, guess) {
    const layout = figure._fullLayout;
    return layout && layout[yaxis] ? [layout.xaxis._length, layout[yaxis]._length] : guess;
  }

  /** Draws a figure; once more if its axes turn out to have another size than the labels were placed for. */
  show(figure, traces, layout, name, sizes, redraw) {
    Plotly.react(figure, traces, layout, figureConfig(name)).then(() => {
      const differs = Object.entries(sizes).some(([yaxis, [width, height]]) => {
        const [w, h] = this.plotSize(figure, yaxis);
        return Math.abs(w - width) > 1.5 || Math.abs(h - height) > 1.5;
      });
      if (differs) redraw();
    });
  }

  draw(only) {
    this.updateCrossings();
    if (only !== "locus") this.drawCampbell();
    if (only !== "campbell") this.drawLocus();
  }

  /** Finds the critical speeds anew if rays or the kind of frequency have changed, and lists them. */
  updateCrossings() {
    const { settings, files } = this, key = JSON.stringify([settings.harmonics, settings.frequency, settings.unit]);
    if (key === this.crossingsKey) return;
    this.crossingsKey = key;
    this.crossings = findCrossings(files, settings);
    if (!settings.hasRays) return;
    const close = this.crossings.filter((crossing) => (separationOf(crossing) || {}).close).length;
    this.critical.replaceChildren(element("h3", { text: "Critical speeds" }),
      ...(close ? [element("p", { class: "warning", text: `${close} too close to an operating range` })] : []),
      criticalSpeedTable(this.crossings, settings, (crossing) => this.showCrossing(crossing)));
  }

  spacing() {
    const modes = this.files.reduce((sum, file) => sum + file.path.modes.length, 0);
    return modes > 40 ? 24 : 10;
  }

  drawCampbell(attempt = 0) {
    const { settings, files, isActive, style } = this, width = this.campbell.clientWidth, height = this.campbell.clientHeight;
    const narrow = width < 560, nameOf = (line) => (narrow ? String(line.mode + 1) : line.file.shortText(line.mode));
    const shown = files.flatMap((file) => file.data.modes.map((_, mode) => ({ file, mode })).filter(isActive));
    const right = 14 + Math.min(Math.max(...shown.map((line) => textWidth(nameOf(line), 11.5)), 0), 200);
    const strips = files.length > 1 ? files.length : 0, margin = { l: 58, r: right, t: 40 + 7 * strips, b: 46 };
    const pad = 0.01 * (this.range[1] - this.range[0] || 1), zoom = this.zoom.campbell;
    const x = zoom ? zoom.x : [this.range[0] - pad, this.range[1] + pad];
    const y = zoom ? zoom.y : this.frequencyRange(), y2 = zoom ? zoom.y2 : padded(this.wholeWindow("damping").y, 0.06);
    const plotWidth = Math.max(width - right - margin.l, 100), plotHeight = Math.max(height - margin.t - margin.b, 100);
    const sizes = { yaxis: this.plotSize(this.campbell, "yaxis", [plotWidth, 0.62 * plotHeight]), yaxis2: this.plotSize(this.campbell, "yaxis2", [plotWidth, 0.3 * plotHeight]) };
    const views = { frequency: this.view({ x, y }, sizes.yaxis), damping: this.view({ x, y: y2 }, sizes.yaxis2) };
    const rays = rayTraces(files, settings), traces = [...rays];
    for (const [chart, plot] of [["frequency", { xaxis: "x", yaxis: "y" }], ["damping", { xaxis: "x", yaxis: "y2" }]]) {
      const lines = this.lines[chart] = chartLines(files, chart, settings, views[chart], this.spacing());
      traces.push(...bandTraces(lines, isActive, style, plot, errorScale(chart, settings), chart === "frequency" && settings.logarithmic));
      traces.push(...modeTraces(lines, isActive, style, plot), ...intervalTrace(files, chart, settings, isActive, plot));
      traces.push(markTrace(lines, isActive, style, { chart, settings, plot }));
      this.marks[chart] = eventMarks(files, chart, settings, isActive);
      traces.push(...eventTraces(this.marks[chart], plot, chart === "frequency"));
    }
    traces.push(...this.frequencyNames(rays, views.frequency, nameOf));
    const layout = figureLayout({
      margin, shapes: [...rangeShapes(files), ...operatingShapes(files, this.crossings)],
      legend: { orientation: "h", x: 0, y: 1.01 + 0.012 * strips, yanchor: "bottom", font: { size: 11.5 } },
      xaxis: figureAxis(axisName(this.parameter), { range: x, anchor: "y2", zeroline: false }),
      yaxis: figureAxis(`${frequencyName(settings)}, ${settings.unit}`, { range: y, domain: [0.38, 1], ...(settings.logarithmic ? logTicks(y) : { tickmode: "auto" }) }),
      yaxis2: figureAxis(settings.damping === "real" ? "Re s, 1/s" : "damping ratio", { range: y2, domain: [0, 0.3], zerolinewidth: 1.5 }),
    });
    this.show(this.campbell, traces, layout, "campbell", sizes, () => attempt < 2 && this.drawCampbell(attempt + 1));
  }

  /** Marks of critical speeds, and all names in the frequency chart. */
  frequencyNames(rays, view, nameOf) {
    const { settings, files, isActive, style } = this, plot = { xaxis: "x", yaxis: "y" };
    const lines = this.lines.frequency.filter(isActive), events = this.marks.frequency;
    const critical = crossingMarks(this.crossings, settings, isActive), marks = [...events, ...critical];
    this.marks.frequency = marks;
    const names = settings.eventNames ? [...markLabels(events, view), ...markLabels(critical, view)] : [];
    const taken = markBoxes(marks, view), { area } = viewPixels(view), curves = linePixels(lines, view);
    const placed = [...placeLabels([...operatingLabels(files, view), ...rayLabels(rays, view)], taken, area, curves),
      ...placeLabels([...names, ...innerNames(lines, style, view, nameOf)], taken, area, [...curves, ...rayPixels(rays, view)])];
    return [crossingTrace(critical, plot), labelTrace(placed, view, plot, "inside"), nameTrace(lines, style, view, nameOf)];
  }

  /** The highest frequency of the `count` lowest modes. */
  topOfLowest(count) {
    const modes = this.sampledModes("frequency").map((points) => points.map(([, y]) => y)).filter((ys) => ys.length);
    const lowest = modes.map((ys) => [Math.min(...ys), Math.max(...ys)]).sort((a, b) => a[0] - b[0]).slice(0, count);
    return Math.max(...lowest.map(([, high]) => high));
  }

  /**
   * Frequencies from zero to the highest mode, but not above the highest ray; or as far as asked for. Rays that neither the
   * scene nor the reader has asked for leave at least the lowest modes in sight.
   */
  frequencyRange() {
    const { settings, files } = this, [low, high] = this.wholeWindow("frequency").y;
    const source = files.find((file) => file.data.excitation);
    const fastest = source ? Math.max(...source.data.excitation.frequency.map(Math.abs)) : 0;
    const ray = onFrequencyAxis(Math.max(0, ...settings.harmonics) * fastest * settings.unitFactor, settings);
    const hasRays = settings.harmonics.length && fastest > 0, end = settings.raysAsked ? ray : Math.max(ray, this.topOfLowest(SHOWN_ANYWAY));
    const top = settings.highest ? onFrequencyAxis(settings.highest, settings) : hasRays ? Math.min(high, end) : high;
    if (!settings.logarithmic) return [-0.02 * (top || 1), (settings.highest ? 1 : 1.06) * (top || 1)];
    const bottom = Math.max(Math.min(low, top - 0.3), top - MOST_DECADES);
    return padded([bottom, top], settings.highest ? 0 : 0.03);
  }

  drawLocus(attempt = 0) {
    const { settings, files, isActive } = this, width = this.locus.clientWidth, height = this.locus.clientHeight;
    const byParameter = settings.colourBy === "parameter";
    const whole = this.wholeWindow("locus"), zoom = this.zoom.locus;
    const largest = Math.max(...whole.y.map((value) => Math.abs(value) / settings.unitFactor), ...whole.x.map(Math.abs), Number.MIN_VALUE);
    const flat = whole.x[1] - whole.x[0] < 1e-7 * largest ? [whole.x[0] - 1e-3 * largest, whole.x[1] + 1e-3 * largest] : whole.x;
    const x = zoom ? zoom.x : padded([Math.min(flat[0], 0), Math.max(flat[1], 0)], 0.05), y = zoom ? zoom.y : padded(whole.y, 0.04);
    const sizes = { yaxis: this.plotSize(this.locus, "yaxis", [Math.max(width - (byParameter ? 150 : 80), 100), Math.max(height - 80, 100)]) };
    const view = this.view({ x, y }, sizes.yaxis);
    this.lines.locus = chartLines(files, "locus", settings, view, this.spacing());
    const plot = { xaxis: "x", yaxis: "y" };
    const style = settings.colourBy === "mode" ? (file, mode) => ({ ...this.style(file, mode), colour: COLOURS[mode % COLOURS.length] }) : this.style;
    const traces = byParameter ? parameterTraces(this.lines.locus, isActive, this.range) : modeTraces(this.lines.locus, isActive, style, plot);
    const marks = this.marks.locus = eventMarks(files, "locus", settings, isActive);
    const placed = placeLabels(settings.eventNames ? markLabels(marks, view) : [], markBoxes([...marks, ...endPoints(this.lines.locus, isActive)], view), viewPixels(view).area, linePixels(this.lines.locus.filter(isActive), view));
    traces.push(...endTraces(this.lines.locus, isActive), ...eventTraces(marks, plot, true), labelTrace(placed, view, plot, "inside"));
    if (byParameter) traces.push(parameterScale(this.range, axisName(this.parameter)));
    const axis = { type: "line", xref: "x", yref: "y domain", x0: 0, x1: 0, y0: 0, y1: 1, line: { color: "#555", width: 1.2 }, layer: "below" };
    const layout = figureLayout({
      margin: { l: 58, r: byParameter ? 74 : 16, t: 40, b: 46 }, shapes: [axis],
      xaxis: figureAxis("Re s, 1/s", { range: x }), yaxis: figureAxis(`Im s, ${settings.unit}`, { range: y }),
    });
    this.show(this.locus, traces, layout, "root_locus", sizes, () => attempt < 2 && this.drawLocus(attempt + 1));
  }
}
