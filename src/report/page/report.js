// Builds the page from the data in it.

const PAPER = { width: "690px", height: "480px" };

function summary(file) {
  const { attributes } = file, message = attributes.message ? `: ${attributes.message}` : "";
  const what = { boundary: "stability boundary", map: "stability map", accuracy: "accuracy study" }[file.kind];
  if (what) return `${file.name}: ${what}${attributes.status ? `, ${attributes.status}` : ""}${message}`;
  const { parameter, curves } = file, nodes = float64(curves.nodes.parameter);
  return `${file.name}: ${parameter.name} ${number(nodes[0], 8)} → ${withUnit(number(nodes[nodes.length - 1], 8), parameter.unit)}, ` +
    `${nodes.length} points, ${file.modes.length} modes, tolerance ${attributes.tolerance || "?"}, ${attributes.status || "status unknown"}${message}`;
}

/** Changes the width of the figures from that of the window to that of the sheet while the page is printed. */
function fitToPaper(views) {
  const resize = (size) => {
    for (const chart of document.querySelectorAll(".chart")) {
      Object.assign(chart.style, size);
      Plotly.Plots.resize(chart);
    }
    for (const view of views) view.draw();
  };
  window.addEventListener("beforeprint", () => resize(PAPER));
  window.addEventListener("afterprint", () => resize({ width: "", height: "" }));
}

function startReport() {
  const { files, program_version: version } = JSON.parse(document.getElementById("data").textContent);
  const titles = [...new Set(files.map((file) => file.title).filter(Boolean))];
  const title = titles.join(" · ") || files.map((file) => file.name).join(", ");
  document.title = `${title} – eigentrail`;
  const of = (...kinds) => files.filter((file) => kinds.includes(file.kind));
  const notes = files.filter((file) => file.attributes.notes).map((file) => element("p", { text: `Note on ${file.name}: ${file.attributes.notes}` }));
  document.getElementById("header").append(element("h1", { text: title }), ...files.map((file) => element("p", { text: summary(file) })), ...notes);

  const loci = grouped(of("loci"), (file) => [file.parameter.name, file.parameter.unit]).map((group) => new LociView(group));
  const planes = grouped(of("boundary", "map"), (file) => [file.first.name, file.first.unit, file.second.name, file.second.unit]).map((group) => new PlaneView(group));
  const studies = of("accuracy").map((file) => new AccuracyView(file));
  const views = [...loci, ...planes, ...studies];
  document.getElementById("main").replaceChildren(...views.map((view) => view.node), element("h2", { text: "Runs and scenes" }),
    ...files.flatMap((file) => [runDetails(file), ...(file.scene ? [sceneDetails(file)] : [])]));
  document.getElementById("footer").append(`Written by eigentrail ${version}. Curves are the dense output of the traces; drawn with plotly.js (MIT).`);
  for (const view of views) view.start();
  fitToPaper(views);
  return {
    views, loci,
    /** For the browser's console: report.eval(12.5) returns the same eigenvalues as `eigentrail eval`. */
    eval(value, file = 0) {
      const { path, data } = loci.flatMap((view) => view.files)[file];
      return path.placesOf(value).flatMap((place) => data.modes.flatMap((mode, i) => {
        const s = path.eigenvalue(i, place);
        return s ? [{ parameter: value, mode: mode.label, real: s[0], imag: s[1] }] : [];
      }));
    },
  };
}

try {
  window.report = startReport();
} catch (error) {
  document.getElementById("main").prepend(element("p", { class: "error", text: `This page could not be drawn: ${error.message}` }));
  throw error;
}
