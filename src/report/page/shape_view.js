// Animation of a mode shape: a stick figure that can be rotated, or bars if the scene has no points and bodies.

const VIEWS = { "3D": [-0.6, 0.42], "x–y": [0, Math.PI / 2], "x–z": [0, 0], "y–z": [-Math.PI / 2, 0] };
const PERIOD = 2400;  // of the animation, ms

class ShapeView {
  constructor(files) {
    this.decoded = files.map((file) => (file.data.shapes ? new Shapes(file.data.shapes, file.data.modes.length) : null));
    this.files = files;
    this.turn = [...VIEWS["3D"]];
    this.amplitude = 1;
    this.phase = 0;
    this.playing = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.canvas = element("canvas", { tabindex: 0, role: "img", "aria-label": "motion of the mode; arrow keys turn the view", keydown: (event) => this.key(event) });
    this.caption = element("p", { class: "note", "aria-live": "polite" });
    this.modeSelect = element("select", { "aria-label": "mode", change: () => this.show(this.file, Number(this.modeSelect.value), this.place) });
    this.play = element("button", { type: "button", text: this.playing ? "Pause" : "Play", click: () => this.setPlaying(!this.playing) });
    const amplitude = element("input", { type: "range", min: 0, max: 3, step: 0.05, value: 1, "aria-label": "amplitude",
      input: () => { this.amplitude = Number(amplitude.value); this.paint(); } });
    this.viewButtons = Object.keys(VIEWS).map((name) => element("button", { type: "button", text: name, click: () => { this.turn = [...VIEWS[name]]; this.paint(); } }));
    this.node = element("div", { class: "shape" }, element("h3", { text: "Mode shape" }),
      element("div", { class: "controls" }, this.modeSelect, this.play, ...this.viewButtons, element("label", {}, "amplitude", amplitude)), this.canvas, this.caption);
    this.dragging();
    requestAnimationFrame((time) => this.frame(time));
  }

  setPlaying(playing) {
    this.playing = playing;
    this.play.textContent = playing ? "Pause" : "Play";
  }

  dragging() {
    let from = null;
    this.canvas.addEventListener("pointerdown", (event) => { from = [event.clientX, event.clientY]; this.canvas.setPointerCapture(event.pointerId); });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!from) return;
      this.turn[0] += (event.clientX - from[0]) * 0.01;
      this.turn[1] = Math.min(Math.max(this.turn[1] + (event.clientY - from[1]) * 0.01, -Math.PI / 2), Math.PI / 2);
      from = [event.clientX, event.clientY];
      this.paint();
    });
    for (const name of ["pointerup", "pointercancel"]) this.canvas.addEventListener(name, () => { from = null; });
  }

  key(event) {
    const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
    if (event.key === " ") this.setPlaying(!this.playing);
    else if (turns) this.turn = [this.turn[0] + turns[0], Math.min(Math.max(this.turn[1] + turns[1], -Math.PI / 2), Math.PI / 2)];
    else return;
    event.preventDefault();
    this.paint();
  }

  show(file, mode, place) {
    if (this.file !== file) this.modeSelect.replaceChildren(...file.data.modes.map((_, i) => element("option", { value: i, text: file.modeText(i) })));
    Object.assign(this, { file, mode, place });
    this.modeSelect.value = String(mode);
    this.shapes = this.decoded[file.index];
    for (const button of this.viewButtons) button.classList.toggle("hidden", !(this.shapes && this.shapes.geometry));
    if (!this.shapes) {
      this.caption.textContent = "The file has too many modes and coordinates for shapes in a page.";
      return this.paint();
    }
    this.row = this.shapes.nearest(file.path, place);
    const { name, unit } = file.data.parameter, all = this.shapes.nodes.length === file.path.nodes.length;
    this.exists = this.shapes.exists(this.row, mode);
    this.caption.textContent = `${file.modeText(mode)} at the stored point ${name} = ${withUnit(number(file.path.nodes[this.shapes.nodes[this.row]], 8), unit)}` +
      (all ? "" : `; shapes of ${this.shapes.nodes.length} of ${file.path.nodes.length} points are in this page`) + (this.exists ? "" : ": does not exist here");
    this.paint();
  }

  frame(time) {
    if (this.playing && this.shapes && !document.hidden) {
      this.phase = (2 * Math.PI * time) / PERIOD;
      this.paint();
    }
    requestAnimationFrame((next) => this.frame(next));
  }

  paint() {
    const { canvas } = this, ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width) return;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio))
      Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    if (!this.shapes || !this.exists) return;
    if (this.shapes.geometry) this.paintFigure(pen, width, height); else this.paintBars(pen, width, height);
  }

  // Stick figure.

  paintFigure(pen, width, height) {
    const { shapes, row, mode, turn } = this;
    const figure = shapes.figure(row, mode);
    const at = shapes.positions(row, mode, this.amplitude * figure.displacement, this.phase), rest = figure.rest;
    const [ca, sa, cb, sb] = [Math.cos(turn[0]), Math.sin(turn[0]), Math.cos(turn[1]), Math.sin(turn[1])];
    const flat = ([x, y, z]) => {
      const [u, v, w] = [x - figure.centre[0], y - figure.centre[1], z - figure.centre[2]];
      return [ca * u - sa * v, -(cb * w + sb * (sa * u + ca * v))];
    };
    const { scale, middle } = fitted(figure.extremes.map(flat), width, height, 0.3 * figure.radius);
    const project = (point) => flat(point).map((value, k) => (k ? height : width) / 2 + scale * (value - middle[k]));
    const line = (a, b, colour, thickness, dash = []) => {
      pen.strokeStyle = colour; pen.lineWidth = thickness; pen.setLineDash(dash);
      pen.beginPath(); pen.moveTo(...project(a)); pen.lineTo(...project(b)); pen.stroke();
      pen.setLineDash([]);
    };
    const dot = (a, radius, colour, fill = true) => {
      pen.beginPath(); pen.arc(...project(a), radius, 0, 2 * Math.PI);
      pen.fillStyle = pen.strokeStyle = colour; pen.lineWidth = 1.5;
      if (fill) pen.fill(); else pen.stroke();
    };
    this.paintAxes(pen, [ca, sa, cb, sb], height);
    for (const [positions, ghost] of [[rest, true], [at, false]]) this.paintParts(positions, ghost, line, dot, figure);
    this.paintNames(pen, at, project);
  }

  /** Draws the names of points and bodies beside their middle, where they do not overlap. */
  paintNames(pen, at, project) {
    const { carriers, places } = this.shapes.geometry, taken = [];
    if (carriers.length > 24) return;
    pen.font = "11.5px system-ui, sans-serif";
    pen.fillStyle = INK;
    carriers.forEach((carrier, i) => {
      const own = [at.origins[i], ...at.places.filter((_, k) => places[k].carrier === i)].map(project);
      const [x, y] = [0, 1].map((k) => own.reduce((sum, point) => sum + point[k], 0) / own.length + [8, -7][k]);
      const width = pen.measureText(carrier.name).width;
      if (taken.some(([a, b, c]) => x < b && x + width > a && Math.abs(y - c) < 12)) return;
      taken.push([x, x + width, y]);
      pen.fillText(carrier.name, x, y);
    });
  }

  paintParts(at, ghost, line, dot, figure) {
    const { geometry } = this.shapes, colour = (strong) => (ghost ? "#cfcfcf" : strong);
    geometry.places.forEach((place, i) => {
      if (place.carrier !== null) line(at.origins[place.carrier], at.places[i], colour("#0072b2"), 3);
    });
    for (const { kind, from, to } of geometry.lines) {
      const soft = kind.match(/spring|damper|bearing|damping/);
      line(at.places[from], at.places[to], colour(soft ? "#009e73" : INK), soft ? 1.5 : 2.2, soft ? [4, 3] : []);
      if (kind.match(/ball|revolute|universal|cylindrical|prismatic/)) dot(at.places[to], 3.5, colour(INK), false);
    }
    geometry.places.forEach((place, i) => { if (place.carrier === null) dot(at.places[i], 4, colour("#777"), false); });
    geometry.carriers.forEach((carrier, i) => {
      if (carrier.body)
        at.axes[i].forEach((axis, k) => line(at.origins[i], at.origins[i].map((x, j) => x + 0.1 * figure.radius * axis[j]), colour(["#d55e00", "#009e73", "#cc79a7"][k]), 1.5));
      dot(at.origins[i], carrier.body ? 3 : 6, colour("#0072b2"));
    });
  }

  /** Draws the axes of the frame in the lower left corner. */
  paintAxes(pen, [ca, sa, cb, sb], height) {
    const origin = [34, height - 34];
    [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]].forEach(([name, [u, v, w]]) => {
      const tip = [origin[0] + 24 * (ca * u - sa * v), origin[1] - 24 * (cb * w + sb * (sa * u + ca * v))];
      pen.strokeStyle = pen.fillStyle = "#777"; pen.lineWidth = 1.2;
      pen.beginPath(); pen.moveTo(...origin); pen.lineTo(...tip); pen.stroke();
      if (Math.hypot(tip[0] - origin[0], tip[1] - origin[1]) > 6) {
        pen.font = "12px system-ui, sans-serif";
        pen.fillText(name, tip[0] + 3, tip[1] - 3);
      }
    });
  }

  // Bars.

  paintBars(pen, width, height) {
    const { shapes, row, mode } = this, n = shapes.n, values = [];
    for (let i = 0; i < n; ++i) values.push(shapes.component(row, mode, i, this.phase));
    const left = 12, step = (width - 2 * left) / n, middle = height / 2, scale = 0.4 * height * Math.min(this.amplitude, 1.15);
    pen.strokeStyle = "#777"; pen.beginPath(); pen.moveTo(left, middle); pen.lineTo(width - left, middle); pen.stroke();
    pen.font = "11px system-ui, sans-serif"; pen.textAlign = "center";
    values.forEach((value, i) => {
      const x = left + (i + 0.5) * step, size = Math.hypot(...shapes.complex(row, mode, i)) * scale;
      pen.fillStyle = "#dfe7ee"; pen.fillRect(x - 0.3 * step, middle - size, 0.6 * step, 2 * size);
      pen.fillStyle = "#0072b2"; pen.fillRect(x - 0.3 * step, Math.min(middle, middle - value * scale), 0.6 * step, Math.abs(value * scale));
      if (n <= 16) { pen.fillStyle = INK; pen.fillText(this.file.data.coordinates[i], x, height - 8); }
    });
    pen.textAlign = "start";
  }
}

/** Scale and middle with which all points are visible, with a margin. The picture shows at least the extent `least`. */
function fitted(points, width, height, least) {
  const low = [0, 1].map((k) => Math.min(...points.map((p) => p[k]))), high = [0, 1].map((k) => Math.max(...points.map((p) => p[k])));
  const room = [width - 90, height - 70];
  const scale = Math.min(...room.map((size, k) => Math.max(size, 40) / Math.max(high[k] - low[k], least)));
  return { scale, middle: low.map((l, k) => (l + high[k]) / 2) };
}
