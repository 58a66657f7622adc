// The family of a seed: random blocks with planted special points, randomly mixed.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <utility>

#include <Eigen/SVD>

#include "properties/blocks.hpp"

namespace eigentrail::test {
namespace {

constexpr double range_from = -0.5, range_to = 0.5;
constexpr int most_points = 6;            ///< planted; crossings with other modes come on top
constexpr std::size_t most_special = 14;  ///< with those
constexpr double largest_condition = 30;  ///< of the mixing matrices

/// Numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  int integer(int a, int b) {
    return a + static_cast<int>(engine_() % static_cast<std::uint64_t>(b - a + 1));
  }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  double power_of_ten(double a, double b) { return std::pow(10.0, uniform(a, b)); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// Of either sign, with a magnitude in the interval.
  double magnitude(double a, double b) {
    const double side = sign();
    return side * uniform(a, b);
  }
  double power_of_ten_or_minus(double a, double b) {
    const double side = sign();
    return side * power_of_ten(a, b);
  }

 private:
  std::mt19937_64 engine_;
};

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  void fill(PlantedFamily& family) {
    n_ = random_.integer(3, 12);
    place();
    group_ = random_.uniform(0.02, 0.15);
    std::size_t i = 0;
    while (i < points_.size() && left() > 0) {
      const std::size_t remaining = points_.size() - i;
      i += static_cast<std::size_t>(plant(static_cast<int>(remaining), &points_[i]));
    }
    while (left() > 0) filler();
    family.from = range_from;
    family.to = range_to;
    family.blocks = blocks_;
    find_special_points(family);
    if (family.special.empty() || family.special.size() > most_special)
      throw UnusableFamily("none or too many special points");
    mix(family);
  }

 private:
  /// Planted parameters: anywhere, or 1e-4 to 0.1 of the range from another; neighbours stay in order.
  void place() {
    const int count = random_.integer(1, most_points);
    for (int i = 0; i < count; ++i) {
      const bool beside = i > 0 && random_.chance(0.5);
      const double p =
          beside ? points_.back() + random_.power_of_ten_or_minus(-4.0, -1.0) : random_.uniform(-0.47, 0.47);
      points_.push_back(p);
    }
  }

  Eigen::Index left() const {
    Eigen::Index used = 0;
    for (const PlantedBlock& block : blocks_) used += block.size;
    return n_ - used;
  }

  Wide level() { return random_.uniform(2.0, 8.0); }
  Wide steep() { return random_.magnitude(0.3, 2.5); }
  Polynomial line(Wide value, Wide slope, Wide at) {
    return Polynomial(value) + Polynomial(slope) * from_root(at);
  }
  Polynomial drifting_level() {
    const Wide slope = random_.uniform(-0.3, 0.3);
    return line(level(), slope, 0);
  }
  /// The damping that blocks share, so that they can cross, or one of their own.
  Wide damping() { return random_.chance(0.6) ? group_ : Wide(random_.uniform(0.02, 0.15)); }

  /// Plants something at the next points; returns how many it took.
  int plant(int points, const double* p) {
    struct Choice {
      int points;
      Eigen::Index freedoms;
      std::function<void(const double*)> make;
    };
    const std::vector<Choice> choices = {
        {1, 2, [this](const double* q) { crossing(q[0]); }},
        {2, 2, [this](const double* q) { crossing_twice(q[0], q[1]); }},
        {1, 2, [this](const double* q) { damped_crossing(q[0]); }},
        {1, 2, [this](const double* q) { veering(q[0]); }},
        {2, 2, [this](const double* q) { veering_twice(q[0], q[1]); }},
        {2, 3, [this](const double* q) { shared_veerings(q[0], q[1]); }},
        {1, 2, [this](const double* q) { exceptional(q, 1); }},
        {2, 2, [this](const double* q) { exceptional(q, 2); }},
        {2, 2, [this](const double* q) { exceptional_pair(q[0], q[1]); }},
        {3, 2, [this](const double* q) { exceptional(q, 3); }},
        {1, 1, [this](const double* q) { collision(q, 1); }},
        {2, 1, [this](const double* q) { collision(q, 2); }},
        {1, 1, [this](const double* q) { real_veering(q[0]); }},
        {1, 1, [this](const double* q) { flutter(q[0]); }},
        {1, 1, [this](const double* q) { divergence(q[0]); }},
    };
    while (true) {
      const Choice& choice =
          choices[static_cast<std::size_t>(random_.integer(0, static_cast<int>(choices.size()) - 1))];
      if (choice.points > points || choice.freedoms > left()) continue;
      choice.make(p);
      return choice.points;
    }
  }

  void crossing(Wide p) {
    // Another crossing with a mode that is there already, where there is one.
    std::vector<std::size_t> partners;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      if (blocks_[i].size == 1 && blocks_[i].damping == rounded(Polynomial(group_))) partners.push_back(i);
    }
    Polynomial partner;
    if (!partners.empty() && random_.chance(0.6)) {
      partner = blocks_[partners[static_cast<std::size_t>(
                            random_.integer(0, static_cast<int>(partners.size()) - 1))]]
                    .K(0, 0);
    } else {
      partner = drifting_level();
      blocks_.push_back(single("crossing", group_, partner));
      partner = blocks_.back().K(0, 0);
    }
    const Wide curvature = random_.uniform(-0.5, 0.5);
    const Polynomial shape = Polynomial(steep()) + Polynomial(curvature) * from_root(p);
    blocks_.push_back(single("crossing", group_, partner + shape * from_root(p)));
  }

  void crossing_twice(Wide p, Wide q) {
    const Polynomial partner = drifting_level();
    blocks_.push_back(single("two crossings", group_, partner));
    blocks_.push_back(
        single("two crossings", group_, partner + Polynomial(steep()) * from_root(p) * from_root(q)));
  }

  /// Dampings and stiffnesses agree at one parameter only, exactly.
  void damped_crossing(Wide p) {
    p = rounded(p, 0x1p-16L);
    const Wide c = rounded(random_.uniform(0.08, 0.15), 0x1p-20L);
    const Wide mu = rounded(level(), 0x1p-20L);
    for (int i = 0; i < 2; ++i) {
      const Wide slope = rounded(random_.uniform(-0.06, 0.06), 0x1p-12L);
      blocks_.push_back(
          single("crossing of dampings", line(c, slope, p), line(mu, rounded(steep(), 0x1p-10L), p)));
    }
  }

  void veering(Wide p) {
    const Wide slope = steep() / 2;
    const Wide half_width = random_.power_of_ten(-9.0, -1.0);
    const Polynomial mean = drifting_level();
    blocks_.push_back(two_coupled("veering", damping(), mean, Polynomial(slope) * from_root(p),
                                  std::abs(slope) * half_width, true));
  }

  void veering_twice(Wide p, Wide q) {
    const Wide curvature = steep();
    const Wide half_width = random_.power_of_ten(-9.0, -1.0);
    const Polynomial mean = drifting_level();
    blocks_.push_back(two_coupled("two veerings", damping(), mean,
                                  Polynomial(curvature) * from_root(p) * from_root(q),
                                  std::abs(curvature * (p - q)) * half_width, true));
  }

  void shared_veerings(Wide p, Wide q) {
    const Wide slope = steep();
    const auto coupling = [&] {
      return std::abs(slope) / 2 * std::min<Wide>(random_.power_of_ten(-9.0, -1.0), std::abs(p - q) / 5);
    };
    const Wide e1 = coupling();
    const Wide e2 = coupling();
    const Wide base = level();
    blocks_.push_back(test::shared_veerings(damping(), base, slope, p, q, e1, e2));
  }

  void exceptional(const double* p, int count) {
    Polynomial delta(random_.power_of_ten_or_minus(-1.5, -0.3));
    for (int i = 0; i < count; ++i) delta = delta * from_root(p[i]);
    const char* const names[] = {"exceptional point", "two exceptional points", "three exceptional points"};
    const Polynomial mean = drifting_level();
    blocks_.push_back(companion(names[count - 1], damping(), mean, delta));
  }

  /// [[m + g, e], [-e, m - g]]: the pair is coupled between the two points.
  void exceptional_pair(Wide p, Wide q) {
    const Wide slope = steep() / 2;
    const Polynomial mean = drifting_level();
    blocks_.push_back(two_coupled("pair of exceptional points", damping(), mean,
                                  Polynomial(slope) * from_root((p + q) / 2), std::abs(slope * (p - q)) / 2,
                                  false));
  }

  Wide heavy_damping() { return rounded(random_.uniform(0.5, 1.2)); }

  void collision(const double* p, int count) {
    const Wide c = heavy_damping();
    Polynomial excess(random_.magnitude(0.05, 0.5));
    for (int i = 0; i < count; ++i) excess = excess * from_root(p[i]);
    blocks_.push_back(
        single(count == 1 ? "real collision" : "two real collisions", c, Polynomial(c * c) - excess));
  }

  void real_veering(Wide p) {
    const Wide c = heavy_damping();
    const Wide half_width = random_.power_of_ten(-4.0, -1.0);
    const Polynomial excess = Polynomial(random_.uniform(0.05, 0.5)) *
                              (from_root(p) * from_root(p) + Polynomial(half_width * half_width));
    blocks_.push_back(single("real veering", c, Polynomial(c * c) - excess));
  }

  void flutter(Wide p) {
    const Wide slope = random_.magnitude(0.05, 0.5);
    blocks_.push_back(single("flutter", Polynomial(slope) * from_root(p), drifting_level()));
  }

  void divergence(Wide p) {
    const Polynomial stiffness = Polynomial(random_.magnitude(0.05, 0.3)) * from_root(p);
    blocks_.push_back(single("divergence", heavy_damping(), stiffness));
  }

  /// Modes beside: of the shared damping, of nearly the same, so that they come close to a crossing, or of
  /// any other.
  void filler() {
    const bool same = random_.chance(0.3);
    const Wide c = same                  ? group_
                   : random_.chance(0.5) ? group_ + Wide(random_.power_of_ten_or_minus(-4.0, -2.0))
                                         : Wide(random_.uniform(0.02, 0.15));
    const Wide slope = same ? Wide(random_.uniform(-0.2, 0.2)) : steep();
    blocks_.push_back(single(same ? "beside, shared damping" : "beside", c, line(level(), slope, 0)));
  }

  // Mixing.

  /// Unit lower triangular with a few quarters.
  Matrix lower() {
    Matrix result = Matrix::Identity(n_, n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        if (random_.chance(std::min(1.0, 3.0 / static_cast<double>(n_))))
          result(i, j) = 0.25 * random_.integer(-3, 3);
      }
    }
    return result;
  }

  Matrix permutation() {
    Matrix result = Matrix::Identity(n_, n_);
    for (Eigen::Index i = n_ - 1; i > 0; --i)
      result.row(i).swap(result.row(random_.integer(0, static_cast<int>(i))));
    return result;
  }

  /// I - 2 v v^T / (v^T v) with v = +-1 at four or eight places: orthogonal, of halves or quarters.
  Matrix reflection() {
    const Eigen::Index places = n_ >= 8 && random_.chance(0.5) ? 8 : 4;
    if (n_ < places) return Matrix::Identity(n_, n_);
    Vector v = Vector::Zero(n_);
    for (Eigen::Index i = 0; i < places; ++i) v[i] = random_.sign();
    v = permutation() * v;
    return Matrix::Identity(n_, n_) - 2.0 / static_cast<double>(places) * v * v.transpose();
  }

  /// Invertible for every p: a constant matrix, or that times I + p N with N nilpotent.
  MatrixSeries mixing(bool along) {
    // One after the other: the order in which a product evaluates its factors is not specified.
    // One after the other: the order in which a product evaluates its factors is not specified.
    const Matrix inner = lower();
    const Matrix order = permutation();
    const Matrix outer = along ? Matrix(Matrix::Identity(n_, n_)) : reflection();
    const Matrix constant = outer * order * inner;
    MatrixSeries T{constant};
    if (along) {
      const Matrix N = lower() - Matrix::Identity(n_, n_);
      const Matrix turn = permutation();
      T.push_back(constant * turn * N * turn.transpose());
    }
    for (const double p : {range_from, 0.0, range_to}) {
      const Matrix at = along ? Matrix(T[0] + p * T[1]) : T[0];
      const auto sigma = Eigen::JacobiSVD<Matrix>(at).singularValues();
      if (sigma[0] > largest_condition * sigma[n_ - 1]) throw UnusableFamily("mixing is badly conditioned");
    }
    return T;
  }

  void mix(PlantedFamily& family) {
    const bool along = random_.chance(0.35);
    const bool congruent = random_.chance(0.5);
    family.mixing =
        std::string(along ? "turning " : "constant ") + (congruent ? "congruence" : "equivalence");
    constexpr int attempts = 200;
    for (int i = 0; i < attempts; ++i) {
      try {
        const MatrixSeries T = mixing(along);
        const MatrixSeries P = congruent ? T : mixing(along);
        family.matrices = mixed(family.blocks, P, T);
        return;
      } catch (const UnusableFamily&) {
        continue;
      }
    }
    throw UnusableFamily("no mixing found");
  }

  Random random_;
  Eigen::Index n_ = 0;
  std::vector<double> points_;
  Wide group_ = 0;
  std::vector<PlantedBlock> blocks_;
};

}  // namespace

PlantedFamily planted_family(std::uint64_t seed) {
  constexpr std::uint64_t attempts = 1000;
  for (std::uint64_t attempt = 0; attempt < attempts; ++attempt) {
    PlantedFamily family;
    family.seed = seed;
    try {
      Generator(seed * attempts + attempt).fill(family);
      return family;
    } catch (const UnusableFamily&) {
      continue;
    }
  }
  throw std::runtime_error("no usable family for seed " + std::to_string(seed));
}

}  // namespace eigentrail::test
