// Large sparse families: projection and trace against shift-invert Arnoldi at the points of a grid.
#include <cmath>
#include <cstdio>
#include <random>

#include "bench/benchmarks.hpp"
#include "bench/grid_rival.hpp"
#include "bench/memory.hpp"
#include "bench/text.hpp"
#include "bench/timing.hpp"
#include "core/sparse_factors.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/projection/route.hpp"
#include "projection/family_pencils.hpp"
#include "support/large_families.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

constexpr int followed = 6;
constexpr double traced_tolerance = 1e-6;
constexpr double spline_error = 1e-8;

const SparseFamily& family_of(const TraceSetup& setup) {
  return dynamic_cast<const SparseFamily&>(*setup.model);
}

Vector at(double p) {
  return Vector::Constant(1, p);
}

struct Run {
  double seconds = 0.0;
  Projection projection;
  Eigen::Index coordinates = 0;
  RecordedTrace trace;
};

Run project_and_trace(const TraceSetup& setup) {
  Run run;
  Setting setting;
  setting.scene = setup.scene;
  setting.options = setup.options;
  run.seconds = seconds_of([&] {
    auto model = projected_family(setup, setting.options);
    run.projection = *model->projection();
    run.coordinates = model->n_coordinates();
    setting.model = std::move(model);
    run.trace = record_trace(setting);
  });
  return run;
}

/// Largest growth of the resident set while the family is projected and traced; points are not kept, as by a
/// program that writes them.
double peak_of_projection_and_trace(const TraceSetup& setup) {
  return peak_bytes_of([&] {
    const auto model = projected_family(setup, setup.options);
    (void)trace(*model, setup.options, TraceObserver{});
  });
}

/// What the program itself takes: the same work on a model whose own vectors and factors are below 1 MB. The
/// first run loads code.
double peak_of_the_program() {
  const TraceSetup small = large_setup(rotating_plate({10}), 0.0, 2.0, followed, traced_tolerance);
  (void)peak_of_projection_and_trace(small);
  return peak_of_projection_and_trace(small);
}

/// Equally spaced points that a spline through exact, labelled eigenvalues needs for `spline_error`. The
/// exact ones are a trace with a tolerance of a hundredth of that.
int points_of_spline(const TraceSetup& setup) {
  Setting projected;
  projected.options = setup.options;
  projected.options.tolerance = 0.01 * spline_error;
  projected.model = projected_family(setup, projected.options);
  return points_for_spline(record(projected, projected.options), setup.options,
                           parameters_on(setup.options, 400, 0.37), spline_error);
}

/// CPU time of the modes at one point of the grid: the mean of a few points.
double seconds_per_point(const TraceSetup& setup) {
  constexpr int places = 4;
  ModeFinder finder(1e-10);
  const FamilyPencils pencils(family_of(setup));
  return seconds_of([&] {
           for (int i = 0; i < places; ++i) {
             const double p = setup.options.from + (setup.options.to - setup.options.from) * i / (places - 1);
             ModeRequest request{{}, followed};
             request.only_right = true;  // they are enough for a grid
             (void)finder.find(pencils.at(at(p)), request);
           }
         }) /
         places;
}

/// Largest relative error at random places, by shift-invert at each of them: up to 10 000 freedoms by solvers
/// that know nothing of the library, beyond by its own, to 1e-12.
double error(const TraceSetup& setup, const RecordedTrace& trace, int places) {
  constexpr Eigen::Index largest_independent = 10000;
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> random(setup.options.from, setup.options.to);
  const bool independent = setup.model->n_coordinates() <= largest_independent;
  ModeFinder finder(1e-12);
  const FamilyPencils pencils(family_of(setup));
  double worst = 0.0;
  for (int i = 0; i < places; ++i) {
    const double p = random(engine);
    const AffinePencil<SparseMatrix> pencil = family_of(setup).at(at(p));
    const auto found = independent ? std::nullopt : finder.find(pencils.at(at(p)), {{}, followed + 2});
    for (const Complex s : trace.eigenvalues_at(p)) {
      if (std::isnan(s.real())) continue;
      const double distance =
          independent ? std::abs(s - eigenvalues_near(pencil, s * Complex(1.0 + 1e-5, 1e-5), 1).front())
                      : (found->s.array() - s).abs().minCoeff();
      worst = std::max(worst, distance / std::abs(s));
    }
  }
  return worst;
}

/// Calls `what` with one factorization of the shifted pencil in the middle of the range, alone.
template <class What>
double of_one_factorization(const TraceSetup& setup, What&& what) {
  const double middle = 0.5 * (setup.options.from + setup.options.to);
  const ShiftedMatrix shifted = shifted_matrix(FamilyPencils(family_of(setup)).at(at(middle)), {});
  return what([&shifted] {
    SparseFactors factors;
    (void)factors.factor(shifted.matrix, shifted.kind);
  });
}

/// Peak memory, bytes.
struct Peaks {
  double program = 0.0;        ///< of a model of 200 freedoms
  double run = 0.0;            ///< of projection and trace
  double factorization = 0.0;  ///< of one factorization, with the work space of the library

  explicit Peaks(const TraceSetup& setup)
      : program(peak_of_the_program()),
        run(peak_of_projection_and_trace(setup)),
        factorization(of_one_factorization(setup, [](auto factor) { return peak_bytes_of(factor); })) {}
};

/// What is measured at the sizes of a kind of models.
struct Sizes {
  std::vector<double> freedoms, seconds, factorizations;
};

void add_growth(const std::string& what, const Sizes& sizes, Figures& figures) {
  figures.push_back({"exponent of time over size, " + what, exponent(sizes.freedoms, sizes.seconds),
                     at_most(exponent(sizes.freedoms, sizes.factorizations)),
                     "that of one factorization is the target"});
}

/// `points`: of the spline.
void measure(const TraceSetup& setup, const std::string& what, int points, const Peaks& peaks, Sizes& sizes,
             Figures& figures) {
  const Run run = project_and_trace(setup);
  const double per_point = seconds_per_point(setup);
  const double one = of_one_factorization(setup, [](auto factor) { return seconds_of(factor); });
  const ProjectionEstimate estimate = estimate_projection(family_of(setup), setup.options);
  const double vectors = estimate.total_bytes - estimate.factor_bytes;
  const Eigen::Index n = setup.model->n_coordinates();
  const std::string size = ", " + what + ", " + std::to_string(n) + " freedoms";
  const auto megabytes = [](double bytes) { return short_text(1e-6 * bytes) + " MB"; };
  const std::string account =
      time_text(run.seconds) + ", of which the trace " + time_text(run.trace.result.seconds) + " with " +
      std::to_string(run.coordinates) + " coordinates and " + std::to_string(run.trace.result.nodes) +
      " points; " + std::to_string(run.projection.solutions) + " solutions by " + run.projection.method +
      ", " + megabytes(static_cast<double>(run.projection.peak_bytes)) + "; a point of the grid " +
      time_text(per_point) + "; a factorization " + time_text(one);
  const std::string memory = "peak " + megabytes(peaks.run) + ", of a model of 200 freedoms " +
                             megabytes(peaks.program) + ", a factorization alone " +
                             megabytes(peaks.factorization) + ", matrices and vectors " + megabytes(vectors);
  std::fprintf(stderr, "%s: %s; %s\n", size.c_str() + 2, account.c_str(), memory.c_str());
  figures.push_back({"sparse factorizations" + size, static_cast<double>(run.projection.factorizations),
                     at_most(12), account});
  const auto from_two_thousand = [n](double limit) {
    return n >= 1800 ? std::optional(at_least(limit)) : std::nullopt;
  };
  figures.push_back({"shift-invert at the points of a spline / trace, time" + size,
                     points * per_point / run.seconds, from_two_thousand(20.0),
                     std::to_string(points) + " points for 1e-8"});
  figures.push_back({"shift-invert at 101 points / trace, time" + size, 101 * per_point / run.seconds,
                     from_two_thousand(5.0)});
  const double allowed = 1.5 * peaks.factorization + vectors;
  figures.push_back(
      {"peak memory beyond that of a model of 200 freedoms / (1.5 factorizations + matrices and "
       "vectors)" +
           size,
       (peaks.run - peaks.program) / allowed, at_most(1.0), memory});
  figures.push_back({"error / tolerance at 20 random places" + size,
                     error(setup, run.trace, 20) / traced_tolerance, at_most(1.0)});
  sizes.freedoms.push_back(static_cast<double>(n));
  sizes.seconds.push_back(run.seconds);
  sizes.factorizations.push_back(one);
}

TraceSetup plate(int cells) {
  return large_setup(rotating_plate({cells}), 0.0, 2.0, followed, traced_tolerance);
}

/// The rotor of a generator with two poles, up to a third of its first critical speed.
TraceSetup shaft(int length) {
  SolidShaft one;
  one.length = length;
  one.width = length / 20;
  one.disc_width = 3 * one.width;
  one.cell = 0.4 / length;
  one.flatness = 0.95;
  one.discs = {length / 4, 2 * length / 3};
  return large_setup(solid_shaft(one), 0.0, 700.0, followed, traced_tolerance);
}

/// A medium that flows through the plate turns left vectors away from right ones.
TraceSetup circulatory_plate(int cells) {
  RotatingPlate plate;
  plate.cells = cells;
  plate.convection = 10.0;
  return large_setup(rotating_plate(plate), 0.0, 2.0, followed, traced_tolerance);
}

/// Largest relative distance, at places between samples, of the followed eigenvalues of a projection with
/// four samples from exact ones.
double error_with_few_samples(const TraceSetup& setup, bool left_vectors) {
  ProjectionOptions options;
  options.first_samples = 3;
  options.max_factorizations = 4;  // and one more
  options.left_vectors = left_vectors;
  TraceOptions tight = setup.options;
  tight.tolerance = 1e-9;  // neither is done with five samples
  const auto model = projected_family(setup, tight, options);
  const FamilyPencils pencils(family_of(setup));
  ModeFinder finder(1e-13);
  double worst = 0.0;
  for (const double p : {0.3, 0.7, 1.2, 1.7}) {
    const AffinePencil<Matrix> small = model->at(at(p));
    const Spectrum spectrum =
        compute_eigenvalues(small.M.front().matrix, small.C.front().matrix, small.K.front().matrix);
    const auto exact = finder.find(pencils.at(at(p)), {{}, followed + 2});
    for (std::size_t i = 0; i < followed; ++i) {
      const Complex s = spectrum.modes[i].s;
      worst = std::max(worst, (exact->s.array() - s).abs().minCoeff() / std::abs(s));
    }
  }
  return worst;
}

void measure_left_vectors(const TraceSetup& setup, Figures& figures) {
  const double both = error_with_few_samples(setup, true), right = error_with_few_samples(setup, false);
  figures.push_back({"error with right vectors only / with left ones, circulatory plate, " +
                         std::to_string(setup.model->n_coordinates()) + " freedoms",
                     right / both, at_least(10.0),
                     short_text(right) + " and " + short_text(both) + " with 5 samples"});
}

/// A model of any size.
using MakeModel = TraceSetup (*)(int);

/// Models of one kind at several sizes, whose memory is measured at once: recorded traces leave a heap in
/// which the same work touches up to twice as many pages.
class Kind {
 public:
  Kind(std::string what, MakeModel make, const std::vector<int>& sizes)
      : what_(std::move(what)), make_(make), sizes_(sizes) {
    for (const int size : sizes_) peaks_.emplace_back(make_(size));
  }

  /// `points`: of the spline.
  void measure(int points, Figures& figures) const {
    Sizes measured;
    for (std::size_t i = 0; i < sizes_.size(); ++i)
      test::measure(make_(sizes_[i]), what_, points, peaks_[i], measured, figures);
    if (sizes_.size() > 1) add_growth(what_, measured, figures);
  }

 private:
  std::string what_;
  MakeModel make_;
  std::vector<int> sizes_;
  std::vector<Peaks> peaks_;
};

}  // namespace

// The loci hardly change with the size: the points of the splines are counted on the smallest models.

Figures large_models(const BenchOptions& options) {
  Figures figures;
  if (options.smoke) {
    Kind("plate", plate, {10}).measure(points_of_spline(plate(10)), figures);
    Kind("circulatory plate", circulatory_plate, {10}).measure(500, figures);
    measure_left_vectors(circulatory_plate(10), figures);
    return figures;
  }
  const std::vector<int> cells{16, 32, 50, 100};
  const Kind plates("plate", plate, cells);
  const Kind circulatory("circulatory plate", circulatory_plate, cells);
  const Kind shafts("solid shaft", shaft, {20, 48, 60, 120});
  plates.measure(points_of_spline(plate(16)), figures);
  circulatory.measure(points_of_spline(circulatory_plate(16)), figures);
  for (const int size : cells) measure_left_vectors(circulatory_plate(size), figures);
  shafts.measure(points_of_spline(shaft(20)), figures);
  return figures;
}

Figures largest_models(const BenchOptions& options) {
  Figures figures;
  if (options.smoke) return figures;
  const Kind plates("plate", plate, {224});
  const Kind shafts("solid shaft", shaft, {220});
  plates.measure(points_of_spline(plate(16)), figures);
  shafts.measure(points_of_spline(shaft(20)), figures);
  return figures;
}

}  // namespace eigentrail::test
