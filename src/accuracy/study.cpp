#include "eigentrail/accuracy/study.hpp"

#include <algorithm>
#include <iterator>

#include "core/archive.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {
namespace {

constexpr Method grid_methods[] = {Method::qz, Method::zero_order, Method::secant, Method::tangent};

/// Restores the options of a trace at the end of its lifetime.
class OptionsGuard {
 public:
  explicit OptionsGuard(TraceOptions& options) : options_(options), kept_(options) {}
  ~OptionsGuard() { options_ = kept_; }
  OptionsGuard(const OptionsGuard&) = delete;
  OptionsGuard& operator=(const OptionsGuard&) = delete;

 private:
  TraceOptions& options_;
  TraceOptions kept_;
};

template <class Values, class Within>
bool all(const Values& values, Within within) {
  return !values.empty() && std::all_of(values.begin(), values.end(), within);
}

}  // namespace

std::string method_name(Method method) {
  switch (method) {
    case Method::trace:
      return "eigentrail";
    case Method::trace_uncertified:
      return "eigentrail, no certificate";
    case Method::qz:
      return "QZ";
    case Method::zero_order:
      return "corrector, zero-order";
    case Method::secant:
      return "corrector, secant";
    default:
      return "corrector, tangent";
  }
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

template <SameAs<ReferenceSample> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [p, passages] = self;
  visit(p, passages);
}

template <SameAs<ReferenceSet> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [samples, unsolved, correction, s_ref] = self;
  visit(samples, unsolved, correction, s_ref);
}

template <SameAs<MeasuredRun> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [method, interpolation, tolerance, order, completed, message, points, error, worst_parameter,
         measured, seconds, factorizations, spectra, evaluations, bytes] = self;
  visit(method, interpolation, tolerance, order, completed, message, points, error, worst_parameter, measured,
        seconds, factorizations, spectra, evaluations, bytes);
}

namespace {

/// Runs that are measured together: one trace, or a grid with both interpolations.
using Measurement = std::function<std::vector<MeasuredRun>(const ReferenceSet&)>;

std::vector<Measurement> measurements(TraceSetup& setup, const StudyOptions& options) {
  std::vector<Measurement> all;
  const auto trace_with = [&](const TraceOptions& changed) {
    all.push_back([&, changed](const ReferenceSet& reference) {
      const OptionsGuard guard(setup.options);
      setup.options = changed;
      return std::vector{measure_trace(setup, reference, options.repeat)};
    });
  };
  TraceOptions changed = setup.options;
  for (const int order : options.orders) {
    for (const double tolerance : options.tolerances) {
      changed.order = order;
      changed.tolerance = tolerance;
      trace_with(changed);
    }
  }
  changed = setup.options;
  for (const bool certify : {true, false}) {
    changed.certify = certify;
    trace_with(changed);
  }
  for (const Method method : grid_methods) {
    for (const int points : options.grids) {
      all.push_back([&, method, points](const ReferenceSet& reference) {
        GridRuns runs = measure_grid(setup, reference, method, points, options.repeat);
        return std::vector{std::move(runs.linear), std::move(runs.spline)};
      });
    }
  }
  return all;
}

}  // namespace

Study accuracy_study(TraceSetup& setup, const StudyOptions& options, Workers& workers,
                     const std::function<void(int, int)>& progress) try {
  Study study;
  const auto reference = [&](std::size_t) {
    return packed(reference_set(setup, sample_parameters(setup.options, options.samples)));
  };
  unpack(workers.compute({"reference", {0}, reference}).front(), study.reference);
  const std::vector<Measurement> all = measurements(setup, options);
  const auto measure = [&](std::size_t i) { return packed(all[i](study.reference)); };
  const auto report = [&](std::size_t done, std::size_t, const std::string&) {
    progress(static_cast<int>(done), static_cast<int>(all.size()));
  };
  for (const std::string& bytes : workers.compute({"measurement", numbers_to(all.size()), measure}, report)) {
    std::vector<MeasuredRun> runs;
    unpack(bytes, runs);
    std::move(runs.begin(), runs.end(), std::back_inserter(study.runs));
  }
  return study;
} catch (const ArchiveError& error) {
  throw InputError(std::string("a measurement is damaged: ") + error.what());
}

Study accuracy_study(TraceSetup& setup, const StudyOptions& options,
                     const std::function<void(int, int)>& progress) {
  Threads one(1);
  return accuracy_study(setup, options, one, progress);
}

}  // namespace eigentrail
