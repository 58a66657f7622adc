// Reference labels of modes: the spectra of the catalogue are followed in fine steps, without eigenvectors.
//
// Spectra at two parameters are matched by the nearest eigenvalue. A match counts only when every
// displacement is below a fifth of the distance to the next other eigenvalue, at both ends; otherwise the
// stretch is bisected, down to 1e-13 of the range. Where modes coincide no label continues, so the stretches
// end there.
#pragma once

#include <string>
#include <vector>

#include "hard_cases/catalogue.hpp"

namespace eigentrail::test {

/// Labelled modes on a stretch of the range without coincidences, on one equilibrium branch.
class LabelledStretch {
 public:
  /// Labels the modes of a branch on [low, high], which may end at a coincidence but not contain one.
  LabelledStretch(const HardCase& hard_case, int branch, double low, double high);

  /// Ends of the labelled part: `low` and `high`, or a 1e-11 of the range before them where modes coincide.
  double low() const { return anchors_.front().p; }
  double high() const { return anchors_.back().p; }
  int branch() const { return branch_; }

  /// Whether the labels reach both ends.
  bool complete() const { return reason_.empty(); }
  /// Where and why they do not.
  const std::string& reason() const { return reason_; }

  /// Modes with Im s >= 0, one per label, for low() <= p <= high(); throws std::out_of_range elsewhere.
  std::vector<Complex> operator()(double p) const;

 private:
  struct Anchor {
    double p;
    std::vector<Complex> modes;  ///< labelled
  };

  std::vector<Complex> spectrum(double p) const;
  std::vector<Complex> continued(const Anchor& anchor, double p, int depth) const;
  void walk(double target);

  const HardCase& case_;
  int branch_;
  double range_;
  std::vector<Anchor> anchors_;  ///< ascending p
  std::string reason_;
};

/// Every stretch of the case: between its coincidences (collision, crossing, fold, branch point, infinite),
/// for every equilibrium branch; those shorter than 1e-9 of the range are left out. `hard_case` must outlive
/// the result.
std::vector<LabelledStretch> reference_labels(const HardCase& hard_case);

/// Members with Im s >= 0: one per complex pair, and the real roots.
std::vector<Complex> upper_members(const std::vector<Complex>& spectrum);

}  // namespace eigentrail::test
