#include "parts.hpp"

#include <cstdio>
#include <cstdlib>

#include "check_output.hpp"
#include "eigentrail/store/output_file.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {

void add_part(CLI::App& command, std::optional<Part>& part) {
  command.add_option_function<std::string>(
      "--part", [&part](const std::string& text) { part = read_part(text); },
      "i/N: compute part i of N only and write it to a file of its own; eigentrail merge joins the parts");
}

std::string default_output(const std::string& scene, const std::string& ending,
                           const std::optional<Part>& part) {
  if (!part) return beside(scene, ending + ".h5");
  return beside(
      scene, ending + ".part-" + std::to_string(part->number) + "-of-" + std::to_string(part->count) + ".h5");
}

void check_part_output(const OutputChoice& output) {
  check_output(output.path, output.force, {part_format, "part of a run"});
  check_can_create(output.path);
}

void write_part(const OutputChoice& output, SharedRun run, const Part& part,
                std::vector<std::string> pieces) {
  const std::size_t computed = pieces.size(), all = run.n_pieces;
  eigentrail::write_part({output.path, std::move(run), part, std::move(pieces)}, existing(output.force));
  if (output.quiet) return;
  std::printf("wrote %s: part %d of %d, %zu of %zu pieces; eigentrail merge joins the parts\n",
              output.path.c_str(), part.number, part.count, computed, all);
}

double number_of(const SharedRun& run, const std::string& label) {
  return std::strtod(run.setting(label).value_or("nan").c_str(), nullptr);
}

}  // namespace eigentrail::app
