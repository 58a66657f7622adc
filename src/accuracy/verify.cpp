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

std::string attribute(const LociFile& loci, const std::string& name) {
  const auto found = loci.attributes.find(name);
  if (found == loci.attributes.end()) throw InputError(loci.path + ": has no attribute " + name);
  return found->second;
}

/// The scene and the options that the file was made from.
TraceSetup rebuild(const LociFile& loci) {
  OptionTexts options;
  for (const auto& [name, text] : loci.attributes) {
    const std::string key = name.starts_with("option_") ? name.substr(7) : "";
    if (!key.empty() && text != "auto") options.emplace_back(key, text);
  }
  return prepare_trace(parse_scene(attribute(loci, "scene"), attribute(loci, "scene_path")), options);
}

/// The whole spectrum at p, from the stored equilibrium nearest to it.
std::optional<Spectrum> fresh_spectrum(const PathProblem& problem, const LociFile& loci, double p) {
  RunCounts counts;
  const auto node = static_cast<Eigen::Index>(loci.nearest_node(p));
  // The stored equilibrium is a guess, not a fact: it is part of what is checked.
  const EquilibriumGuess guess{loci.equilibrium.row(node).transpose(), loci.multiplier.row(node).transpose(),
                               false};
  const PathPoint point = reduce_at(problem, p, guess, Matrix(), counts);
  if (point.status != PointStatus::computed) return std::nullopt;
  Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  if (spectrum.status != SpectrumStatus::complete) return std::nullopt;
  return spectrum;
}

/// Distance of every traced value from the eigenvalue assigned to it, one to one, relative to max(|s|,
/// reference). More traced values than eigenvalues: those left over are infinitely far.
Vector distances(const ComplexVector& traced, const Spectrum& spectrum, double reference) {
  const auto n = static_cast<Eigen::Index>(
      std::max<std::size_t>(spectrum.modes.size(), static_cast<std::size_t>(traced.size())));
  constexpr double nowhere = 1e30;
  Matrix cost = Matrix::Constant(n, n, nowhere);
  cost.bottomRows(n - traced.size()).setZero();  // eigenvalues that nobody followed
  for (Eigen::Index i = 0; i < traced.size(); ++i) {
    for (std::size_t j = 0; j < spectrum.modes.size(); ++j) {
      const Complex s = spectrum.modes[j].s;
      // A pair is stored by its upper member; on the real axis rounding may pick the lower one.
      const double distance = std::min(std::abs(traced[i] - s), std::abs(traced[i] - std::conj(s)));
      cost(i, static_cast<Eigen::Index>(j)) = distance / std::max(std::abs(s), reference);
    }
  }
  const std::vector<int> assignment = optimal_assignment(cost);
  Vector result(traced.size());
  for (Eigen::Index i = 0; i < traced.size(); ++i) {
    const double distance = cost(i, assignment[static_cast<std::size_t>(i)]);
    result[i] = distance < nowhere ? distance : INFINITY;
  }
  return result;
}

}  // namespace

VerifyReport verify_loci(const LociFile& loci, const VerifyOptions& options) {
  if (loci.n_nodes() == 0) throw InputError(loci.path + ": holds no points");
  const TraceSetup setup = rebuild(loci);
  const PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  const double reference = std::stod(attribute(loci, "reference"));
  VerifyReport report;
  report.tolerance = setup.options.tolerance;

  std::mt19937_64 engine(options.seed);
  std::uniform_real_distribution<double> uniform(loci.lowest(), loci.highest());
  for (; report.samples < options.samples; ++report.samples) {
    const double p = uniform(engine);
    const auto spectrum = fresh_spectrum(problem, loci, p);
    if (!spectrum) {
      ++report.unsolved;
      continue;
    }
    Eigen::Index mode = 0;
    const double worst = distances(loci.eigenvalues_at(p), *spectrum, reference).maxCoeff(&mode);
    if (report.worst.mode < 0 || worst > report.worst.relative)
      report.worst = {worst, p, static_cast<int>(mode)};
  }
  return report;
}

}  // namespace eigentrail
