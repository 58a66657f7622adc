// The two parameters of maps and boundaries, and their window.
#pragma once

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Throws InputError, with a message about --second, unless `second` is a declared parameter, is not defined
/// by an expression, is not trimmed, and differs from `first`.
void check_second_parameter(const Scene& scene, const std::string& second, const std::string& first);

/// Throws InputError unless the range of the second parameter is finite and has a length.
void check_second_range(double from, double to);

/// Throws InputError unless the options, `overrides`, or the scene give the range of the first parameter. The
/// scene's is that of the parameter which it names.
void require_first_range(const Scene& scene, const OptionTexts& overrides);

/// n >= 2 equidistant values from `from` to `to`, both ends exact.
std::vector<double> evenly(double from, double to, int n);

/// The second parameter of a window and its range, in its unit.
struct SecondRange {
  std::string name;
  double from, to;
};

/// The model of a scene, checked at places all over the window: its four corners first, then `per_side` x
/// `per_side` places. Parameters on which it does not depend are reported in its description, except those in
/// `used` that are not of the window.
std::unique_ptr<Model> model_over_window(const Scene& scene, const TraceOptions& trace,
                                         const SecondRange& second, std::set<int> used, int per_side);

}  // namespace eigentrail
