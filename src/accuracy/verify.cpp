#include "eigentrail/accuracy/verify.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/modes/matching.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// The scene and the options that the file was made from.
TraceSetup rebuild(const LociFile& loci) {
  OptionTexts options;
  for (const auto& [name, text] : loci.attributes) {
    const std::string key = name.starts_with("option_") ? name.substr(7) : "";
    if (!key.empty() && text != "auto") options.emplace_back(key, text);
  }
  return prepare_trace(parse_scene(loci.attribute("scene"), loci.attribute("scene_path")), options);
}

/// Where the path turns back, an equilibrium looked for at p alone may be that of another passage. Between
/// the two points of a step it is met on planes across their chord, from the one that lies on p.
EquilibriumGuess guess_on_chord(const PathProblem& problem, const LociFile& loci, std::size_t step,
                                double p) {
  constexpr int most_planes = 60;
  const auto node = static_cast<Eigen::Index>(step);
  const auto row = [](const Matrix& rows, Eigen::Index i) { return Vector(rows.row(i).transpose()); };
  const Vector begin = row(loci.equilibrium, node);
  const Vector chord = row(loci.equilibrium, node + 1) - begin;
  const double p_begin = loci.p[step];
  const double p_chord = loci.p[step + 1] - p_begin;
  const double range = loci.highest() - loci.lowest();
  const double size = std::max(begin.squaredNorm(), 1e-300);
  const PathPlane plane{chord / size, p_chord / (range * range)};
  EvaluationCounts counts = problem.model.new_counts();
  EquilibriumGuess guess{begin, row(loci.multiplier, node), false};
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < most_planes; ++i) {
    const double t = 0.5 * (low + high);
    double p_there = p_begin + t * p_chord;
    const Vector multipliers = (1.0 - t) * row(loci.multiplier, node) + t * row(loci.multiplier, node + 1);
    const Equilibrium there =
        solve_equilibrium_on(plane, problem.model, parameters_at(problem, p_there), problem.traced,
                             begin + t * chord, multipliers, problem.steady, p_there, counts);
    if (there.status != SteadyStatus::converged) break;
    guess = {there.x, there.lambda, false};
    // p is monotonic on a step: points of the trace lie on its folds.
    ((p_there - p) * p_chord < 0.0 ? low : high) = t;
  }
  return guess;
}

/// The whole spectrum where the path passes p. What the file stores of the equilibrium is a guess, not a
/// fact: it is part of what is checked.
std::optional<Spectrum> fresh_spectrum(const PathProblem& problem, const LociFile& loci,
                                       const LociFile::Position& position, double p) {
  RunCounts counts;
  const auto node = static_cast<Eigen::Index>(position.step);
  const double t = position.t;
  const auto between = [&](const Matrix& rows) {
    return Vector(((1.0 - t) * rows.row(node) + t * rows.row(node + 1)).transpose());
  };
  const EquilibriumGuess guess =
      follows_parameter(loci.steps[position.step])
          ? EquilibriumGuess{between(loci.equilibrium), between(loci.multiplier), false}
          : guess_on_chord(problem, loci, position.step, p);
  const PathPoint point = reduce_at(problem, p, guess, Matrix(), counts);
  if (point.status != PointStatus::computed) return std::nullopt;
  Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  if (spectrum.status != SpectrumStatus::complete) return std::nullopt;
  return spectrum;
}

/// Near a meeting single eigenvalues are as uncertain as roots of a polynomial there, and what the file
/// stores, and promises, are the block's functions. An error of an eigenvalue counts as the error of those:
/// weighed by its distance to the others, where that is below a tenth.
double weight_in_block(const Spectrum& spectrum, Complex s, double error, double scale) {
  double weight = 1.0;
  for (const StartingMode& other : spectrum.modes) {
    for (const Complex neighbour : {other.s, std::conj(other.s)}) {
      if (neighbour == s || (other.s.imag() == 0.0 && neighbour != other.s)) continue;
      weight *= std::min(1.0, std::max(std::abs(neighbour - s), error) / (0.1 * scale));
      if (other.s.imag() == 0.0) break;
    }
  }
  return weight;
}

/// Whether each mode is part of a block of several on the step.
std::vector<bool> in_blocks(const PathStep& step, std::size_t n_modes) {
  std::vector<bool> result(n_modes, false);
  for (const DenseBlock& block : step.blocks) {
    for (const int mode : block.modes) result[static_cast<std::size_t>(mode)] = block.size() > 1;
  }
  return result;
}

/// Distance of every traced value from the eigenvalue assigned to it, one to one, relative to max(|s|,
/// reference); zero for modes that do not exist. More traced values than eigenvalues: those left over are
/// infinitely far.
Vector distances(const ComplexVector& traced, const std::vector<bool>& in_block, const Spectrum& spectrum,
                 double reference) {
  std::vector<Eigen::Index> present;
  for (Eigen::Index i = 0; i < traced.size(); ++i) {
    if (std::isfinite(traced[i].real())) present.push_back(i);
  }
  const auto n = static_cast<Eigen::Index>(std::max(spectrum.modes.size(), present.size()));
  constexpr double nowhere = 1e30;
  Matrix cost = Matrix::Constant(n, n, nowhere);
  const auto count = static_cast<Eigen::Index>(present.size());
  cost.bottomRows(n - count).setZero();  // eigenvalues that nobody followed
  for (Eigen::Index i = 0; i < count; ++i) {
    const Complex value = traced[present[static_cast<std::size_t>(i)]];
    for (std::size_t j = 0; j < spectrum.modes.size(); ++j) {
      const Complex s = spectrum.modes[j].s;
      // A pair is stored by its upper member; on the real axis rounding may pick the lower one.
      const double distance = std::min(std::abs(value - s), std::abs(value - std::conj(s)));
      cost(i, static_cast<Eigen::Index>(j)) = distance / std::max(std::abs(s), reference);
    }
  }
  const std::vector<int> assignment = optimal_assignment(cost);
  Vector result = Vector::Zero(traced.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const int j = assignment[static_cast<std::size_t>(i)];
    const double distance = cost(i, j);
    const Eigen::Index mode = present[static_cast<std::size_t>(i)];
    result[mode] = distance < nowhere ? distance : INFINITY;
    if (!in_block[static_cast<std::size_t>(mode)] || !std::isfinite(result[mode])) continue;
    const Complex s = spectrum.modes[static_cast<std::size_t>(j)].s;
    const double scale = std::max(std::abs(s), reference);
    result[mode] *= weight_in_block(spectrum, s, distance * scale, scale);
  }
  return result;
}

}  // namespace

VerifyReport verify_loci(const LociFile& loci, const VerifyOptions& options) {
  if (loci.n_nodes() == 0) throw InputError(loci.path + ": holds no points");
  const TraceSetup setup = rebuild(loci);
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.steady.relax = false;  // another equilibrium than the stored one proves nothing
  const double reference = std::stod(loci.attribute("reference"));
  VerifyReport report;
  report.tolerance = setup.options.tolerance;

  std::mt19937_64 engine(options.seed);
  std::uniform_real_distribution<double> uniform(loci.lowest(), loci.highest());
  for (; report.samples < options.samples; ++report.samples) {
    const double p = uniform(engine);
    for (const LociFile::Position& position : loci.positions(p)) {
      const auto spectrum = fresh_spectrum(problem, loci, position, p);
      if (!spectrum) {
        ++report.unsolved;
        continue;
      }
      Eigen::Index mode = 0;
      const std::vector<bool> in_block = in_blocks(loci.steps[position.step], loci.modes.size());
      const double worst =
          distances(loci.eigenvalues_at(position), in_block, *spectrum, reference).maxCoeff(&mode);
      if (report.worst.mode < 0 || worst > report.worst.relative)
        report.worst = {worst, p, static_cast<int>(mode)};
    }
  }
  return report;
}

}  // namespace eigentrail
