// H07 to H12, H16 to H20: pairs that flutter, diverge or meet on the real axis.
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "hard_cases/family.hpp"
#include "hard_cases/parts.hpp"

namespace eigentrail::test {
namespace {

WideComplexMatrix wide(const Matrix& matrix) {
  return matrix.cast<WideComplex>();
}

/// s^2 + 2 (1 + cos(p) / 2) s + 1: real roots, a pair, real roots again.
HardCase recollision() {
  const double pi = std::numbers::pi;
  const std::string scene =
      family_scene("M = [ [[1]] ]\nC = [ [[\"2*(1 + 0.5*cos(p))\"]] ]\nK = [ [[1]] ]\n", 0.0, 2.0 * pi);
  const auto damping = [](WideComplex p) { return Wide(2) + std::cos(p); };
  HardCase result = expression_case(
      "H07_recollision", own_closed_form, 0.0, 2.0 * pi, scene,
      [=](WideComplex p) {
        WidePencil pencil{wide(rows({{1}})), wide(rows({{0}})), wide(rows({{1}}))};
        pencil.C(0, 0) = damping(p);
        return pencil;
      },
      {{"collision", 1.57079632679489661923, -1.0}, {"collision", 4.71238898038468985769, -1.0}});
  set_spectrum(result, [](Wide p) {
    // s = -b +- sqrt(b^2 - 1), b = 1 + cos(p) / 2, b^2 - 1 = cos(p) (1 + cos(p) / 4).
    const Wide cosine = std::cos(p);
    const WideComplex root = std::sqrt(WideComplex(cosine * (1 + cosine / 4)));
    const WideComplex first = -1 - cosine / 2 - root;
    const WideComplex second = WideComplex(1) / first;
    if (root.imag() != 0) return std::vector{narrow(first), std::conj(narrow(first))};
    return std::vector{narrow(first), narrow(second)};
  });
  return result;
}

/// Ziegler's column M = [[3, 1], [1, 1]], C = b [[2, -1], [-1, 1]], K = [[2 - p, p - 1], [-1, 1]].
HardCase ziegler(const std::string& name, double b, std::vector<SpecialPoint> special) {
  Family family{{rows({{3, 1}, {1, 1}})}, {}, {rows({{2, -1}, {-1, 1}}), rows({{-1, 1}, {0, 0}})}};
  if (b != 0.0) family.C = {b * rows({{2, -1}, {-1, 1}})};
  HardCase result = family_case(
      name,
      "Ziegler 1952 (Ingenieur-Archiv 20) in units of its stiffness; flutter at p = 41/28 + b^2/2, "
      "s = j sqrt(2/7); the rest in 40-digit arithmetic, reference.py",
      0.0, 3.0, family, std::move(special));
  if (b != 0.0) return result;
  set_spectrum(result, [](Wide p) {
    // 2 mu^2 - (7 - 2 p) mu + 1 = 0.
    const Wide half = (Wide(3.5) - p) / 2;
    const WideComplex root = std::sqrt(WideComplex(half * half - Wide(0.5)));
    return undamped_pairs({half + root, half - root});
  });
  return result;
}

/// K = -I, C = p J: gyroscopic stabilization is lost at p = 2 in both pairs at once.
HardCase gyroscopic_loss() {
  HardCase result =
      family_case("H10_gyroscopic_loss", own_closed_form, 3.0, 1.0,
                  {{Matrix::Identity(2, 2)}, {Matrix::Zero(2, 2), quarter_turn()}, {-Matrix::Identity(2, 2)}},
                  {{"collision", 2.0, {0.0, 1.0}}});
  set_spectrum(result, [](Wide p) {
    // s = +-j (p / 2 +- sqrt(p^2 / 4 - 1)), so s^2 = -mu with the squares.
    const WideComplex root = std::sqrt(WideComplex((p / 2 - 1) * (p / 2 + 1)));
    const WideComplex plus = p / 2 + root;
    const WideComplex minus = p / 2 - root;
    return undamped_pairs({plus * plus, minus * minus});
  });
  return result;
}

/// C = 0.03 I, K = [[1, 0.01 p], [-0.01 p, 1]]: s^2 + 0.03 s + 1 -+ 0.01 j p = 0.
HardCase internal_damping() {
  const Family family{{Matrix::Identity(2, 2)},
                      {0.03 * Matrix::Identity(2, 2)},
                      {Matrix::Identity(2, 2), -0.01 * quarter_turn()}};
  HardCase result =
      family_case("H11_internal_damping", own_closed_form, 0.0, 6.0, family,
                  {{"crossing", 0.0, {-0.015, 0.999887493671162985817}}, {"flutter", 3.0, {0.0, 1.0}}});
  const auto branch = [](Wide sign) {
    return [sign](Wide p) {
      const Wide half = Wide(0.03) / 2;
      return -half + WideComplex(0, 1) * std::sqrt(WideComplex(1 - half * half, sign * Wide(0.01) * p));
    };
  };
  set_branches(result, {branch(1), branch(-1)});
  return result;
}

/// The same with stiffnesses 1.02 and 0.98: the modes coalesce at p = 2 before they flutter at sqrt(13).
HardCase internal_damping_anisotropic() {
  const Family family{{Matrix::Identity(2, 2)},
                      {0.03 * Matrix::Identity(2, 2)},
                      {diagonal({1.02, 0.98}), -0.01 * quarter_turn()}};
  return family_case("H12_internal_damping_anisotropic", own_closed_form, 0.0, 6.0, family,
                     {{"collision", 2.00000000000000173472, {-0.015, 0.999887493671162985817}},
                      {"flutter", 3.60555127546399011103, {0.0, 1.0}}});
}

/// Flap and lag of a hovering blade: Lock number 5, solidity 0.05, drag 0.01, lift slope 2 pi, p^2 = 4/3.
HardCase flap_lag() {
  const std::string scene =
      "[parameters]\ntheta = 0.01\ninflow = \"pi*0.05/8*(sqrt(1 + 12*theta/(pi*0.05)) - 1)\"\n"
      "cone = \"0.625*(theta - inflow)/(4/3)\"\n\n[trace]\nparameter = \"theta\"\nfrom = 0.01\nto = 0.5\n\n"
      "[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\n"
      "C = [ [[0.625, \"2*cone - 0.625*(2*theta - inflow)\"],\n"
      "       [\"-2*cone + 0.625*(theta - 2*inflow)\", \"0.625*(0.01/pi + theta*inflow)\"]] ]\n"
      "K = [ [[\"4/3\", 0], [0, \"4/3\"]] ]\n";
  const auto pencil = [](WideComplex theta) {
    const Wide pi = std::numbers::pi_v<Wide>;
    const Wide solidity = 0.05;
    const WideComplex inflow =
        pi * solidity / 8 * (std::sqrt(Wide(1) + Wide(12) * theta / (pi * solidity)) - Wide(1));
    const WideComplex cone = Wide(0.625) * (theta - inflow) / (Wide(4) / 3);
    WidePencil result{wide(Matrix::Identity(2, 2)), wide(Matrix::Zero(2, 2)),
                      wide(Matrix::Identity(2, 2)) * WideComplex(Wide(4) / 3)};
    result.C << Wide(0.625), Wide(2) * cone - Wide(0.625) * (Wide(2) * theta - inflow),
        -Wide(2) * cone + Wide(0.625) * (theta - Wide(2) * inflow),
        Wide(0.625) * (Wide(0.01) / pi + theta * inflow);
    return result;
  };
  return expression_case("H16_flap_lag",
                         "Ormiston & Hodges 1972 (J. Am. Helicopter Soc. 17), elastic coupling left out; "
                         "flutter in 40-digit arithmetic, reference.py",
                         0.01, 0.5, scene, pencil,
                         {{"flutter", 0.165786301209754159240, {0.0, 1.15470053837925152902}}});
}

/// a(p) s^2 + b(p) s + c(p), linear or quadratic in p.
HardCase oscillator(const std::string& name, double from, double to,
                    const std::array<std::vector<double>, 3>& abc, std::vector<SpecialPoint> special) {
  Family family;
  MatrixSeries* const series[] = {&family.M, &family.C, &family.K};
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double value : abc[i]) series[i]->push_back(rows({{value}}));
  }
  HardCase result = family_case(name, own_closed_form, from, to, family, std::move(special));
  set_spectrum(result, [family](Wide p) {
    const WidePencil pencil = evaluate(family, p);
    return quadratic_roots(pencil.M(0, 0), pencil.C(0, 0), pencil.K(0, 0));
  });
  return result;
}

/// s^2 + p s + p^2: s = p e^(+-2 pi j / 3), analytic although the double zero at p = 0 is defective.
HardCase pair_through_zero() {
  HardCase result = oscillator("H19_pair_through_zero", -1.0, 1.0, {{{1.0}, {0.0, 1.0}, {0.0, 0.0, 1.0}}},
                               {{"collision", 0.0, 0.0}, {"flutter", 0.0, 0.0}});
  set_branches(result, {[](Wide p) { return p * WideComplex(Wide(-0.5), std::sqrt(Wide(0.75))); }});
  return result;
}

}  // namespace

std::vector<HardCase> flutter_families() {
  const Complex flutter(0.0, 0.534522483824848769369);
  return {recollision(),
          ziegler("H08_ziegler", 0.0, {{"collision", 2.0857864376269049512, {0.0, 0.840896415253714543031}}}),
          ziegler("H09_ziegler_damped_1em4", 1e-4,
                  {{"flutter", 1.46428571928571428571, flutter},
                   {"veering",
                    2.08578642753347063033,
                    {-0.0000614276693314804417626, 0.840896411105472585453},
                    0.000175393033370550009093}}),
          ziegler("H09_ziegler_damped_1em2", 1e-2,
                  {{"flutter", 1.46433571428571428572, flutter},
                   {"veering",
                    2.08568550473459910546,
                    {-0.00614256875923395054731, 0.84085493285689807898},
                    0.0175388354041262798566}}),
          ziegler("H09_ziegler_damped_1", 1.0,
                  {{"collision", 0.524313124729236499514, -1.67825541924948939561},
                   {"flutter", 1.96428571428571428571, flutter}}),
          gyroscopic_loss(),
          internal_damping(),
          internal_damping_anisotropic(),
          flap_lag(),
          oscillator("H17_divergence", 0.0, 1.5, {{{1.0}, {0.1}, {1.0, -1.0}}},
                     {{"collision", 0.9975, -0.05}, {"divergence", 1.0, 0.0}}),
          oscillator("H18_undamped_divergence", 0.0, 1.5, {{{1.0}, {0.0}, {1.0, -1.0}}},
                     {{"collision", 1.0, 0.0}}),
          pair_through_zero(),
          oscillator("H20_infinite_eigenvalue", 0.0, 1.5, {{{1.0, -1.0}, {0.5}, {1.0}}},
                     {{"collision", 0.9375, -4.0}, {"infinite", 1.0, {INFINITY, 0.0}}})};
}

}  // namespace eigentrail::test
