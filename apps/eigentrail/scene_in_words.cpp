#include "scene_in_words.hpp"

#include <cctype>
#include <optional>
#include <utility>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail::app {
namespace {

std::string counted(long long number, const std::string& one, const std::string& many) {
  return std::to_string(number) + " " + (number == 1 ? one : many);
}

std::string freedoms(const Model& model, const Sizes& sizes) {
  long long states = 0;
  for (const Effect& effect : model.description().effects) states += effect.states;
  std::string text = counted(sizes.freedoms, "freedom", "freedoms") + ": ";
  text += counted(sizes.coordinates, "coordinate", "coordinates");
  const long long independent = sizes.constraints - sizes.redundant;
  text += independent == 0 ? ", no constraints" : ", " + counted(independent, "constraint", "constraints");
  if (sizes.redundant > 0) text += " (" + std::to_string(sizes.redundant) + " more say what others do)";
  text += ".";
  if (states > 0)
    text += " " +
            counted(states, "coordinate is a state of an element", "coordinates are states of elements") +
            ", of first order: one eigenvalue each.";
  return text;
}

/// The instabilities that are possible with this structure of the pencil.
std::string prospects(const Structure& structure) {
  if (structure.circulatory) {
    return "Forces without a potential (unsymmetric K): flutter is possible, with and without damping.";
  }
  if (structure.damped && structure.gyroscopic) {
    return "Damping and gyroscopic forces: modes decay where damping is external; damping that rotates may "
           "make them grow.";
  }
  if (structure.damped) {
    return "Damping and a potential: modes decay until the stiffness is lost (divergence), as long as no "
           "damping is negative.";
  }
  if (structure.gyroscopic) {
    return "Gyroscopic forces without damping: modes neither grow nor decay until two of them meet "
           "(flutter), or the stiffness is lost.";
  }
  return "A potential without damping: modes neither grow nor decay until the stiffness is lost "
         "(divergence).";
}

/// What the program takes for the blade and for the support of a rotor of equal blades.
std::vector<std::string> blades_in_words(const std::optional<BladedRotor>& rotor) {
  if (!rotor) return {};
  return {std::to_string(rotor->blades) + " equal blades turn on '" + printable(rotor->hub) +
              "'; one of them is " + joined(rotor->of_blade, ", ", printable) +
              ". What stands: " + joined(rotor->support, ", ", printable) + ".",
          "In multiblade coordinates (collective, cosine, sine, ...) all coefficients are constant; s is "
          "seen from the "
          "frame that stands."};
}

std::string equilibrium(const Structure& structure, const std::string& parameter) {
  if (structure.known_equilibrium) return "The equilibrium is zero throughout.";
  if (structure.fixed_equilibrium) return "The equilibrium does not depend on " + parameter + ".";
  return "The equilibrium may move with " + parameter +
         " and is followed; eigenvalues belong to where it is.";
}

std::string followed(const TraceSetup& setup, const Sizes& sizes) {
  const TraceOptions& options = setup.options;
  const std::string unit = setup.model->description().parameters.at(options.parameter).unit;
  std::string modes =
      options.modes.count.value_or(0) >= sizes.freedoms ? "all modes" : in_words(options.modes);
  modes.front() = static_cast<char>(std::toupper(modes.front()));
  return modes + " are followed from " + options.parameter + " = " + exact_text(options.from) + " to " +
         exact_text(options.to) + (unit.empty() ? "" : " " + unit) + ", every eigenvalue to " +
         exact_text(options.tolerance) + " of its magnitude, everywhere on the range.";
}

}  // namespace

std::vector<std::string> in_words(const TraceSetup& setup, const Structure& structure, const Sizes& sizes) {
  std::vector<std::string> sentences = blades_in_words(setup.model->description().rotor);
  for (std::string& sentence :
       std::vector<std::string>{freedoms(*setup.model, sizes), prospects(structure),
                                equilibrium(structure, setup.options.parameter), followed(setup, sizes)})
    sentences.push_back(std::move(sentence));
  return sentences;
}

}  // namespace eigentrail::app
