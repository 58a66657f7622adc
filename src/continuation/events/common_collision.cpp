#include "continuation/events/common_collision.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "continuation/events/meeting_resolution.hpp"
#include "continuation/tracks/members.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// As a share of the reach: step of central differences. Their truncation error is about the square.
constexpr double collision_difference_step = 1e-3;
/// Safety factor on estimates of rounding errors.
constexpr double collision_rounding_margin = 10.0;

/// Sum of the powers of the eigenvalues of a part about their mean, tr N^j, from value and two derivatives at
/// the point. All of them vanish where all eigenvalues are one.
struct PowerSum {
  Complex value, slope, curvature;
  double error = 0.0;  ///< of the value, by rounding

  Complex root() const { return -value / slope; }
  double doubt() const { return error / std::abs(slope); }
  /// Whether its root is a simple one, to which Newton's method converges at once: for a root of order m the
  /// measure is (m - 1) / m, and half for a double one.
  bool is_simple() const {
    constexpr double nearly_linear = 0.2;
    return std::abs(curvature * value) <= nearly_linear * std::norm(slope);
  }
};

Complex sum_of_powers(const ComplexMatrix& N, int power) {
  ComplexMatrix all = N;
  for (int j = 1; j < power; ++j) all *= N;
  return all.trace();
}

PowerSum power_sum(const std::vector<ComplexMatrix>& part, int power, double lambda, double width) {
  const auto sum = [&](double h) { return sum_of_powers(centred(part, h), power); };
  const Complex here = sum(0.0), ahead = sum(width), behind = sum(-width);
  const double size = std::pow(centred(part, 0.0).norm(), power - 1);
  return {here, (ahead - behind) / (2.0 * width), (ahead - 2.0 * here + behind) / (width * width),
          collision_rounding_margin * power * size * lambda};
}

/// The place where all eigenvalues of a part are one, as the simple root of that power sum which is known
/// best; empty if there is none within reach. Where m of them vary like the m-th root of the distance, that
/// is the m-th one, and where all of them vary like the square root, the second.
std::optional<double> common_place(const std::vector<ComplexMatrix>& part, double lambda, double reach) {
  constexpr double on_axis = 1e-3;  // of the reach: about the error of the linear approximation of the root
  std::optional<double> place;
  double least = on_axis * std::abs(reach);
  for (int power = 2; power <= static_cast<int>(part[0].rows()); ++power) {
    const PowerSum sum = power_sum(part, power, lambda, collision_difference_step * std::abs(reach));
    if (sum.slope == 0.0 || !sum.is_simple() || !(sum.doubt() < least)) continue;
    const Complex root = sum.root();
    if (std::abs(root.imag()) > on_axis * std::abs(reach) || std::abs(root) > std::abs(reach)) continue;
    least = sum.doubt();
    place = root.real();
  }
  return place;
}

ComplexVector eigenvalues(const ComplexMatrix& Lambda) {
  return Eigen::ComplexEigenSolver<ComplexMatrix>(Lambda, false).eigenvalues();
}

/// Whether the eigenvalues of a centred part may all be zero, within the error of Lambda.
bool is_one(const ComplexMatrix& N, double lambda) {
  const ComplexVector s = eigenvalues(N);
  const Vector errors = Vector::Constant(N.size(), collision_rounding_margin * lambda / std::sqrt(N.size()));
  return s.cwiseAbs().maxCoeff() <= root_errors(N.reshaped(), s, errors).maxCoeff();
}

/// Number of different eigenvalues of a part.
Eigen::Index count_different(const ComplexVector& s) {
  constexpr double one = 1e-6;  // of the radius: equal ones that rounding has split
  const double radius = (s.array() - s.mean()).abs().maxCoeff();
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    if (((s.head(i).array() - s[i]).abs() > one * radius).all()) ++count;
  }
  return count;
}

/// Whether rounding leaves the eigenvalues of a part distinct at a distance from their collision. Those of
/// equal parts are equal everywhere; then it is enough that their radius there, `from`, is exceeded.
bool tells_apart(const std::vector<ComplexMatrix>& part, double place, double width, double from) {
  constexpr double exceeded = 3.0;
  const ComplexMatrix Lambda = evaluate_series(part, place + width);
  const ComplexVector s = eigenvalues(Lambda);
  if (are_told_apart(Lambda.reshaped(), s, collision_rounding_margin * function_rounding(Lambda)))
    return true;
  const Eigen::Index different = count_different(s);
  return different < s.size() && (s.array() - s.mean()).abs().maxCoeff() > exceeded * from &&
         count_different(eigenvalues(evaluate_series(part, place + 2.0 * width))) == different;
}

/// Lambda of a block from its functions.
ComplexMatrix block_of(const ComplexVector& functions) {
  const Eigen::Index k = block_size(functions.size());
  return functions.reshaped(k, k);
}

ComplexMatrix centred_block(const HermiteInterpolant& functions, double t) {
  return centred(block_of(functions(t)));
}

std::vector<ComplexMatrix> series_at(const HermiteInterpolant& functions, double t) {
  const ComplexMatrix series = functions.series(t, functions.degree());
  std::vector<ComplexMatrix> Lambda;
  for (Eigen::Index k = 0; k < series.cols(); ++k) Lambda.push_back(block_of(series.col(k)));
  return Lambda;
}

}  // namespace

std::optional<Meeting> common_collision(const std::vector<ComplexMatrix>& part, double lambda, double reach) {
  // The m-th power of the radius of the eigenvalues about their mean at the root, as a share of that beside
  // it. In exact arithmetic the first is zero; the linear approximation leaves about a thousandth.
  constexpr double closes_in = 1e-2;
  constexpr double there = 1e-8;    // of the reach: from here rounding alone keeps them apart
  constexpr double farthest = 2.0;  // of the reach: where the eigenvalues are looked at at most
  const Eigen::Index size = part[0].rows();
  const std::optional<double> root = common_place(part, lambda, reach);
  if (!root) return std::nullopt;
  const auto radius = [&](double h) { return eigenvalues(centred(part, h)).cwiseAbs().maxCoeff(); };
  const double at_root = radius(*root);
  double width = collision_difference_step * std::abs(reach);
  while (!tells_apart(part, *root, width, at_root)) {
    width *= 2.0;
    if (width > farthest * std::abs(reach)) return std::nullopt;
  }
  const bool is_there = std::abs(*root) <= there * std::abs(reach);
  if (is_there && !is_one(centred(part, *root), lambda)) return std::nullopt;
  const double order = 1.0 / static_cast<double>(size);
  const double beside = radius(*root + width);
  if (!(at_root < std::pow(closes_in, order) * beside)) return std::nullopt;
  // The radius grows by 2^(1/cycle) when the distance is doubled; by 2 where the eigenvalues cross.
  const double growth = std::log2(radius(*root + 2.0 * width) / beside);
  constexpr double nearer_to_a_square_root = 0.4;
  constexpr double nearer_to_a_crossing = 0.75;
  if (!(growth < nearer_to_a_crossing)) return std::nullopt;
  const auto slope_of = [&](const auto& function, double w) {
    return (function(*root + w) - function(*root - w)) / (2.0 * w);
  };
  Meeting meeting{.found = true, .offset = *root, .hidden_within = width};
  if (size > 2 && growth > nearer_to_a_square_root) {
    meeting.cycle = 2;
    const auto mean_square = [&](double h) {
      return sum_of_powers(centred(part, h), 2) / static_cast<double>(size);
    };
    meeting.puiseux = std::sqrt(slope_of(mean_square, collision_difference_step * std::abs(reach)));
  } else {
    meeting.cycle = static_cast<int>(size);
    const Complex slope = slope_of([&](double h) { return centred(part, h).determinant(); }, width);
    meeting.puiseux = std::pow((size % 2 == 0 ? -1.0 : 1.0) * slope, order);
  }
  return meeting;
}

Meeting meeting_of_all(const Track& track, double reach) {
  const std::vector<ComplexMatrix>& Lambda = track.series.Lambda;
  Meeting meeting = common_collision(Lambda, rounding_of(track, Lambda).lambda, reach).value_or(Meeting{});
  meeting.members = other_members(track.size(), {});
  return meeting;
}

std::vector<PlaceOnStep> common_collisions_on_step(const HermiteInterpolant& functions, double lambda) {
  // A root of a power sum starts the search for the place: a few digits of it suffice.
  constexpr int highest_degree = 24;
  constexpr double off_axis = 1e-2;  // in steps
  constexpr double reach = 1.0;      // in steps: a polynomial is its own series
  const Eigen::Index size = block_size(functions.size());
  std::vector<PlaceOnStep> places;
  if (size < 3) return places;
  for (const int power : {2, static_cast<int>(size)}) {
    if (!places.empty()) break;
    const auto sum = [&](double t) { return sum_of_powers(centred_block(functions, t), power); };
    const ComplexVector coefficients =
        chebyshev_coefficients(sum, std::min(power * functions.degree(), highest_degree));
    if (chebyshev_has_no_root_in(coefficients, {0.5, 0.5 + off_axis, off_axis})) continue;
    for (const Complex root : chebyshev_roots(coefficients)) {
      if (std::abs(root.imag()) > off_axis || std::abs(root.real() - 0.5) > 0.5 + off_axis) continue;
      const auto found = common_collision(series_at(functions, root.real()), lambda, reach);
      if (!found) continue;
      const double place = root.real() + found->offset;
      const auto is_it = [&](const PlaceOnStep& other) { return std::abs(other.t - place) <= off_axis; };
      if (place > 0.0 && place <= 1.0 && std::none_of(places.begin(), places.end(), is_it))
        places.push_back({place, found->hidden_within});
    }
  }
  std::sort(places.begin(), places.end(),
            [](const PlaceOnStep& a, const PlaceOnStep& b) { return a.t < b.t; });
  return places;
}

}  // namespace eigentrail
