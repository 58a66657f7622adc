"use strict";
// Creates elements and texts. Texts from files become text nodes, never markup.

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

const SAME_AS_ZERO = 1e-9;

/** A number with this many significant digits, without trailing zeros. */
function number(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  return String(Number(value.toPrecision(digits))).replace("-", "−").replace("e−", "e-");
}

/** A complex number. Real parts below 1e-9 of the imaginary part are rounding, as in the stability analysis, and shown as zero. */
function complexText(real, imag, digits = 7) {
  if (Math.abs(real) < SAME_AS_ZERO * Math.abs(imag)) real = 0;
  return `${number(real, digits)} ${imag < 0 ? "−" : "+"} ${number(Math.abs(imag), digits)}j`;
}

/** What the frequency axis shows, by its name. */
const frequencyName = (settings) => (settings.frequency === "abs" ? "natural frequency abs(s)" : "damped frequency Im s");

/** Damping ratio and logarithmic decrement of an eigenvalue, which a real one does not have. */
function dampingText(real, imag) {
  const decrement = imag === 0 ? "" : `, logarithmic decrement ${number((-2 * Math.PI * real) / Math.abs(imag), 6)}`;
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
