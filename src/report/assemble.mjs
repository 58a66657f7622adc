// Inserts styles and scripts into the page: node assemble.mjs PAGE OUTPUT FILE...
// Each <!-- insert NAME --> in the page is replaced by the contents of the FILE of that name.
import { basename } from "node:path";
import { readFileSync, writeFileSync } from "node:fs";

const [page, output, ...files] = process.argv.slice(2);
const contents = new Map(files.map((file) => [basename(file), readFileSync(file, "utf8")]));
const missing = [];
const used = new Set();
const text = readFileSync(page, "utf8").replace(/<!-- insert (\S+) -->/g, (mark, name) => {
  if (!contents.has(name)) missing.push(name);
  used.add(name);
  return contents.get(name);
});
const unused = [...contents.keys()].filter((name) => !used.has(name));
if (missing.length || unused.length)
  throw new Error(`${page}: not given: ${missing.join(", ") || "none"}; not inserted: ${unused.join(", ") || "none"}`);
for (const [name, content] of contents)
  if (/<\/(script|style)/i.test(content)) throw new Error(`${name}: would end the element that it stands in`);
writeFileSync(output, text);
