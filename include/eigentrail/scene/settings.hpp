// Other values for parameters of a scene, from the command line: --set drag=20 --set "omega=300 rpm".
#pragma once

#include <string>
#include <vector>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

struct ChangedScene {
  Scene scene;
  std::vector<std::string> warnings;  ///< about settings that have no effect
};

/// The scene with values replaced in its text, so that files of results hold the scene that was computed. A
/// setting is "NAME=VALUE"; the value is a number in the unit that the scene declares, a number with its unit
/// ("300 rpm"), or an expression of other parameters. It is checked as the scene itself is. A name that the
/// scene does not declare is a warning, and an error if it looks like a misprint of one that it declares.
/// Throws InputError.
ChangedScene with_settings(Scene scene, const std::vector<std::string>& settings);

}  // namespace eigentrail
