#include "projection/mode_entries.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/modes/spectrum.hpp"
#include "projection/projection_error.hpp"

namespace eigentrail {
namespace {

/// Eigenvalues of the projected pencil with a larger relative indicator stand for none of the large one.
constexpr double closeness = 1e-3;

/// Those eigenvalues of the projected pencil that are close to one of the large pencil, as those of the kept
/// modes are.
std::vector<Complex> exact_ones(const SmallPencil& small, const SparsePencil& large, const Bases& bases,
                                const std::vector<Complex>& eigenvalues, double reference) {
  std::vector<ProjectedMode> modes;
  for (const Complex s : eigenvalues) modes.push_back(mode_of(small, s));
  const std::vector<EigenvalueError> errors =
      eigenvalue_errors(large, lifted(modes, *bases.right, *bases.left));
  std::vector<Complex> exact;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Complex s = eigenvalues[i];
    if (errors[i].distance < closeness * std::max(std::abs(s), reference)) exact.push_back(s);
  }
  return exact;
}

/// Accuracy of eigenvalues that are counted and not used.
constexpr double accuracy_of_count = 1e-6;

/// Up to this size of the projected pencil all of its eigenvalues are computed: the QR algorithm takes as
/// long as Arnoldi iterations for a few of them.
constexpr Eigen::Index all_at_once = 32;

std::vector<Complex> all_eigenvalues(const SmallPencil& small) {
  std::vector<Complex> all;
  for (const StartingMode& mode : compute_eigenvalues(small.M, small.C, small.K).modes) all.push_back(mode.s);
  return all;
}

/// The eigenvalues of the projected pencil within `reach` of the centre, and others; about `count` are
/// expected.
std::vector<Complex> eigenvalues_within(double reach, const SmallPencil& small, const Shift& centre,
                                        int count) {
  const Eigen::Index k = small.K.rows();
  if (k <= all_at_once) return all_eigenvalues(small);
  ModeFinder finder(accuracy_of_count);
  ModeRequest request{centre, count, reach, static_cast<int>(k) / 2, std::nullopt};
  request.only_right = true;
  const auto found = finder.find({small.M.sparseView(), small.C.sparseView(), small.K.sparseView()}, request);
  if (!found || found->radius < reach) return all_eigenvalues(small);
  return {found->s.begin(), found->s.end()};
}

/// The spectrum of the projected pencil near the centre without the followed modes, and how far these reach.
struct Others {
  std::vector<Complex> s;
  double farthest = 0.0, largest = 0.0;
};

Others without_followed(const ProjectedPlace& place, const Shift& shift) {
  constexpr int to_spare = 3;  // so that one more is seldom needed
  const Complex centre = shift.value();
  Others others;
  for (const ProjectedMode& mode : place.modes) {
    if (!std::isfinite(std::abs(mode.s))) continue;
    others.farthest = std::max(others.farthest, std::abs(mode.s - centre));
    others.largest = std::max(others.largest, std::abs(mode.s));
  }
  others.s = eigenvalues_within(others.farthest, place.small, shift,
                                static_cast<int>(place.modes.size()) + to_spare);
  for (const ProjectedMode& mode : place.modes) {
    if (!std::isfinite(std::abs(mode.s)) || others.s.empty()) continue;
    others.s.erase(std::min_element(others.s.begin(), others.s.end(), [&](Complex a, Complex b) {
      return std::abs(a - mode.s) < std::abs(b - mode.s);
    }));
  }
  return others;
}

/// Eigenvalues that are not followed and nearer to the centre than the farthest followed one, the farthest of
/// them last.
std::vector<Complex> among_the_followed(const LargeModel& large, const Model& model,
                                        const ProjectedPlace& place, const Shift& shift, double reference) {
  const Complex centre = shift.value();
  Others others = without_followed(place, shift);
  std::erase_if(others.s, [&](Complex s) {
    return std::abs(s - centre) >= others.farthest || std::abs(s) <= rigid * others.largest;
  });
  if (others.s.empty()) return {};
  const SparsePencil pencil = large.pencil(place.at);
  const auto bases = large.bases(model, pencil);
  if (!bases) return {};
  others.s = exact_ones(place.small, pencil, *bases, others.s, reference);
  std::sort(others.s.begin(), others.s.end(),
            [&](Complex a, Complex b) { return std::abs(a - centre) < std::abs(b - centre); });
  return others.s;
}

}  // namespace

ModeEntries find_mode_entries(const LargeModel& large, const Model& model,
                              const std::vector<ProjectedPlace>& places, const Shift& centre,
                              double reference) {
  ModeEntries found;
  std::size_t known = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::vector<Complex> there = among_the_followed(large, model, places[i], centre, reference);
    const bool enters = i > 0 && there.size() > known;
    known = there.size();
    if (!enters) continue;
    if (++found.count == 1) {
      found.from = places[i - 1].at.p;
      found.to = places[i].at.p;
      found.frequency = there.back().imag();
    }
  }
  return found;
}

}  // namespace eigentrail
