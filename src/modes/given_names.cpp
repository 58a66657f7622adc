#include "eigentrail/modes/given_names.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Modal assurance of a shape and a few components that it should have, from 0 to 1; the components that are
/// not given count as zero among those of the same unit only where they are named.
double assurance(const std::vector<std::pair<std::string, double>>& wanted, const ComplexVector& shape,
                 const std::vector<std::string>& coordinates) {
  Complex product = 0.0;
  double of_wanted = 0.0, of_shape = 0.0;
  for (const auto& [name, amount] : wanted) {
    const auto at = std::find(coordinates.begin(), coordinates.end(), name) - coordinates.begin();
    product += amount * shape[at];
    of_wanted += amount * amount;
    of_shape += std::norm(shape[at]);
  }
  return of_shape > 0.0 ? std::norm(product) / (of_wanted * of_shape) : 0.0;
}

/// How far a mode is from what a name wants; the least is the best. `none`: it cannot have the name.
double distance(const GivenName& given, const std::vector<NamedMode>& modes, std::size_t number,
                const std::vector<std::string>& coordinates) {
  const NamedMode& mode = modes[number];
  if (given.frequency >= 0.0) {
    const bool oscillates = std::isfinite(mode.s.imag()) && mode.s.imag() != 0.0;
    return oscillates ? std::abs(std::abs(mode.s.imag()) - given.frequency) /
                            std::max(given.frequency, std::abs(mode.s.imag()))
                      : none;
  }
  if (!given.moves.empty())
    return mode.name.find(given.moves) == std::string::npos
               ? none
               : static_cast<double>(number) / static_cast<double>(modes.size());
  return mode.shape.allFinite() ? 1.0 - assurance(given.shape, mode.shape, coordinates) : none;
}

void check_coordinates(const GivenName& given, const std::vector<std::string>& coordinates,
                       const std::string& label) {
  for (const auto& [name, amount] : given.shape) {
    if (std::find(coordinates.begin(), coordinates.end(), name) == coordinates.end())
      throw InputError(label + " " + given.name + ": no coordinate is called '" + name + "'; " +
                       suggestion(name, coordinates));
  }
}

}  // namespace

std::vector<std::size_t> modes_of_names(const std::vector<GivenName>& given,
                                        const std::vector<NamedMode>& modes,
                                        const std::vector<std::string>& coordinates,
                                        const std::string& label) {
  for (const GivenName& one : given) check_coordinates(one, coordinates, label);
  std::vector<std::size_t> chosen(given.size(), modes.size());
  std::vector<bool> taken(modes.size(), false);
  for (std::size_t round = 0; round < given.size(); ++round) {
    double least = none;
    std::size_t name = given.size(), mode = modes.size();
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (chosen[i] != modes.size()) continue;
      for (std::size_t k = 0; k < modes.size(); ++k) {
        const double away = taken[k] ? none : distance(given[i], modes, k, coordinates);
        if (away < least) {
          least = away;
          name = i;
          mode = k;
        }
      }
    }
    if (name == given.size()) break;
    chosen[name] = mode;
    taken[mode] = true;
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (chosen[i] != modes.size()) continue;
    const std::string what = given[i].moves.empty()
                                 ? "no mode is left for it"
                                 : "the name of no mode holds \"" + given[i].moves +
                                       "\"; they are: " + joined(modes, ", ", &NamedMode::name);
    throw InputError(label + " " + given[i].name + ": where the trace begins, " + what);
  }
  return chosen;
}

}  // namespace eigentrail
