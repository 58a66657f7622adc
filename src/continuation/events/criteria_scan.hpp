// Search on a step for zeros and extrema of functions of single eigenvalues: flutter, divergence, damping
// ratios, logarithmic decrements, resonances. Every criterion of every mode is sampled on the dense output.
// Where consecutive samples show a change of sign or an extremum, the place is located by Newton's method
// (criterion_walk.hpp).
#pragma once

#include <map>
#include <utility>

#include "continuation/events/criterion_walk.hpp"
#include "continuation/tracks/mode_order.hpp"

namespace eigentrail {

/// The last samples of one criterion of one mode.
class CriterionHistory {
 public:
  enum class Seen { nothing, zero, extremum };

  /// Takes the value at the next sample. Returns `zero` if the sign changes between the last sample and this
  /// one, and `extremum` if the function has one near the last sample. After skipped samples the function has
  /// touched zero, or has crossed it: `extremum` if the sign is the same as before, else `zero`.
  Seen next(double value);
  /// Leaves out a sample whose value cannot be distinguished from zero.
  void skip() { skipped_ = known_; }

  bool is_known() const { return known_; }
  double value() const { return value_; }
  bool is_pair() const { return is_pair_; }
  void is_pair(bool value) { is_pair_ = value; }
  /// At the last extremum: second difference of the samples, and value at the vertex of the parabola through
  /// them. After skipped samples: the value after them, and zero.
  double bend() const { return bend_; }
  double top() const { return top_; }

  /// Visits all members, for saving and restoring the state of a trace.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.known_, self.skipped_, self.is_pair_, self.value_, self.change_, self.bend_, self.top_);
  }

 private:
  bool known_ = false, skipped_ = false, is_pair_ = false;
  double value_ = 0.0, change_ = 0.0, bend_ = 0.0, top_ = 0.0;
};

/// By mode number and index of the criterion.
using CriterionHistories = std::map<std::pair<int, std::size_t>, CriterionHistory>;

/// Gives modes that begin the histories of their parents, for criteria that apply to real eigenvalues. Then a
/// zero between the beginning of a mode and its first sample is not missed.
void inherit_histories(const std::vector<Birth>& births, const std::vector<Criterion>& criteria,
                       CriterionHistories& histories);

/// Begins the histories of modes, those from number `first` on, that were noticed on a step of length h and
/// followed back to its left end, `node`: with Re s just before it, from their series. Then one that is zero
/// at that end and grows behind it is an event.
void begin_histories(const PathProblem& problem, const PathNode& node, int first, double h,
                     const std::vector<Criterion>& criteria, CriterionHistories& histories);

/// Samples all criteria on a step, and locates the zeros and extrema that the samples show.
FoundEvents scan_criteria(const EventSearch& search, const Step& step, CriterionHistories& histories);

}  // namespace eigentrail
