#include "scene_in_words.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/modes/energy_shares.hpp"

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
          "seen from the frame that stands."};
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

/// What is free of a shaft in the direction of one freedom, and the nodes whose support would hold it.
struct FreeMotion {
  std::vector<std::string> words = {};
  std::vector<std::string> supports = {};
};

/// `free`: the motions against which no force acts. Freedoms as in the names of coordinates.
FreeMotion free_motion(const std::vector<std::string>& names, const SpinningShaft& shaft,
                       const std::string& freedom, const Matrix& free, const std::string& along) {
  std::vector<std::string> nodes;
  std::vector<Eigen::Index> rows;
  for (std::size_t k = 1; k <= shaft.places.size(); ++k) {
    const std::string node = (shaft.name.empty() ? "" : shaft.name + " ") + "node " + std::to_string(k);
    const auto found = std::ranges::find(names, node + ": " + freedom);
    if (found == names.end()) continue;
    nodes.push_back(shaft.name.empty() ? std::to_string(k) : '"' + node + '"');
    rows.push_back(found - names.begin());
  }
  constexpr double small = 1e-6;
  const Matrix moved = free(rows, Eigen::all);
  Eigen::Index most = 0, farthest = 0;
  if (moved.size() == 0 || !(moved.colwise().norm().maxCoeff(&most) > small)) return {};
  const std::string tilting = "to tilt along " + freedom;
  if (Eigen::FullPivLU<Matrix>(moved).setThreshold(small).rank() > 1)
    return {{along, tilting}, {nodes.front(), nodes.back()}};
  const Vector motion = moved.col(most);
  if (motion.maxCoeff() - motion.minCoeff() <= small * motion.norm()) return {{along}, {nodes.front()}};
  motion.cwiseAbs().maxCoeff(&farthest);
  return {{tilting}, {nodes[static_cast<std::size_t>(farthest)]}};
}

std::vector<std::string> free_shafts_in_words(const ModelDescription& description, const Matrix& K) {
  constexpr std::array<std::array<const char*, 2>, 4> ways = {{{"x", "to move along x"},
                                                               {"y", "to move along y"},
                                                               {"z", "to move along its axis"},
                                                               {"rz", "to turn about its axis"}}};
  constexpr double rounding = 1e-12;
  const Matrix free = Eigen::FullPivLU<Matrix>(K).setThreshold(rounding).kernel();  // zero if there are none
  std::vector<std::string> sentences;
  for (const SpinningShaft& shaft : description.shafts) {
    std::vector<std::string> words;
    std::map<std::string, std::string> supports;  // nodes, and what they would hold
    for (const auto& [freedom, along] : ways) {
      const FreeMotion found = free_motion(description.coordinate_names, shaft, freedom, free, along);
      if (found.words.empty()) continue;
      words.insert(words.end(), found.words.begin(), found.words.end());
      const std::string nodes = joined(found.supports, ", ");
      std::string& holds = supports[found.supports.size() == 1 ? nodes : "[" + nodes + "]"];
      holds += (holds.empty() ? "\"" : ", \"") + std::string(freedom) + "\"";
    }
    if (words.empty()) continue;
    const std::string added = joined(supports, " and ", [](const auto& support) {
      return "[[support]] node = " + support.first + ", holds = [" + support.second + "]";
    });
    sentences.push_back("The " + (shaft.name.empty() ? "shaft" : "shaft " + shaft.name) + " is free " +
                        enumerated(words) + ": eigenvalues zero. To hold it, add " + added + ".");
  }
  return sentences;
}

/// The freedoms that no force holds: columns of coordinates, n x their number.
Matrix free_motions(const IndependentParts& parts) {
  std::vector<Eigen::Index> free;
  for (const IndependentParts::Range& range : parts.ranges) {
    if (parts.is_free(range)) free.push_back(range.first);
  }
  return parts.right(Eigen::all, free);
}

/// What moves in each column: the motion of bodies and points, or the coordinate that moves most.
std::vector<std::string> names_of(const Model& model, const PathPoint& point, const Matrix& motions) {
  const ModelDescription& description = model.description();
  const SystemMatrix& M = point.equilibrium.linearization.M[0];
  const EnergyShares shares(description, M, point.equilibrium.x);
  if (!shares.motions().empty())
    return shares.names(shares.of(M, point.equilibrium.x, motions.cast<Complex>()));
  std::vector<std::string> names;
  for (const auto& motion : motions.colwise()) {
    Eigen::Index most = 0;
    motion.cwiseAbs().maxCoeff(&most);
    names.push_back(description.coordinate_names[static_cast<std::size_t>(most)]);
  }
  return names;
}

}  // namespace

std::vector<std::string> in_words(const TraceSetup& setup, const Structure& structure, const Sizes& sizes) {
  std::vector<std::string> sentences = blades_in_words(setup.model->description().rotor);
  sentences.insert(sentences.end(),
                   {freedoms(*setup.model, sizes), prospects(structure),
                    equilibrium(structure, setup.options.parameter), followed(setup, sizes)});
  return sentences;
}

std::vector<std::string> free_motions_in_words(const Model& model, const PathPoint& point,
                                               const IndependentParts* parts) {
  if (!model.description().shafts.empty())
    return free_shafts_in_words(model.description(), point.equilibrium.linearization.K[0].dense());
  const Matrix motions = parts != nullptr && parts->falls_apart() ? free_motions(*parts) : Matrix();
  if (motions.cols() == 0) return {};
  const std::string held = model.n_constraints() > 0 || !model.description().masses.empty()
                               ? "a spring, a joint or another constraint holds them"
                               : "stiffness, or a constraint A, holds them";
  return {"Free to move, with eigenvalues zero throughout: " + enumerated(names_of(model, point, motions)) +
          "; " + held + "."};
}

}  // namespace eigentrail::app
