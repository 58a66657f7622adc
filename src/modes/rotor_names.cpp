#include "eigentrail/modes/rotor_names.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "eigentrail/model/projection.hpp"
#include "modes/ordinal.hpp"

namespace eigentrail {
namespace {

/// A shaft counts as straight if the rest of its displacement beside a straight line has at most this share
/// of the squares. A beam with a half wave of a sine between its ends has it if its ends move by 40 % of the
/// middle.
constexpr double straight = 0.05;

/// Displacement of each node in one complex number: of the sense with the larger orbits.
ComplexVector main_displacement(const std::vector<std::array<Complex, 2>>& nodes) {
  const Complex i(0.0, 1.0);
  const auto n = static_cast<Eigen::Index>(nodes.size());
  ComplexVector forward(n), backward(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& [x, y] = nodes[static_cast<std::size_t>(k)];
    forward[k] = 0.5 * (x + i * y);
    backward[k] = 0.5 * (x - i * y);
  }
  return forward.squaredNorm() >= backward.squaredNorm() ? forward : backward;
}

/// Lengths of shaft that belong to its nodes.
Vector lengths_of_nodes(const std::vector<double>& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Vector result = Vector::Zero(n);
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    const double half = 0.5 * (places[static_cast<std::size_t>(k) + 1] - places[static_cast<std::size_t>(k)]);
    result[k] += half;
    result[k + 1] += half;
  }
  return result;
}

/// Fits a straight line, weighted by length, and compares its parts.
ShaftMotion motion_of(const SpinningShaft& shaft, const ComplexVector& moved) {
  const Vector weights = lengths_of_nodes(shaft.places);
  const Vector places = Eigen::Map<const Vector>(shaft.places.data(), weights.size());
  const double length = weights.sum();
  const double centre = weights.dot(places) / length;
  const Vector arm = (places.array() - centre) / (0.5 * length);
  const Complex shift = (weights.cast<Complex>().array() * moved.array()).sum() / length;
  const double turning = weights.dot(arm.cwiseAbs2());
  const Complex turn = (weights.cwiseProduct(arm).cast<Complex>().array() * moved.array()).sum() / turning;
  const ComplexVector rest =
      moved - ComplexVector::Constant(moved.size(), shift) - turn * arm.cast<Complex>();
  const double all = weights.dot(moved.cwiseAbs2());
  if (weights.dot(rest.cwiseAbs2()) > straight * all) return ShaftMotion::bending;
  // A shaft that turns about one of its ends is as much of both: a cone.
  constexpr double beyond_the_ends = 1.01;
  return std::abs(shift) >= beyond_the_ends * std::abs(turn) ? ShaftMotion::cylindrical
                                                             : ShaftMotion::conical;
}

/// 1 or 2 if nearly all motion is along x or y.
int axis_of(const std::vector<std::array<Complex, 2>>& nodes) {
  double along_x = 0.0, along_y = 0.0;
  for (const auto& [x, y] : nodes) {
    along_x += std::norm(x);
    along_y += std::norm(y);
  }
  constexpr double nearly_all = 0.9;
  const double all = along_x + along_y;
  return along_x > nearly_all * all ? 1 : along_y > nearly_all * all ? 2 : 0;
}

double lateral_size(const std::vector<std::array<Complex, 2>>& nodes) {
  double sum = 0.0;
  for (const auto& [x, y] : nodes) sum += std::norm(x) + std::norm(y);
  return sum;
}

/// Motion of a shaft whose nodes stay on their places, by the coordinate that moves most.
ShaftMotion motion_on_the_axis(const Model& model, const ComplexVector& shape) {
  Eigen::Index largest = 0;
  const Projection* projection = model.projection();
  const ComplexVector whole =
      projection == nullptr ? shape : ComplexVector(projection->basis.cast<Complex>() * shape);
  whole.cwiseAbs().maxCoeff(&largest);
  const std::vector<std::string>& names =
      projection == nullptr ? model.description().coordinate_names : projection->names;
  const std::string& name = names[static_cast<std::size_t>(largest)];
  if (name.ends_with(": z")) return ShaftMotion::axial;
  return name.ends_with(": rz") ? ShaftMotion::torsion : ShaftMotion::bending;  // between nodes that are held
}

int sense_of(const Whirl& whirl) {
  const std::string word = whirl_in_words(whirl);
  return word == "forward" ? 1 : word == "backward" ? -1 : word == "mixed" ? 2 : 0;
}

/// "forward bending": a name without its number.
std::string common_name(const RotorMode& mode) {
  static const std::map<ShaftMotion, std::string> words = {{ShaftMotion::cylindrical, "cylindrical"},
                                                           {ShaftMotion::conical, "conical"},
                                                           {ShaftMotion::bending, "bending"},
                                                           {ShaftMotion::axial, "axial"},
                                                           {ShaftMotion::torsion, "torsion"}};
  const std::string& word = words.at(mode.motion);
  if (mode.is_zero) return "rigid-body " + word;
  if (!mode.oscillates) return "overdamped " + word;
  if (mode.motion == ShaftMotion::axial || mode.motion == ShaftMotion::torsion) return word;
  if (mode.sense == 1) return "forward " + word;
  if (mode.sense == -1) return "backward " + word;
  if (mode.sense == 2) return "mixed " + word;
  return word + (mode.axis == 1 ? " along x" : mode.axis == 2 ? " along y" : "");
}

}  // namespace

RotorMode rotor_mode(const Model& model, const Vector& parameters, Complex s, const ComplexVector& shape,
                     double rounding) {
  RotorMode mode;
  mode.is_zero = std::abs(s) <= rounding;
  mode.frequency = std::abs(s);
  mode.oscillates = s.imag() != 0.0;
  const std::vector<SpinningShaft>& shafts = model.description().shafts;
  double most = 0.0;
  std::vector<std::array<Complex, 2>> nodes;
  for (std::size_t i = 0; i < shafts.size(); ++i) {
    auto moved = displacements(model, shafts[i], shape);
    if (const double size = lateral_size(moved); size > most) {
      most = size;
      mode.shaft = static_cast<int>(i);
      nodes = std::move(moved);
    }
  }
  constexpr double nothing = 1e-20;  // squares of rounding
  if (!(most > nothing * shape.squaredNorm())) {
    mode.motion = motion_on_the_axis(model, shape);
    return mode;
  }
  mode.motion = motion_of(shafts[static_cast<std::size_t>(mode.shaft)], main_displacement(nodes));
  mode.axis = axis_of(nodes);
  if (mode.oscillates) mode.sense = sense_of(whirl_of(model, parameters, shape));
  return mode;
}

std::vector<std::string> rotor_mode_names(const std::vector<RotorMode>& modes,
                                          const std::vector<SpinningShaft>& shafts) {
  std::vector<std::size_t> ascending(modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i) ascending[i] = i;
  std::stable_sort(ascending.begin(), ascending.end(),
                   [&](std::size_t a, std::size_t b) { return modes[a].frequency < modes[b].frequency; });
  const auto group = [&](std::size_t i) {
    const std::string of =
        shafts.size() > 1 ? ", " + shafts[static_cast<std::size_t>(modes[i].shaft)].name : "";
    return std::pair(common_name(modes[i]), of);
  };
  std::map<std::pair<std::string, std::string>, int> total, number;
  for (std::size_t i = 0; i < modes.size(); ++i) ++total[group(i)];
  std::vector<std::string> names(modes.size());
  for (const std::size_t i : ascending) {
    const auto key = group(i);
    const bool numbered = total[key] > 1 || modes[i].motion == ShaftMotion::bending;
    names[i] = (numbered ? ordinal(++number[key]) + " " : "") + key.first + key.second;
  }
  return names;
}

}  // namespace eigentrail
