// Own cases: rotors, chains, graded and singular matrices.
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

/// Kronecker product with a 2 x 2 matrix: one block per disc.
Matrix per_disc(const Matrix& discs, const Matrix& block) {
  Matrix result(2 * discs.rows(), 2 * discs.cols());
  for (Eigen::Index i = 0; i < discs.rows(); ++i) {
    for (Eigen::Index j = 0; j < discs.cols(); ++j) result.block<2, 2>(2 * i, 2 * j) = discs(i, j) * block;
  }
  return result;
}

/// Six gyroscopic discs on an anisotropic shaft; internal damping 0.002 turns with the shaft, external 0.01.
Family rotor() {
  constexpr Eigen::Index discs = 6;
  Matrix shaft = 2.0 * identity(discs);
  for (Eigen::Index i = 0; i + 1 < discs; ++i) shaft(i, i + 1) = shaft(i + 1, i) = -1.0;
  const Matrix masses = diagonal({1, 1.1, 1.2, 1.3, 1.4, 1.5});
  const Matrix gyroscopic = diagonal({0.16523937077237263, 0.21244434678543145, 0.0872714216738833,
                                      0.1532482815592989, 0.2678840863042964, 0.2688879266800314});
  const Matrix turn = -quarter_turn();
  const Matrix internal = 0.002 * shaft;
  return {{per_disc(masses, identity(2))},
          {per_disc(internal, identity(2)) + 0.01 * identity(2 * discs), per_disc(gyroscopic, turn)},
          {per_disc(shaft, diagonal({1.02, 0.98})), per_disc(internal, turn)}};
}

std::vector<SpecialPoint> rotor_points() {
  // clang-format off
  return {
      {"veering", 0.000274561655816295464001, {-0.00412943116227726032385, 0.397281478688949831464}, 0.0572391701486339473887},
      {"veering", 0.000310079733113121108821, {-0.00462361486211467683132, 0.777071249495749535961}, 0.0905433379297110982312},
      {"veering", 1.24339050506886328964, {-0.00769727970202200019025, 1.7098542674551377593}, 0.0604395870304054448348},
      {"veering", 1.2460589935531688276, {-0.00719414782884520961489, 1.70988894024274672595}, 0.000971167246956013955524},
      {"veering", 1.37997876375256119701, {-0.00662918814698217152105, 1.50308476958264686249}, 0.0571623362309363212471},
      {"veering", 1.38208281727253458078, {-0.00645747190243764471605, 1.50310408934903062935}, 0.0037850661545877086714},
      {"veering", 1.80302789245911399543, {-0.00627707096954993438548, 1.26650572435019760859}, 0.0360545693378859569953},
      {"veering", 1.80334228483418304901, {-0.00603962346336807228844, 1.26651618566102226073}, 0.0128156460515754691017},
      {"veering", 2.03242843191746840517, {-0.00574085054464850145565, 0.970899490200143770097}, 0.0187491242779245269131},
      {"veering", 2.03276015837829019992, {-0.00563431795131213208808, 0.970907719369758937047}, 0.0132736886950890297038},
      {"veering", 2.43092330876016061167, {-0.00519560057698467197425, 0.595771016757467501475}, 0.0104403184202322677688},
      {"veering", 2.43092449680541020127, {-0.00498989663913292062304, 0.595774571148598821148}, 0.00425249909303781987054},
      {"veering", 2.77962641991781469314, {-0.00855374012283485258462, 1.61347031033369980518}, 0.114521547360223218757},
      {"veering", 2.78406759921513816727, {-0.00746458259420305216212, 1.61355730281995284627}, 0.0105977365155460046434},
      {"veering", 3.08077802413604292549, {-0.00771959490468565883384, 1.38587577349339438959}, 0.0498986748338856699293},
      {"veering", 3.08110858768374981189, {-0.00759566383876337838764, 1.385885515805986493}, 0.0420885827441512971097},
      {"veering", 3.62793144696031394758, {-0.00781231611073804130722, 1.14745802629982894816}, 0.0429701708848148084509},
      {"veering", 3.62836819997208769558, {-0.00735482724654809735449, 1.1474790703306147941}, 0.0262270083723119030748},
      {"veering", 4.41262923620220421773, {-0.0103355640564824521654, 1.52284754462079479074}, 0.0769521190771594512057},
      {"veering", 4.41353659037194499814, {-0.0101137673447475129848, 1.5228794358334978392}, 0.0689258703065072574816},
      {"veering", 4.70851530962113245789, {-0.00786157814440214872099, 0.814007972013996360181}, 0.0484288138101507213231},
      {"veering", 4.70942892129846236436, {-0.00676436407716446175518, 0.814044889504810544553}, 0.000182646137351946319908},
      {"veering", 4.73815287773443976554, {-0.0099490270632919141032, 1.28055150807208499043}, 0.062696438855605928524},
      {"veering", 4.73898962787791429301, {-0.00928641748621833407678, 1.28059165486512301755}, 0.0413018466253017036681},
      {"flutter", 5.11478439439169429546, {0.0, 2.0810347300415062371}},
      {"flutter", 5.74703095349982524174, {0.0, 1.85968439496086427018}},
      {"flutter", 5.86632132875453838782, {0.0, 2.34865984046486932628}},
  };
  // clang-format on
}

HardCase rotor_12() {
  HardCase result = family_case("rotor_12", computed, 0.0, 6.0, rotor(), rotor_points());
  result.reach = 0.02;
  return result;
}

/// Free chain of three masses with springs 1 and p: a defective s = 0 for every p, which is no event.
HardCase free_chain() {
  const Family family{{identity(3)},
                      {},
                      {rows({{1, -1, 0}, {-1, 1, 0}, {0, 0, 0}}), rows({{0, 0, 0}, {0, 1, -1}, {0, -1, 1}})}};
  HardCase result = family_case("free_chain", own_closed_form, 0.5, 2.0, family, {});
  // mu^2 - 2 (1 + p) mu + 3 p = 0, and mu = 0.
  const auto mu = [](Wide p, Wide sign) { return 1 + p + sign * std::sqrt(1 - p + p * p); };
  set_spectrum(result, [mu](Wide p) { return undamped_pairs({0, mu(p, -1), mu(p, 1)}); });
  const auto rigid = [](Wide) { return WideComplex(0); };
  set_branches(result, {rigid, rigid, [mu](Wide p) { return WideComplex(0, std::sqrt(mu(p, -1))); },
                        [mu](Wide p) { return WideComplex(0, std::sqrt(mu(p, 1))); }});
  return result;
}

/// Stiffnesses from 1e-6 to 1e6; the two softest modes veer.
HardCase graded_veering() {
  const Matrix K0 = rows({{1e-6, 1e-9, 0, 0}, {1e-9, 1e-6, 1e-4, 0}, {0, 1e-4, 1, 1e2}, {0, 0, 1e2, 1e6}});
  return family_case("graded_veering", computed, -0.1, 0.1,
                     {{identity(4)}, {}, {K0, diagonal({1e-6, -1e-6, 0, 0})}},
                     {{"veering",
                       -0.00505051012626517644967,
                       {-2.55723108806092428754e-15, 0.000997471548403128528316},
                       0.00100000000000000009452}});
}

/// Shaft in its own frame, C = 2 p J, K = I - p^2 I: s = j (1 - p) passes zero and stays imaginary.
HardCase whirl_through_zero() {
  HardCase result = family_case("whirl_through_zero", own_closed_form, 0.5, 1.5,
                                {{identity(2)},
                                 {Matrix::Zero(2, 2), 2.0 * quarter_turn()},
                                 {identity(2), Matrix::Zero(2, 2), -identity(2)}},
                                {{"crossing", 1.0, 0.0}});
  set_spectrum(result, [](Wide p) { return undamped_pairs({(1 - p) * (1 - p), (1 + p) * (1 + p)}); });
  set_branches(result,
               {[](Wide p) { return WideComplex(0, 1 - p); }, [](Wide p) { return WideComplex(0, 1 + p); }});
  return result;
}

/// The same with stiffnesses 0.9 and 1.1 and damping d in the frame: real roots between the critical speeds.
HardCase whirl_anisotropic(const std::string& name, double d, std::vector<SpecialPoint> special) {
  Family family{{identity(2)},
                {d * identity(2), 2.0 * quarter_turn()},
                {diagonal({0.9, 1.1}), Matrix::Zero(2, 2), -identity(2)}};
  HardCase result =
      family_case(name, d == 0.0 ? own_closed_form : computed, 0.5, 1.5, family, std::move(special));
  if (d != 0.0) return result;
  set_spectrum(result, [](Wide p) {
    // mu^2 - (2 + 2 p^2) mu + (k1 - p^2)(k2 - p^2) = 0; the small root from the product.
    const Wide product = (Wide(0.9) - p * p) * (Wide(1.1) - p * p);
    const Wide half = (Wide(0.9) + Wide(1.1)) / 2 + p * p;
    const Wide large = half + std::sqrt(half * half - product);
    return undamped_pairs({product / large, large});
  });
  return result;
}

/// s^2 + 0.2 s + tan p.
HardCase tangent_divergence() {
  const std::string scene =
      family_scene("M = [ [[1]] ]\nC = [ [[0.2]] ]\nK = [ [[\"tan(p)\"]] ]\n", 1.0, -0.5);
  const auto pencil = [](WideComplex p) {
    WidePencil result{WideComplexMatrix::Ones(1, 1), WideComplexMatrix::Ones(1, 1),
                      WideComplexMatrix::Ones(1, 1)};
    result.C(0, 0) = 0.2;
    result.K(0, 0) = std::tan(p);
    return result;
  };
  HardCase result =
      expression_case("tangent_divergence", own_closed_form, 1.0, -0.5, scene, pencil,
                      {{"divergence", 0.0, 0.0}, {"collision", 0.00999966668666523931645, -0.1}});
  set_spectrum(result, [](Wide p) { return quadratic_roots(1, 0.2, std::tan(p)); });
  return result;
}

/// M = diag(1, p): the mass is singular at p = 0 and an eigenvalue runs through infinity.
HardCase mass_through_zero(bool damped) {
  Family family{{diagonal({1, 0}), diagonal({0, 1})}, {}, {rows({{1, 0.2}, {0.2, 1}})}};
  std::vector<SpecialPoint> special = {{"infinite", 0.0, {INFINITY, 0.0}}};
  if (damped) {
    family.C = {rows({{0.1, 0.05}, {0.05, 0.4}})};
    special.push_back({"collision", 0.0400039250974680777868, -5.00148563728451635204});
  }
  HardCase result = family_case(damped ? "mass_through_zero" : "mass_through_zero_undamped",
                                damped ? computed : own_closed_form, 1.0, -0.5, family, special);
  if (damped) return result;
  set_spectrum(result, [](Wide p) {
    // p mu^2 - (1 + p) mu + 1 - 0.2^2 = 0: one root by the product, the other infinite at p = 0.
    const Wide last = 1 - Wide(0.2) * Wide(0.2);
    const Wide q = (1 + p + std::sqrt((1 + p) * (1 + p) - 4 * p * last)) / 2;
    if (p == 0) return undamped_pairs({last / q});
    return undamped_pairs({last / q, q / p});
  });
  return result;
}

/// s^2 + 2 s + 1 + p^2: s = -1 + j p touches the real axis at p = 0 and leaves on the other side.
HardCase touching() {
  HardCase result =
      family_case("touching", own_closed_form, -0.5, 0.5,
                  {{identity(1)}, {2.0 * identity(1)}, {identity(1), Matrix::Zero(1, 1), identity(1)}},
                  {{"collision", 0.0, -1.0}});
  const auto branch = [](Wide p) { return WideComplex(-1, p); };
  set_branches(result, {branch});
  set_spectrum(result, [](Wide p) {
    const Complex s(-1.0, static_cast<double>(p));
    return std::vector{s, std::conj(s)};
  });
  return result;
}

}  // namespace

std::vector<HardCase> own_structures() {
  const std::vector<SpecialPoint> critical = {{"collision", 0.948683298050513811302, 0.0},
                                              {"collision", 1.04880884817015158933, 0.0}};
  return {rotor_12(),
          free_chain(),
          graded_veering(),
          whirl_through_zero(),
          whirl_anisotropic("whirl_anisotropic", 0.0, critical),
          whirl_anisotropic("whirl_damped", 0.05,
                            {{"collision", 0.948665962801973325797, -0.00131544670383356875658},
                             {"divergence", 0.948683298050513811302, 0.0},
                             {"divergence", 1.04880884817015158933, 0.0},
                             {"collision", 1.04882303378721129438, 0.00119005382086269312347}}),
          tangent_divergence(),
          mass_through_zero(true),
          mass_through_zero(false),
          touching()};
}

}  // namespace eigentrail::test
