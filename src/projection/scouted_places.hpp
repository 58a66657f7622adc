// Places along the path of a projected model, with its modes, and how far these may be from the large model.
#pragma once

#include <vector>

#include "projection/mode_entries.hpp"

namespace eigentrail {

/// Tolerance of the traces that only look for the worst place.
inline constexpr double scout_tolerance = 1e-3;

/// The mode with the largest indicator of all places.
struct Worst {
  const ProjectedPlace* place = nullptr;
  double indicator = 0.0;  ///< relative to max(|s|, reference)
};

/// Finds places and their modes by rough traces of a projected model.
class ScoutedPlaces {
 public:
  /// What is given must outlive this.
  ScoutedPlaces(const LargeModel& large, const TraceOptions& trace, const std::vector<ParameterValues>& lines)
      : large_(large), trace_(trace), lines_(lines) {}

  /// Magnitude below which an eigenvalue counts as zero, 1/s.
  double reference() const { return reference_; }
  const std::vector<ProjectedPlace>& all() const { return places_; }

  /// A place with a large indicator: the largest one of every second place and of its neighbours, or, where
  /// this is below `enough`, of all places on all lines. `traces_hold`: the model differs from the one before
  /// by less than its rough traces were accurate to; then the modes at the same places are corrected.
  Worst worst(const Model& model, bool traces_hold, double enough);
  /// The place with the largest indicator of all, for the model for which one was looked for.
  Worst worst_of_all(const Model& model);

  /// Corrects the modes at all places to those of another model. The place with the largest indicator; empty
  /// if one of the modes is not found.
  std::optional<Worst> correct_for(const Model& model);

  /// Largest distance of the modes at a place from the nearest of some eigenvalues, relative to their size.
  double distance(const ProjectedPlace& place, const std::vector<Complex>& exact) const;

  /// Modes of a place without infinite eigenvalues and rigid-body motions: zeros are known to the root of
  /// rounding only.
  static std::vector<ProjectedMode> moving_modes(const ProjectedPlace& place);

 private:
  void scout(const Model& model, const ParameterValues& line);
  /// Notes that the modes are of a space that has changed.
  void forget_modes();
  std::optional<Worst> find_worst(const Model& model, double enough);
  bool look_at(const Model& model, std::size_t i, Worst& worst);
  std::optional<double> indicator_at(const Model& model, ProjectedPlace& place) const;
  double size(Complex s) const { return std::max(std::abs(s), reference_); }

  const LargeModel& large_;
  const TraceOptions& trace_;
  const std::vector<ParameterValues>& lines_;
  std::vector<ProjectedPlace> places_;
  std::vector<std::optional<double>> indicators_;  ///< of the places, as far as they were computed
  double reference_ = 0.0;
};

}  // namespace eigentrail
