#include "stability/second_parameter.hpp"

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/traced_parameter.hpp"

namespace eigentrail {

void check_second_parameter(const Scene& scene, const std::string& second, const std::string& first) {
  const Parameters& parameters = scene.parameters;
  const auto require = [](bool holds, const std::string& message) {
    if (!holds) throw InputError("--second: " + message);
  };
  require(parameters.index(second).has_value(),
          "no parameter is called '" + second + "'; " + suggestion(second, parameters.names()));
  require(second != first,
          "'" + second + "' is the first parameter already; choose another one, or give --parameter");
  require(!is_trimmed(scene, second),
          "'" + second + "' is the unknown of a [[trim]]; vary another parameter");
  require(!parameters.at(second).definition,
          "'" + second + "' is defined by an expression; vary one of the parameters in it");
}

}  // namespace eigentrail
