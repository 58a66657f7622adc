#include "eigentrail/accuracy/verify.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "accuracy/spectrum_distance.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// If the scene has its matrices in a separate file, that file is read again. Its place is given only by the
/// loci file, which may come from an untrusted source. It is therefore read only if the scene file beside it
/// exists and has the text stored in the loci file. Throws InputError otherwise.
void check_place_of_matrices(const Scene& scene, const std::string& path) {
  const Value* family = scene.root.find("matrix_family");
  const auto* table = family != nullptr ? std::get_if<Table>(&family->data) : nullptr;
  if (table == nullptr || table->find("file") == nullptr) return;
  if (read_scene(scene.path).text != scene.text) {
    throw InputError(path + ": was made from another scene than " + scene.path +
                     " is now; its matrices cannot be checked");
  }
}

/// The scene and the options of the trace in the file.
TraceSetup rebuild(const LociFile& loci) {
  OptionTexts options;
  for (const auto& [name, text] : loci.attributes) {
    const std::string key = name.starts_with("option_") ? name.substr(7) : "";
    if (!key.empty() && text != "auto") options.emplace_back(key, text);
  }
  Scene scene = parse_scene(loci.attribute("scene"), loci.attribute("scene_path"));
  check_place_of_matrices(scene, loci.path);
  TraceSetup setup = prepare_trace(std::move(scene), options);
  const bool same = setup.model->n_coordinates() == loci.equilibrium.cols() &&
                    setup.model->n_constraints() == loci.multiplier.cols();
  if (!same) {
    throw InputError(loci.path + ": its scene has " + std::to_string(setup.model->n_coordinates()) +
                     " coordinates and " + std::to_string(setup.model->n_constraints()) +
                     " constraints, its points " + std::to_string(loci.equilibrium.cols()) + " and " +
                     std::to_string(loci.multiplier.cols()));
  }
  return setup;
}

/// Starting value for the equilibrium at p on a step where the path may turn back. Newton's method at
/// constant p could converge to another passage of the path. Here equilibria are computed on planes
/// perpendicular to the chord between the two points of the step, and the plane on which the equilibrium has
/// the parameter value p is found by bisection.
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
    // p is monotonic on a step, because the trace stores a point at every fold.
    ((p_there - p) * p_chord < 0.0 ? low : high) = t;
  }
  return guess;
}

/// The whole spectrum at a place of the path; empty if it cannot be computed. The stored equilibria are only
/// starting values, because they are checked as well.
std::optional<Spectrum> fresh_spectrum(const PathProblem& problem, const LociFile& loci,
                                       const LociFile::Position& position, double p) {
  RunCounts counts;
  const auto node = static_cast<Eigen::Index>(position.step);
  const double t = position.t;
  const auto between = [&](const Matrix& rows) {
    if (rows.cols() == 0) return Vector(0);  // no coordinates, or no constraints
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

/// rebuild(), with messages that name the loci file: errors in the scene and the options are those of the
/// stored text, not of a scene file that may have changed since.
TraceSetup setup_of(const LociFile& loci) {
  try {
    return rebuild(loci);
  } catch (const InputError& error) {
    throw InputError(loci.path + ": cannot be solved afresh: " + error.what());
  }
}

}  // namespace

VerifyReport verify_loci(const LociFile& loci, const VerifyOptions& options) {
  if (loci.n_nodes() == 0) throw InputError(loci.path + ": holds no points");
  const TraceSetup setup = setup_of(loci);
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.steady.relax = false;  // relaxation may lead to another equilibrium than the stored one
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
      std::vector<Complex> exact;
      for (const StartingMode& found : spectrum->modes) exact.push_back(found.s);
      const double worst =
          distances_from_spectrum(loci.eigenvalues_at(position), in_block, exact, reference).maxCoeff(&mode);
      if (report.worst.mode < 0 || worst > report.worst.relative)
        report.worst = {worst, p, static_cast<int>(mode)};
    }
  }
  return report;
}

}  // namespace eigentrail
