#include "continuation/tracks/arrival.hpp"

#include <Eigen/LU>

#include "core/reciprocal_condition.hpp"

namespace eigentrail {
namespace {

/// Reciprocal condition of M up to which an eigenvalue may be infinite: its |1/s| is about this share of that
/// of a typical one, squared.
constexpr double singular_mass = 1e-9;
}  // namespace

bool has_arrived(const PathProblem& problem, const PathNode& node, Complex s,
                 const InfinityThresholds& thresholds) {
  if (std::abs(s) <= thresholds.arrived * problem.s_max) return true;
  return reciprocal_condition(Eigen::PartialPivLU<Matrix>(node.pencil.M[0])) > singular_mass;
}

}  // namespace eigentrail
