#include "eigentrail/accuracy/study.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/archive.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {
namespace {

constexpr Method grid_methods[] = {Method::qz, Method::zero_order, Method::secant, Method::tangent};

template <class Values, class Within>
bool all(const Values& values, Within within) {
  return !values.empty() && std::all_of(values.begin(), values.end(), within);
}

}  // namespace

std::string method_name(Method method) {
  return std::array{"eigentrail",        "eigentrail, no certificate", "QZ", "corrector, zero-order",
                    "corrector, secant", "corrector, tangent"}
      .at(static_cast<std::size_t>(method));
}

std::string run_name(const MeasuredRun& run) {
  if (!run.interpolation) return method_name(run.method);
  return method_name(run.method) +
         (run.interpolation == Interpolation::linear ? ", linear" : ", cubic spline");
}

std::vector<std::string> find_faults(const StudyOptions& options) {
  std::vector<std::string> faults;
  if (!all(options.tolerances, [](double t) { return t >= 1e-13 && t <= 0.1; }))
    faults.push_back("tolerances: expected numbers from 1e-13 to 0.1");
  if (!all(options.orders, [](int order) { return order >= 1 && order <= 4; }))
    faults.push_back("orders: expected numbers from 1 to 4");
  if (!options.grids.empty() && !all(options.grids, [](int n) { return n >= 5 && n <= 1000000; }))
    faults.push_back("grids: expected numbers from 5 to 1000000");
  if (options.samples < 1 || options.samples > 1000000)
    faults.push_back("samples: expected a number from 1 to 1000000");
  if (options.repeat < 1 || options.repeat > 1000)
    faults.push_back("repeat: expected a number from 1 to 1000");
  return faults;
}

// How results are written to an archive and read from it (core/archive.hpp).

Members<2> archived(const ReferenceSample*);
Members<4> archived(const ReferenceSet*);
Members<15> archived(const MeasuredRun*);

Study accuracy_study(TraceSetup& setup, const StudyOptions& options, Workers& workers,
                     const std::function<void(int, int)>& progress) try {
  const TraceOptions own = setup.options;
  const std::size_t all_runs = options.tolerances.size() * options.orders.size() + 2 +
                               2 * options.grids.size() * std::size(grid_methods);
  Study study;
  const auto reference = [&](std::size_t) {
    return packed(reference_set(setup, sample_parameters(own, options.samples)));
  };
  unpack(workers.compute({"reference", {0}, reference}).front(), study.reference);
  std::size_t number = 0;
  const auto add = [&](const std::function<std::vector<MeasuredRun>()>& measure) {
    const auto piece = [&](std::size_t) { return packed(measure()); };
    std::vector<MeasuredRun> runs;
    unpack(workers.compute({"measurement", {number++}, piece}).front(), runs);
    for (MeasuredRun& run : runs) {
      study.runs.push_back(std::move(run));
      progress(static_cast<int>(study.runs.size()), static_cast<int>(all_runs));
    }
  };
  const auto add_trace = [&] {
    add([&] { return std::vector{measure_trace(setup, study.reference, options.repeat)}; });
  };
  for (const int order : options.orders) {
    for (const double tolerance : options.tolerances) {
      setup.options.order = order;
      setup.options.tolerance = tolerance;
      add_trace();
    }
  }
  setup.options = own;
  for (const bool certify : {true, false}) {
    setup.options.certify = certify;
    add_trace();
  }
  setup.options = own;
  for (const Method method : grid_methods) {
    for (const int points : options.grids) {
      add([&] {
        const GridRuns runs = measure_grid(setup, study.reference, method, points, options.repeat);
        return std::vector{runs.linear, runs.spline};
      });
    }
  }
  return study;
} catch (const ArchiveError& error) {
  throw InputError(std::string("a measurement is damaged: ") + error.what());
}

}  // namespace eigentrail
