// Large sparse families: projection and trace against shift-invert Arnoldi at the points of a grid.
#include <cstdio>
#include <random>

#include "bench/benchmarks.hpp"
#include "bench/spline.hpp"
#include "bench/text.hpp"
#include "bench/timing.hpp"
#include "eigentrail/projection/project.hpp"
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

Run project_and_trace(const TraceSetup& setup, double tight = traced_tolerance) {
  Run run;
  Setting setting;
  setting.scene = setup.scene;
  setting.options = setup.options;
  setting.options.tolerance = tight;
  run.seconds = seconds_of([&] {
    auto model = project(family_of(setup), setting.options);
    run.projection = *model->projection();
    run.coordinates = model->n_coordinates();
    setting.model = std::move(model);
    run.trace = record_trace(setting);
  });
  return run;
}

/// Equally spaced points that a spline through exact, labelled eigenvalues needs for `spline_error`, relative
/// to the eigenvalue. The exact ones are a trace with a tolerance of a hundredth of that.
int points_of_spline(const TraceSetup& setup) {
  const RecordedTrace exact = project_and_trace(setup, 0.01 * spline_error).trace;
  const double from = setup.options.from, length = setup.options.to - from;
  constexpr int probes = 400;
  for (int points = 51; points < 20000; points = points * 5 / 4) {
    ComplexMatrix values(points, followed);
    for (int i = 0; i < points; ++i)
      values.row(i) = exact.eigenvalues_at(from + length * i / (points - 1)).head(followed).transpose();
    const CubicSpline spline(values);
    double worst = 0.0;
    for (int i = 0; i < probes; ++i) {
      const double share = (i + 0.37) / probes;
      const ComplexVector s = exact.eigenvalues_at(from + length * share).head(followed);
      worst = std::max(
          worst, ((spline(share * (points - 1)) - s).cwiseAbs().array() / s.cwiseAbs().array()).maxCoeff());
    }
    if (worst <= spline_error) return points;
  }
  return 20000;
}

/// CPU time of the modes at one point of the grid: the mean of a few points.
double seconds_per_point(const TraceSetup& setup) {
  constexpr int places = 4;
  ModeFinder finder(1e-10);
  const FamilyPencils pencils(family_of(setup));
  return seconds_of([&] {
           for (int i = 0; i < places; ++i) {
             const double p = setup.options.from + (setup.options.to - setup.options.from) * i / (places - 1);
             SparsePencil pencil = pencils.at(at(p));
             pencil.one_sided = true;  // right vectors are enough for a grid
             (void)finder.find(pencil, {{}, followed});
           }
         }) /
         places;
}

/// Largest relative error at random places, by solvers that know nothing of the projection.
double error(const TraceSetup& setup, const RecordedTrace& trace, int places) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> random(setup.options.from, setup.options.to);
  double worst = 0.0;
  for (int i = 0; i < places; ++i) {
    const double p = random(engine);
    const AffinePencil<SparseMatrix> pencil = family_of(setup).at(at(p));
    for (const Complex s : trace.eigenvalues_at(p)) {
      if (std::isnan(s.real())) continue;
      const Complex exact = eigenvalues_near(pencil, s * Complex(1.0 + 1e-5, 1e-5), 1).front();
      worst = std::max(worst, std::abs(s - exact) / std::abs(s));
    }
  }
  return worst;
}

/// `points`: of the spline.
void measure(const TraceSetup& setup, const std::string& what, int points, bool with_error,
             Figures& figures) {
  const Run run = project_and_trace(setup);
  const double per_point = seconds_per_point(setup);
  const std::string size = ", " + what + ", " + std::to_string(setup.model->n_coordinates()) + " freedoms";
  const std::string account =
      time_text(run.seconds) + ", of which the trace " + time_text(run.trace.result.seconds) + " with " +
      std::to_string(run.coordinates) + " coordinates and " + std::to_string(run.trace.result.nodes) +
      " points; " + std::to_string(run.projection.solutions) + " solutions by " + run.projection.method +
      ", " + std::to_string(run.projection.peak_bytes / 1000000) + " MB; a point of the grid " +
      time_text(per_point);
  std::fprintf(stderr, "%s: %s\n", size.c_str() + 2, account.c_str());
  figures.push_back({"sparse factorizations" + size, static_cast<double>(run.projection.factorizations),
                     at_most(12), account});
  figures.push_back({"shift-invert at the points of a spline / trace, time" + size,
                     points * per_point / run.seconds, at_least(20.0),
                     std::to_string(points) + " points for 1e-8"});
  figures.push_back(
      {"shift-invert at 101 points / trace, time" + size, 101 * per_point / run.seconds, at_least(5.0)});
  if (with_error)
    figures.push_back({"error / tolerance at 20 random places" + size,
                       error(setup, run.trace, 20) / traced_tolerance, at_most(1.0)});
}

}  // namespace

Figures large_models(const BenchOptions& options) {
  Figures figures;
  // The loci hardly change with the size: the points of the spline are counted on the smallest model.
  const auto plate = [](int cells) {
    return large_setup(rotating_plate({cells}), 0.0, 2.0, followed, traced_tolerance);
  };
  const int plate_points = options.smoke ? 500 : points_of_spline(plate(16));
  for (const int cells : options.smoke ? std::vector<int>{10} : std::vector<int>{16, 32, 50, 100, 224})
    measure(plate(cells), "plate", plate_points, cells < 100, figures);
  if (options.smoke) return figures;
  const auto shaft = [](int length) {
    SolidShaft one;
    one.length = length;
    one.width = length / 20;
    one.disc_width = 3 * one.width;
    one.cell = 0.4 / length;
    one.discs = {length / 4, 2 * length / 3};
    return large_setup(solid_shaft(one), 0.0, 2000.0, followed, traced_tolerance);
  };
  const int shaft_points = points_of_spline(shaft(20));
  for (const int length : {40, 80, 120})
    measure(shaft(length), "solid shaft", shaft_points, length < 80, figures);
  return figures;
}

}  // namespace eigentrail::test
