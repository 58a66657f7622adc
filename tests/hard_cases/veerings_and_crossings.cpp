// H01 to H06: two or three undamped modes that come close, cross or coalesce.
#include <cmath>
#include <numbers>

#include "hard_cases/family.hpp"
#include "hard_cases/parts.hpp"

namespace eigentrail::test {
namespace {

const Complex unit_stiffness(0.0, 1.0);  // s of a mode with unit mass and stiffness

/// Undamped branch s = j sqrt(mu(p)) for mu > 0.
std::function<WideComplex(Wide)> oscillation(const std::function<Wide(Wide)>& mu) {
  return [mu](Wide p) { return WideComplex(0, std::sqrt(mu(p))); };
}

/// K = [[1 + p, eps], [eps, 1 - p]]: s^2 = -(1 +- sqrt(p^2 + eps^2)), exceptional points p = +- j eps.
HardCase veering(const std::string& name, double eps) {
  const Family family{{rows({{1, 0}, {0, 1}})}, {}, {rows({{1, eps}, {eps, 1}}), diagonal({1, -1})}};
  HardCase result =
      family_case(name, own_closed_form, -0.5, 0.5, family, {{"veering", 0.0, unit_stiffness, eps}});
  const Wide coupling = eps;
  const auto upper = [coupling](Wide p) { return 1 + std::hypot(p, coupling); };
  const auto lower = [coupling](Wide p) { return 1 - std::hypot(p, coupling); };
  set_spectrum(result, [=](Wide p) { return undamped_pairs({upper(p), lower(p)}); });
  set_branches(result, {oscillation(lower), oscillation(upper)});
  return result;
}

/// Modes with mu = 1 + p and 1 - p that cross at p = 0.
HardCase crossing(const std::string& name, const Family& family) {
  HardCase result =
      family_case(name, own_closed_form, -0.5, 0.5, family, {{"crossing", 0.0, unit_stiffness}});
  set_spectrum(result, [](Wide p) { return undamped_pairs({1 + p, 1 - p}); });
  set_branches(result,
               {oscillation([](Wide p) { return 1 + p; }), oscillation([](Wide p) { return 1 - p; })});
  return result;
}

/// K = I + p [[c, s], [s, -c]]: the vectors lie at an angle of 0.7 to the coordinates.
HardCase hidden_crossing() {
  const double c = std::cos(1.4);
  const double s = std::sin(1.4);
  return crossing("H03_hidden_crossing",
                  {{Matrix::Identity(2, 2)}, {}, {Matrix::Identity(2, 2), rows({{c, s}, {s, -c}})}});
}

/// K = I + p 11^T / 3: a doublet for every p, which the third mode crosses at p = 0.
HardCase permanent_doublet() {
  const Family family{
      {Matrix::Identity(3, 3)}, {}, {Matrix::Identity(3, 3), Matrix::Constant(3, 3, 1.0 / 3.0)}};
  HardCase result = family_case("H04_permanent_doublet", own_closed_form, -0.5, 0.5, family,
                                {{"crossing", 0.0, unit_stiffness}});
  set_spectrum(result, [](Wide p) { return undamped_pairs({1 + p, 1, 1}); });
  const auto one = oscillation([](Wide) { return Wide(1); });
  set_branches(result, {oscillation([](Wide p) { return 1 + p; }), one, one});
  return result;
}

/// K = [[1, p], [-p, 2]]: mu = 3/2 +- sqrt(1/4 - p^2), exceptional point p = 1/2.
HardCase exceptional_point(const std::string& name, double to) {
  const Family family{{Matrix::Identity(2, 2)}, {}, {diagonal({1, 2}), -quarter_turn()}};
  HardCase result =
      family_case(name, own_closed_form, 0.0, to, family, {{"collision", 0.5, {0.0, 1.2247448713915890491}}});
  set_spectrum(result, [](Wide p) {
    const WideComplex root = std::sqrt(WideComplex((Wide(0.5) - p) * (Wide(0.5) + p)));
    return undamped_pairs({Wide(1.5) + root, Wide(1.5) - root});
  });
  return result;
}

/// K = I + [[0, 1, 0], [0, 0, 1], [p, 0, 0]]: mu = 1 + p^(1/3) e^(2 pi j k / 3).
HardCase triple_exceptional_point() {
  const Family family{{Matrix::Identity(3, 3)},
                      {},
                      {rows({{1, 1, 0}, {0, 1, 1}, {0, 0, 1}}), rows({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}})}};
  HardCase result = family_case("H06_triple_exceptional_point", own_closed_form, -0.1, 0.1, family,
                                {{"collision", 0.0, unit_stiffness}});
  set_spectrum(result, [](Wide p) {
    const Wide root = std::cbrt(p);
    const WideComplex turn(Wide(-0.5), std::sqrt(Wide(0.75)));
    return undamped_pairs({1 + root, Wide(1) + root * turn, Wide(1) + root * std::conj(turn)});
  });
  return result;
}

}  // namespace

std::vector<HardCase> veerings_and_crossings() {
  return {
      veering("H01_veering_1em2", 1e-2),
      veering("H01_veering_1em4", 1e-4),
      veering("H01_veering_1em6", 1e-6),
      veering("H01_veering_1em9", 1e-9),
      veering("H01_veering_1em12", 1e-12),
      crossing("H02_crossing", {{Matrix::Identity(2, 2)}, {}, {Matrix::Identity(2, 2), diagonal({1, -1})}}),
      hidden_crossing(),
      permanent_doublet(),
      exceptional_point("H05_exceptional_point", 1.0),
      exceptional_point("H05_exceptional_point_at_end", 0.5),
      triple_exceptional_point()};
}

}  // namespace eigentrail::test
