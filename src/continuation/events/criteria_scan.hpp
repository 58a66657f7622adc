// Looks along a step for zeros and extrema of functions of single eigenvalues: flutter, divergence, damping
// ratios, resonances. The values of every criterion for every mode are taken at several samples of the dense
// output; where they change sign, bend, or leave the axis, the place is located (criterion_walk.hpp).
#pragma once

#include <map>
#include <utility>

#include "continuation/events/criterion_walk.hpp"
#include "continuation/tracks/mode_order.hpp"

namespace eigentrail {

/// The last values of a criterion for a mode, from sample to sample.
class CriterionHistory {
 public:
  enum class Seen { nothing, zero, extremum };

  /// Takes the next value. Returns what lies between the last value and this one, or (an extremum) about at
  /// the last one. A value that was skipped as not told from zero counts as an extremum.
  Seen next(double value);
  void skip() { skipped_ = known_; }

  bool is_known() const { return known_; }
  double value() const { return value_; }
  bool is_pair() const { return is_pair_; }
  void is_pair(bool value) { is_pair_ = value; }
  double bend() const { return bend_; }  ///< second difference at the extremum
  double top() const { return top_; }    ///< value at the extremum, about

  /// Its state, for files that a trace goes on from.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.known_, self.skipped_, self.is_pair_, self.value_, self.change_, self.bend_, self.top_);
  }

 private:
  bool known_ = false, skipped_ = false, is_pair_ = false;
  double value_ = 0.0, change_ = 0.0, bend_ = 0.0, top_ = 0.0;
};

/// Per mode and criterion.
using CriterionHistories = std::map<std::pair<int, std::size_t>, CriterionHistory>;

/// A mode that begins comes from where its parent was: what it crosses at once is not missed.
void inherit_histories(const std::vector<Birth>& births, const std::vector<Criterion>& criteria,
                       CriterionHistories& histories);

/// Scans a step, and locates what it sees.
FoundEvents scan_criteria(const EventSearch& search, const Step& step, CriterionHistories& histories);

}  // namespace eigentrail
