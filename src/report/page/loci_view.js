"use strict";
// View of loci files with the same parameter: charts, the selected place and mode, mode shapes, events.

const REACH = 22;  // distance in px from the pointer within which a line is selected

class LociView {
  constructor(datas) {
    let events = 0;
    this.files = datas.map((data, i) => {
      const file = new LociFile(data, i, events);
      events += data.events.length;
      return file;
    });
    const rays = this.files.find((file) => file.data.excitation);
    const asked = rays ? rays.data.excitation.harmonics : [];
    this.settings = { unit: "rad/s", unitFactor: 1, frequency: "imag", damping: "ratio", eventNames: true, colourBy: datas.length > 1 ? "file" : "parameter",
      harmonics: rays ? (asked.length ? asked : [1, 2, 3, 4]) : [], hasRays: Boolean(rays) };
    this.isolated = new Set();
    this.zoom = { campbell: null, locus: null };
    this.lines = {};
    this.marks = {};
    this.parameter = this.files[0].data.parameter;
    this.range = [Math.min(...this.files.map((file) => file.path.lowest)), Math.max(...this.files.map((file) => file.path.highest))];
    this.place = this.files.map(() => 0);
    this.current = { file: this.files[0], mode: 0 };
    this.isActive = ({ file, mode }) => this.isolated.size === 0 || this.isolated.has(`${file.index}/${mode}`);
    this.style = (file, mode) => (this.files.length > 1
      ? { colour: file.colour, symbol: SYMBOLS[file.index % SYMBOLS.length], width: file.index === 0 ? 2.4 : 1.6 }
      : { colour: COLOURS[mode % COLOURS.length], symbol: SYMBOLS[(mode + Math.floor(mode / COLOURS.length)) % SYMBOLS.length], width: 2 });
    this.build();
  }

  build() {
    this.campbell = element("div", { class: "chart campbell", role: "img", "aria-label": "Campbell diagram: frequency and damping against the parameter" });
    this.locus = element("div", { class: "chart locus", role: "img", "aria-label": "Root locus" });
    this.modeTable = new ModeTable(this.files, this.style, (file, mode, more) => this.toggle(file, mode, more));
    this.shape = new ShapeView(this.files);
    this.node = element("section", { class: "loci" }, this.controls(),
      element("div", { class: "charts" }, this.campbell, this.locus), this.key(), this.placeBar(),
      element("div", { class: "pair" }, element("div", {}, element("h3", { text: "Modes" }), this.modeTable.node,
        element("p", { class: "note", text: "Click a line, or a mode here, to isolate it; again to release it. Shift adds further ones." }),
        element("h3", { text: "Events" }), eventTable(this.files, (file, event) => this.showEvent(file, event))), this.shape.node),
      element("h3", { text: "Stable ranges" }), rangeTable(this.files));
  }

  start() {
    this.draw();
    for (const [figure, charts] of [[this.campbell, ["frequency", "damping"]], [this.locus, ["locus"]]]) this.listen(figure, charts);
    this.moveTo(this.files[0], this.files[0].path.placesOf(this.range[0])[0] ?? 0, 0);
    let width = this.node.clientWidth;
    new ResizeObserver(() => { if (width !== (width = this.node.clientWidth)) this.laterDraw(); }).observe(this.node);
  }

  // Controls.

  select(label, options, value, change) {
    const node = element("select", { change: () => change(node.value) }, ...Object.entries(options).map(([key, text]) =>
      element("option", { value: key, text, selected: key === value })));
    return element("label", {}, label, node);
  }

  controls() {
    const set = (name) => (value) => { this.settings[name] = value; this.zoom.campbell = null; this.draw(); this.showPlace(); };
    const harmonics = element("input", { type: "text", value: this.settings.harmonics.join(", "), "aria-label": "harmonics of the excitation",
      change: () => {
        this.settings.harmonics = harmonics.value.split(/[\s,;]+/).map(Number).filter((n) => Number.isFinite(n) && n > 0);
        harmonics.value = this.settings.harmonics.join(", ");
        this.draw();
      } });
    const names = element("input", { type: "checkbox", checked: true, change: () => { this.settings.eventNames = names.checked; this.draw(); } });
    const colours = this.files.length > 1 ? { file: "file", parameter: "parameter", mode: "mode" } : { parameter: "parameter", mode: "mode" };
    return element("div", { class: "controls" },
      this.select("Frequency", { imag: "damped, Im s", abs: "natural, abs(s)" }, "imag", set("frequency")),
      this.select("in", Object.fromEntries(Object.keys(FREQUENCY_UNITS).map((unit) => [unit, unit])), "rad/s", (unit) => {
        this.settings.unitFactor = FREQUENCY_UNITS[unit];
        set("unit")(unit);
      }),
      this.select("Damping", { ratio: "ratio −Re s/abs(s)", real: "Re s" }, "ratio", set("damping")),
      ...(this.settings.hasRays ? [element("label", { title: "rays: multiples of the excitation frequency" }, "Harmonics", harmonics)] : []),
      this.select("Locus coloured by", colours, this.settings.colourBy, (value) => { this.settings.colourBy = value; this.draw(); }),
      element("label", {}, names, "event names"),
      element("button", { type: "button", text: "Release all modes", click: () => { this.isolated.clear(); this.draw(); this.showPlace(); } }));
  }

  key() {
    const files = this.files.length > 1 ? this.files.map((file) => element("span", {}, swatch(file.colour, this.style(file, 0).symbol), file.data.name)) : [];
    const has = (test) => this.files.some(test);
    const ranges = (kind) => has((file) => (file.data.ranges || []).some((range) => range.kind === kind));
    const item = (kind, text) => element("span", {}, element("i", { class: kind }), text);
    const several = this.files.length > 1;
    return element("div", { class: "key" }, ...files,
      ...(several && (ranges("stable") || ranges("marginal") || ranges("undecided")) ? [element("span", { text: "strips above: no mode grows (pale: marginal; palest: undecided)" })] : []),
      ...(!several && ranges("stable") ? [item("stable", "stable: all modes decay")] : []),
      ...(!several && ranges("marginal") ? [item("marginal", "marginal: none grows, some stay on the imaginary axis")] : []),
      ...(!several && ranges("undecided") ? [item("undecided", "undecided: the errors of the data leave it open")] : []),
      ...(has((file) => file.data.modes.some((mode) => mode.errors)) ? [item("band", "bands and bars: errors of the data")] : []),
      ...((ranges("stable") || ranges("marginal")) && has((file) => file.path.turnsBack) ? [element("span", { text: "the path turns back: shaded where one passage is so" })] : []),
      ...(has((file) => file.data.modes.some((mode) => mode.uncertified.length)) ? [item("dashed", "identity of the mode not certified")] : []),
      ...(this.settings.hasRays ? [element("span", { text: "dotted n×: harmonics of the excitation" })] : []),
      element("span", { text: "root locus: ○ begins, ● ends; upper half plane" }));
  }

  placeBar() {
    this.slider = element("input", { type: "range", min: 0, max: 2000, step: 1, value: 0, "aria-label": "place on the path",
      input: () => this.moveTo(this.current.file, (this.slider.value / 2000) * this.current.file.path.length) });
    this.value = element("input", { type: "text", inputmode: "decimal", "aria-label": this.parameter.name, change: () => this.goToValue(this.value.value) });
    this.passage = element("span", { class: "note" });
    const step = (by) => () => this.moveNode(by);
    return element("div", { class: "place" },
      element("label", {}, `${this.parameter.name} `, this.value, this.parameter.unit === "1" ? "" : ` ${this.parameter.unit}`),
      element("button", { type: "button", text: "‹ point", title: "stored point before", click: step(-1) }), this.slider,
      element("button", { type: "button", text: "point ›", title: "next stored point", click: step(1) }), this.passage);
  }

  // The selected place.

  goToValue(text) {
    const value = Number(text.replace(",", ".").replace("−", "-"));
    const { file, mode } = this.current;
    const places = Number.isFinite(value) ? file.path.placesOf(value) : [];
    if (!places.length) {
      this.passage.textContent = `not on the path: it goes from ${number(file.path.lowest, 8)} to ${number(file.path.highest, 8)}`;
      return;
    }
    const now = places.findIndex((place) => Math.abs(place - this.place[file.index]) < 1e-9 * file.path.length);
    this.moveTo(file, places[(now + 1) % places.length], mode);  // if the value is entered again, go to its next passage
    this.value.value = text;
  }

  moveNode(by) {
    const { path } = this.current.file, place = this.place[this.current.file.index], slack = 1e-9 * path.length;
    const nodes = [...path.places].filter((node) => (by > 0 ? node > place + slack : node < place - slack));
    if (nodes.length) this.moveTo(this.current.file, by > 0 ? nodes[0] : nodes[nodes.length - 1]);
  }

  moveTo(file, place, mode = this.current.mode) {
    this.current = { file, mode };
    this.place[file.index] = place;
    const value = file.path.parameterAt(place);
    for (const other of this.files) {
      if (other === file) continue;
      const places = other.path.placesOf(value), before = this.place[other.index];
      this.place[other.index] = places.length ? places.reduce((a, b) => (Math.abs(b - before) < Math.abs(a - before) ? b : a)) : null;
    }
    this.showPlace();
  }

  showPlace() {
    const { file, mode } = this.current, place = this.place[file.index] ?? 0;
    this.slider.value = (2000 * place) / file.path.length;
    this.value.value = number(file.path.parameterAt(place), 10).replace("−", "-");
    const passages = file.path.placesOf(file.path.parameterAt(place)).length;
    this.passage.textContent = passages > 1 ? `the path passes here ${passages} times` : "";
    this.modeTable.update((other) => this.place[other.index], this.settings, this.isActive, (f, m) => this.isolated.has(`${f.index}/${m}`));
    this.shape.show(file, mode, place);
    this.showDots();
  }

  /** Draws rings around the selected mode at the selected place, in all charts. */
  showDots() {
    const { file, mode } = this.current, place = this.place[file.index];
    const s = place === null ? null : file.path.eigenvalue(mode, place);
    for (const [figure, charts] of [[this.campbell, ["frequency", "damping"]], [this.locus, ["locus"]]]) {
      if (!figure._fullLayout) continue;
      figure.querySelectorAll(".overlay-dot").forEach((dot) => dot.remove());
      for (const chart of s ? charts : []) {
        const { xaxis, yaxis, project } = CHARTS[chart];
        const at = toPixels(figure, xaxis, yaxis, ...project(file, this.settings)(place, s));
        if (insideAxes(figure, xaxis, yaxis, at)) figure.append(element("div", { class: "overlay-dot", style: `left:${at[0]}px;top:${at[1]}px` }));
      }
    }
  }

  showEvent(file, event) {
    const places = file.path.placesOf(event.parameter);
    const node = event.node >= 0 && event.node < file.path.places.length ? file.path.places[event.node] : 0;
    const place = places.length ? places.reduce((a, b) => (Math.abs(b - node) < Math.abs(a - node) ? b : a)) : node;
    this.isolated = new Set(event.modes.map((mode) => `${file.index}/${mode}`));
    this.moveTo(file, place, event.modes[0] ?? 0);
    this.draw();
    this.campbell.scrollIntoView({ block: "nearest" });
  }

  toggle(file, mode, more = false) {
    const key = `${file.index}/${mode}`, only = this.isolated.size === 1 && this.isolated.has(key);
    if (more) { if (!this.isolated.delete(key)) this.isolated.add(key); } else this.isolated = new Set(only ? [] : [key]);
    this.current = { file, mode };
    this.draw();
    this.showPlace();
  }

  // Pointer.

  listen(figure, charts) {
    const tip = element("div", { class: "tip hidden", role: "status" });
    figure.append(tip);
    const nearest = (event) => {
      const box = figure.getBoundingClientRect(), at = [event.clientX - box.left, event.clientY - box.top];
      const chart = charts.find((name) => insideAxes(figure, CHARTS[name].xaxis, CHARTS[name].yaxis, at));
      if (!chart) return null;
      const mark = this.marks[chart].find(({ x, y }) => {
        const [px, py] = toPixels(figure, CHARTS[chart].xaxis, CHARTS[chart].yaxis, x, y);
        return Math.hypot(px - at[0], py - at[1]) < 8;
      });
      const hit = nearestOnLines(this.pixelLines(figure, chart), ...at);
      return mark ? { at, mark } : hit && hit.distance < REACH ? { at, ...hit } : null;
    };
    let down = null;
    figure.addEventListener("pointermove", (event) => {
      const hit = event.buttons ? null : nearest(event);
      tip.classList.toggle("hidden", !hit);
      if (hit) this.fillTip(tip, figure, hit);
    }, true);
    figure.addEventListener("pointerleave", () => tip.classList.add("hidden"));
    figure.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; }, true);
    window.addEventListener("pointerup", (event) => {
      const still = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 5;
      down = null;
      const hit = still ? nearest(event) : null;
      if (!hit) return;
      if (hit.mark) return void this.showEvent(hit.mark.file, hit.mark.event);
      this.moveTo(hit.line.file, hit.place, hit.line.mode);
      this.toggle(hit.line.file, hit.line.mode, event.shiftKey || event.ctrlKey || event.metaKey);
      if (event.pointerType !== "mouse") { tip.classList.remove("hidden"); this.fillTip(tip, figure, hit); }
    }, true);
    figure.on("plotly_relayout", (change) => this.zoomed(figure, change));
    figure.on("plotly_doubleclick", () => { this.zoom[figure === this.campbell ? "campbell" : "locus"] = null; this.laterDraw(); });
    figure.on("plotly_afterplot", () => this.showDots());
  }

  pixelLines(figure, chart) {
    const lines = this.lines[chart];
    if (lines.figureState !== figure._fullLayout) {
      const { xaxis, yaxis } = CHARTS[chart];
      for (const line of lines) {
        line.pixels = new Float64Array(2 * line.points.length);
        line.points.forEach((point, i) => line.pixels.set(toPixels(figure, xaxis, yaxis, point.x, point.y), 2 * i));
      }
      lines.figureState = figure._fullLayout;
    }
    return lines;
  }

  fillTip(tip, figure, hit) {
    const texts = hit.mark ? this.eventTexts(hit.mark) : this.lineTexts(hit), at = hit.at;
    if (!texts) return;
    const [head, ...others] = texts.filter(Boolean);
    tip.replaceChildren(element("b", { text: head }), ...others.map((text) => element("div", { text })));
    const width = tip.offsetWidth, height = tip.offsetHeight;
    const left = at[0] + 18 + width > figure.clientWidth ? Math.max(at[0] - width - 18, 2) : at[0] + 18;
    const top = Math.min(Math.max(at[1] - height - 10, 2), figure.clientHeight - height - 2);
    tip.style.left = `${left}px`;
    tip.style.top = `${top}px`;
  }

  eventTexts({ file, event }) {
    return [`${file.eventNumber(event)} ${event.kind}`, this.files.length > 1 ? file.data.name : "",
      `${this.parameter.name} = ${withUnit(number(event.parameter, 10), this.parameter.unit)}`, `s = ${complexText(event.real, event.imag, 8)} 1/s`,
      event.modes.map((mode) => file.modeText(mode)).join(" and "), event.remark, intervalText(event)];
  }

  lineTexts({ line, place }) {
    const { file, mode } = line, s = file.path.eigenvalue(mode, place);
    if (!s) return null;
    const settings = this.settings, size = Math.hypot(...s);
    const frequency = (settings.frequency === "abs" ? size : Math.abs(s[1])) * settings.unitFactor;
    const doubtful = file.data.modes[mode].uncertified.some(([a, b]) => place >= file.path.places[a] && place <= file.path.places[b]);
    return [file.modeText(mode), this.files.length > 1 ? file.data.name : "",
      `${this.parameter.name} = ${withUnit(number(file.path.parameterAt(place), 8), this.parameter.unit)}`,
      `s = ${complexText(...s, 8)} 1/s`,
      `${frequencyName(settings)} = ${number(frequency, 8)} ${settings.unit}`,
      dampingText(...s), this.errorText(file, mode, place), doubtful ? "identity not certified here" : ""];
  }

  errorText(file, mode, place) {
    const errors = file.errors(mode), error = errors ? errors[file.path.stepOf(place)] : NaN;
    return Number.isFinite(error) ? `error of the data up to ${number(error, 2)} 1/s` : "";
  }

  // Drawing.

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

  /** The window of a chart that shows all active modes. */
  wholeWindow(chart) {
    const xs = [], ys = [];
    for (const file of this.files) {
      const project = CHARTS[chart].project(file, this.settings);
      file.path.modes.forEach((stretches, mode) => {
        if (!this.isActive({ file, mode })) return;
        for (const stretch of stretches) {
          const samples = stretch.samples(), stride = Math.max(1, Math.floor(samples.length / 200));
          for (let i = 0; i < samples.length; i += stride) {
            const [x, y] = project(samples[i], stretch.at(samples[i]));
            if (Number.isFinite(x) && Number.isFinite(y)) { xs.push(x); ys.push(y); }
          }
          const [x, y] = project(stretch.to, stretch.at(stretch.to));
          xs.push(x); ys.push(y);
        }
      });
    }
    return { x: usualRange(xs), y: usualRange(ys) };
  }

  view(figure, window, size) {
    return { x: window.x, y: window.y, perX: size[0] / Math.abs(window.x[1] - window.x[0]), perY: size[1] / Math.abs(window.y[1] - window.y[0]) };
  }

  draw(only) {
    if (only !== "locus") this.drawCampbell();
    if (only !== "campbell") this.drawLocus();
  }

  spacing() {
    const modes = this.files.reduce((sum, file) => sum + file.path.modes.length, 0);
    return modes > 40 ? 24 : 10;
  }

  drawCampbell() {
    const { settings, files, isActive } = this, width = this.campbell.clientWidth, height = this.campbell.clientHeight;
    const active = this.files.reduce((sum, file) => sum + file.data.modes.filter((_, mode) => isActive({ file, mode })).length, 0);
    const named = active <= MOST_LABELLED, narrow = width < 560;
    const longest = Math.max(...files.map((file) => Math.max(...file.data.modes.map((_, mode) => file.shortText(mode).length))));
    const right = !named ? 18 : narrow ? 30 : Math.min(24 + 6.4 * longest, 210);
    const pad = 0.01 * (this.range[1] - this.range[0] || 1), zoom = this.zoom.campbell;
    const x = zoom ? zoom.x : [this.range[0] - pad, this.range[1] + pad];
    const y = zoom ? zoom.y : this.frequencyRange(), y2 = zoom ? zoom.y2 : padded(this.wholeWindow("damping").y, 0.06);
    const plotWidth = Math.max(width - right - 70, 100), plotHeight = Math.max(height - 80, 100);
    const views = { frequency: this.view(this.campbell, { x, y }, [plotWidth, 0.62 * plotHeight]), damping: this.view(this.campbell, { x, y: y2 }, [plotWidth, 0.3 * plotHeight]) };
    const traces = [...rayTraces(files, settings, views.frequency)];
    for (const [chart, plot] of [["frequency", { xaxis: "x", yaxis: "y" }], ["damping", { xaxis: "x", yaxis: "y2" }]]) {
      this.lines[chart] = chartLines(files, chart, settings, views[chart], this.spacing());
      traces.push(...bandTraces(this.lines[chart], isActive, this.style, plot, errorScale(chart, settings)));
      traces.push(...modeTraces(this.lines[chart], isActive, this.style, plot), ...intervalTrace(files, chart, settings, isActive, plot));
      if (named) traces.push(markTrace(this.lines[chart], isActive, this.style, { chart, settings, plot }));
      traces.push(...this.eventTraces(chart, plot, views[chart]));
    }
    if (named) traces.push(nameTrace(this.lines.frequency, isActive, this.style, views.frequency, narrow));
    const layout = figureLayout({
      margin: { l: 58, r: right, t: 40 + (files.length > 1 ? 7 * files.length : 0), b: 46 }, shapes: rangeShapes(files),
      legend: { orientation: "h", x: 0, y: 1.01 + (files.length > 1 ? 0.012 * files.length : 0), yanchor: "bottom", font: { size: 11.5 } },
      xaxis: figureAxis(axisName(this.parameter), { range: x, anchor: "y2", zeroline: false }),
      yaxis: figureAxis(`${frequencyName(settings)}, ${settings.unit}`, { range: y, domain: [0.38, 1] }),
      yaxis2: figureAxis(settings.damping === "real" ? "Re s, 1/s" : "damping ratio", { range: y2, domain: [0, 0.3], zerolinewidth: 1.5 }),
    });
    Plotly.react(this.campbell, traces, layout, figureConfig("campbell"));
  }

  eventTraces(chart, plot, view) {
    const traces = eventTraces(this.files, chart, this.settings, this.isActive, { ...plot, view }, chart === "frequency");
    this.marks[chart] = traces.flatMap((trace) => trace.marks);
    for (const trace of traces) delete trace.marks;
    return traces;
  }

  frequencyRange() {
    const [, high] = this.wholeWindow("frequency").y;
    return [-0.02 * (high || 1), 1.06 * (high || 1)];
  }

  drawLocus() {
    const { settings, files, isActive } = this, width = this.locus.clientWidth, height = this.locus.clientHeight;
    const byParameter = settings.colourBy === "parameter";
    const whole = this.wholeWindow("locus"), zoom = this.zoom.locus;
    const largest = Math.max(...whole.y.map(Math.abs), ...whole.x.map(Math.abs), Number.MIN_VALUE);
    const flat = whole.x[1] - whole.x[0] < 1e-7 * largest ? [whole.x[0] - 1e-3 * largest, whole.x[1] + 1e-3 * largest] : whole.x;
    const x = zoom ? zoom.x : padded([Math.min(flat[0], 0), Math.max(flat[1], 0)], 0.05), y = zoom ? zoom.y : padded(whole.y, 0.04);
    const view = this.view(this.locus, { x, y }, [Math.max(width - (byParameter ? 150 : 80), 100), Math.max(height - 80, 100)]);
    this.lines.locus = chartLines(files, "locus", settings, view, this.spacing());
    const plot = { xaxis: "x", yaxis: "y" };
    const style = settings.colourBy === "mode" ? (file, mode) => ({ ...this.style(file, mode), colour: COLOURS[mode % COLOURS.length] }) : this.style;
    const traces = byParameter ? parameterTraces(this.lines.locus, isActive, this.range) : modeTraces(this.lines.locus, isActive, style, plot);
    traces.push(...endTraces(this.lines.locus, isActive), ...this.eventTraces("locus", plot, view));
    if (byParameter) traces.push(parameterScale(this.range, axisName(this.parameter)));
    const axis = { type: "line", xref: "x", yref: "y domain", x0: 0, x1: 0, y0: 0, y1: 1, line: { color: "#555", width: 1.2 }, layer: "below" };
    const layout = figureLayout({
      margin: { l: 58, r: byParameter ? 74 : 16, t: 40, b: 46 }, shapes: [axis],
      xaxis: figureAxis("Re s, 1/s", { range: x }), yaxis: figureAxis("Im s, rad/s", { range: y }),
    });
    Plotly.react(this.locus, traces, layout, figureConfig("root_locus"));
  }
}
