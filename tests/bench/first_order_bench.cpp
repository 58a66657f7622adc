// Time per point of first-order families against second-order ones with the same eigenvalues.
#include <Eigen/QR>
#include <cmath>

#include "bench/benchmarks.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"
#include "hard_cases/family.hpp"
#include "support/families.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

constexpr double first_order_tolerance = 1e-8;
constexpr double largest_ratio = 1.3;

/// Pairs of families with the same eigenvalues for p from 0 to `to`.
struct Kind {
  std::string name;
  bool heavy = false;        ///< damping ratios up to about a third, in place of one percent
  bool circulatory = false;  ///< K and C without symmetry
  bool mixed = false;        ///< states that are random combinations of positions and velocities
  bool implicit = false;     ///< a full E
  double to = 3.0;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{"lightly damped"},
                                     {"heavily damped", true},
                                     {"circulatory", false, true, false, false, 1.5},
                                     {"mixed states", false, false, true},
                                     {"mixed states and a full E", false, false, true, true}};
  return all;
}

Matrix random_rotation(Eigen::Index n, std::mt19937_64& engine) {
  return random_matrix(n, n, engine).householderQr().householderQ();
}

/// Frequencies 3, 4.3, 5.6 ... rad/s that a random stiffness moves across each other.
Family second_order(const Kind& kind, int n, std::mt19937_64& engine) {
  const Matrix Q = random_rotation(n, engine);
  const Vector squares = Vector::LinSpaced(n, 3.0, 3.0 + 1.3 * (n - 1)).cwiseAbs2();
  const Matrix S = random_matrix(n, n, engine), G = random_matrix(n, n, engine),
               D = random_matrix(n, n, engine);
  Matrix C = 0.05 * Matrix::Identity(n, n);
  if (kind.heavy) C = 0.5 * Matrix::Identity(n, n) + 1.5 * D * D.transpose() / n;
  if (kind.circulatory) C = 0.5 * Matrix::Identity(n, n) + 0.3 * D;
  Matrix stiffness = 4.0 * (S + S.transpose());
  if (kind.circulatory) stiffness += 4.0 * (G + D - G.transpose() - D.transpose());
  return {{Matrix::Identity(n, n)},
          {C, 0.3 * (G - G.transpose())},
          {Q * squares.asDiagonal() * Q.transpose(), stiffness}};
}

/// E x' = A x with x = T^-1 [z; z'], multiplied by E from the left.
struct StateSpace {
  MatrixSeries E, A;
};

StateSpace first_order(const Kind& kind, const Family& family, std::mt19937_64& engine) {
  constexpr double frequency = 8.0;  // brings velocities to the size of positions
  const Eigen::Index n = family.K[0].rows(), N = 2 * n;
  Matrix T = Matrix::Identity(N, N), E = T;
  if (kind.mixed) {
    T = random_rotation(N, engine);
    T.bottomRows(n) *= frequency;
  }
  if (kind.implicit) E += 0.2 * random_matrix(N, N, engine);
  StateSpace states{{E}, {}};
  for (std::size_t k = 0; k < family.K.size(); ++k) {
    Matrix A = Matrix::Zero(N, N);
    if (k == 0) A.topRightCorner(n, n).setIdentity();
    A.bottomLeftCorner(n, n) = -family.K[k];
    A.bottomRightCorner(n, n) = -family.C[k];
    states.A.push_back(kind.mixed ? Matrix(E * T.partialPivLu().solve(A * T)) : Matrix(E * A));
  }
  return states;
}

struct Pair {
  Setting first, second;
};

Pair pair_of(const Kind& kind, int n, unsigned seed) {
  std::mt19937_64 engine(seed);
  const Family family = second_order(kind, n, engine);
  const StateSpace states = first_order(kind, family, engine);
  const std::string E = kind.implicit ? "E = " + text(states.E) + "\n" : "";
  return {make_setting(family_scene(E + "A = " + text(states.A) + "\n", 0.0, kind.to)),
          make_setting(family_scene(family, 0.0, kind.to))};
}

double seconds_per_point(const Setting& setting, int& points) {
  TraceOptions options = setting.options;
  options.tolerance = first_order_tolerance;
  const TimedTrace timed = time_trace(setting, options);
  points = static_cast<int>(timed.result.nodes);
  return timed.follow_seconds / std::max(1, points - 1);
}

/// The ratio for one pair, as the median of the rounds' ratios.
Figure ratio_of(const Kind& kind, int n, unsigned seed, const BenchOptions& options) {
  const Pair pair = pair_of(kind, n, seed);
  Rounds rounds;
  int first_points = 0, second_points = 0;
  for (int i = 0; i < options.repeats; ++i) {
    const double second = seconds_per_point(pair.second, second_points);
    rounds.add({seconds_per_point(pair.first, first_points), second});
  }
  return {"first order of " + std::to_string(2 * n) + " states / second order of " + std::to_string(n) +
              ", all modes, time per point, " + kind.name + ", seed " + std::to_string(seed),
          rounds.ratio(0, 1), at_most(largest_ratio),
          time_text(rounds.seconds(0)) + ", " + std::to_string(first_points) + " points / " +
              time_text(rounds.seconds(1)) + ", " + std::to_string(second_points) + " points"};
}

}  // namespace

Figures first_order(const BenchOptions& options) {
  const int n = options.smoke ? 3 : 10;
  const unsigned seeds = options.smoke ? 1 : 4;
  Figures figures;
  for (const Kind& kind : kinds()) {
    for (unsigned seed = 1; seed <= seeds; ++seed) figures.push_back(ratio_of(kind, n, seed, options));
  }
  return figures;
}

}  // namespace eigentrail::test
