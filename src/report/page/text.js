// Creates elements and texts, and groups items. Texts from files become text nodes, never markup.

/** Creates an element with children. Attributes that are functions become listeners; "text" is the text content. */
function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (typeof value === "function") node.addEventListener(name, value);
    else if (name === "text") node.textContent = value;
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children);
  return node;
}

/** A list of choices { value: text }, which calls `change` with the value. */
function selectControl(label, options, value, change) {
  const node = element("select", { change: () => change(node.value) }, ...Object.entries(options).map(([key, text]) =>
    element("option", { value: key, text, selected: key === value })));
  return element("label", {}, label, node);
}

const SAME_AS_ZERO = 1e-9;

/** A number with this many significant digits, without trailing zeros. */
function number(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";  // not −0
  return String(Number(value.toPrecision(digits))).replace("-", "−").replace("e−", "e-");
}

/** Parts of a complex number below 1e-9 of its size, or of `reference`, are rounding, as in the stability analysis: zero. */
function withoutRounding(real, imag, reference = 0) {
  const least = SAME_AS_ZERO * Math.max(Math.abs(real), Math.abs(imag), reference);
  return [Math.abs(real) < least ? 0 : real, Math.abs(imag) < least ? 0 : imag];
}

/** A complex number without rounding. */
function complexText(real, imag, digits = 7, reference = 0) {
  [real, imag] = withoutRounding(real, imag, reference);
  return `${number(real, digits)} ${imag < 0 ? "−" : "+"} ${number(Math.abs(imag), digits)}j`;
}

/** What the frequency axis shows, by its name. */
const frequencyName = (settings) => (settings.frequency === "abs" ? "natural frequency abs(s)" : "damped frequency Im s");

/** The frequency of an eigenvalue in the unit of the settings. */
const frequencyOf = (s, settings) => (settings.frequency === "abs" ? Math.hypot(...s) : Math.abs(s[1])) * settings.unitFactor;

/** −2π Re s/abs(Im s); NaN of a real eigenvalue, which has none. */
function logDecrement(re, im) {
  const [real, imag] = withoutRounding(re, im);
  return imag === 0 ? NaN : (-2 * Math.PI * real) / Math.abs(imag);
}

/** Damping ratio and logarithmic decrement of an eigenvalue, which a real one does not have. */
function dampingText(real, imag) {
  const value = logDecrement(real, imag), decrement = Number.isNaN(value) ? "" : `, logarithmic decrement ${number(value, 6)}`;
  return `damping ratio ${number(dampingRatio(real, imag), 6)}${decrement}`;
}

/** Escapes a text for Plotly, which interprets some markup in texts. */
function plotText(text) {
  return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

function withUnit(text, unit) {
  return unit && unit !== "1" ? `${text} ${unit}` : text;
}

function axisName(axis) {
  return plotText(axis.unit && axis.unit !== "1" ? `${axis.name}, ${axis.unit}` : axis.name);
}

/** The first item of a list with the least value. */
const leastOf = (items, value) => items.reduce((a, b) => (value(b) < value(a) ? b : a));

/** Groups of items with the same key, in the order of their first items. */
const grouped = (items, key) => {
  const groups = new Map();
  for (const item of items) {
    const name = JSON.stringify(key(item));
    groups.has(name) ? groups.get(name).push(item) : groups.set(name, [item]);
  }
  return [...groups.values()];
};
