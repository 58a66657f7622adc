// View of loci files with the same parameter: charts, the selected place and mode, mode shapes, events.

const REACH = 22;  // distance in px from the pointer within which a line is selected

class LociView extends LociCharts {
  constructor(datas) {
    super();
    let events = 0;
    this.files = datas.map((data, i) => {
      const file = new LociFile(data, i, events);
      events += data.events.length;
      return file;
    });
    const rays = this.files.find((file) => file.data.excitation);
    const asked = rays ? rays.data.excitation.harmonics : [];
    const { name: unit, factor } = this.files[0].data.frequency_unit;
    this.units = { [unit]: 1 / factor, ...FREQUENCY_UNITS };
    this.settings = { unit, unitFactor: 1 / factor, frequency: "imag", damping: "ratio", eventNames: true, colourBy: datas.length > 1 ? "file" : "parameter",
      logarithmic: false, realRoots: !this.files.some((file) => file.oscillates()), highest: null,
      harmonics: rays ? (asked.length ? asked : [1, 2, 3, 4]) : [], hasRays: Boolean(rays), raysAsked: asked.length > 0 };
    this.isolated = new Set();
    this.zoom = { campbell: null, locus: null };
    this.lines = {};
    this.marks = {};
    this.parameter = this.files[0].data.parameter;
    this.range = [Math.min(...this.files.map((file) => file.path.lowest)), Math.max(...this.files.map((file) => file.path.highest))];
    this.place = this.files.map(() => 0);
    this.current = { file: this.files[0], mode: 0 };
    this.isActive = ({ file, mode }) => this.isolated.size === 0 || this.isolated.has(`${file.index}/${mode}`);
    const whirls = this.files.some((file) => file.whirl);
    this.style = (file, mode) => (this.files.length > 1
      ? { colour: file.colour, symbol: SYMBOLS[file.index % SYMBOLS.length], width: file.index === 0 ? 2.4 : 1.6, dash: "solid" }
      : { colour: COLOURS[mode % COLOURS.length], symbol: SYMBOLS[(mode + Math.floor(mode / COLOURS.length)) % SYMBOLS.length], width: 2,
        dash: whirls ? "solid" : DASHES[Math.floor(mode / COLOURS.length) % DASHES.length] });
    this.build();
  }

  build() {
    this.campbell = element("div", { class: "chart campbell", role: "img", "aria-label": "Campbell diagram: frequency and damping against the parameter" });
    this.locus = element("div", { class: "chart locus", role: "img", "aria-label": "Root locus" });
    this.modeTable = new ModeTable(this.files, this.style, (file, mode, more) => this.toggle(file, mode, more));
    this.shape = new ShapeView(this.files);
    this.critical = element("div", { class: "critical" });
    this.node = element("section", { class: "loci" }, lociControls(this), element("div", { class: "charts" }, this.campbell, this.locus), lociKey(this), this.placeBar(),
      this.critical, element("div", { class: "pair" }, element("div", {}, element("h3", { text: "Modes" }), this.modeTable.node,
        element("p", { class: "note", text: "Click a line, or a mode here, to isolate it; again to release it. Shift adds further ones." })), this.shape.node),
      element("h3", { text: "Events" }), eventTable(this.files, (file, event) => this.showEvent(file, event)),
      element("h3", { text: "Stable ranges" }), rangeTable(this.files));
  }

  start() {
    this.draw();
    for (const [figure, charts] of [[this.campbell, ["frequency", "damping"]], [this.locus, ["locus"]]]) this.listen(figure, charts);
    const first = this.files[0], begin = first.path.placesOf(this.range[0])[0] ?? 0;
    this.moveTo(first, begin, Math.max(first.data.modes.findIndex((_, mode) => !first.isReal(mode, begin)), 0));
    let width = this.node.clientWidth;
    new ResizeObserver(() => { if (width !== (width = this.node.clientWidth)) this.laterDraw(); }).observe(this.node);
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
      this.place[other.index] = places.length ? leastOf(places, (there) => Math.abs(there - before)) : null;
    }
    this.showPlace();
  }

  showPlace() {
    const { file, mode } = this.current, place = this.place[file.index] ?? 0;
    this.slider.value = (2000 * place) / file.path.length;
    this.value.value = number(file.parameterValue(file.path.parameterAt(place)), 10).replace("−", "-");
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
      const hidden = s && !this.settings.realRoots && figure === this.campbell && file.isReal(mode, place);
      for (const chart of s && !hidden ? charts : []) {
        const { xaxis, yaxis } = CHARTS[chart];
        const at = toPixels(figure, xaxis, yaxis, ...projection(chart, file, this.settings)(place, s));
        if (insideAxes(figure, xaxis, yaxis, at)) figure.append(element("div", { class: "overlay-dot", style: `left:${at[0]}px;top:${at[1]}px` }));
      }
    }
  }

  showEvent(file, event) {
    const places = file.path.placesOf(event.parameter);
    const node = event.node >= 0 && event.node < file.path.places.length ? file.path.places[event.node] : 0;
    const place = places.length ? leastOf(places, (there) => Math.abs(there - node)) : node;
    this.isolate(file, event.modes, place);
  }

  showCrossing({ file, mode, place }) { this.isolate(file, [mode], place); }

  isolate(file, modes, place) {
    this.isolated = new Set(modes.map((mode) => `${file.index}/${mode}`));
    this.moveTo(file, place, modes[0] ?? 0);
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
      this.highlight(figure, hit && hit.line);
      if (hit) this.fillTip(tip, figure, hit);
    }, true);
    figure.addEventListener("pointerleave", () => { tip.classList.add("hidden"); this.highlight(figure, null); });
    figure.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; }, true);
    window.addEventListener("pointerup", (event) => {
      const still = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 5;
      down = null;
      const hit = still ? nearest(event) : null;
      if (!hit) return;
      if (hit.mark) return void (hit.mark.event ? this.showEvent(hit.mark.file, hit.mark.event) : this.showCrossing(hit.mark.crossing));
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

  /** Draws a broad band over a line of a figure and marks its row in the table; no line: removes them. */
  highlight(figure, line) {
    figure.querySelectorAll(".overlay-line").forEach((node) => node.remove());
    this.modeTable.mark(line);
    if (!line) return;
    const points = Array.from({ length: line.points.length }, (_, i) => `${line.pixels[2 * i].toFixed(1)},${line.pixels[2 * i + 1].toFixed(1)}`);
    figure.append(overlayLine(figure, points.join(" "), this.style(line.file, line.mode).colour));
  }

  eventTexts({ file, event, crossing }) {
    if (crossing) return this.crossingTexts(crossing);
    return [`${file.eventNumber(event)} ${event.kind}`, this.files.length > 1 ? file.data.name : "",
      `${this.parameter.name} = ${withUnit(number(file.parameterValue(event.parameter), 10), this.parameter.unit)}`, `s = ${file.eigenvalueText(event.real, event.imag, 8)} 1/s`,
      event.modes.map((mode) => file.modeText(mode)).join(" and "), event.remark, intervalText(event)];
  }

  crossingTexts(crossing) {
    const { file, mode, place, harmonic, s, parameter } = crossing, separation = separationOf(crossing);
    return [`critical speed ${number(harmonic)}×`, this.files.length > 1 ? file.data.name : "", `${this.parameter.name} = ${withUnit(number(parameter, 10), this.parameter.unit)}`,
      `${frequencyName(this.settings)} = ${number(frequencyOf(s, this.settings), 8)} ${this.settings.unit}`, file.modeText(mode), dampingText(...s), file.whirlText(mode, place),
      separation ? separationText(crossing) : ""];
  }

  lineTexts({ line, place }) {
    const { file, mode } = line, s = file.path.eigenvalue(mode, place);
    if (!s) return null;
    const settings = this.settings, whirl = file.whirlText(mode, place);
    return [file.modeText(mode), this.files.length > 1 ? file.data.name : "",
      `${this.parameter.name} = ${withUnit(number(file.parameterValue(file.path.parameterAt(place)), 8), this.parameter.unit)}`,
      `s = ${file.eigenvalueText(...s, 8)} 1/s`,
      `${frequencyName(settings)} = ${number(frequencyOf(s, settings), 8)} ${settings.unit}`,
      dampingText(...s), whirl && `whirls ${whirl}`, this.errorText(file, mode, place), file.isCertified(mode, place) ? "" : "identity not certified here"];
  }

  errorText(file, mode, place) {
    const errors = file.errors[mode], error = errors ? errors[file.path.stepOf(place)] : NaN;
    return Number.isFinite(error) ? `error of the data up to ${number(error, 2)} 1/s` : "";
  }
}
