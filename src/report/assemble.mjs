// Inserts styles and scripts into the page: node assemble.mjs PAGE OUTPUT STYLES LIBRARY SCRIPTS...
import { readFileSync, writeFileSync } from "node:fs";

const [page, output, styles, library, ...scripts] = process.argv.slice(2);
const parts = { styles: [styles], library: [library], scripts };
const text = readFileSync(page, "utf8").replace(/<!-- insert (\S+) -->/g, (mark, name) => parts[name].map((file) => {
  const content = readFileSync(file, "utf8");
  if (/<\/(script|style)/i.test(content)) throw new Error(`${file}: would end the element that it stands in`);
  return content;
}).join("\n"));
writeFileSync(output, text);
