#include "eigentrail/modes/energy_shares.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

namespace eigentrail {
namespace {

using Eigen::Index;
using Moments = Eigen::Matrix4d;
using ComplexVec3 = Eigen::Vector3cd;

constexpr double on_axis = 1e-9;  ///< radius over distance from the origin below which a mass is on the axis

/// Names of the motions along and about the three axes of a blade (s, a, a x s), and of the frame.
constexpr std::array<const char*, 6> of_blade = {"axial", "flap", "lag", "torsion", "lag", "flap"};
constexpr std::array<const char*, 6> of_frame = {"along x", "along y", "along z",
                                                 "about x", "about y", "about z"};

Eigen::Vector3d triple(const Vector& x, Index i) {
  return x.segment<3>(3 * i);
}

/// Moments G of a mass, from its constant mass matrix G x 1 (Kronecker product).
Moments moments(const SystemMatrix& M, const MassCarrier& mass) {
  Moments G = Moments::Zero();
  for (Index i = 0; i < mass.n_triples; ++i) {
    for (Index j = 0; j < mass.n_triples; ++j)
      G(i, j) = M(3 * (mass.first_triple + i), 3 * (mass.first_triple + j));
  }
  return G;
}

/// Position of the centre of mass.
Eigen::Vector3d centre(const MassCarrier& mass, const Moments& G, const Vector& x) {
  Eigen::Vector3d at = triple(x, mass.first_triple);
  for (Index i = 1; i < mass.n_triples && G(0, 0) > 0.0; ++i)
    at += (G(0, i) / G(0, 0)) * triple(x, mass.first_triple + i);
  return at;
}

/// Velocity of the centre of mass and angular velocity.
struct RigidMotion {
  ComplexVec3 velocity = ComplexVec3::Zero();
  ComplexVec3 rotation = ComplexVec3::Zero();
};

RigidMotion rigid_motion(const MassCarrier& mass, const Moments& G, const Vector& x,
                         const ComplexVector& shape) {
  RigidMotion motion;
  motion.velocity = shape.segment<3>(3 * mass.first_triple);
  for (Index i = 1; i < mass.n_triples; ++i) {
    const ComplexVec3 rate = shape.segment<3>(3 * (mass.first_triple + i));
    const ComplexVec3 director = triple(x, mass.first_triple + i).cast<Complex>();
    if (G(0, 0) > 0.0) motion.velocity += (G(0, i) / G(0, 0)) * rate;
    motion.rotation += 0.5 * director.cross(rate);
  }
  return motion;
}

/// Two kinds of motion as one: "flap-lag", "along x and y", "along x, about y".
std::string both(const std::string& first, const std::string& second) {
  const std::size_t word = first.find(' ');
  if (word == std::string::npos) return first + "-" + second;
  if (first.substr(0, word) != second.substr(0, word)) return first + ", " + second;
  return std::min(first, second) + " and " + std::max(first, second).substr(word + 1);
}

/// Inertia tensor about the centre of mass, components in the frame: tr(E) 1 - E with the second moments E.
Eigen::Matrix3d inertia(const MassCarrier& mass, const Moments& G, const Vector& x) {
  if (mass.n_triples == 1) return Eigen::Matrix3d::Zero();
  Eigen::Matrix3d E = G.bottomRightCorner<3, 3>();
  if (G(0, 0) > 0.0) E -= G.col(0).tail<3>() * G.row(0).tail<3>() / G(0, 0);
  Eigen::Matrix3d R;
  for (Index i = 0; i < 3; ++i) R.col(i) = triple(x, mass.first_triple + 1 + i);
  const Eigen::Matrix3d in_frame = R * E * R.transpose();
  return in_frame.trace() * Eigen::Matrix3d::Identity() - in_frame;
}

}  // namespace

namespace {

/// Rows: directions along a beam, of flap and of lag. Along is from its first node to its last one, and flap
/// the mean of the z axes of its sections, as far as it is normal to that.
Eigen::Matrix3d beam_axes(const std::vector<const MassCarrier*>& nodes, const Vector& x) {
  const Eigen::Vector3d s =
      (triple(x, nodes.back()->first_triple) - triple(x, nodes.front()->first_triple)).normalized();
  Eigen::Vector3d z = Eigen::Vector3d::Zero();
  for (const MassCarrier* node : nodes) z += triple(x, node->first_triple + 3);
  const Eigen::Vector3d a = (z - s.dot(z) * s).normalized();
  Eigen::Matrix3d axes;
  axes << s.transpose(), a.transpose(), a.cross(s).transpose();
  return axes;
}

/// Masses by name. Those of one name are the nodes of a beam, in their order.
std::map<std::string, std::vector<const MassCarrier*>> by_name(const std::vector<MassCarrier>& masses) {
  std::map<std::string, std::vector<const MassCarrier*>> groups;
  for (const MassCarrier& mass : masses) groups[mass.name].push_back(&mass);
  return groups;
}

/// "1st", "2nd", "3rd", "4th", ...
std::string ordinal(int i) {
  const bool teens = i % 100 >= 11 && i % 100 <= 13;
  const char* ending = teens || i % 10 > 3 || i % 10 == 0 ? "th"
                       : i % 10 == 1                      ? "st"
                       : i % 10 == 2                      ? "nd"
                                                          : "rd";
  return std::to_string(i) + ending;
}

}  // namespace

EnergyShares::EnergyShares(const ModelDescription& description, const SystemMatrix& M, const Vector& x) {
  const auto groups = by_name(description.masses);
  for (const MassCarrier& mass : description.masses) {
    Carrier carrier{mass, false, {}, Eigen::Matrix3d::Identity()};
    const Eigen::Vector3d at = centre(mass, moments(M, mass), x);
    if (const auto& nodes = groups.at(mass.name); nodes.size() > 1) {
      carrier.blade = true;
      carrier.axes = beam_axes(nodes, x);
    } else if (description.rotation_axis) {
      const Eigen::Vector3d a = *description.rotation_axis;
      const Eigen::Vector3d radius = at - a.dot(at) * a;
      carrier.blade = radius.norm() > on_axis * (1.0 + at.norm());
      if (carrier.blade) {
        const Eigen::Vector3d s = radius.normalized();
        carrier.axes << s.transpose(), a.transpose(), a.cross(s).transpose();
      }
    }
    const std::size_t n_motions = mass.n_triples > 1 ? 6 : 3;
    for (std::size_t k = 0; k < n_motions; ++k)
      carrier.rows[k] = row_of(mass.name, carrier.blade ? of_blade[k] : of_frame[k]);
    carriers_.push_back(carrier);
  }
}

bool EnergyShares::fits(const ModelDescription& description) const {
  if (carriers_.size() != description.masses.size()) return false;
  for (std::size_t i = 0; i < carriers_.size(); ++i) {
    const MassCarrier& mass = description.masses[i];
    const MassCarrier& own = carriers_[i].mass;
    if (own.first_triple != mass.first_triple || own.n_triples != mass.n_triples) return false;
    for (const Index row : carriers_[i].rows) {
      if (row < 0 || row >= static_cast<Index>(motions_.size())) return false;
    }
  }
  return true;
}

Index EnergyShares::row_of(const std::string& mass, const std::string& kind) {
  const auto known = std::find_if(motions_.begin(), motions_.end(),
                                  [&](const MassMotion& m) { return m.mass == mass && m.kind == kind; });
  const auto row = static_cast<Index>(known - motions_.begin());
  if (known == motions_.end()) motions_.push_back({mass, kind});
  return row;
}

Matrix EnergyShares::of(const SystemMatrix& M, const Vector& x, const ComplexMatrix& shapes) const {
  Matrix shares = Matrix::Zero(static_cast<Index>(motions_.size()), shapes.cols());
  for (const Carrier& carrier : carriers_) {
    const Moments G = moments(M, carrier.mass);
    const Eigen::Matrix3d J = carrier.axes * inertia(carrier.mass, G, x) * carrier.axes.transpose();
    for (Index mode = 0; mode < shapes.cols(); ++mode) {
      const RigidMotion motion = rigid_motion(carrier.mass, G, x, shapes.col(mode));
      const ComplexVec3 v = carrier.axes.cast<Complex>() * motion.velocity;
      const ComplexVec3 w = carrier.axes.cast<Complex>() * motion.rotation;
      const ComplexVec3 angular_momentum = J.cast<Complex>() * w;
      for (Index k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        shares(carrier.rows[at], mode) += G(0, 0) * std::norm(v[k]);
        if (carrier.mass.n_triples > 1)
          shares(carrier.rows[at + 3], mode) += (std::conj(w[k]) * angular_momentum[k]).real();
      }
    }
  }
  for (Index mode = 0; mode < shapes.cols(); ++mode) {
    const double total = shares.col(mode).sum();
    if (total > 0.0) shares.col(mode) /= total;
  }
  return shares;
}

std::vector<std::string> EnergyShares::names(const Matrix& shares) const {
  // share of the energy from which one kind of motion, or one mass, alone gives the name
  constexpr double dominant = 0.7;
  std::map<std::string, int> nodes;  // of a beam: more than one
  for (const Carrier& carrier : carriers_) ++nodes[carrier.mass.name];
  std::vector<std::string> names;
  std::map<std::string, int> beam_modes;
  for (Index mode = 0; mode < shares.cols(); ++mode) {
    std::map<std::string, double> by_kind, by_mass;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      by_kind[motions_[i].kind] += shares(static_cast<Index>(i), mode);
      by_mass[motions_[i].mass] += shares(static_cast<Index>(i), mode);
    }
    const auto ranked = [](const std::map<std::string, double>& sums) {
      std::vector<std::pair<std::string, double>> list(sums.begin(), sums.end());
      std::stable_sort(list.begin(), list.end(),
                       [](const auto& a, const auto& b) { return a.second > b.second; });
      return list;
    };
    const auto kinds = ranked(by_kind);
    const auto masses = ranked(by_mass);
    if (kinds.empty() || !(kinds[0].second > 0.0)) {
      names.emplace_back();
      continue;
    }
    std::string name = kinds[0].first;
    if (kinds[0].second < dominant && kinds.size() > 1) name = both(name, kinds[1].first);
    const bool of_one = masses.size() == 1 || masses[0].second > dominant;
    const std::string owner = masses.size() > 1 && of_one ? masses[0].first + " " : "";
    if (of_one && nodes[masses[0].first] > 1) name = ordinal(++beam_modes[owner + name]) + " " + name;
    name = owner + name;
    names.push_back(std::move(name));
  }
  // Equal names are numbered; those of beams differ already.
  std::map<std::string, int> total, seen;
  for (const std::string& name : names) ++total[name];
  for (std::string& name : names) {
    const std::string base = name;
    if (!base.empty() && total[base] > 1) name += " " + std::to_string(++seen[base]);
  }
  return names;
}

}  // namespace eigentrail
