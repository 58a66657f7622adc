// Compares a recorded trace with reference data of its case: eigenvalues, special points, labels.
#pragma once

#include <string>
#include <vector>

#include "hard_cases/catalogue.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {

/// Spectra of all equilibrium branches at one parameter.
struct Sample {
  double p;
  Spectra spectra;
  std::vector<Spectra> nearby;  ///< beside a fold: at parameters that rounding cannot tell from p
};
Sample sample_at(const HardCase& hard_case, double p);

/// Random parameters, and 1e-3 ... 1e-10 of the range beside every special point.
std::vector<double> sample_parameters(const HardCase& hard_case, int random_samples);

struct Accuracy {
  double worst_error = 0.0;  ///< largest error of the functions of blocks divided by the tolerance
  double worst_at = 0.0;     ///< parameter value of that error
};
/// Dense output against the samples, block by block: tau and the power means of the distances from it,
/// relative to the size of the block's eigenvalues.
Accuracy measure_accuracy(const std::vector<Sample>& samples, const RecordedTrace& trace, double tolerance);

struct EventComparison {
  std::vector<std::string> missing, invented;
  /// Per special point of the case: the index of its event, -1 without one.
  std::vector<int> event_of;
};
/// Events against special points: the kind, the parameter and a veering's half-width within 1e-7 (1e-9 at
/// tolerance 1e-8). Veerings count up to a half-width of one percent of the range; wider ones may be there.
EventComparison compare_events(const HardCase& hard_case, const RecordedTrace& trace, double tolerance);

/// A mode of the smooth continuation at some parameter.
struct LabelledMode {
  Complex s;
  int family = 0;   ///< a column never leaves it while it is certified
  int version = 0;  ///< of the family: it changes where the family's labels end, at a coincidence of its own
  int label = 0;    ///< within the family; kept while the version stays
};

struct LabelCount {
  int labels = 0;  ///< certified labels compared
  int wrong = 0;   ///< of them, on another mode
  /// The first few that are wrong.
  std::vector<std::string> wrong_places;
};
/// Modes that are known at a parameter.
struct LabelledPlace {
  double p;
  std::vector<LabelledMode> modes;
};
/// Compares the labels at places of ascending p, on the passage `branch` of each: a column keeps to one label
/// as long as it is certified. A place counts where one mode is ten times as near as the next.
void count_labels(const RecordedTrace& trace, const std::vector<LabelledPlace>& reference, int branch,
                  LabelCount& count);

}  // namespace eigentrail::test
