// Other values for parameters of a scene, as on the command line: --set drag=20 --set "omega=300 rpm".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

struct ChangedScene {
  Scene scene;
  std::vector<std::string> names;     ///< of the parameters that were set
  std::vector<std::string> warnings;  ///< about settings that have no effect
};

/// The scene with values replaced in its text, so that files of results hold the scene that was computed. A
/// setting is "NAME=VALUE"; the value is a number in the unit that the scene declares, a number with its unit
/// ("300 rpm"), or an expression of other parameters. It is checked as the scene itself is. A value for the
/// traced parameter of a family, which it need not declare, is a warning. Messages begin with `option` and
/// the name. Throws InputError, also for names that the scene does not have.
ChangedScene with_settings(Scene scene, const std::vector<std::string>& settings,
                           std::string_view option = "--set ");

}  // namespace eigentrail
