"use strict";
// Elements and texts. What comes from a file becomes text nodes here, never markup.

/** An element with attributes (functions are listeners, "text" its text) and children. */
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

/** The number with so many significant digits, without zeros that say nothing. */
function number(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  return String(Number(value.toPrecision(digits))).replace("-", "−").replace("e−", "e-");
}

/** Real parts that count as zero everywhere in eigentrail are shown as zero. */
function complexText(real, imag, digits = 7) {
  if (Math.abs(real) < SAME_AS_ZERO * Math.abs(imag)) real = 0;
  return `${number(real, digits)} ${imag < 0 ? "−" : "+"} ${number(Math.abs(imag), digits)}j`;
}

/** For Plotly, which reads some markup in its texts. */
function plotText(text) {
  return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

function withUnit(text, unit) {
  return unit && unit !== "1" ? `${text} ${unit}` : text;
}

function axisName(axis) {
  return plotText(axis.unit && axis.unit !== "1" ? `${axis.name}, ${axis.unit}` : axis.name);
}
