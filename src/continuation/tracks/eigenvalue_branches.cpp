#include "continuation/tracks/eigenvalue_branches.hpp"

#include <array>
#include <cmath>
#include <iterator>

#include "continuation/step/shared_basis.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Distance relative to the norm of the block up to which eigenvalues coincide on a whole step: rounding with
/// a margin, for double eigenvalues that are semisimple.
constexpr double coinciding = 1e-12;
/// Relative tolerance for rounding in the comparison of distances.
constexpr double length_rounding = 1e-9;
/// A departure that is too far away is replaced by one at this share of the largest distance.
constexpr double much_closer = 0.1;
/// Places on a step at which eigenvalues are compared: irregular, so that eigenvalues that meet at simple
/// fractions of the step do not seem to coincide everywhere.
constexpr std::array<double, 6> samples{0.07, 0.19, 0.37, 0.61, 0.83, 1.0};

}  // namespace

ComplexVector departing_roots(const Track& track, double h, double& position) {
  position = 0.0;
  if (!track.departure) return track.roots;
  const Track::Departure& departure = *track.departure;
  position = departure.distance / h;
  const bool is_close = std::abs(position) <= farthest_departure * (1.0 + length_rounding);
  if (is_close || track.hidden_within > 0.0) return departure.roots;
  // Towards the point, the differences of the eigenvalues shrink linearly or like a square root of the
  // distance. The order therefore follows from linear interpolation between the point and the departure.
  const double share = much_closer * farthest_departure / std::abs(position);
  position *= share;
  return in_order_of(track.roots + share * (departure.roots - track.roots),
                     block_roots(evaluate_series(track.functions, share * departure.distance)));
}

EigenvalueSampler::EigenvalueSampler(const PathNode& left, const PathNode& right, std::size_t index,
                                     double length)
    : track_(left.tracks[index]), functions_(functions_on_step(left, right, index, length)) {
  const Track& track = left.tracks[index];
  ComplexVector roots = departing_roots(track, length, start_);
  rounding_ = coinciding * track.pair.Lambda.norm();
  resolutions_ = root_resolutions(functions_(start_), roots);
  known_.emplace(start_, std::move(roots));
}

bool EigenvalueSampler::are_distinct(const ComplexVector& roots) const {
  const ComplexVector& start = known_.at(start_);
  for (Eigen::Index i = 0; i < roots.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double least = resolution(i, j);
      if (std::abs(roots[i] - roots[j]) <= least && std::abs(start[i] - start[j]) > least) return false;
    }
  }
  return true;
}

const ComplexVector& EigenvalueSampler::operator()(double t) {
  const auto above = known_.upper_bound(t);
  const auto nearest = above == known_.begin() ? above : std::prev(above);
  if (nearest->first == t) return nearest->second;
  if (functions_.size() == 1) return single_ = functions_(t);
  // At a place where two of them cross, rounding decides which is which: from there none can be followed.
  auto from = nearest;
  while (from != known_.begin() && !are_distinct(from->second)) --from;
  return known_.emplace(t, follow_roots(functions_, from->second, from->first, t)).first->second;
}

bool EigenvalueSampler::are_hidden(Eigen::Index i, Eigen::Index j) {
  return std::all_of(samples.begin(), samples.end(), [&](double t) {
    const ComplexVector& roots = (*this)(t);
    const Vector errors = rounding_of_roots(track_, functions_(t), roots, RoundingThresholds());
    return std::abs(roots[i] - roots[j]) <= errors[i] + errors[j];
  });
}

double EigenvalueSampler::resolution_at(double t, Eigen::Index i, Eigen::Index j) {
  if (functions_.size() <= 4) return resolution(i, j);  // blocks of one and two
  const ComplexVector& roots = (*this)(t);
  const Vector there = root_resolutions(functions_(t), roots);
  return std::max(resolution(i, j), std::min(there[i], there[j]));
}

std::vector<EigenvalueBranch> eigenvalue_branches_of(const Track& track, std::size_t index,
                                                     EigenvalueSampler& sampler) {
  const auto coincide = [&](Eigen::Index i, Eigen::Index j) {
    return std::all_of(samples.begin(), samples.end(), [&](double t) {
      const ComplexVector& roots = sampler(t);
      return std::abs(roots[i] - roots[j]) <= sampler.resolution(i, j);
    });
  };
  std::vector<EigenvalueBranch> branches;
  for (int i = 0; i < static_cast<int>(track.size()); ++i) {
    const auto known = std::find_if(branches.begin(), branches.end(), [&](const EigenvalueBranch& branch) {
      return coincide(branch.members.front(), i);
    });
    if (known == branches.end()) {
      branches.push_back({index, {i}});
    } else {
      known->members.push_back(i);
    }
  }
  return branches;
}

}  // namespace eigentrail
