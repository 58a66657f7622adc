// Writes the manual page from the output of the program's --help: node manual.mjs PROGRAM VERSION OUTPUT.gz
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const [program, version, output] = process.argv.slice(2);
const help = (...words) => execFileSync(program, [...words, "--help"], { encoding: "utf8" }).trimEnd().split("\n");

/// The text with escapes, so that troff prints it unchanged.
const plain = (text) => text.replace(/\\/g, "\\e").replace(/-/g, "\\-").replace(/^([.'])/, "\\&$1");

/// The sections of a help text as { heading, lines }. Lines that do not belong to a heading have an empty one.
function sections(lines) {
  const result = [{ heading: "", lines: [] }];
  for (const line of lines) {
    const heading = line.match(/^(\w[\w ]*):$/);
    if (heading) result.push({ heading: heading[1], lines: [] });
    else if (line === "" && result.at(-1).heading) result.push({ heading: "", lines: [] });
    else result.at(-1).lines.push(line);
  }
  return result.filter((section) => section.heading || section.lines.some((line) => line !== ""));
}

/// What lines "  name   text" list, as { name, text }. The text goes on in the lines below, after a long name it begins there.
function items(lines) {
  const result = [];
  for (const line of lines) {
    const [, name, text] = line.match(/^ {2}(\S.*?)(?: {2,}(.*))?$/) ?? [];
    if (name) result.push({ name, text: text ? [text] : [] });
    else result.at(-1).text.push(line.trim());
  }
  return result.map(({ name, text }) => ({ name, text: text.join(" ") }));
}

const tagged = (lines) => items(lines).flatMap(({ name, text }) => [".TP", `.B ${plain(name)}`, plain(text)]);

/// Converts indented lines to preformatted ones and all others to paragraphs, which end where a line is empty or indented.
function paragraphs(lines) {
  const result = [], isIndented = (line) => line.startsWith("  ");
  lines.forEach((line, i) => {
    if (isIndented(line)) result.push(".nf", plain(line), ".fi");
    else if (line !== "") result.push(...(i > 0 && lines[i - 1] !== "" && !isIndented(lines[i - 1]) ? [] : [".PP"]), plain(line));
  });
  return result;
}

function command(name, about) {
  const [head, ...rest] = sections(help(name));
  const usage = head.lines.find((line) => line.startsWith("Usage: ")).slice("Usage: ".length);
  const lists = ["Positionals", "Options"];
  const body = rest.flatMap(({ heading, lines }) =>
    lists.includes(heading)
      ? tagged(lines.filter((line) => !/^ {2}-h,--help /.test(line)))
      : paragraphs(heading ? [`${heading}:`, ...lines] : lines),
  );
  return [`.SS ${name}`, plain(about), ".PP", `.B ${plain(usage)}`, ...body];
}

const [head, ...rest] = sections(help());
const about = head.lines.slice(0, head.lines.findIndex((line) => line.startsWith("Usage: "))).join(" ");
const commands = items(rest.find((section) => section.heading === "Subcommands").lines);
const ends = rest.filter((section) => !section.heading).flatMap((section) => section.lines).join(" ");
const page = [
  `.TH EIGENTRAIL 1 "" "eigentrail ${version}" "User Commands"`,
  ".SH NAME",
  `eigentrail \\- ${plain(about.replace(/^F/, "f").replace(/\.$/, ""))}`,
  ".SH SYNOPSIS",
  ".B eigentrail",
  ".I COMMAND",
  "[\\fIOPTIONS\\fR]",
  ".PP",
  ".B eigentrail",
  "[\\fICOMMAND\\fR]",
  ".B \\-\\-help",
  ".SH DESCRIPTION",
  plain(about),
  "A scene file says what the system is and which parameter changes; the result is a file of labelled loci of known accuracy.",
  "Begin with",
  ".BR \"eigentrail new my_scene.toml\" .",
  ".SH COMMANDS",
  ...commands.flatMap(({ name, text }) => command(name, text)),
  ".SH EXIT STATUS",
  plain(ends.replace(/^Exit codes: /, "")),
  "",
];
writeFileSync(output, gzipSync(page.join("\n"), { level: 9 }));
