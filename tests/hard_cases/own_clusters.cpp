// Own cases: modes that are close to each other.
#include <cmath>
#include <utility>

#include "hard_cases/family.hpp"
#include "hard_cases/parts.hpp"

namespace eigentrail::test {
namespace {

const char* const computed = "own derivation; special points in 40-digit arithmetic, reference.py";

Matrix identity(Eigen::Index n) {
  return Matrix::Identity(n, n);
}

std::vector<SpecialPoint> three_blades_points() {
  // clang-format off
  return {
      {"veering", -0.000638219487719598138417, {-0.000770159912183307500574, 1.00068065294439199626}, 0.0018798954546312235208},
      {"veering", 0.000020926987765541005678, {-0.00099927911823632224833, 1.00150659516326487443}, 0.000207175979241935128091},
  };
  // clang-format on
}

/// Three coupled blades, tuned differently by p and a little by themselves: three modes within 0.3 %.
HardCase three_blades() {
  constexpr double k = 1e-3;
  const Matrix K0 = rows({{1 + 2 * k, -k, -k}, {-k, 1 + 2 * k + 2e-4, -k}, {-k, -k, 1 + 2 * k - 1.5e-4}});
  return family_case("three_blade_cluster", computed, -0.02, 0.02,
                     {{identity(3)}, {0.002 * identity(3)}, {K0, diagonal({1, -0.4, -0.6})}},
                     three_blades_points());
}

std::vector<SpecialPoint> two_partners_points() {
  // clang-format off
  return {
      {"veering", -0.00999950001249938393686, {-0.0000502512626088028218164, 0.994987438381856223453}, 0.000200002499921880673088},
      {"veering", 0.00999950001249938393686, {-0.0000497512376098971769046, 1.00498756333732155416}, 0.000200002499921880673088},
  };
  // clang-format on
}

/// A steep mode meets two flat ones, at p = -0.01 and p = 0.01: one long step sees neither.
HardCase two_partners() {
  const Matrix K0 = rows({{1, 1e-4, 1e-4}, {1e-4, 0.99, 0}, {1e-4, 0, 1.01}});
  return family_case("two_veerings_two_partners", computed, -0.5, 0.5,
                     {{identity(3)}, {}, {K0, diagonal({1, 0, 0})}}, two_partners_points());
}

std::vector<SpecialPoint> same_pair_twice_points() {
  // clang-format off
  return {
      {"veering", -0.0500003999919997358948, {0.00000499999999993750040902, 1.0000000000125}, 0.000199998400044800458376},
      {"veering", 0.0500003999919997358948, {-0.00000499999999993750040902, 1.0000000000125}, 0.000199998400044800458376},
  };
  // clang-format on
}

/// The same two modes meet twice, at p = +-0.05: K = [[1 + d, 1e-5], [1e-5, 1]], d = p^2 - 0.0025.
HardCase same_pair_twice() {
  constexpr double start = 0.9975, coupling = 1e-5;
  HardCase result = family_case(
      "two_veerings_same_pair", own_closed_form, -0.5, 0.5,
      {{identity(2)}, {}, {rows({{start, coupling}, {coupling, 1}}), Matrix::Zero(2, 2), diagonal({1, 0})}},
      same_pair_twice_points());
  const auto mu = [](Wide p, Wide sign) {
    const Wide d = p * p + (Wide(start) - 1);
    return 1 + (d + sign * std::hypot(d, 2 * Wide(coupling))) / 2;
  };
  set_spectrum(result, [mu](Wide p) { return undamped_pairs({mu(p, 1), mu(p, -1)}); });
  set_branches(result, {[mu](Wide p) { return WideComplex(0, std::sqrt(mu(p, -1))); },
                        [mu](Wide p) { return WideComplex(0, std::sqrt(mu(p, 1))); }});
  return result;
}

/// The constraint x3 = p x1 turns with p; the reduced pencil is circulatory and coalesces.
HardCase constrained_exceptional_point() {
  const Family free{{identity(3)},
                    {},
                    {diagonal({1, 2, 0.5}), rows({{0, 2, 0}, {-2, 0, 0.3}, {0, -0.3, 0}})},
                    {rows({{0, 0, -1}}), rows({{1, 0, 0}})}};
  const Family reduced{{identity(2), Matrix::Zero(2, 2), diagonal({1, 0})},
                       {},
                       {diagonal({1, 2}), rows({{0, 2}, {-2, 0}}), rows({{0.5, -0.3}, {0.3, 0}})}};
  HardCase result = family_case("constrained_exceptional_point", own_closed_form, 0.0, 1.0, reduced,
                                {{"collision", 0.281036879269310891975, {0.0, 1.21725097600560612207}}});
  result.scene = family_scene(free, 0.0, 1.0);
  set_spectrum(result, [](Wide p) {
    // (1 + p^2) mu^2 - (k + 2 (1 + p^2)) mu + 2 k + q^2 = 0, k = 1 + p^2 / 2, q = 2 p - 0.3 p^2.
    const Wide a = 1 + p * p;
    const Wide k = 1 + p * p / 2;
    const Wide q = 2 * p - Wide(0.3) * p * p;
    const Wide discriminant = (2 * a - k - 2 * std::sqrt(a) * q) * (2 * a - k + 2 * std::sqrt(a) * q);
    const WideComplex root = std::sqrt(WideComplex(discriminant));
    return undamped_pairs({(k + 2 * a + root) / (2 * a), (k + 2 * a - root) / (2 * a)});
  });
  return result;
}

/// C = p J, K = diag(-1, -2): two pairs meet on the imaginary axis at p = 1 + sqrt(2) (Hamiltonian Hopf), and
/// the quadruple falls on the real axis at p = sqrt(2) - 1.
HardCase hamiltonian_hopf() {
  HardCase result = family_case("hamiltonian_hopf", own_closed_form, 4.0, 0.2,
                                {{identity(2)}, {Matrix::Zero(2, 2), quarter_turn()}, {diagonal({-1, -2})}},
                                {{"collision", 0.414213562373095048802, 1.18920711500272106672},
                                 {"collision", 0.414213562373095048802, -1.18920711500272106672},
                                 {"collision", 2.4142135623730950488, {0.0, 1.18920711500272106672}}});
  set_spectrum(result, [](Wide p) {
    // mu^2 - (p^2 - 3) mu + 2 = 0.
    const Wide half = (p * p - 3) / 2;
    const Wide root2 = std::sqrt(Wide(2));
    const WideComplex root = std::sqrt(WideComplex((half - root2) * (half + root2)));
    return undamped_pairs({half + root, half - root});
  });
  return result;
}

/// H05 with dampings d and d / 4, which move its exceptional point by `half_width` off the real axis. Flutter
/// by Hurwitz at p^2 = 0.16 + 0.45 d^2, s^2 = -1.8.
HardCase near_exceptional(const std::string& name, double d, const SpecialPoint& veering) {
  const double flutter = std::sqrt(0.16 + 0.45 * d * d);
  return family_case(name, computed, 0.0, 1.5,
                     {{identity(2)}, {diagonal({d, d / 4})}, {diagonal({1, 2}), -quarter_turn()}},
                     {{"flutter", flutter, {0.0, 1.34164078649987381785}}, veering});
}

// clang-format off
std::vector<HardCase> near_exceptional_points() {
  return {
      near_exceptional("near_exceptional_1em1", 0.21818926174404107,
                       {"veering", 0.505295580860658768077, {-0.0612535927982497937474, 1.22153497054933702265}, 0.100000000000000002554}),
      near_exceptional("near_exceptional_1em3", 0.002177324669416801,
                       {"veering", 0.500000527777954561166, {-0.000612372452391099515724, 1.22474455197494626652}, 0.000999999999999999948986}),
      near_exceptional("near_exceptional_1em5", 2.1773242158526304e-05,
                       {"veering", 0.50000000005277777778, {-0.00000612372435697464072713, 1.22474487135964740045}, 0.0000100000000000000002329}),
      near_exceptional("near_exceptional_1em8", 2.1773242158072697e-08,
                       {"veering", 0.500000000000000052778, {-6.12372435695794579461e-9, 1.22474487139158901716}, 1.00000000000000008694e-8})};
}
// clang-format on

/// Coupling below the difference of the dampings: frequencies cross, real parts veer.
HardCase damped_veering() {
  return family_case(
      "frequencies_cross_dampings_veer", computed, -0.5, 0.5,
      {{identity(2)}, {diagonal({0.06, 0.04})}, {rows({{1, 0.006}, {0.006, 1}}), diagonal({1, -1})}},
      {{"veering", 0.00025, {-0.025, 0.999702460011741918371}, 0.015996949556874387938},
       {"veering", 0.00025, {-0.025, 0.999672441625450919517}, 0.00399679946400435086261}});
}

/// Two overdamped oscillators (s + 1 + p)(s + 4 + p) and (s + 2 - p)(s + 5.5 - p) in mixed coordinates: real
/// roots cross at p = 0.5 and p = 0.75. Every number is exact in binary.
HardCase overdamped_crossing() {
  const Matrix U = rows({{1, 1}, {0, 1}});
  const auto mix = [&](double a, double b) { return Matrix(U.transpose() * diagonal({a, b}) * U); };
  HardCase result =
      family_case("overdamped_crossing", own_closed_form, 0.0, 1.0,
                  {{mix(1, 1)}, {mix(5, 7.5), mix(2, -2)}, {mix(4, 11), mix(5, -7.5), mix(1, 1)}},
                  {{"crossing", 0.5, -1.5}, {"crossing", 0.75, -4.75}});
  set_branches(result, {[](Wide p) { return -1 - p; }, [](Wide p) { return -4 - p; },
                        [](Wide p) { return p - 2; }, [](Wide p) { return p - Wide(5.5); }});
  set_spectrum(result, [](Wide p) {
    std::vector<Complex> s;
    for (const Wide value : {-1 - p, -4 - p, p - 2, p - Wide(5.5)})
      s.emplace_back(static_cast<double>(value));
    return s;
  });
  return result;
}

/// mu = 1 + p, 1 - p, 1 + p / 2 and 2 in mixed coordinates. Every number is exact in binary.
HardCase triple_crossing() {
  const Matrix U = rows({{1, 1, 0, 0}, {0, 1, 1, 0}, {0, 0, 1, 1}, {0, 0, 0, 1}});
  const auto mix = [&](const Matrix& D) { return Matrix(U.transpose() * D * U); };
  HardCase result =
      family_case("triple_crossing", own_closed_form, -0.5, 0.5,
                  {{mix(identity(4))}, {}, {mix(diagonal({1, 1, 1, 2})), mix(diagonal({1, -1, 0.5, 0}))}},
                  {{"crossing", 0.0, {0.0, 1.0}}});
  set_spectrum(result, [](Wide p) { return undamped_pairs({1 + p, 1 - p, 1 + p / 2, 2}); });
  const auto branch = [](Wide start, Wide slope) {
    return [=](Wide p) { return WideComplex(0, std::sqrt(start + slope * p)); };
  };
  set_branches(result, {branch(1, 1), branch(1, -1), branch(1, 0.5), branch(2, 0)});
  return result;
}

}  // namespace

std::vector<HardCase> own_clusters() {
  std::vector<HardCase> result = {
      three_blades(),     two_partners(),   same_pair_twice(),     constrained_exceptional_point(),
      hamiltonian_hopf(), damped_veering(), overdamped_crossing(), triple_crossing()};
  for (HardCase& near : near_exceptional_points()) result.push_back(std::move(near));
  return result;
}

}  // namespace eigentrail::test
