// Tables and lists beside the figures.

function table(heads, rows, caption) {
  const head = element("tr", {}, ...heads.map((text) => element("th", { scope: "col", text })));
  for (const row of rows) [...row.children].forEach((node, i) => { if (heads[i] && !node.querySelector("button")) node.dataset.head = heads[i]; });
  const body = element("table", { "aria-label": caption }, element("thead", {}, head), element("tbody", {}, ...rows));
  return element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption }, body);
}

const cell = (content, kind) => element("td", kind ? { class: kind } : {}, content);

/** "between 12.2 and 24"; empty for events without an interval. */
const intervalText = ({ interval }) => (interval && interval[0] < interval[1] ? `between ${number(interval[0], 6)} and ${number(interval[1], 6)}` : "");

/** Table of the events of all files; selecting one moves the view to it. */
function eventTable(files, choose) {
  const several = files.length > 1, resonates = files.some((file) => file.data.events.some((event) => event.kind === "resonance"));
  const rows = files.flatMap((file) => file.data.events.map((event) => {
    const modes = event.modes.map((mode) => file.modeText(mode)).join(", ");
    return element("tr", {},
      cell(element("button", { type: "button", text: file.eventNumber(event), click: () => choose(file, event), title: "show it" })),
      ...(several ? [cell(file.data.name)] : []),
      cell(event.kind), ...(resonates ? [cell(event.kind === "resonance" ? `${number(event.value)}×` : "–")] : []), cell(number(file.parameterValue(event.parameter), 12), "value"),
      cell(event.real === null ? "–" : file.eigenvalueText(event.real, event.imag, 9), "value"), cell(modes, "words"), cell([event.remark, intervalText(event)].filter(Boolean).join(", "), "words"));
  }));
  if (!rows.length) return element("p", { class: "note", text: "No special points on the traced range." });
  const { name, unit } = files[0].data.parameter;
  return table(["", ...(several ? ["file"] : []), "kind", ...(resonates ? ["harmonic"] : []), withUnit(name, unit === "1" ? "" : `(${unit})`), "s, 1/s", "modes", "remark"], rows, "Events");
}

function rangeEnd(file, end, kind) {
  const mode = end.mode ? `, ${file.modeText(end.mode - 1)}` : "";
  const margin = kind === "stable" && end.margin ? `, margin ${number(end.margin, 4)}` : "";
  return `${number(file.parameterValue(end.parameter), 12)} (${end.cause}${mode}${margin})`;
}

function rangeTable(files) {
  const several = files.length > 1;
  const rows = files.flatMap((file) => (file.data.ranges || []).map((range) => element("tr", {},
    ...(several ? [cell(file.data.name)] : []), cell(range.whole_model ? range.kind : `${range.kind} among the followed modes`), cell(rangeEnd(file, range.from, range.kind), "words"), cell(rangeEnd(file, range.to, range.kind), "words"),
    cell(range.kind === "stable" ? `${number(range.least_margin, 4)} to ${number(range.largest_margin, 4)}, largest at ${number(file.parameterValue(range.largest_at), 6)}` : "", "words"))));
  if (files.every((file) => !file.data.ranges)) return element("p", { class: "note", text: "The trace ended before stable ranges were written." });
  if (!rows.length) return element("p", { class: "note", text: "No stable range: some mode grows everywhere." });
  return table([...(several ? ["file"] : []), "kind", "from", "to", "margin −max Re s, 1/s"], rows, "Stable ranges");
}

/** Table of the modes: a button that isolates the mode, its values at the selected place, its certified share. */
class ModeTable {
  constructor(files, style, toggle) {
    const several = files.length > 1, named = files.some((file) => file.data.modes.some((mode) => mode.name));
    this.entries = files.flatMap((file) => file.data.modes.map((mode, i) => {
      const button = element("button", { type: "button", "aria-pressed": "false", text: mode.label, title: "isolate, again to release",
        click: (event) => toggle(file, i, event.shiftKey || event.ctrlKey || event.metaKey) });
      const { colour, symbol, dash } = style(file, i);
      const values = ["s", "frequency", "damping"].map(() => element("td", { class: "value" }));
      const share = mode.certified === null ? "–" : `${number(100 * mode.certified, 4)} %`;
      const row = element("tr", {}, element("td", {}, swatch(colour, symbol, dash), button), ...(several ? [cell(file.data.name)] : []),
        ...(named ? [cell(mode.name || "–", "words")] : []), ...values, cell(share, "value"));
      return { file, mode: i, button, values, row };
    }));
    this.node = table(["mode", ...(several ? ["file"] : []), ...(named ? ["what moves"] : []), "s, 1/s", "frequency", "damping", "certified"],
      this.entries.map((entry) => entry.row), "Modes");
    this.frequencyHead = this.node.querySelectorAll("th")[2 + several + named];
  }

  update(place, settings, isActive, isIsolated) {
    this.frequencyHead.textContent = `${settings.frequency === "abs" ? "natural" : "damped"} frequency, ${settings.unit}`;
    for (const { file, mode, button, values, row } of this.entries) {
      const at = place(file), s = at === null ? null : file.path.eigenvalue(mode, at);
      const isReal = at !== null && file.isReal(mode, at);
      const texts = s ? [file.eigenvalueText(...s, 6), isReal ? "real root" : number(file.frequency(s, settings), 7), isReal ? "–" : number(dampingRatio(...s), 4)] : ["–", "–", "–"];
      values.forEach((node, i) => { node.textContent = texts[i]; });
      values[1].dataset.head = this.frequencyHead.textContent;
      button.setAttribute("aria-pressed", String(isIsolated(file, mode)));
      row.classList.toggle("dim", !isActive({ file, mode }));
    }
  }

  /** Marks the row of a line { file, mode }; none for null. */
  mark(line) {
    for (const { file, mode, row } of this.entries) row.classList.toggle("pointed", Boolean(line) && line.file === file && line.mode === mode);
  }
}

/** How a file was made: the most important attributes first, then all. */
function runDetails(file) {
  const attributes = file.attributes;
  const first = ["status", "message", "notes", "tolerance", "series_order", "seconds", "program_version", "parameter"];
  const names = [...first.filter((name) => attributes[name]), ...Object.keys(attributes).filter((name) => !first.includes(name)).sort()];
  const list = element("dl", {}, ...names.flatMap((name) => [element("dt", { text: name }), element("dd", { text: attributes[name] })]));
  return element("details", {}, element("summary", { text: `The run: ${file.name}` }), list);
}

function sceneDetails(file) {
  return element("details", {}, element("summary", { text: `The scene: ${file.attributes.scene_path || file.name}` }), element("pre", { text: file.scene, tabindex: 0 }));
}
