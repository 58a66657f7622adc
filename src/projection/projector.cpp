#include "eigentrail/projection/project.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "projection/large_model.hpp"
#include "projection/mode_entries.hpp"
#include "projection/projection_space.hpp"
#include "projection/scouted_places.hpp"

namespace eigentrail {
namespace {

/// Vectors are kept to this share of the square root of the target. What is left out of right and left
/// vectors together is then below a tenth of the target; measured, two hundredths. With 0.02 a projection has
/// a quarter more coordinates, and all that is done with it takes twice as long; with 1, what is left out is
/// most of the error.
constexpr double share_of_vectors = 0.3;

/// Accuracy of the exact eigenvalues, as a share of the error that they are to show.
constexpr double accuracy_of_samples = 0.01;

/// Accuracy of vectors that are only put into the space, as a share of that to which they are kept.
constexpr double accuracy_of_added_vectors = 0.1;

/// Up to this size of the large model a projection on two spaces saves more in one trace than looking at all
/// places once more costs: measured, 0.1 s against 14 us per freedom.
constexpr Eigen::Index largest_on_two_spaces = 8000;

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
        finder_(std::clamp(accuracy_of_samples * target_, 1e-13, 1e-9), options.solver),
        places_(large, trace, lines_) {
    if (lines_.empty()) lines_.push_back(trace.values);
    check_choice();
  }

  std::unique_ptr<Model> along_the_lines() {
    first_samples(lines_.front());
    if (lines_.size() > 1) first_samples(lines_.back());
    bool traces_hold = false;
    while (true) {
      std::unique_ptr<Model> model = reduced();
      const Worst worst = places_.worst(*model, traces_hold, target_ / factor_);
      if (projection_.factorizations > options_.max_factorizations)
        return give_up(std::move(model), worst, worst.indicator * factor_,
                       "after " + std::to_string(projection_.factorizations) + " factorizations");
      // Exact eigenvalues at the worst place show the true error of the space as it is.
      Sample sample = sample_at(*worst.place);
      const double error = places_.distance(*worst.place, sample.exact);
      const Vector parameters = worst.place->at.parameters;
      traces_hold = error <= scout_tolerance;
      if (worst.indicator > 0.0 && error > rounding_of_samples)
        factor_ = std::max(factor_, error / worst.indicator);
      note_error(error, worst);
      bool is_enough = error <= target_ && projection_.error <= safety * target_;
      if (is_enough) {
        note_error(error, places_.worst_of_all(*model));
        is_enough = projection_.error <= safety * target_;
      }
      Worst left = worst_of_visited();
      if (left.indicator > target_) {
        (void)places_.worst_of_all(*model);  // others may be worse
        left = worst_of_visited();
      }
      const bool stuck = left.indicator > target_;
      if (!stuck && !is_enough) {
        add_vectors(sample, *model);
        visits_.push_back({parameters, std::move(sample.exact), error});
        continue;
      }
      if (stuck) {
        if (lines_.size() == 1) note_mode_entries(*model, places_);
        return give_up(std::move(model), left, left.indicator,
                       "also with the vectors of that place, probably by rounding of the large matrices");
      }
      if (!is_complete(sample)) {
        visits_.push_back({parameters, std::move(sample.exact), error});
        return settled(smallest(std::move(model)));
      }
      if (lines_.size() == 1) note_mode_entries(*model, places_);
      // Vectors that are at hand are not thrown away; left ones are not looked for only to be safer.
      add_vectors(sample, *model);
      model.reset();
      return settled(reduced());
    }
  }

  /// The space of the modes at single values of the parameter: there the eigenvalues are exact.
  std::unique_ptr<Model> at(const std::vector<double>& values) {
    for (const double p : values) {
      const auto place = large_.place_at(p, parameters_on(lines_.front(), p));
      if (place) add(find_chosen(large_.pencil(*place)), p);
    }
    return settled(reduced());
  }

 private:
  /// The indicator's factor differs from place to place by about this: so much larger than the target the
  /// error may be at places whose exact eigenvalues were not computed. The target leaves room for it.
  static constexpr double safety = 30.0;

  /// Errors of the exact eigenvalues themselves: below this nothing is known of the projection.
  static constexpr double rounding_of_samples = 1e-11;

  void check_choice() const {
    if (trace_.modes.count || trace_.modes.band) return;
    refuse_all_modes(large_.model());
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
    const bool has_left = options_.left_vectors && modes.left.cols() > 0;
    space_.add(large_.for_space(modes.right), has_left ? Side::right : Side::both);
    if (has_left) space_.add(large_.for_space(modes.left), Side::left);
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
      const auto place = large_.place_at(p, parameters_on(line, p));
      if (!place) return;  // the path turns back: the trace will show where
      const SparsePencil pencil = large_.pencil(*place);
      add(count_ == 0 ? find_chosen(pencil, tolerance)
                      : find(pencil, {usual_shift(trace_.modes), count_, 0.0, 0, tolerance}, p),
          p);
    }
  }

  /// The model on the space of the vectors, without what these need less than the target.
  std::unique_ptr<Model> reduced() {
    return large_.reduced(space_, accuracy_of_vectors(), middle(), frequency_);
  }

  Vector parameters_on(const ParameterValues& line, double p) const {
    return parameters_at(large_.model(), trace_, line, p);
  }
  Vector middle() const { return parameters_on(lines_.front(), 0.5 * (trace_.from + trace_.to)); }

  std::unique_ptr<Model> settled(std::unique_ptr<Model> model) {
    projection_.factorizations = finder_.factorizations();
    projection_.solutions = finder_.solutions();
    projection_.peak_bytes = finder_.peak_bytes();
    projection_.method = finder_.method();
    projection_.target = target_;
    dynamic_cast<Projected&>(*model).settle(std::move(projection_));
    return model;
  }

  /// Relative accuracy of the vectors in the space, right and left: their product is the target.
  double accuracy_of_vectors() const { return share_of_vectors * std::sqrt(target_); }

  /// Exact eigenvalues at a place, and the modes near one shift or two.
  struct Sample {
    std::vector<Complex> exact;
    SparsePencil pencil;
    double p = 0.0;
    std::vector<NearestModes> modes;  ///< those near the usual shift, at first without left vectors
  };

  static bool is_complete(const Sample& sample) {
    return sample.pencil.one_sided || sample.modes.front().left.cols() > 0;
  }

  Sample sample_at(const ProjectedPlace& place) {
    const Complex centre = usual_shift(trace_.modes).value();
    std::vector<Complex> followed;
    double farthest = 0.0;
    for (const ProjectedMode& mode : ScoutedPlaces::moving_modes(place)) {
      followed.push_back(mode.s);
      farthest = std::max(farthest, std::abs(mode.s - centre));
    }
    Sample sample{{}, large_.pencil(place.at), place.at.p, {}};
    // More modes cost less than a second shift with its factorization.
    ModeRequest request{usual_shift(trace_.modes), count_, 1.01 * farthest, 3 * count_ / 2, std::nullopt};
    request.only_right = true;
    sample.modes.push_back(find(sample.pencil, request, sample.p));
    const double radius = sample.modes.front().radius;
    std::erase_if(followed, [&](Complex s) { return std::abs(s - centre) <= radius; });
    if (!followed.empty()) {
      complete(sample);  // while its factors are at hand
      sample.modes.push_back(find_far_ones(sample.pencil, followed, sample.p));
    }
    for (const NearestModes& modes : sample.modes)
      sample.exact.insert(sample.exact.end(), modes.s.begin(), modes.s.end());
    return sample;
  }

  /// Finds left vectors that are missing. They need only the accuracy of vectors.
  void complete(Sample& sample) {
    if (is_complete(sample)) return;
    NearestModes& modes = sample.modes.front();
    if (!finder_.add_left(sample.pencil, accuracy_of_added_vectors * accuracy_of_vectors(), modes))
      modes = find(sample.pencil, {usual_shift(trace_.modes), count_}, sample.p);
  }

  /// Adds the vectors of a sample to the space, which it takes back from the model.
  void add_vectors(Sample& sample, Model& model) {
    complete(sample);
    space_.take_basis(dynamic_cast<Projected&>(model).take_basis());
    for (const NearestModes& modes : sample.modes) add(modes, sample.p);
  }

  /// Followed modes that have left the neighbourhood of the usual shift are looked for with one of their own.
  NearestModes find_far_ones(const SparsePencil& pencil, const std::vector<Complex>& far, double p) {
    double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
    for (const Complex s : far) {
      lowest = std::min(lowest, s.imag());
      highest = std::max(highest, std::abs(s));
    }
    const double middle = 0.5 * (lowest + highest);
    const double cover = 1.01 * std::max(highest - middle, 1e-3 * highest);
    const int count = static_cast<int>(far.size()) + options_.spare_modes;
    return find(pencil, {{0.0, middle}, count, cover, 3 * count}, p);
  }

  /// The error of the projection, from the true one at a place and an indicator.
  void note_error(double error, const Worst& worst) {
    projection_.error = std::max(error, factor_ * worst.indicator);
    projection_.error_at = worst.place->at.p;
  }

  void note_mode_entries(const Model& model, const ScoutedPlaces& places) {
    const ModeEntries found =
        find_mode_entries(large_, model, places.all(), usual_shift(trace_.modes), places.reference());
    if (found.count == 0) return;
    const std::string who = found.count == 1
                                ? "a mode that is not followed comes among the followed ones, "
                                : std::to_string(found.count) +
                                      " modes that are not followed come among the followed ones, the first ";
    projection_.notes.push_back(who + "between " + trace_.parameter + " = " + short_text(found.from, 5) +
                                " and " + short_text(found.to, 5) + ", at " + short_text(found.frequency, 4) +
                                " rad/s; to follow more, ask for more modes");
  }

  /// A place where exact eigenvalues were computed, and what the error was before their vectors were added.
  struct Visit {
    Vector parameters;
    std::vector<Complex> exact;
    double error = 0.0;
  };

  /// The place of a visit among others; null if it is not there, or if its modes are of another space.
  const ProjectedPlace* place_of(const Visit& visit, const ScoutedPlaces& places) const {
    constexpr double same_place = 1e-9;  // of the range: where events are located again
    const double close = same_place * std::abs(trace_.to - trace_.from);
    for (const ProjectedPlace& place : places.all()) {
      if (!place.is_old && (visit.parameters - place.at.parameters).cwiseAbs().maxCoeff() <= close)
        return &place;
    }
    return nullptr;
  }

  /// The largest error that the vectors of a place have left there, though they are in the space; those
  /// that they have reduced to less than half are not counted.
  Worst worst_of_visited() const {
    Worst worst;
    for (const Visit& visit : visits_) {
      const ProjectedPlace* place = place_of(visit, places_);
      if (place == nullptr) continue;
      const double error = places_.distance(*place, visit.exact);
      if (error > worst.indicator && error > 0.5 * visit.error) worst = {place, error};
    }
    return worst;
  }

  /// A model that is accurate enough, or one on two spaces if that is so as well where exact eigenvalues are
  /// known, and by the indicator everywhere.
  std::unique_ptr<Model> smallest(std::unique_ptr<Model> model) {
    ScoutedPlaces places(places_);
    std::unique_ptr<Model> smaller;
    if (large_.model().n_coordinates() <= largest_on_two_spaces)
      smaller = large_.on_two_spaces(*model, space_, accuracy_of_vectors(), middle(), frequency_);
    const bool is_enough = smaller && holds(*smaller, places);
    if (is_enough) model = std::move(smaller);
    if (lines_.size() == 1) note_mode_entries(*model, is_enough ? places : places_);
    return model;
  }

  /// Whether a model of the same vectors is accurate enough; corrects the places to it, and notes its error
  /// if it is.
  bool holds(const Model& model, ScoutedPlaces& places) {
    const std::optional<Worst> worst = places.correct_for(model);
    if (!worst || factor_ * worst->indicator > safety * target_) return false;
    double error = 0.0;
    for (const Visit& visit : visits_) {
      const ProjectedPlace* place = place_of(visit, places);
      if (place == nullptr && &visit == &visits_.back()) return false;
      if (place != nullptr) error = std::max(error, places.distance(*place, visit.exact));
    }
    if (error > target_) return false;
    note_error(error, *worst);
    return true;
  }

  std::unique_ptr<Model> give_up(std::unique_ptr<Model> model, const Worst& worst, double error,
                                 const std::string& why) {
    projection_.error = error;
    projection_.error_at = worst.place->at.p;
    projection_.notes.push_back("the projection leaves an error of about " + short_text(error, 2) + " at " +
                                trace_.parameter + " = " + exact_text(worst.place->at.p) + " " + why +
                                "; asked for were " + short_text(target_, 2));
    return settled(std::move(model));
  }

  LargeModel& large_;
  const TraceOptions& trace_;
  std::vector<ParameterValues> lines_;
  const ProjectionOptions& options_;
  ProjectionSpace space_;
  double target_;  ///< error of the eigenvalues by the projection, relative to their size
  ModeFinder finder_;
  Projection projection_;
  ScoutedPlaces places_;
  double frequency_ = 0.0;  ///< largest |s| that was found
  double factor_ = 1.0;     ///< error over indicator, the largest that was seen
  std::vector<Visit> visits_;
  int count_ = 0;  ///< modes that are looked for at a place
};

}  // namespace

Vector parameters_at(const Model& model, const TraceOptions& trace, const ParameterValues& line, double p) {
  const Parameters& parameters = model.description().parameters;
  Vector values = parameters.declared_values();
  for (const auto& [name, value] : line) values[parameters.index(name).value()] = value;
  values[parameters.index(trace.parameter).value()] = p;
  return values;
}

Shift usual_shift(const ModeChoice& choice) {
  if (choice.near) return {0.0, *choice.near};
  if (choice.band && choice.band->lowest > 0.0)
    return {0.0, 0.5 * (choice.band->lowest + choice.band->highest)};
  return {};
}

std::unique_ptr<Model> project(std::shared_ptr<const Model> model, const TraceOptions& trace,
                               const std::vector<ParameterValues>& lines, const ProjectionOptions& options) {
  return Projector(*large_model_of(std::move(model), trace), trace, lines, options).along_the_lines();
}

std::unique_ptr<Model> project_at(std::shared_ptr<const Model> model, const TraceOptions& trace,
                                  const std::vector<double>& values, const ProjectionOptions& options) {
  return Projector(*large_model_of(std::move(model), trace), trace, {}, options).at(values);
}

}  // namespace eigentrail
