// The controls above the charts of a LociView, and the key below them.

function checkControl(label, checked, change, title) {
  const node = element("input", { type: "checkbox", checked, change: () => change(node.checked) });
  return element("label", { title }, node, label);
}

function lociControls(view) {
  const { settings, files, units } = view;
  const apply = (changes) => { Object.assign(settings, changes); view.zoom.campbell = null; view.zoom.locus = null; view.draw(); view.showPlace(); };
  const set = (name) => (value) => apply({ [name]: value });
  const harmonics = element("input", { type: "text", value: settings.harmonics.join(", "), "aria-label": "harmonics of the excitation",
    change: () => {
      const typed = harmonics.value.split(/[\s,;×x]+/).map(Number).filter((n) => Number.isFinite(n) && n > 0);
      harmonics.value = typed.join(", ");
      apply({ harmonics: [...new Set(typed)], raysAsked: true });
    } });
  const highest = element("input", { type: "text", inputmode: "decimal", class: "short", placeholder: "all", "aria-label": "highest frequency shown",
    change: () => {
      const value = Number(highest.value.replace(",", "."));
      if (!(value > 0)) highest.value = "";
      apply({ highest: value > 0 ? value : null });
    } });
  const colours = files.length > 1 ? { file: "file", parameter: "parameter", mode: "mode" } : { parameter: "parameter", mode: "mode" };
  return element("div", { class: "controls" },
    selectControl("Frequency", { imag: "damped, Im s", abs: "natural, abs(s)" }, "imag", set("frequency")),
    selectControl("in", Object.fromEntries(Object.keys(units).map((unit) => [unit, unit === "rpm" ? "rpm (cpm)" : unit])), settings.unit, (unit) => {
      highest.value = "";
      apply({ unit, unitFactor: units[unit], highest: null });
    }),
    element("label", { title: "highest frequency of the diagram, in its unit; empty: all modes, or up to the highest ray" }, "up to", highest),
    checkControl("log", false, set("logarithmic"), "logarithmic frequencies"),
    selectControl("Damping", { ratio: "ratio −Re s/abs(s)", real: "Re s" }, "ratio", set("damping")),
    checkControl("real roots", settings.realRoots, set("realRoots"), "modes without a frequency in the Campbell diagram, too"),
    ...(settings.hasRays ? [element("label", { title: "rays: multiples of the excitation frequency" }, "Harmonics", harmonics)] : []),
    selectControl("Locus coloured by", colours, settings.colourBy, (value) => { settings.colourBy = value; view.draw(); }),
    checkControl("names of events", true, (value) => { settings.eventNames = value; view.draw(); }),
    element("button", { type: "button", text: "Release all modes", click: () => { view.isolated.clear(); view.draw(); view.showPlace(); } }));
}

/** What colours, strips and styles of lines mean. */
function lociKey(view) {
  const { files, settings, style } = view, several = files.length > 1;
  const has = (test) => files.some(test);
  const ranges = (kind, whole = true) => has((file) => (file.data.ranges || []).some((range) => range.kind === kind && range.whole_model === whole));
  const operates = files.find((file) => file.operating.ranges.length), margin = operates && operates.operating.margin;
  const item = (kind, text) => element("span", {}, element("i", { class: kind }), text);
  const entries = [
    ...(several ? files.map((file) => element("span", {}, swatch(file.colour, style(file, 0).symbol), file.data.name)) : []),
    several && (ranges("stable") || ranges("marginal") || ranges("undecided")) && element("span", { text: "strips above: no mode grows (pale: marginal; palest: undecided)" }),
    !several && ranges("stable") && item("stable", "stable: all modes decay"),
    !several && ranges("marginal") && item("marginal", "marginal: none grows, some stay on the imaginary axis"),
    !several && (ranges("stable", false) || ranges("marginal", false)) && item("partial", "no followed mode grows; others are not known"),
    !several && ranges("undecided") && item("undecided", "undecided: the errors of the data leave it open"),
    operates && item("operating", "operating range"),
    operates && item("margin", `separation margin ${margin === null ? "by API 684, for the amplification factors found" : percent(margin)}`),
    has((file) => file.data.modes.some((mode) => mode.errors)) && item("band", "bands and bars: errors of the data"),
    (ranges("stable") || ranges("marginal")) && has((file) => file.path.turnsBack) && element("span", { text: "the path turns back: shaded where one passage is so" }),
    has((file) => file.whirl) && item("solid", "forward whirl, mixed, or in a plane"),
    has((file) => file.whirl) && item("dashed", "backward whirl"),
    !several && !has((file) => file.whirl) && files[0].data.modes.length > COLOURS.length && element("span", { text: "colours repeat from mode 8 on, with other dashes and marks" }),
    has((file) => file.data.modes.some((mode) => mode.uncertified.length)) && item("doubtful", "identity of the mode not certified"),
    settings.hasRays && item("ray", "n×: harmonics of the excitation"),
    settings.hasRays && element("span", {}, element("i", { class: "crossing", text: "◇" }), "critical speed"),
    element("span", { text: "root locus: ○ begins, ● ends; upper half plane" })];
  return element("div", { class: "key" }, ...entries.filter(Boolean));
}
