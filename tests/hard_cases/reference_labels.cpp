#include "hard_cases/reference_labels.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

namespace eigentrail::test {
namespace {

constexpr double allowed_displacement = 0.2;  // relative to the distance to the next eigenvalue
// Relative to the range:
constexpr double shortest_step = 1e-13;
constexpr double end_margin = 1e-11;  // labels end at this distance before a coincidence
constexpr double shortest_stretch = 1e-9;
constexpr int max_depth = 50;

/// Distance from s to the nearest eigenvalue that differs from it. Equal ones coincide at all parameters.
double gap(Complex s, const std::vector<Complex>& spectrum) {
  double nearest = INFINITY;
  for (const Complex other : spectrum) {
    const double distance = std::abs(other - s);
    if (distance > 1e-15 * std::abs(s)) nearest = std::min(nearest, distance);
  }
  return nearest;
}

/// The modes of `there` in the order of the labels `here`; empty if the match is doubtful.
std::optional<std::vector<Complex>> match(const std::vector<Complex>& here,
                                          const std::vector<Complex>& all_here,
                                          const std::vector<Complex>& all_there) {
  std::vector<Complex> there = upper_members(all_there);
  if (there.size() != here.size()) return std::nullopt;
  std::vector<Complex> labelled;
  for (const Complex s : here) {
    const auto closer = [s](Complex a, Complex b) { return std::abs(a - s) < std::abs(b - s); };
    const auto nearest = std::min_element(there.begin(), there.end(), closer);
    const double allowed = allowed_displacement * std::min(gap(s, all_here), gap(*nearest, all_there));
    if (!(std::abs(*nearest - s) < allowed)) return std::nullopt;
    labelled.push_back(*nearest);
    there.erase(nearest);
  }
  return labelled;
}

/// The modes with their conjugates, so that pairs are complete.
std::vector<Complex> with_conjugates(const std::vector<Complex>& modes) {
  std::vector<Complex> all = modes;
  for (const Complex s : modes) {
    if (s.imag() != 0.0) all.push_back(std::conj(s));
  }
  return all;
}

bool is_coincidence(const std::string& kind) {
  return kind == "collision" || kind == "crossing" || kind == "fold" || kind == "branch_point" ||
         kind == "infinite";
}

std::set<double> coincidences(const HardCase& hard_case) {
  std::set<double> result;
  for (const SpecialPoint& point : hard_case.special) {
    if (is_coincidence(point.kind)) result.insert(point.parameter);
  }
  return result;
}

}  // namespace

std::vector<Complex> upper_members(const std::vector<Complex>& spectrum) {
  std::vector<Complex> result;
  std::copy_if(spectrum.begin(), spectrum.end(), std::back_inserter(result),
               [](Complex s) { return s.imag() >= 0.0; });
  return result;
}

LabelledStretch::LabelledStretch(const HardCase& hard_case, int branch, double low, double high)
    : case_(hard_case), branch_(branch), range_(std::abs(hard_case.to - hard_case.from)) {
  const std::set<double> ends = coincidences(hard_case);
  const double last = high - (ends.count(high) != 0 ? end_margin * range_ : 0.0);
  const double first = low + (ends.count(low) != 0 ? end_margin * range_ : 0.0);
  const double middle = 0.5 * (first + last);
  anchors_.push_back({middle, upper_members(spectrum(middle))});
  walk(last);
  std::reverse(anchors_.begin(), anchors_.end());
  walk(first);
  std::reverse(anchors_.begin(), anchors_.end());
}

std::vector<Complex> LabelledStretch::spectrum(double p) const {
  return case_.spectrum(p)[static_cast<std::size_t>(branch_)];
}

void LabelledStretch::walk(double target) {
  double step = 0.01 * range_;
  while (anchors_.back().p != target) {
    const Anchor& last = anchors_.back();
    const double left = target - last.p;
    const double p = std::abs(left) <= step ? target : last.p + std::copysign(step, left);
    const auto next = match(last.modes, with_conjugates(last.modes), spectrum(p));
    if (next) {
      anchors_.push_back({p, *next});
      step *= 1.5;
      continue;
    }
    step = 0.5 * std::min(step, std::abs(left));
    if (step < shortest_step * range_ || last.p + std::copysign(step, left) == last.p) {
      std::ostringstream text;
      text.precision(17);
      text << case_.name << ": modes cannot be told apart at " << last.p;
      reason_ = text.str();
      return;
    }
  }
}

std::vector<Complex> LabelledStretch::continued(const Anchor& anchor, double p, int depth) const {
  const auto direct = match(anchor.modes, with_conjugates(anchor.modes), spectrum(p));
  if (direct) return *direct;
  if (depth == max_depth)
    throw std::runtime_error(case_.name + ": modes cannot be told apart between anchors");
  const double middle = 0.5 * (anchor.p + p);
  return continued({middle, continued(anchor, middle, depth + 1)}, p, depth + 1);
}

std::vector<Complex> LabelledStretch::operator()(double p) const {
  if (p < low() || p > high())
    throw std::out_of_range(case_.name + ": parameter outside the labelled stretch");
  const auto right = std::lower_bound(anchors_.begin(), anchors_.end(), p,
                                      [](const Anchor& anchor, double value) { return anchor.p < value; });
  if (right->p == p) return right->modes;
  const auto left = right - 1;
  return continued(p - left->p < right->p - p ? *left : *right, p, 0);
}

std::vector<LabelledStretch> reference_labels(const HardCase& hard_case) {
  const auto [low, high] = std::minmax(hard_case.from, hard_case.to);
  std::set<double> ends = coincidences(hard_case);
  ends.insert({low, high});
  std::vector<LabelledStretch> result;
  for (auto begin = ends.begin(); std::next(begin) != ends.end(); ++begin) {
    const double end = *std::next(begin);
    if (*begin < low || end > high || end - *begin < shortest_stretch * (high - low)) continue;
    const auto spectra = hard_case.spectrum(0.5 * (*begin + end));
    for (std::size_t branch = 0; branch < spectra.size(); ++branch) {
      if (!spectra[branch].empty()) result.emplace_back(hard_case, static_cast<int>(branch), *begin, end);
    }
  }
  return result;
}

}  // namespace eigentrail::test
