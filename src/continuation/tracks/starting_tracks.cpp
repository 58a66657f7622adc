#include "continuation/tracks/starting_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace eigentrail {
namespace {

/// Eigenvalues with at most this relative distance start as a block. QZ gives a double eigenvalue to 1e-8 at
/// best, a triple one to 1e-5.
constexpr double close = 1e-4;

/// Double eigenvalues zero, rigid-body motions for example, are known only to the square root of rounding,
/// relative to the square root of |K|/|M|. This is ten times as much, for the factors that depend on n.
constexpr double blurred = 1.5e-7;

/// Magnitude (1/s) up to which eigenvalues cannot be distinguished from zero.
double blur_at_zero(const ReducedPencil& pencil) {
  const double mass = pencil.M[0].norm();
  return mass > 0.0 ? blurred * std::sqrt(pencil.K[0].norm() / mass) : 0.0;
}

/// A label per mode, equal for modes that are connected by close eigenvalues. A mode is also close to another
/// if it is close to the conjugate of that. `s_ref`: magnitude below which eigenvalues count as zero; `blur`:
/// as from blur_at_zero.
std::vector<int> group_labels(const std::vector<StartingMode>& modes, double s_ref, double blur) {
  std::vector<int> label(modes.size());
  std::iota(label.begin(), label.end(), 0);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (modes[i].part != modes[j].part || modes[i].copy > 0 || modes[j].copy > 0) continue;
      const Complex a = modes[i].s;
      const Complex b = modes[j].s;
      const double scale = std::max({std::abs(a), std::abs(b), s_ref});
      const double distance = std::min(std::abs(a - b), std::abs(a - std::conj(b)));
      const bool both_zero = std::max(std::abs(a), std::abs(b)) <= blur;
      if (distance <= close * scale || both_zero)
        std::replace(label.begin(), label.end(), label[i], label[j]);
    }
  }
  return label;
}

/// Whether an eigenvalue is so close to its conjugate that both start in one block.
bool near_real(Complex s, double s_ref) {
  return 2.0 * std::abs(s.imag()) <= close * std::max(std::abs(s), s_ref);
}

}  // namespace

std::vector<StartingGroup> starting_groups(const ReducedPencil& pencil,
                                           const std::vector<StartingMode>& modes, int n_modes, double s_ref,
                                           double least_scale) {
  s_ref = std::max(s_ref, least_scale);
  const double blur = blur_at_zero(pencil);
  const std::vector<int> labels = group_labels(modes, s_ref, blur);
  std::vector<StartingGroup> groups;
  for (int label = 0; label < static_cast<int>(modes.size()); ++label) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      if (labels[i] == label && modes[i].copy == 0) members.push_back(i);
    }
    if (members.empty() || static_cast<int>(members.front()) >= n_modes) continue;
    const bool is_real = std::any_of(members.begin(), members.end(),
                                     [&](std::size_t i) { return near_real(modes[i].s, s_ref); });
    std::vector<Complex> roots;
    StartingGroup group;
    for (const std::size_t i : members) {
      const bool followed = static_cast<int>(i) < n_modes;
      roots.push_back(modes[i].s);
      group.modes.push_back(followed ? static_cast<int>(i) : Track::guard);
      if (!is_real || modes[i].s.imag() == 0.0) continue;
      roots.push_back(std::conj(modes[i].s));
      group.modes.push_back(followed ? Track::no_mode : Track::guard);
    }
    group.roots = Eigen::Map<ComplexVector>(roots.data(), static_cast<Eigen::Index>(roots.size()));
    const int part = modes[members.front()].part;
    const ReducedPencil& own = pencil.of(part);
    if (roots.size() == 1) {
      group.pair.is_real = roots[0].imag() == 0.0;
      const StartingMode& mode = modes[members.front()];
      group.pair.Z = mode.z.size() > 0 ? mode.z : eigenvector_near(own, mode.s, s_ref);
      group.pair.Lambda = group.roots;
      if (group.pair.is_real) group.pair.Z.imag().setZero();
    } else {
      const Complex centre = is_real ? Complex(group.roots.mean().real()) : group.roots.mean();
      group.pair = invariant_subspace(own, centre, group.roots.size(), is_real, least_scale);
    }
    group.pair.part = part;
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace eigentrail
