#include "eigentrail/accuracy/verify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>

#include "accuracy/spectrum_distance.hpp"
#include "core/positive_or_one.hpp"
#include "eigentrail/accuracy/reference.hpp"
#include "eigentrail/continuation/eigenvalue_error.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "eigentrail/projection/large_spectrum.hpp"
#include "eigentrail/projection/route.hpp"

namespace eigentrail {
namespace {

constexpr int usual_samples = 100;
constexpr int samples_of_large_model = 10;

/// The text that a key of a table has; empty if it has none.
std::string text_of(const Table& table, const char* key) {
  const Value* value = table.find(key);
  const auto* text = value != nullptr ? std::get_if<std::string>(&value->data) : nullptr;
  return text == nullptr ? "" : *text;
}

/// The file with the matrices of a scene, or the first table of a rotor, as the scene names it; empty if they
/// stand in the scene.
std::string file_of_matrices(const Scene& scene) {
  constexpr std::array<std::pair<const char*, const char*>, 4> keys{
      {{"matrix_family", "file"}, {"sampled_family", "file"}, {"shaft", "stations"}, {"bearing", "table"}}};
  for (const auto& [name, key] : keys) {
    for (const Table* table : tables(scene, name)) {
      if (const std::string file = text_of(*table, key); !file.empty()) return file;
    }
  }
  return "";
}

/// Where the scene of a loci file may be: its path as it was given to the trace, seen from here, from the
/// loci file's folder and from the folders above it; and beside the loci file.
std::vector<std::filesystem::path> places_of_scene(const std::string& scene, const std::string& loci) {
  namespace fs = std::filesystem;
  std::vector<fs::path> places{scene};
  std::error_code error;
  const fs::path file = fs::absolute(loci, error);
  if (error || fs::path(scene).is_absolute()) return places;
  for (fs::path folder = file.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    places.push_back(folder / scene);
    if (folder == folder.root_path()) break;
  }
  places.push_back(file.parent_path() / fs::path(scene).filename());
  return places;
}

/// If the scene has its matrices in a separate file, that file is read again. Its place is given only by the
/// loci file, which may come from an untrusted source. It is therefore read only if the scene file beside it
/// exists and has the text stored in the loci file. Throws InputError otherwise.
void find_matrices(Scene& scene, const std::string& path) {
  const std::string matrices = file_of_matrices(scene);
  if (matrices.empty()) return;
  const std::string given = scene.path;
  bool changed = false;
  for (const std::filesystem::path& place : places_of_scene(given, path)) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(place, error) || error) continue;
    std::ifstream stream(place, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    scene.path = place.string();
    if (text == scene.text) return;
    changed = true;
  }
  if (changed)
    throw InputError("it was made from another scene than " + given + " is now; the matrices in " + matrices +
                     " cannot be checked");
  throw InputError(
      "the matrices are in " + matrices + " beside " + given +
      ", which is neither in this folder nor beside the loci file or above it; go to the folder in "
      "which the trace was made, or put both beside the loci file");
}

/// The scene and the options of the trace in the file.
TraceSetup rebuild(const LociFile& loci) {
  OptionTexts options;
  for (const auto& [name, text] : loci.attributes) {
    const std::string key = name.starts_with("option_") ? name.substr(7) : "";
    if (!key.empty() && text != "auto") options.emplace_back(key, text);
  }
  Scene scene = parse_scene(loci.attribute("scene"), loci.attribute("scene_path"));
  find_matrices(scene, loci.path);
  TraceSetup setup = prepare_trace(std::move(scene), options);
  // The points of a projected family are at x = 0.
  if (large_family(*setup.model, setup.options) != nullptr) return setup;
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

/// Multipliers and trimmed parameters, as in Path::lambda, one row per node.
Matrix multipliers_and_trim(const LociFile& loci) {
  const Eigen::Index m = loci.multiplier.cols();
  Matrix rows(loci.multiplier.rows(), m + static_cast<Eigen::Index>(loci.trimmed.size()));
  rows.leftCols(m) = loci.multiplier;
  for (std::size_t i = 0; i < loci.trimmed.size(); ++i)
    rows.col(m + static_cast<Eigen::Index>(i)) =
        Vector::Map(loci.trimmed[i].values.data(), loci.multiplier.rows());
  return rows;
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
  const Matrix unknowns = multipliers_and_trim(loci);
  const Vector begin = row(loci.equilibrium, node);
  const Vector chord = row(loci.equilibrium, node + 1) - begin;
  const double p_begin = loci.p[step];
  const double p_chord = loci.p[step + 1] - p_begin;
  const double range = loci.highest() - loci.lowest();
  const double size = std::max(begin.squaredNorm(), 1e-300);
  PathPlane plane{chord / size, p_chord / (range * range)};
  const auto n_trims = static_cast<Eigen::Index>(loci.trimmed.size());
  if (n_trims > 0) {
    const Vector sizes = unknowns.rightCols(n_trims).cwiseAbs().colwise().maxCoeff().transpose();
    const Vector change = (row(unknowns, node + 1) - row(unknowns, node)).tail(n_trims);
    plane.u = change.cwiseQuotient(sizes.cwiseAbs2().unaryExpr(&positive_or_one));
  }
  EvaluationCounts counts = problem.model.new_counts();
  EquilibriumGuess guess{begin, row(unknowns, node), false};
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < most_planes; ++i) {
    const double t = 0.5 * (low + high);
    double p_there = p_begin + t * p_chord;
    const Vector multipliers = (1.0 - t) * row(unknowns, node) + t * row(unknowns, node + 1);
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

/// Starting value for the equilibrium at a place of the path. The stored equilibria are no more than that,
/// because they are checked as well.
EquilibriumGuess guess_at(const PathProblem& problem, const LociFile& loci,
                          const LociFile::Position& position, double p) {
  const auto node = static_cast<Eigen::Index>(position.step);
  const double t = position.t;
  const auto between = [&](const Matrix& rows) {
    if (rows.cols() == 0) return Vector(0);  // no coordinates, or no constraints
    return Vector(((1.0 - t) * rows.row(node) + t * rows.row(node + 1)).transpose());
  };
  return follows_parameter(loci.steps[position.step])
             ? EquilibriumGuess{between(loci.equilibrium), between(multipliers_and_trim(loci)), false}
             : guess_on_chord(problem, loci, position.step, p);
}

/// The whole spectrum at a place of the path; empty if it cannot be computed.
std::vector<Complex> fresh_spectrum(const PathProblem& problem, const LociFile& loci,
                                    const LociFile::Position& position, double p) {
  RunCounts counts;
  const EquilibriumGuess guess = guess_at(problem, loci, position, p);
  const PathPoint point = reduce_at(problem, p, guess, Matrix(), counts);
  if (point.status != PointStatus::computed) return {};
  const Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  if (spectrum.status != SpectrumStatus::complete) return {};
  std::vector<Complex> exact;
  for (const StartingMode& found : spectrum.modes) exact.push_back(found.s);
  return exact;
}

/// Solves the scene of a loci file afresh: as a whole, or beside the followed modes if it is large.
class FreshSolver {
 public:
  FreshSolver(const TraceSetup& setup, const PathProblem& problem, const LociFile& loci)
      : problem_(problem), loci_(loci) {
    if (is_large(*setup.model, setup.options)) large_.emplace(*setup.model, setup.options);
  }

  bool is_of_large_model() const { return large_.has_value(); }

  /// Exact eigenvalues at a place where the file has the values s; empty if they cannot be computed.
  std::vector<Complex> at(const LociFile::Position& position, double p, const ComplexVector& s) {
    if (!large_) return fresh_spectrum(problem_, loci_, position, p);
    if (problem_.model.n_coordinates() != loci_.equilibrium.cols()) return large_->beside(s, p, {}, {});
    const EquilibriumGuess guess = guess_at(problem_, loci_, position, p);
    return large_->beside(s, p, guess.x, guess.lambda);
  }

  /// The same in extended precision: where eigenvalues are close, or the entries of the matrices of very
  /// different size, QZ itself is off by more than a trace. Empty where that cannot be had.
  std::vector<Complex> in_extended_precision(const LociFile::Position& position, double p) const {
    if (large_) return {};
    const ReferenceSpectrum spectrum =
        reference_spectrum(problem_, p, guess_at(problem_, loci_, position, p));
    if (spectrum.status != ReferenceStatus::converged) return {};
    std::vector<Complex> exact;
    for (const ExtendedComplex& s : spectrum.s)
      exact.emplace_back(static_cast<double>(s.real()), static_cast<double>(s.imag()));
    return exact;
  }

 private:
  const PathProblem& problem_;
  const LociFile& loci_;
  std::optional<LargeSpectrum> large_;
};

/// rebuild(), with messages that name the loci file: errors in the scene and the options are those of the
/// stored text, not of a scene file that may have changed since.
TraceSetup setup_of(const LociFile& loci) {
  try {
    return rebuild(loci);
  } catch (const InputError& error) {
    throw InputError(loci.path + ": cannot be solved afresh: " + error.what());
  }
}

/// Distances of the dense output from the exact eigenvalues, |s_dense - s| / max(|s|, reference). For the
/// members of a block, in units of what their error may be: beside an exceptional point eigenvalues move by
/// the root of the tolerance, and a distance of that size counts as the tolerance.
Vector discrepancies(const LociFile& loci, const LociFile::Position& position, const ComplexVector& s,
                     const std::vector<Complex>& exact, double tolerance, double reference) {
  const std::vector<bool> alone(loci.modes.size(), false);
  Vector result = distances_from_spectrum(s, alone, exact, reference);
  const PathStep& step = loci.steps[position.step];
  for (const DenseBlock& block : step.blocks) {
    if (block.size() == 1) continue;
    const bool at_node = position.t == 0.0 || position.t == 1.0;
    const Vector errors = block_errors(block, step.length, position.t, s, at_node, tolerance, reference);
    for (std::size_t i = 0; i < block.modes.size(); ++i) {
      const int mode = block.modes[i];
      if (!std::isfinite(s[mode].real())) continue;
      const double promised = tolerance * std::max(std::abs(s[mode]), reference);
      result[mode] *= std::min(1.0, promised / errors[static_cast<Eigen::Index>(i)]);
    }
  }
  return result;
}

/// The eigenvalues, and of pairs within rounding of the real axis both members: two equal real eigenvalues
/// may come as such a pair. Of two that may be one, which rounding has split, their mean as well: it is known
/// to rounding, they only to its root.
std::vector<Complex> with_double_roots(const std::vector<Complex>& exact) {
  constexpr double rounding_of_double_root = 1e-7;  // root of rounding times a few
  std::vector<Complex> result = exact;
  for (const Complex s : exact) {
    if (s.imag() != 0.0 && std::abs(s.imag()) <= rounding_of_double_root * std::abs(s))
      result.push_back(std::conj(s));
  }
  const std::size_t all = result.size();
  for (std::size_t i = 0; i < all; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (std::abs(result[i] - result[j]) <= rounding_of_double_root * std::abs(result[i]))
        result.insert(result.end(), 2, 0.5 * (result[i] + result[j]));  // for both
    }
  }
  return result;
}

/// Number of exact eigenvalues, up to a magnitude, that no mode of the file has.
int missing_modes(const ComplexVector& s, const std::vector<Complex>& exact, double largest) {
  const auto is_within = [](Complex value, double limit) {
    return std::isfinite(value.real()) && std::abs(value) <= limit;
  };
  constexpr double margin = 1.1;  // beside the limit an eigenvalue may count here and not there
  const auto expected =
      std::count_if(exact.begin(), exact.end(), [&](Complex value) { return is_within(value, largest); });
  const auto found =
      std::count_if(s.begin(), s.end(), [&](Complex value) { return is_within(value, margin * largest); });
  return static_cast<int>(std::max<std::ptrdiff_t>(expected - found, 0));
}

/// Largest magnitude of an eigenvalue at the stored points, 1/s.
double largest_of(const LociFile& loci) {
  double largest = 0.0;
  for (std::size_t i = 0; i < loci.steps.size(); ++i) {
    for (const Complex s : loci.eigenvalues_at(LociFile::Position{i, 0.0})) {
      if (std::isfinite(s.real())) largest = std::max(largest, std::abs(s));
    }
  }
  return largest;
}

/// Whether eigenvalues that were solved at stored points are off there already: then the matrices are others.
bool differs_at_points(FreshSolver& solver, const LociFile& loci, double tolerance, double reference) {
  const std::size_t last = loci.steps.size() - 1;
  for (const std::size_t step : {std::size_t{0}, last / 2, last}) {
    const double p = loci.p[step];
    const ComplexVector s = loci.eigenvalues_at(LociFile::Position{step, 0.0});
    const std::vector<Complex> exact = solver.at({step, 0.0}, p, s);
    if (exact.empty()) continue;
    if (discrepancies(loci, {step, 0.0}, s, exact, tolerance, reference).maxCoeff() > tolerance) return true;
  }
  return false;
}

}  // namespace

VerifyReport verify_loci(const LociFile& loci, const VerifyOptions& options) {
  if (loci.n_nodes() == 0) throw InputError(loci.path + ": holds no points");
  const TraceSetup setup = setup_of(loci);
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.steady.relax = false;  // relaxation may lead to another equilibrium than the stored one
  const double reference = std::stod(loci.attribute("reference"));
  const bool follows_all = setup.options.modes.is_all();
  const double largest_finite = largest_of(loci);
  FreshSolver solver(setup, problem, loci);
  VerifyReport report;
  report.large = solver.is_of_large_model();
  report.tolerance = setup.options.tolerance;
  const int samples = options.samples.value_or(report.large ? samples_of_large_model : usual_samples);

  std::mt19937_64 engine(options.seed);
  std::uniform_real_distribution<double> uniform(loci.lowest(), loci.highest());
  for (; report.samples < samples; ++report.samples) {
    const double p = uniform(engine);
    for (const LociFile::Position& position : loci.positions(p)) {
      const ComplexVector s = loci.eigenvalues_at(position);
      const std::vector<Complex> exact = solver.at(position, p, s);
      if (exact.empty()) {
        ++report.unsolved;
        continue;
      }
      const auto off_from = [&](const std::vector<Complex>& values) {
        return discrepancies(loci, position, s, with_double_roots(values), report.tolerance, reference);
      };
      Vector off = off_from(exact);
      if (off.maxCoeff() > report.tolerance) {
        const std::vector<Complex> refined = solver.in_extended_precision(position, p);
        if (!refined.empty()) {
          off = off_from(refined);
          ++report.refined;
        }
      }
      Eigen::Index mode = 0;
      const double worst = off.maxCoeff(&mode);
      if (report.worst.mode < 0 || worst > report.worst.relative)
        report.worst = {worst, p, static_cast<int>(mode)};
      const int missing = follows_all ? missing_modes(s, exact, largest_finite) : 0;
      if (missing > report.missing) report.missing_at = p;
      report.missing = std::max(report.missing, missing);
    }
  }
  const std::string matrices = file_of_matrices(setup.scene);
  if (!report.passed() && !matrices.empty() && !loci.steps.empty() &&
      differs_at_points(solver, loci, report.tolerance, reference))
    report.other_matrices = (std::filesystem::path(setup.scene.path).parent_path() / matrices).string();
  return report;
}

}  // namespace eigentrail
