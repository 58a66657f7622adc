#include "eigentrail/modes/energy_shares.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "modes/ordinal.hpp"

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

/// First triple of a mass at rest: for blades of a rotor, of its collective coordinates.
Index at_rest(const MassCarrier& mass) {
  return mass.wave.rest_triple < 0 ? mass.first_triple : mass.wave.rest_triple;
}

/// Position of the centre of mass.
Eigen::Vector3d centre(const MassCarrier& mass, const Moments& G, const Vector& x) {
  Eigen::Vector3d at = triple(x, at_rest(mass));
  for (Index i = 1; i < mass.n_triples && G(0, 0) > 0.0; ++i)
    at += (G(0, i) / G(0, 0)) * triple(x, at_rest(mass) + i);
  return at;
}

/// Velocity of the centre of mass and angular velocity.
struct RigidMotion {
  ComplexVec3 velocity = ComplexVec3::Zero();
  ComplexVec3 rotation = ComplexVec3::Zero();
};

/// Displacement of one triple of a mass. A wave of blades, q_k = c cos(n psi_k) + s sin(n psi_k), is made of
/// one that turns with the rotor and one against it, (c + i s)/sqrt(2) and (c - i s)/sqrt(2) at psi_k = 0,
/// which together have the energy of c and s.
ComplexVec3 displacement(const MassCarrier& mass, Index i, const ComplexVector& shape) {
  const ComplexVec3 own = shape.segment<3>(3 * (mass.first_triple + i));
  if (mass.wave.sense == 0) return own;
  const ComplexVec3 sine = shape.segment<3>(3 * (mass.wave.sine_triple + i));
  return std::sqrt(0.5) * (own + Complex(0.0, mass.wave.sense) * sine);
}

RigidMotion rigid_motion(const MassCarrier& mass, const Moments& G, const Vector& x,
                         const ComplexVector& shape) {
  RigidMotion motion;
  motion.velocity = displacement(mass, 0, shape);
  for (Index i = 1; i < mass.n_triples; ++i) {
    const ComplexVec3 rate = displacement(mass, i, shape);
    const ComplexVec3 director = triple(x, at_rest(mass) + i).cast<Complex>();
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
  for (Index i = 0; i < 3; ++i) R.col(i) = triple(x, at_rest(mass) + 1 + i);
  const Eigen::Matrix3d in_frame = R * E * R.transpose();
  return in_frame.trace() * Eigen::Matrix3d::Identity() - in_frame;
}

/// Rows: directions along a beam, of flap and of lag. Along is from its first node to its last one, and flap
/// the mean of the z axes of its sections, as far as it is normal to that.
Eigen::Matrix3d beam_axes(const std::vector<const MassCarrier*>& nodes, const Vector& x) {
  const Eigen::Vector3d s =
      (triple(x, at_rest(*nodes.back())) - triple(x, at_rest(*nodes.front()))).normalized();
  Eigen::Vector3d z = Eigen::Vector3d::Zero();
  for (const MassCarrier* node : nodes) z += triple(x, at_rest(*node) + 3);
  const Eigen::Vector3d a = (z - s.dot(z) * s).normalized();
  Eigen::Matrix3d axes;
  axes << s.transpose(), a.transpose(), a.cross(s).transpose();
  return axes;
}

/// Masses by name and wave. Those of one name are the nodes of a beam, in their order.
using MassGroups = std::map<std::pair<std::string, std::string>, std::vector<const MassCarrier*>>;

MassGroups by_name(const std::vector<MassCarrier>& masses) {
  MassGroups groups;
  for (const MassCarrier& mass : masses) groups[{mass.name, mass.wave.name}].push_back(&mass);
  return groups;
}

}  // namespace

double blade_rotor_speed(const ModelDescription& description, Vector parameters) {
  if (!description.rotor) return std::numeric_limits<double>::quiet_NaN();
  const std::span<double> values(parameters.data(), static_cast<std::size_t>(parameters.size()));
  description.parameters.to_si(values);
  return description.rotor->speed.evaluate(std::span<const double>(values));
}

EnergyShares::EnergyShares(const ModelDescription& description, const SystemMatrix& M, const Vector& x) {
  const auto groups = by_name(description.masses);
  for (const MassCarrier& mass : description.masses) {
    Carrier carrier{mass, false, {}, Eigen::Matrix3d::Identity()};
    const Eigen::Vector3d at = centre(mass, moments(M, mass), x);
    if (const auto& nodes = groups.at({mass.name, mass.wave.name}); nodes.size() > 1) {
      carrier.blade = true;
      carrier.axes = beam_axes(nodes, x);
    } else if (description.rotation_axis && !mass.stands) {
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
      carrier.rows[k] = row_of({mass.name, carrier.blade ? of_blade[k] : of_frame[k], mass.wave.name});
    carriers_.push_back(carrier);
  }
}

bool EnergyShares::fits(const ModelDescription& description) const {
  if (carriers_.size() != description.masses.size()) return false;
  for (std::size_t i = 0; i < carriers_.size(); ++i) {
    const MassCarrier& mass = description.masses[i];
    const MassCarrier& own = carriers_[i].mass;
    if (own.first_triple != mass.first_triple || own.n_triples != mass.n_triples ||
        own.wave.name != mass.wave.name)
      return false;
    for (const Index row : carriers_[i].rows) {
      if (row < 0 || row >= static_cast<Index>(motions_.size())) return false;
    }
  }
  return true;
}

Index EnergyShares::row_of(const MassMotion& motion) {
  const auto known = std::find_if(motions_.begin(), motions_.end(), [&](const MassMotion& m) {
    return m.mass == motion.mass && m.kind == motion.kind && m.wave == motion.wave;
  });
  const auto row = static_cast<Index>(known - motions_.begin());
  if (known == motions_.end()) motions_.push_back(motion);
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

namespace {

/// Share of the energy from which one kind of motion, one mass or one wave alone gives the name.
constexpr double dominant = 0.7;

/// Names with their shares, by descending share.
using Ranking = std::vector<std::pair<std::string, double>>;

Ranking ranked(const std::map<std::string, double>& sums) {
  Ranking list(sums.begin(), sums.end());
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return list;
}

/// " progressive", " slow progressive" if the wave turns with the rotor but more slowly, " cyclic" if two
/// waves have about the same share. Empty for what is not a blade. `turns`: Im s over the speed of the rotor.
std::string wave_in_words(const std::map<std::string, double>& by_wave, double turns) {
  const Ranking waves = ranked(by_wave);
  if (waves.empty() || !(waves[0].second > 0.0)) return "";
  double all = 0.0;
  for (const auto& [wave, share] : waves) all += share;
  if (waves[0].second < dominant * all) return " cyclic";
  const std::string& wave = waves[0].first;
  if (!wave.starts_with("progressive")) return " " + wave;
  const std::size_t number = wave.find(' ');
  const double harmonic = number == std::string::npos ? 1.0 : std::stod(wave.substr(number));
  return std::abs(turns) < harmonic ? " slow " + wave : " " + wave;
}

}  // namespace

std::vector<std::string> EnergyShares::names(const Matrix& shares, const std::vector<double>& turns) const {
  std::map<std::pair<std::string, std::string>, int> nodes;  // of a beam: more than one
  for (const Carrier& carrier : carriers_) ++nodes[{carrier.mass.name, carrier.mass.wave.name}];
  std::map<std::string, bool> is_beam;
  for (const auto& [name, count] : nodes) is_beam[name.first] = count > 1;
  std::vector<std::string> names;
  std::map<std::string, int> beam_modes;
  for (Index mode = 0; mode < shares.cols(); ++mode) {
    std::map<std::string, double> by_kind, by_mass;
    std::map<std::string, std::map<std::string, double>> by_wave;  // of each kind
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const double share = shares(static_cast<Index>(i), mode);
      by_kind[motions_[i].kind] += share;
      by_mass[motions_[i].mass] += share;
      if (!motions_[i].wave.empty()) by_wave[motions_[i].kind][motions_[i].wave] += share;
    }
    const Ranking kinds = ranked(by_kind);
    const Ranking masses = ranked(by_mass);
    if (kinds.empty() || !(kinds[0].second > 0.0)) {
      names.emplace_back();
      continue;
    }
    const double turn = turns.empty() ? NAN : turns[static_cast<std::size_t>(mode)];
    const auto with_wave = [&](const std::string& kind) { return kind + wave_in_words(by_wave[kind], turn); };
    std::string name = with_wave(kinds[0].first);
    if (kinds[0].second < dominant && kinds.size() > 1) {
      const bool alike =
          wave_in_words(by_wave[kinds[0].first], turn) == wave_in_words(by_wave[kinds[1].first], turn);
      name = alike ? both(kinds[0].first, kinds[1].first) + wave_in_words(by_wave[kinds[0].first], turn)
                   : name + ", " + with_wave(kinds[1].first);
    }
    const bool of_one = masses.size() == 1 || masses[0].second > dominant;
    const std::string owner = masses.size() > 1 && of_one ? masses[0].first + " " : "";
    if (of_one && is_beam[masses[0].first]) name = ordinal(++beam_modes[owner + name]) + " " + name;
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
