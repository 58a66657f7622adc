// Every special point of a family of blocks, from roots of polynomials.
#include <algorithm>
#include <stdexcept>

#include "properties/planted_family.hpp"

namespace eigentrail::test {
namespace {

constexpr double least_distance = 0.9e-4;  // of the range, between special points
constexpr double end_margin = 1e-3;        // of the range, from its ends
constexpr double widest_veering = 0.01;    // of the range, for the distances
constexpr Wide least_excess = 0.3;         // of mu over c^2 where a block is not meant to be overdamped
constexpr Wide least_slope = 1e-3;         // of what changes its sign at a flutter point

Wide constant_part(const Polynomial& a) {
  return a.c[0];
}

/// -c + sqrt(c^2 - mu), the member with Im s >= 0.
Complex mode_at(const PlantedBlock& block, WideComplex p, WideComplex mu) {
  const WideComplex c = block.damping(p);
  const WideComplex root = std::sqrt(c * c - mu);
  const WideComplex s = root.imag() >= 0 ? -c + root : -c - root;
  return narrow(s.imag() >= 0 ? s : std::conj(s));
}

/// (k11 - k22)^2 / 4 + k12 k21 of a block of two.
Polynomial discriminant(const PlantedBlock& block) {
  const Polynomial half = Polynomial(Wide(0.5)) * (block.K(0, 0) - block.K(1, 1));
  return half * half + block.K(0, 1) * block.K(1, 0);
}

Polynomial mean(const PlantedBlock& block) {
  return Polynomial(Wide(0.5)) * (block.K(0, 0) + block.K(1, 1));
}

/// det(K - x I).
Polynomial characteristic(const PlantedBlock& block, const Polynomial& x) {
  if (block.size == 1) return block.K(0, 0) - x;
  const auto entry = [&](Eigen::Index i, Eigen::Index j) {
    return i == j ? block.K(i, j) - x : block.K(i, j);
  };
  if (block.size == 2) return entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
  return entry(0, 0) * (entry(1, 1) * entry(2, 2) - entry(1, 2) * entry(2, 1)) -
         entry(0, 1) * (entry(1, 0) * entry(2, 2) - entry(1, 2) * entry(2, 0)) +
         entry(0, 2) * (entry(1, 0) * entry(2, 1) - entry(1, 1) * entry(2, 0));
}

/// Vanishes where two blocks of equal damping have an eigenvalue of K in common.
Polynomial resultant(const PlantedBlock& a, const PlantedBlock& b) {
  if (a.size == 1) return characteristic(b, a.K(0, 0));
  if (b.size == 1) return characteristic(a, b.K(0, 0));
  if (a.size != 2 || b.size != 2) throw UnusableFamily("no resultant for blocks of this size");
  const Polynomial between = mean(a) - mean(b);
  const Polynomial sum = between * between - discriminant(a) - discriminant(b);
  return sum * sum - Polynomial(4) * discriminant(a) * discriminant(b);
}

class Finder {
 public:
  explicit Finder(PlantedFamily& family) : family_(family), low_(family.from), high_(family.to) {
    if (low_ > high_) std::swap(low_, high_);
  }

  void find() {
    family_.special.clear();
    family_.meeting.clear();
    family_.breaks.assign(family_.blocks.size(), {});
    for (std::size_t i = 0; i < family_.blocks.size(); ++i) {
      of_one_block(i);
      for (std::size_t j = 0; j < i; ++j) of_two_blocks(i, j);
    }
    for (auto& breaks : family_.breaks) std::sort(breaks.begin(), breaks.end());
    std::sort(found_.begin(), found_.end(),
              [](const Found& a, const Found& b) { return a.point.parameter < b.point.parameter; });
    for (const Found& found : found_) {
      family_.special.push_back(found.point);
      family_.meeting.push_back(found.blocks);
    }
    check_distances();
  }

 private:
  Wide range() const { return high_ - low_; }

  struct Found {
    SpecialPoint point;
    std::vector<int> blocks;
  };

  void add(const std::string& kind, WideComplex p, Complex s) {
    // Half-widths up to a tenth of the range, as in the catalogue.
    if (p.imag() > range() / 10 || p.real() < low_ || p.real() > high_) {
      if (p.real() > low_ - end_margin * range() && p.real() < high_ + end_margin * range() &&
          p.imag() <= range() / 10)
        throw UnusableFamily("a special point just outside the range");
      return;
    }
    found_.push_back({{kind, static_cast<double>(p.real()), s, static_cast<double>(p.imag())}, current_});
  }

  void of_one_block(std::size_t index) {
    const PlantedBlock& block = family_.blocks[index];
    current_ = {static_cast<int>(index)};
    for (const PlantedBlock::Exceptional& point : block.exceptional) {
      const bool on_axis = point.p.imag() == 0;
      add(on_axis ? "collision" : "veering", point.p, mode_at(block, point.p, point.mu));
      if (on_axis) family_.breaks[index].push_back(point.p.real());
    }
    check_damping(block);
    if (block.size == 1) of_one_freedom(index);
    if (block.size == 2) flutter_of_two(block);
  }

  void of_one_freedom(std::size_t index) {
    const PlantedBlock& block = family_.blocks[index];
    const Polynomial excess = block.overdamping();
    for (const Wide p : real_roots(excess, low_, high_)) {
      add("collision", p, {static_cast<double>(-block.damping(p)), 0.0});
      family_.breaks[index].push_back(p);
    }
    near_touch(block, excess);
    for (const Wide p : real_roots(block.K(0, 0), low_, high_)) add("divergence", p, 0.0);
    for (const Wide p : real_roots(block.damping, low_, high_)) {
      const Wide mu = block.K(0, 0)(p);
      if (mu > 0) add("flutter", p, {0.0, static_cast<double>(std::sqrt(mu))});
    }
  }

  /// Real eigenvalues that come close and part. A pair that nears the real axis meets nothing.
  void near_touch(const PlantedBlock& block, const Polynomial& excess) {
    if (excess.c.size() < 3 || excess.c[2] == 0) return;
    if (excess.c.size() > 3) throw UnusableFamily("overdamping is not quadratic");
    for (const WideComplex p : roots_of_quadratic(excess.c[0], excess.c[1], excess.c[2])) {
      if (p.imag() > 0 && excess(p.real()) > 0) add("veering", p, narrow(-block.damping(p)));
    }
  }

  /// Im s^2 = 0 and Re s = 0 of mu = mean +- j sqrt(-discriminant): -discriminant = 4 c^2 mean.
  void flutter_of_two(const PlantedBlock& block) {
    const Polynomial c = block.damping;
    const Polynomial margin = discriminant(block) + Polynomial(4) * c * c * mean(block);
    for (const Wide p : real_roots(margin, low_, high_)) {
      if (discriminant(block)(p) >= 0) throw UnusableFamily("a real eigenvalue of K below zero");
      if (std::abs(derivative(margin)(p)) < least_slope) throw UnusableFamily("flutter that hardly crosses");
      add("flutter", p, {0.0, static_cast<double>(std::sqrt(mean(block)(p)))});
    }
  }

  void of_two_blocks(std::size_t i, std::size_t j) {
    const PlantedBlock& a = family_.blocks[i];
    const PlantedBlock& b = family_.blocks[j];
    current_ = {static_cast<int>(i), static_cast<int>(j)};
    if (a.damping == b.damping) {
      for (const Wide p : real_roots(resultant(a, b), low_, high_)) {
        const PlantedBlock& single = a.size == 1 ? a : b;
        crossing(p, a.damping(p), single.size == 1 ? WideComplex(single.K(0, 0)(p)) : common_mu(a, b, p));
      }
      return;
    }
    if (a.damping.is_constant() && b.damping.is_constant()) {
      real_crossings(a, b);
      return;
    }
    // Of unequal dampings complex eigenvalues coincide where dampings and stiffnesses do.
    for (const Wide p : real_roots(a.damping - b.damping, low_, high_)) {
      for (const WideComplex x : a.mu(p)) {
        for (const WideComplex y : b.mu(p)) {
          const Wide distance = std::abs(x - y);
          if (distance < Wide(1e-16) * std::abs(x)) {
            crossing(p, a.damping(p), x);
          } else if (distance < Wide(1e-4)) {
            throw UnusableFamily("almost a crossing");
          }
        }
      }
    }
  }

  static WideComplex common_mu(const PlantedBlock& a, const PlantedBlock& b, Wide p) {
    WideComplex best = 0;
    Wide nearest = std::numeric_limits<Wide>::infinity();
    for (const WideComplex x : a.mu(p)) {
      for (const WideComplex y : b.mu(p)) {
        if (std::abs(x - y) >= nearest) continue;
        nearest = std::abs(x - y);
        best = x;
      }
    }
    return best;
  }

  void crossing(Wide p, Wide c, WideComplex mu) {
    const Wide excess = c * c - mu.real();
    if (excess < 0) {
      add("crossing", p, {static_cast<double>(-c), static_cast<double>(std::sqrt(-excess))});
    } else {
      for (const Wide root : {-std::sqrt(excess), std::sqrt(excess)})
        add("crossing", p, {static_cast<double>(-c + root), 0.0});
    }
  }

  /// Constant dampings that differ: s = -(mu_a - mu_b) / (2 (c_a - c_b)) in both characteristic equations,
  /// real.
  void real_crossings(const PlantedBlock& a, const PlantedBlock& b) {
    if (a.size != 1 || b.size != 1) return;  // larger blocks have no real eigenvalues
    const Wide d = 2 * (constant_part(a.damping) - constant_part(b.damping));
    const Polynomial shift = b.K(0, 0) - a.K(0, 0);
    const Polynomial both =
        shift * shift + Polynomial(2 * d) * a.damping * shift + Polynomial(d * d) * a.K(0, 0);
    for (const Wide p : real_roots(both, low_, high_))
      add("crossing", p, {static_cast<double>(shift(p) / d), 0.0});
  }

  /// Blocks that are not meant to have real eigenvalues have none.
  void check_damping(const PlantedBlock& block) const {
    if (block.size == 1 && block.damping.is_constant() && constant_part(block.damping) > Wide(0.4)) return;
    constexpr int n = 200;
    for (int i = 0; i <= n; ++i) {
      const Wide p = low_ + range() * i / n;
      const Wide c = block.damping(p);
      for (const WideComplex mu : block.mu(p)) {
        if (mu.imag() == 0 && mu.real() - c * c < least_excess)
          throw UnusableFamily("a mode is overdamped that should not be");
        if (mu.real() < least_excess) throw UnusableFamily("a stiffness is nearly negative");
      }
    }
  }

  void check_distances() const {
    std::vector<double> at;
    for (const SpecialPoint& point : family_.special) {
      if (point.half_width > widest_veering * static_cast<double>(range())) continue;
      at.push_back(point.parameter);
      const double from_end =
          std::min(point.parameter - static_cast<double>(low_), static_cast<double>(high_) - point.parameter);
      if (from_end < end_margin * static_cast<double>(range()))
        throw UnusableFamily("a special point at the end");
    }
    for (std::size_t i = 1; i < at.size(); ++i) {
      const double distance = at[i] - at[i - 1];
      if (distance > 0.0 && distance < least_distance * static_cast<double>(range()))
        throw UnusableFamily("special points too close");
    }
  }

  PlantedFamily& family_;
  Wide low_, high_;
  std::vector<int> current_;  ///< blocks that are looked at
  std::vector<Found> found_;
};

}  // namespace

void find_special_points(PlantedFamily& family) {
  Finder(family).find();
}

}  // namespace eigentrail::test
