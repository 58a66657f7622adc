// Inserts styles and scripts into the page: node assemble.mjs PAGE OUTPUT LIBRARY
// Each <!-- insert NAME --> in the page is replaced by the LIBRARY, or the file beside the page, of that name.
import { basename, dirname, join } from "node:path";
import { readFileSync, writeFileSync } from "node:fs";

const [page, output, library] = process.argv.slice(2);
const text = readFileSync(page, "utf8").replace(/<!-- insert (\S+) -->/g, (mark, name) => {
  const content = readFileSync(name === basename(library) ? library : join(dirname(page), name), "utf8");
  if (/<\/(script|style)/i.test(content)) throw new Error(`${name}: would end the element that it stands in`);
  return content;
});
writeFileSync(output, text);
