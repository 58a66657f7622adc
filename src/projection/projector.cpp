#include "eigentrail/projection/project.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/core/text.hpp"
#include "projection/large_model.hpp"
#include "projection/newcomers.hpp"
#include "projection/projection_error.hpp"
#include "projection/projection_space.hpp"

namespace eigentrail {
namespace {

/// Vectors are kept to this share of the square root of the target. What is left out of right and left
/// vectors together is then below a tenth of the target; measured, a hundredth. With 0.02 a projection has a
/// quarter more coordinates, and all that is done with it takes twice as long; with 1, what is left out is
/// most of the error.
constexpr double share_of_vectors = 0.1;

/// Accuracy of the exact eigenvalues, as a share of the error that they are to show.
constexpr double accuracy_of_samples = 0.01;

/// Accuracy of vectors that are only put into the space, as a share of that to which they are kept.
constexpr double accuracy_of_added_vectors = 0.1;

/// Tolerance of the traces that only look for the worst place.
constexpr double scout_tolerance = 1e-3;

/// Such a trace has at least this many steps, so that places between the samples are seen.
constexpr int scout_steps = 16;

std::string digits(double value, int count) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", count, value);
  return text.data();
}

/// The mode with the largest indicator of all places.
struct Worst {
  const ProjectedPlace* place = nullptr;
  double indicator = 0.0;  ///< relative to max(|s|, reference)
};

class Projector {
 public:
  Projector(LargeModel& large, const TraceOptions& trace, const std::vector<ParameterValues>& lines,
            const ProjectionOptions& options)
      : large_(large),
        trace_(trace),
        lines_(lines),
        options_(options),
        space_(large.model().n_coordinates()),
        target_(options.share_of_tolerance * trace.tolerance),
        finder_(std::clamp(accuracy_of_samples * target_, 1e-13, 1e-9), options.solver) {
    if (lines_.empty()) lines_.push_back(trace.values);
    check_choice();
  }

  std::unique_ptr<Model> along_the_lines() {
    first_samples(lines_.front());
    if (lines_.size() > 1) first_samples(lines_.back());
    std::vector<ProjectedPlace> places;
    while (true) {
      const std::unique_ptr<Model> model = reduced();
      const Worst worst = look_for_worst(*model, places);
      if (projection_.factorizations > options_.max_factorizations)
        return give_up(worst, worst.indicator * factor_,
                       "after " + std::to_string(projection_.factorizations) + " factorizations");
      // Exact eigenvalues at the worst place show the true error of the space as it was.
      const double error = error_at(*worst.place);
      traces_hold_ = error <= scout_tolerance;
      if (worst.indicator > 0.0 && error > rounding_of_samples)
        factor_ = std::max(factor_, error / worst.indicator);
      projection_.error = std::max(error, factor_ * worst.indicator);
      projection_.error_at = worst.place->at.p;
      const Worst left = worst_of_visited(places);
      visits_.back().error = error;
      const bool stuck = left.indicator > target_;
      if (!stuck && (error > target_ || projection_.error > safety * target_)) continue;
      if (lines_.size() == 1) note_newcomers(*model, places);
      if (!stuck) return reduced();
      return give_up(left, left.indicator,
                     "also with the vectors of that place, probably by rounding of the large matrices");
    }
  }

  /// The space of the modes at single values of the parameter: there the eigenvalues are exact.
  std::unique_ptr<Model> at(const std::vector<double>& values) {
    for (const double p : values) {
      const auto place = large_.place_at(p, parameters_at(p, lines_.front()));
      if (place) add(find_chosen(large_.pencil(*place)), p);
    }
    return reduced();
  }

 private:
  /// The indicator's factor differs from place to place by about this: so much larger than the target the
  /// error may be at places whose exact eigenvalues were not computed. The target leaves room for it.
  static constexpr double safety = 30.0;

  /// Errors of the exact eigenvalues themselves: below this nothing is known of the projection.
  static constexpr double rounding_of_samples = 1e-11;

  void check_choice() const {
    if (trace_.modes.count || trace_.modes.band) return;
    throw InputError("a large model with " + std::to_string(large_.model().n_coordinates()) +
                     (large_.model().n_constraints() > 0 ? " coordinates" : " freedoms") +
                     ", of which all modes are asked for: follow some of them, with modes = 6 or modes = "
                     "{ band = [\"0 Hz\", \"50 Hz\"] } in [trace], or --modes 6");
  }

  Vector parameters_at(double p, const ParameterValues& line) const {
    const Parameters& parameters = large_.model().description().parameters;
    Vector values = parameters.declared_values();
    for (const auto& [name, value] : line) values[parameters.index(name).value()] = value;
    values[parameters.index(trace_.parameter).value()] = p;
    return values;
  }

  NearestModes find(const SparsePencil& pencil, ModeRequest request, double p) {
    const int most = static_cast<int>(pencil.freedoms()) - 2;
    for (const int more : {0, 6, 20}) {
      request.count = std::min(request.count + more, most);
      request.most = std::min(request.most, most);
      auto modes = finder_.find(pencil, request);
      projection_.factorizations = finder_.factorizations();
      if (modes) return *modes;
    }
    throw NotProjected("the modes of the large model at " + trace_.parameter + " = " + exact_text(p) +
                       " were not found: shift-invert iterations do not converge. Is the pencil singular "
                       "(a freedom without mass and stiffness)?");
  }

  /// As many modes as contain the chosen ones, and spare ones; at the start of the trace.
  NearestModes find_chosen(const SparsePencil& pencil, std::optional<double> tolerance = std::nullopt) {
    count_ = trace_.modes.count.value_or(8) + options_.spare_modes;
    while (true) {
      NearestModes modes = find(pencil, {usual_shift(trace_.modes), count_, 0.0, 0, tolerance}, trace_.from);
      const int missing = missing_modes(modes, usual_shift(trace_.modes));
      if (missing == 0 || count_ >= static_cast<int>(pencil.freedoms()) / 2) return modes;
      count_ += missing;
    }
  }

  /// How many modes more are to be looked for, so that all chosen ones are there.
  int missing_modes(const NearestModes& modes, const Shift& shift) const {
    const ModeChoice& choice = trace_.modes;
    const double largest = modes.s.cwiseAbs().maxCoeff();
    int wanted = 0;
    for (const Complex s : modes.s) wanted += std::abs(s) > rigid * largest && choice.wants(s) ? 1 : 0;
    if (choice.count) return std::max(0, *choice.count + options_.spare_modes - wanted);
    const double edge =
        std::max(choice.band->highest - shift.frequency, shift.frequency - choice.band->lowest);
    return modes.radius < edge ? count_ : 0;
  }

  void add(const NearestModes& modes, double p) {
    frequency_ = std::max(frequency_, modes.s.cwiseAbs().maxCoeff());
    space_.add(large_.for_space(modes.right));
    if (options_.left_vectors && modes.left.cols() > 0) space_.add(large_.for_space(modes.left));
    projection_.sampled_at.push_back(p);
  }

  void first_samples(const ParameterValues& line) {
    const int n = options_.first_samples;
    // Their vectors are needed, not their eigenvalues.
    const double tolerance = accuracy_of_added_vectors * accuracy_of_vectors();
    for (int i = 0; i < n; ++i) {
      // Chebyshev places with the ends: dense where interpolation is worst.
      const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * i / (n - 1));
      const double p = i == n - 1 ? trace_.to : trace_.from + share * (trace_.to - trace_.from);
      const auto place = large_.place_at(p, parameters_at(p, line));
      if (!place) return;  // the path turns back: the trace will show where
      const SparsePencil pencil = large_.pencil(*place);
      add(count_ == 0 ? find_chosen(pencil, tolerance)
                      : find(pencil, {usual_shift(trace_.modes), count_, 0.0, 0, tolerance}, p),
          p);
    }
  }

  /// The model on the space of the vectors, without what these need less than the target.
  std::unique_ptr<Model> reduced() {
    projection_.solutions = finder_.solutions();
    projection_.peak_bytes = finder_.peak_bytes();
    projection_.method = finder_.method();
    projection_.target = target_;
    const Vector middle = parameters_at(0.5 * (trace_.from + trace_.to), lines_.front());
    return large_.reduced(space_, accuracy_of_vectors(), middle, frequency_, projection_);
  }

  /// Relative accuracy of the vectors in the space, right and left: their product is the target.
  double accuracy_of_vectors() const { return share_of_vectors * std::sqrt(target_); }

  /// The place with the largest indicator on all lines. Rough traces find the places and their modes. While
  /// the space changes eigenvalues by less than these traces are accurate to, the modes at the same places
  /// are corrected instead.
  Worst look_for_worst(const Model& model, std::vector<ProjectedPlace>& places) {
    if (traces_hold_) {
      for (ProjectedPlace& place : places) place.is_old = true;
      if (const auto worst = find_worst(model, places)) return *worst;
    }
    places.clear();
    for (const ParameterValues& line : lines_) scout(model, line, places);
    return find_worst(model, places).value();
  }

  /// A rough trace of the projected model along a line; its points are added to `places`.
  void scout(const Model& model, const ParameterValues& line, std::vector<ProjectedPlace>& places) {
    TraceOptions options = trace_;
    options.values = line;
    options.tolerance = std::max(trace_.tolerance, scout_tolerance);
    options.certify = false;
    options.events = {};
    options.events.extrema = false;
    options.events.veerings = false;
    options.order.reset();
    options.max_step = std::abs(trace_.to - trace_.from) / scout_steps;
    TraceObserver observer;
    observer.started = [this](const TraceStart& start) { reference_ = start.s_ref; };
    observer.point = [&](const TracePoint& point) {
      const Path& path = point.node.path;
      ProjectedPlace& place = places.emplace_back(
          ProjectedPlace{{point.node.p, path.parameters.col(0), path.x.col(0), path.lambda.col(0)},
                         large_.small(model, point),
                         {},
                         false});
      for (const ModeState& mode : point.modes) {
        const ComplexVector shape =
            mode.shape.size() > 0 ? large_.coordinates(point, mode.shape) : ComplexVector();
        place.modes.push_back(refined_mode(place.small, mode.s, shape).mode);
      }
      return true;
    };
    const TraceResult result = trace(model, options, observer);
    if (places.empty()) throw NotProjected("the projected model cannot be traced: " + result.message);
  }

  /// Largest finite magnitude.
  static double largest_of(const std::vector<ProjectedMode>& modes) {
    double largest = 0.0;
    for (const ProjectedMode& mode : modes) {
      if (std::isfinite(std::abs(mode.s))) largest = std::max(largest, std::abs(mode.s));
    }
    return largest;
  }

  /// Without infinite eigenvalues and rigid-body motions: zeros are known to the root of rounding only.
  static std::vector<ProjectedMode> moving_modes(const ProjectedPlace& place) {
    std::vector<ProjectedMode> modes = place.modes;
    std::erase_if(modes, [largest = largest_of(modes)](const ProjectedMode& mode) {
      return !std::isfinite(std::abs(mode.s)) || std::abs(mode.s) <= rigid * largest;
    });
    return modes;
  }

  double size(Complex s) const { return std::max(std::abs(s), reference_); }

  /// Empty if the modes of an old place are not found again. Every second place is looked at first: where one
  /// of them needs vectors its neighbours are enough.
  std::optional<Worst> find_worst(const Model& model, std::vector<ProjectedPlace>& places) const {
    Worst worst{&places.front(), -1.0};
    const auto look_at = [&](std::size_t i) {
      const std::optional<double> indicator = indicator_at(model, places[i]);
      if (indicator && *indicator > worst.indicator) worst = {&places[i], *indicator};
      return indicator.has_value();
    };
    for (std::size_t i = 0; i < places.size(); i += 2) {
      if (!look_at(i)) return std::nullopt;
    }
    const bool is_enough = worst.indicator * factor_ > safety * target_;
    const std::size_t middle = static_cast<std::size_t>(worst.place - places.data());
    for (std::size_t i = 1; i < places.size(); i += 2) {
      const bool is_beside = i + 1 == middle || i == middle + 1;
      if ((is_beside || !is_enough) && !look_at(i)) return std::nullopt;
    }
    return worst;
  }

  /// The largest indicator of the modes at a place, which are corrected if they are of another space. Empty
  /// if they are not found.
  std::optional<double> indicator_at(const Model& model, ProjectedPlace& place) const {
    const SparsePencil pencil = large_.pencil(place.at);
    const auto basis = large_.basis(model, pencil);
    if (!basis) return place.is_old ? std::nullopt : std::optional(0.0);
    if (place.is_old && !renew(place, large_.small(model, place.at, pencil, *basis))) return std::nullopt;
    std::vector<ProjectedMode> modes = moving_modes(place);
    for (ProjectedMode& mode : modes) mode = lifted(mode, *basis);
    const std::vector<EigenvalueError> errors = eigenvalue_errors(pencil, modes);
    double largest = 0.0;
    for (std::size_t i = 0; i < modes.size(); ++i)
      largest = std::max(largest, errors[i].relative_to(size(modes[i].s)));
    return largest;
  }

  /// Replaces the modes of a place by those of another space. False if one is not found there.
  static bool renew(ProjectedPlace& place, SmallPencil small) {
    place.small = std::move(small);
    const double largest = largest_of(place.modes);
    for (ProjectedMode& mode : place.modes) {
      if (std::abs(mode.s) <= rigid * largest) continue;  // nobody uses its vectors
      RefinedMode refined = refined_mode(place.small, mode.s, {});
      if (!refined.is_settled) return false;
      mode = std::move(refined.mode);
    }
    place.is_old = false;
    return true;
  }

  /// Largest distance of the modes at a place from exact eigenvalues of the large pencil, relative to their
  /// size; the vectors of these are added to the space.
  double error_at(const ProjectedPlace& place) {
    const SparsePencil pencil = large_.pencil(place.at);
    const Complex centre = usual_shift(trace_.modes).value();
    const std::vector<ProjectedMode> modes = moving_modes(place);
    std::vector<Complex> followed;
    double farthest = 0.0;
    for (const ProjectedMode& mode : modes) {
      followed.push_back(mode.s);
      farthest = std::max(farthest, std::abs(mode.s - centre));
    }
    // More modes cost less than a second shift with its factorization.
    const NearestModes exact =
        find(pencil, {usual_shift(trace_.modes), count_, 1.01 * farthest, 3 * count_ / 2}, place.at.p);
    add(exact, place.at.p);
    std::vector<Complex> known(exact.s.begin(), exact.s.end());
    for (const Complex s : find_far_ones(pencil, followed, exact.radius, place.at.p)) known.push_back(s);
    visits_.push_back({place.at.parameters, std::move(known), 0.0});
    return distance(place, visits_.back().exact);
  }

  /// Largest distance of the modes at a place from the nearest of some eigenvalues, relative to their size.
  double distance(const ProjectedPlace& place, const std::vector<Complex>& exact) const {
    double largest = 0.0;
    for (const ProjectedMode& mode : moving_modes(place)) {
      EigenvalueError error{std::numeric_limits<double>::infinity()};
      for (const Complex other : exact) error.distance = std::min(error.distance, std::abs(other - mode.s));
      error.half_gap = half_gap(place.small, mode);
      largest = std::max(largest, error.relative_to(size(mode.s)));
    }
    return largest;
  }

  /// Followed modes that have left the neighbourhood of the usual shift are looked for with one of their own.
  ComplexVector find_far_ones(const SparsePencil& pencil, const std::vector<Complex>& followed, double radius,
                              double p) {
    double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
    int count = 0;
    for (const Complex s : followed) {
      if (std::abs(s - usual_shift(trace_.modes).value()) <= radius) continue;
      lowest = std::min(lowest, s.imag());
      highest = std::max(highest, std::abs(s));
      ++count;
    }
    if (count == 0) return {};
    const double middle = 0.5 * (lowest + highest);
    const double cover = 1.01 * std::max(highest - middle, 1e-3 * highest);
    const int most = 3 * (count + options_.spare_modes);
    const NearestModes modes = find(pencil, {{0.0, middle}, count + options_.spare_modes, cover, most}, p);
    add(modes, p);
    return modes.s;
  }

  void note_newcomers(const Model& model, const std::vector<ProjectedPlace>& places) {
    const Newcomers found = find_newcomers(large_, model, places, usual_shift(trace_.modes), reference_);
    if (found.count == 0) return;
    const std::string who = found.count == 1
                                ? "a mode that is not followed comes among the followed ones, "
                                : std::to_string(found.count) +
                                      " modes that are not followed come among the followed ones, the first ";
    projection_.notes.push_back(who + "between " + trace_.parameter + " = " + digits(found.from, 5) +
                                " and " + digits(found.to, 5) + ", at " + digits(found.frequency, 4) +
                                " rad/s; to follow more, ask for more modes");
  }

  /// The largest error that the vectors of a place have left there, though they are in the space; those
  /// that they have reduced to less than half are not counted.
  Worst worst_of_visited(const std::vector<ProjectedPlace>& places) const {
    constexpr double same_place = 1e-9;  // of the range: where events are located again
    const double close = same_place * std::abs(trace_.to - trace_.from);
    Worst worst;
    for (const ProjectedPlace& place : places) {
      for (const Visit& visit : visits_) {
        const bool is_there = (visit.parameters - place.at.parameters).cwiseAbs().maxCoeff() <= close;
        if (!is_there || place.is_old || visit.error == 0.0) continue;
        const double error = distance(place, visit.exact);
        if (error > worst.indicator && error > 0.5 * visit.error) worst = {&place, error};
      }
    }
    return worst;
  }

  std::unique_ptr<Model> give_up(const Worst& worst, double error, const std::string& why) {
    projection_.error = error;
    projection_.error_at = worst.place->at.p;
    projection_.notes.push_back("the projection leaves an error of about " + digits(error, 2) + " at " +
                                trace_.parameter + " = " + exact_text(worst.place->at.p) + " " + why +
                                "; asked for were " + digits(target_, 2));
    return reduced();
  }

  LargeModel& large_;
  const TraceOptions& trace_;
  std::vector<ParameterValues> lines_;
  const ProjectionOptions& options_;
  ProjectionSpace space_;
  double target_;  ///< error of the eigenvalues by the projection, relative to their size
  ModeFinder finder_;
  Projection projection_;
  double frequency_ = 0.0;    ///< largest |s| that was found
  double reference_ = 0.0;    ///< of the scout's eigenvalues
  double factor_ = 1.0;       ///< error over indicator, the largest that was seen
  bool traces_hold_ = false;  ///< the last rough traces are as accurate in the space as it is now
  /// A place where exact eigenvalues were computed, and what the error was before their vectors were added; 0
  /// until they are part of the model.
  struct Visit {
    Vector parameters;
    std::vector<Complex> exact;
    double error = 0.0;
  };
  std::vector<Visit> visits_;
  int count_ = 0;  ///< modes that are looked for at a place
};

std::unique_ptr<ProjectedFamily> as_family(std::unique_ptr<Model> model) {
  return std::unique_ptr<ProjectedFamily>(dynamic_cast<ProjectedFamily*>(model.release()));
}

}  // namespace

Shift usual_shift(const ModeChoice& choice) {
  if (choice.near) return {0.0, *choice.near};
  if (choice.band && choice.band->lowest > 0.0)
    return {0.0, 0.5 * (choice.band->lowest + choice.band->highest)};
  return {};
}

std::unique_ptr<ProjectedFamily> project(const SparseFamily& family, const TraceOptions& trace,
                                         const std::vector<ParameterValues>& lines,
                                         const ProjectionOptions& options) {
  return as_family(Projector(*large_model_of(family), trace, lines, options).along_the_lines());
}

std::unique_ptr<ProjectedFamily> project_at(const SparseFamily& family, const TraceOptions& trace,
                                            const std::vector<double>& values,
                                            const ProjectionOptions& options) {
  return as_family(Projector(*large_model_of(family), trace, {}, options).at(values));
}

std::unique_ptr<Model> project(std::shared_ptr<const Model> scene, const TraceOptions& trace,
                               const std::vector<ParameterValues>& lines, const ProjectionOptions& options) {
  return Projector(*large_model_of(std::move(scene), trace), trace, lines, options).along_the_lines();
}

std::unique_ptr<Model> project_at(std::shared_ptr<const Model> scene, const TraceOptions& trace,
                                  const std::vector<double>& values, const ProjectionOptions& options) {
  return Projector(*large_model_of(std::move(scene), trace), trace, {}, options).at(values);
}

}  // namespace eigentrail
