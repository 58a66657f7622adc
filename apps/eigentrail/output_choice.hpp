// Where and how a command writes its output, and what it may replace there.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <optional>
#include <string>

#include "eigentrail/core/workers.hpp"
#include "eigentrail/store/output_file.hpp"
#include "records.hpp"

namespace eigentrail::app {

struct OutputChoice {
  std::string path;
  bool force = false;
  bool resume = false;
  bool quiet = false;
  std::optional<Part> part;            ///< only this part of the run is computed, and written
  const CLI::Option* given = nullptr;  ///< the option that names it

  /// Names an output that was not given: like `source`, with another ending, in the folder in which the
  /// program runs: SCENE_map.h5, or SCENE_map.part-2-of-5.h5 for a part.
  void name_like(const std::string& source, const std::string& ending, const std::string& extension = "");

  /// What writing does to a file that is there.
  Existing existing() const { return force ? Existing::replace : Existing::keep; }
};

/// The ending of a part: "part-2-of-5".
std::string part_ending(const Part& part);

/// Adds -o, which is returned.
CLI::Option* add_output(CLI::App& command, OutputChoice& output, const std::string& help);

/// Help of the flags that belong to an output; an empty text: there is no such flag.
struct OutputFlags {
  std::string force = "replace an existing output";
  std::string resume = "go on with a run that was interrupted; begin where there is none";
  std::string quiet = "no progress bar, no summary";
};

/// Adds --force, --resume and --quiet, which is returned.
CLI::Option* add_output_flags(CLI::App& command, OutputChoice& output, const OutputFlags& help = {});

/// Adds --part.
void add_part(CLI::App& command, OutputChoice& output);

/// Adds --csv and --json, which are returned; one excludes the other.
std::array<CLI::Option*, 2> add_formats(CLI::App& command, PrintedFormat& format,
                                        const std::string& csv_help);

/// A format of output files.
struct OutputFormat {
  std::string name;                                        ///< for messages: "report"
  std::function<bool(const std::string& path)> is_format;  ///< whether an existing file has it
};

/// An HDF5 file with this attribute "format".
OutputFormat hdf5_format(const std::string& attribute, const std::string& name);

/// Throws InputError if `path` is empty, is a folder, lies in a folder that does not exist, or is an existing
/// file that may not be replaced. An existing file may be replaced only with `force`, and only if it has the
/// same format.
void check_output(const std::string& path, bool force, const OutputFormat& format);

/// The same, and throws InputError if no file can be created there.
void check_new_output(const std::string& path, bool force, const OutputFormat& format);

/// The ending of a path in small letters: ".h5".
std::string extension_of(const std::string& path);

/// Whether the first bytes of a file are these.
bool begins_with(const std::string& path, std::string_view text);

}  // namespace eigentrail::app
