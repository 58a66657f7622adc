#include "model/first_frequency.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "model/gauss_points.hpp"

namespace eigentrail {
namespace {

constexpr int shapes = 6;
/// Exact for squares of the shapes times properties that are linear between stations.
constexpr int points_between_stations = 8;

/// What resists the motion at a station: the stiffness of bending without axial force, or of twist.
Expression stiffness_at(const BeamTable::Stiffness& S, BladeMotion motion) {
  if (motion == BladeMotion::torsion) return S[section_entry(3, 3)];
  const std::size_t bending = motion == BladeMotion::flap ? 4 : 5;
  const Expression& coupling = S[section_entry(bending, 0)];
  return S[section_entry(bending, bending)] - coupling * coupling / S[section_entry(0, 0)];
}

Expression inertia_at(const BeamTable::Mass& mass, BladeMotion motion) {
  return motion == BladeMotion::torsion ? mass[3] + mass[4] : mass[0];
}

/// Shape k at s: s^p, and its strain, the derivative that bending or twist is.
struct RitzShape {
  double value = 0.0, strain = 0.0;
};
RitzShape ritz_shape(int k, double s, BladeMotion motion) {
  const int order = motion == BladeMotion::torsion ? 1 : 2;
  const int power = k + order;
  const double factor = order == 1 ? power : power * (power - 1.0);
  return {std::pow(s, power), factor * std::pow(s, power - order)};
}

}  // namespace

Expression first_frequency(const Draft& draft, const BeamTable& table, const Expression& length,
                           BladeMotion motion) {
  std::vector<Expression> stiffness, inertia;
  for (const BeamTable::Stiffness& S : table.stiffness) stiffness.push_back(stiffness_at(S, motion));
  for (const BeamTable::Mass& mass : table.mass) inertia.push_back(inertia_at(mass, motion));
  std::vector<double> ends = table.span;
  if (ends.size() == 1) ends = {0.0, 1.0};

  // Of each station: integrals of products of shapes, weighted with its share.
  std::vector<Eigen::MatrixXd> K(stiffness.size(), Eigen::MatrixXd::Zero(shapes, shapes)), M = K;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    for (const auto& [at, weight] : gauss_points(points_between_stations)) {
      const double width = ends[i] - ends[i - 1];
      const double s = ends[i - 1] + at * width;
      Eigen::VectorXd value(shapes), strain(shapes);
      for (int k = 0; k < shapes; ++k) {
        const RitzShape one = ritz_shape(k, s, motion);
        value[k] = one.value;
        strain[k] = one.strain;
      }
      for (const auto& [station, part] : table.shares(s)) {
        K[station] += weight * width * part * strain * strain.transpose();
        M[station] += weight * width * part * value * value.transpose();
      }
    }
  }

  Eigen::MatrixXd K_sum = Eigen::MatrixXd::Zero(shapes, shapes), M_sum = K_sum;
  for (std::size_t i = 0; i < K.size(); ++i) {
    K_sum += draft.check_values(stiffness[i]).front() * K[i];
    M_sum += draft.check_values(inertia[i]).front() * M[i];
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K_sum, M_sum);
  const Eigen::VectorXd first = solver.eigenvectors().col(0);
  Expression strain_energy(0.0), kinetic(0.0);
  for (std::size_t i = 0; i < K.size(); ++i) {
    strain_energy = strain_energy + Expression(first.dot(K[i] * first)) * stiffness[i];
    kinetic = kinetic + Expression(first.dot(M[i] * first)) * inertia[i];
  }
  const Expression per_length = motion == BladeMotion::torsion ? length : length * length;
  return sqrt(strain_energy / kinetic) / per_length;
}

}  // namespace eigentrail
