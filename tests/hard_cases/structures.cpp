// H13 to H15, H21 to H23: ground resonance, blades, a free chain, a pipe.
#include <cmath>

#include "hard_cases/family.hpp"
#include "hard_cases/parts.hpp"

namespace eigentrail::test {
namespace {

const char* const hammond =
    "Hammond 1974 (J. Am. Helicopter Soc. 19), two multiblade lag and two hub coordinates, slug and foot; "
    "special points in 40-digit arithmetic, reference.py";

/// Coleman's equations for four blades on an isotropic rotor: lag damper `cz`, hub dampers `cx` and `cy`.
Family ground_resonance(double cz, double cx, double cy) {
  constexpr double moment = 65.0, inertia = 800.0, half_blades = 2.0;
  const double h = half_blades * moment;
  Matrix lag = Matrix::Zero(4, 4);
  lag(0, 1) = 1.0;
  lag(1, 0) = -1.0;
  Family family;
  family.M = {rows({{inertia, 0, 0, -moment}, {0, inertia, moment, 0}, {0, h, 576.0, 0}, {-h, 0, 0, 251.0}})};
  family.C = {diagonal({cz, cz, cx, cy}), 2.0 * inertia * lag};
  family.K = {diagonal({0, 0, 85000.0, 85000.0}), cz * lag,
              diagonal({moment - inertia, moment - inertia, 0, 0})};
  return family;
}

// clang-format off
HardCase ground_resonance_undamped() {
  return family_case("H13_ground_resonance_undamped", hammond, 5.0, 40.0, ground_resonance(0, 0, 0), {
      {"veering", 9.35422746783672060214, {-1.15675672755845295251, 12.0403433379223168554}, 2.06096561450541283745},
      {"collision", 14.1259381305006228162, {0.0, 10.9708300921193995802}},
      {"collision", 19.2463072079093788425, {0.0, 13.0218840132874476995}},
      {"collision", 21.0104974221559377757, {0.0, 15.9479574101974401562}},
      {"collision", 32.0416739146243330408, {0.0, 20.0483827926322879337}},
  });
}

HardCase ground_resonance_tenth() {
  return family_case("H14_ground_resonance_damped", hammond, 5.0, 40.0, ground_resonance(300, 350, 175), {
      {"veering", 9.25385312474680718414, {-1.45313396201176122328, 11.9881185291607760114}, 2.14468553479613581444},
      {"veering", 9.45880084249786625662, {0.861113393782115146798, 12.0846727952250168983}, 1.97504558999683881065},
      {"veering", 14.1154020828510562526, {-0.235138096396202756919, 10.967560565033121317}, 0.0120989262172342258522},
      {"flutter", 14.1963226170887080707, {0.0, 10.9872849991016857022}},
      {"veering", 19.2367541418477237949, {-0.346281723517875819107, 13.0173319729201222063}, 0.246432515658806528907},
      {"flutter", 19.4045912446823985969, {0.0, 13.5402066616355867106}},
      {"flutter", 20.9506962384701920316, {0.0, 15.6001633246151844684}},
      {"veering", 21.0003598331710718398, {-0.258905228954052867505, 15.9449145535127906026}, 0.102004116434716681681},
      {"veering", 32.0329133426259206011, {-0.396219090411767970755, 20.0447317608275260374}, 0.429770278461928774643},
      {"flutter", 33.1444644749369868116, {0.0, 21.7184638627409989702}},
  });
}

HardCase ground_resonance_full() {
  return family_case("H15_ground_resonance_stable", hammond, 5.0, 60.0, ground_resonance(3000, 3500, 1750), {
      {"veering", 6.74185692599734215231, {-2.12532101300213461444, 6.65064477086132398282}, 0.350643917276117610161},
      {"veering", 8.55381501617591662257, {-4.16262775747563672183, 11.130111302611697751}, 2.73472788641421263879},
      {"veering", 10.6795343422991117532, {-1.69283880195730692221, 12.1379324979740335254}, 1.19705232284252770924},
      {"veering", 11.7352724481355805694, {-5.88042284123128051388, 17.002847929855039882}, 4.39841931753293740155},
      {"veering", 12.9250899936591796297, {-2.21705497095101326932, 10.6396932469814230679}, 0.0924214781537445013854},
      {"veering", 14.1785488473443161659, {-0.742119243486596365848, 18.4394487122235215901}, 3.31777830141206699331},
      {"veering", 18.2624451628436355581, {-3.44977037976619423948, 12.5697150422033220001}, 2.56675770676671309191},
      {"veering", 19.9289605035823445447, {-2.56736648397772153099, 15.6143743656962934682}, 0.989355332939724183962},
      {"veering", 31.159701179060223679, {-3.96148232596450237506, 19.6804218962069083275}, 4.34151181925659899009},
  });
}
// clang-format on

/// Eight blades in a circle, coupling 0.05, mistuned by p sin(3 j + 1): three doublets at p = 0 that part.
HardCase blades() {
  constexpr Eigen::Index n = 8;
  constexpr double coupling = 0.05;
  Matrix K0 = (1.0 + 2.0 * coupling) * Matrix::Identity(n, n);
  Vector mistuning(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    K0(j, (j + 1) % n) -= coupling;
    K0((j + 1) % n, j) -= coupling;
    mistuning[j] = std::sin(3.0 * static_cast<double>(j) + 1.0);
  }
  const Matrix D = mistuning.asDiagonal();
  return family_case(
      "H21_eight_blades",
      "own derivation; doublets of a circulant matrix in closed form, no other special point by reference.py",
      0.0, 0.2, {{Matrix::Identity(n, n)}, {0.01 * Matrix::Identity(n, n)}, {K0, D}},
      {{"crossing", 0.0, {-0.005, 1.0145266491725810415}},
       {"crossing", 0.0, {-0.005, 1.04879692982006773646}},
       {"crossing", 0.0, {-0.005, 1.0819822910374526297}}});
}

/// Three masses in a free chain, held at one end by a spring p: s = +-j sqrt(p / 3) near p = 0.
HardCase held_chain() {
  const Family family{
      {Matrix::Identity(3, 3)}, {}, {rows({{1, -1, 0}, {-1, 2, -1}, {0, -1, 1}}), diagonal({1, 0, 0})}};
  HardCase result = family_case("H22_rigid_body_mode", "own derivation; det K = p", -0.1, 0.1, family,
                                {{"collision", 0.0, 0.0}});
  set_spectrum(result, [family](Wide p) {
    std::vector<Wide> mu = jacobi_eigenvalues(evaluate(family, p).K.real());
    mu[0] = p / (mu[1] * mu[2]);  // keeps its relative accuracy
    return undamped_pairs({mu.begin(), mu.end()});
  });
  return result;
}

/// Cantilever conveying fluid with mass ratio 0.2, eight Galerkin modes of the clamped-free beam.
Family pipe() {
  constexpr Eigen::Index n = 8;
  constexpr Wide beta = 0.2;
  // Roots of cos x cosh x = -1.
  constexpr Wide root[n] = {1.87510406871196116645L, 4.69409113297417457644L, 7.85475743823761256486L,
                            10.9955407348754669907L, 14.1371683910464705809L, 17.2787595320882363336L,
                            20.4203522510412509944L, 23.5619449018064435015L};
  Matrix stiffness = Matrix::Zero(n, n);
  Matrix coriolis(n, n);
  Matrix centrifugal(n, n);
  for (Eigen::Index s = 0; s < n; ++s) {
    stiffness(s, s) = static_cast<double>(root[s] * root[s] * root[s] * root[s]);
    for (Eigen::Index r = 0; r < n; ++r) {
      const auto weighted = [&](Eigen::Index i) {
        const Wide x = root[i];
        return x * (std::sinh(x) - std::sin(x)) / (std::cosh(x) + std::cos(x));
      };
      const Wide sign = (r + s) % 2 == 0 ? 1 : -1;
      const Wide ratio = root[s] * root[s] / (root[r] * root[r]);
      const Wide b = s == r ? 2 : 4 / (ratio + sign);
      const Wide c =
          s == r ? weighted(r) * (2 - weighted(r)) : 4 * (weighted(r) - weighted(s)) / (sign - ratio);
      coriolis(s, r) = static_cast<double>(2 * std::sqrt(beta) * static_cast<double>(b));
      centrifugal(s, r) = static_cast<double>(c);
    }
  }
  const Matrix zero = Matrix::Zero(n, n);
  return {{Matrix::Identity(n, n)}, {zero, coriolis}, {stiffness, zero, centrifugal}};
}

}  // namespace

std::vector<HardCase> structures() {
  return {ground_resonance_undamped(),
          ground_resonance_tenth(),
          ground_resonance_full(),
          blades(),
          held_chain(),
          family_case("H23_pipe",
                      "Gregory & Paidoussis 1966 (Proc. R. Soc. A 293); special points in 40-digit "
                      "arithmetic, reference.py",
                      0.0, 8.0, pipe(),
                      {{"flutter", 5.59220844922307315673, {0.0, 13.7111332727711441189}},
                       {"collision", 6.23389505943606101636, -13.1280953564590963407}})};
}

}  // namespace eigentrail::test
