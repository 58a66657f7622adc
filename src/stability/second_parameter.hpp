// The two parameters of maps and boundaries, and their window.
#pragma once

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Throws InputError, with a message about --second, unless `second` is a declared parameter, is not defined
/// by an expression, is not trimmed, and differs from `first`.
void check_second_parameter(const Scene& scene, const std::string& second, const std::string& first);

/// Throws InputError unless the options, `overrides`, or the scene give the range of the first parameter. The
/// scene's is that of the parameter which it names.
void require_first_range(const Scene& scene, const OptionTexts& overrides);

/// n >= 2 equidistant values from `from` to `to`, both ends exact.
std::vector<double> evenly(double from, double to, int n);

/// A side of the window: number and range of a parameter, in its unit.
struct WindowSide {
  int parameter;
  double from, to;
};

/// Values of all parameters at places all over the window, at which the model is checked: its four corners
/// first, then `per_side` x `per_side` places.
std::vector<Vector> points_of_window(const Parameters& parameters, const WindowSide& first,
                                     const WindowSide& second, int per_side);

}  // namespace eigentrail
