// Reads {tex, display} a line, answers {html} or {error} a line: node katex.js KATEX
const katex = require(process.argv[2]);
const { createInterface } = require('readline');

function answer({ tex, display }) {
  try {
    return { html: katex.renderToString(tex, { displayMode: display, throwOnError: true, strict: 'ignore' }) };
  } catch (error) {
    return { error: error.message };
  }
}

createInterface({ input: process.stdin }).on('line', (line) => console.log(JSON.stringify(answer(JSON.parse(line)))));
