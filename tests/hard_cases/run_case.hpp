// Traces one hard case with one setting and checks errors, events and labels.
#pragma once

#include <string>
#include <vector>

#include "hard_cases/catalogue.hpp"
#include "hard_cases/trace_checks.hpp"

namespace eigentrail::test {

struct RunSetting {
  double tolerance = 1e-6;
  bool reversed = false;    ///< traced from the other end of the range
  double first_step = 0.0;  ///< relative to the range; 0: chosen by the program
  int order = 3;
  Thresholds thresholds = {};
};

struct CaseReport {
  bool completed = false;
  std::string message;
  int nodes = 0;
  double worst_error = 0.0;  ///< largest error of the functions of blocks divided by the tolerance
  double worst_at = 0.0;     ///< parameter value of that error
  std::vector<std::string> missing, invented;
  int most_retrackings = 0;  ///< points computed to locate one event; veerings aside
  int wrong_labels = 0;      ///< certified labels that are on another mode

  /// In one line; empty where nothing is wrong.
  std::string problems() const;
};

/// Reference data of a case that all its runs share: computing it costs more than the runs.
struct CaseReference {
  const HardCase* hard_case = nullptr;
  std::vector<Sample> samples;
  struct Labels {
    int branch;
    std::vector<LabelledPlace> places;
  };
  std::vector<Labels> labels;
};
CaseReference make_reference(const HardCase& hard_case, int random_samples);

/// The trace of a case, from the other end if the setting is `reversed`: then `there` is the trace to that
/// end with the same setting, if it is known.
RecordedTrace trace_case(const HardCase& hard_case, const RunSetting& setting,
                         const RecordedTrace* there = nullptr);

CaseReport check_case(const CaseReference& reference, const RecordedTrace& trace, double tolerance);

}  // namespace eigentrail::test
