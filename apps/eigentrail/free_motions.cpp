#include "free_motions.hpp"

#include <array>

#include "core/texts.hpp"
#include "eigentrail/modes/energy_shares.hpp"

namespace eigentrail::app {
namespace {

struct RigidMotion {
  const char* freedom;  ///< as in the names of coordinates and in [[support]] holds
  const char* words;
};
constexpr std::array<RigidMotion, 4> motions_of_shafts = {{{"x", "to move along x"},
                                                           {"y", "to move along y"},
                                                           {"z", "to move along its axis"},
                                                           {"rz", "to turn about its axis"}}};

/// The motion with one for the freedom of all nodes of a shaft, and `inner` for that of its elements.
Vector rigid_motion(const std::vector<std::string>& names, const std::string& shaft, const char* freedom,
                    double inner) {
  const std::string begin = shaft.empty() ? "" : shaft + " ", end = std::string(": ") + freedom;
  Vector motion = Vector::Zero(static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].ends_with(end)) continue;
    if (names[i].starts_with(begin + "node ")) motion[static_cast<Eigen::Index>(i)] = 1.0;
    if (names[i].starts_with(begin + "element ")) motion[static_cast<Eigen::Index>(i)] = inner;
  }
  return motion;
}

/// Whether no force acts against the motion, up to rounding of the terms that cancel.
bool is_free(const Matrix& K, const Vector& motion) {
  constexpr double rounding = 1e-12;
  const Vector largest = K.cwiseAbs() * motion.cwiseAbs();
  return motion.any() && (K * motion).cwiseAbs().maxCoeff() <= rounding * largest.maxCoeff();
}

std::vector<std::string> free_shafts_in_words(const ModelDescription& description, const Matrix& K) {
  std::vector<std::string> sentences;
  for (const SpinningShaft& shaft : description.shafts) {
    std::vector<std::string> words;
    std::string holds;
    for (const RigidMotion& motion : motions_of_shafts) {
      const auto free_with = [&](double inner) {
        return is_free(K, rigid_motion(description.coordinate_names, shaft.name, motion.freedom, inner));
      };
      if (!free_with(1.0) && !free_with(0.0)) continue;
      words.emplace_back(motion.words);
      holds += (holds.empty() ? "\"" : ", \"") + std::string(motion.freedom) + "\"";
    }
    if (words.empty()) continue;
    const std::string name = shaft.name.empty() ? "shaft" : "shaft " + shaft.name;
    const std::string node = shaft.name.empty() ? "1" : "\"" + shaft.name + " node 1\"";
    sentences.push_back("The " + name + " is free " + enumerated(words) +
                        ": eigenvalues zero. To hold it, add [[support]] node = " + node + ", holds = [" +
                        holds + "].");
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
