#include "eigentrail/modes/participation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {

namespace {

/// Endings of the name of a velocity, behind that of its position.
constexpr std::array velocities{" velocity", " rate"};
constexpr const char* cosine = " cosine";
constexpr const char* sine = " sine";

/// The text in front of an ending; empty if it does not end so.
std::string before(const std::string& text, const std::string& ending) {
  const bool ends = text.size() > ending.size() && text.ends_with(ending);
  return ends ? text.substr(0, text.size() - ending.size()) : "";
}

/// A motion with the coordinate that is its position.
struct Motion {
  std::string name;
  Eigen::Index position = 0;
  double share = 0.0;
};

/// Motions in the order of the names, velocities added to their positions.
std::vector<Motion> with_velocities(const std::vector<std::string>& names, const Vector& shares) {
  std::vector<Motion> motions;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (known.emplace(names[i], motions.size()).second)
      motions.push_back({names[i], static_cast<Eigen::Index>(i), 0.0});
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::size_t own = known.at(names[i]);
    for (const char* velocity : velocities) {
      const auto position = known.find(before(names[i], velocity));
      if (position != known.end()) own = position->second;
    }
    motions[own].share += shares[static_cast<Eigen::Index>(i)];
  }
  return motions;
}

/// "1st flap cosine 2" as motion "1st flap", component " cosine", harmonic " 2".
struct Component {
  std::string motion, harmonic;
  bool is_cosine = false;
};

std::optional<Component> component_of(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  const bool numbered = end != std::string::npos && end + 1 < name.size() && name[end] == ' ';
  const std::string harmonic = numbered ? name.substr(end) : "";
  const std::string rest = numbered ? name.substr(0, end) : name;
  for (const bool is_cosine : {true, false}) {
    std::string motion = before(rest, is_cosine ? cosine : sine);
    if (!motion.empty()) return Component{std::move(motion), harmonic, is_cosine};
  }
  return std::nullopt;
}

/// Replaces the share of both components by those of the waves that they are made of.
void take_apart(Motion& c, Motion& s, const Component& component, const ComplexVector& shape) {
  const Complex i(0.0, 1.0);
  const Complex along_c = shape[c.position], along_s = shape[s.position];
  const double size = 2.0 * (std::norm(along_c) + std::norm(along_s));
  const double both = c.share + s.share;
  const double progressive = size > 0.0 ? std::norm(along_c + i * along_s) / size : 0.5;
  c = {component.motion + " progressive" + component.harmonic, c.position, progressive * both};
  s = {component.motion + " regressive" + component.harmonic, s.position, (1.0 - progressive) * both};
}

/// Whether anything turns: the components of a real mode are all in phase.
bool is_real(const ComplexVector& shape) {
  Eigen::Index most = 0;
  if (!(shape.cwiseAbs().maxCoeff(&most) > 0.0)) return true;
  constexpr double in_phase = 1e-8;
  return (shape / shape[most]).imag().norm() <= in_phase * shape.norm() / std::abs(shape[most]);
}

}  // namespace

std::vector<MotionShare> motion_shares(const std::vector<std::string>& names, const Vector& shares,
                                       const ComplexVector& shape) {
  std::vector<Motion> motions = with_velocities(names, shares);
  for (Motion& one : motions) {
    const auto component = component_of(one.name);
    if (!component || !component->is_cosine || is_real(shape)) continue;
    const std::string other = component->motion + sine + component->harmonic;
    const auto partner = std::find_if(motions.begin(), motions.end(),
                                      [&](const Motion& motion) { return motion.name == other; });
    if (partner != motions.end()) take_apart(one, *partner, *component, shape);
  }
  std::vector<MotionShare> result;
  for (Motion& one : motions) {
    if (one.share > 0.0) result.push_back({std::move(one.name), one.share});
  }
  // Shares that are equal but for rounding stay in the order of the coordinates.
  constexpr double told_apart = 1e-9;
  const auto steps = [](const MotionShare& one) { return std::round(one.share / told_apart); };
  std::stable_sort(result.begin(), result.end(),
                   [&](const MotionShare& a, const MotionShare& b) { return steps(a) > steps(b); });
  return result;
}

namespace {

/// Coordinates are named down to this share of the participation, and at most so many.
constexpr double least_share = 0.15;
constexpr std::size_t most_named = 3;

Vector squared_shares(const ComplexVector& shape) {
  return shape.cwiseAbs2() / shape.squaredNorm();
}

}  // namespace

Vector participation(const ComplexVector& left, const ComplexVector& slope, const ComplexVector& right,
                     bool is_simple) {
  const Vector product = left.cwiseProduct(slope).cwiseAbs();
  const double sum = product.sum();
  if (is_simple && sum > 0.0 && std::isfinite(sum)) return product / sum;
  return squared_shares(right);
}

std::string largest_names(const Vector& shares, const ComplexVector& shape,
                          const std::vector<std::string>& names) {
  std::string text;
  std::size_t named = 0;
  for (const MotionShare& one : motion_shares(names, shares, shape)) {
    if (named == most_named || (named > 0 && one.share < least_share)) break;
    text +=
        (named++ > 0 ? ", " : "") + one.name + " " + std::to_string(std::lround(100.0 * one.share)) + " %";
  }
  return text;
}

std::string largest_names(const ComplexVector& shape, const std::vector<std::string>& names) {
  return largest_names(squared_shares(shape), shape, names);
}

std::string name_by_participation(const Matrix& M, const Matrix& C, const Matrix& K, Complex s,
                                  const ComplexVector& right, double s_ref,
                                  const std::vector<std::string>& names) {
  const ComplexVector left = eigenvector_near(M.transpose(), C.transpose(), K.transpose(), s, s_ref);
  const ComplexVector slope = 2.0 * s * (M * right) + C * right;
  const Vector shares = participation(left, slope, right, true);
  return shares.allFinite() ? largest_names(shares, right, names) : "";
}

bool has_own_names(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != "x" + std::to_string(i + 1)) return true;
  }
  return false;
}

}  // namespace eigentrail
