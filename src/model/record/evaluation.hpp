// Evaluates programs as power series along the path, for several elements of one structure at a time.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "eigentrail/core/series.hpp"
#include "eigentrail/core/types.hpp"
#include "model/record/program.hpp"
#include "model/record/smooth_function.hpp"

namespace eigentrail {

/// Elements that are evaluated together: two vector registers, so that the time of an instruction covers that
/// of reading it.
inline constexpr int lanes = 4;

/// The numbers of programs of which one is evaluated at a time. Not for several threads.
template <class Real, int Lanes>
class Evaluation {
 public:
  using Pack = Eigen::Array<Real, Lanes, 1>;
  /// A function for each lane.
  using Functions = std::array<const SmoothFunction*, Lanes>;

  /// Prepares for a program and series up to h^order, and computes its constants.
  void begin(const Program& program, int order) {
    order_ = order;
    const std::size_t n = static_cast<std::size_t>(program.n_slots);
    if (packs_.size() < n * stride()) packs_.resize(n * stride());
    if (varies_.size() < n) varies_.resize(n);
    for (const Instruction& constant : program.constants) set_constant(constant.out, Real(constant.constant));
  }

  /// Coefficients of a slot. If it does not vary along the path, only the first is valid.
  Pack* series(int slot) { return packs_.data() + static_cast<std::size_t>(slot) * stride(); }
  const Pack* series(int slot) const { return packs_.data() + static_cast<std::size_t>(slot) * stride(); }
  bool varies(int slot) const { return varies_[static_cast<std::size_t>(slot)]; }
  void set_varies(int slot, bool varies) { varies_[static_cast<std::size_t>(slot)] = varies; }

  /// Carries out the instructions. `functions`: by index.
  void run(const Program& program, const std::vector<Functions>& functions);

 private:
  void run_function(const Instruction& i, const std::vector<Functions>& functions);
  void run_choice(const Instruction& i);
  void compose(const Instruction& i, const Functions& functions, int top);

  using LongSeries = Series<Real, max_order>;
  LongSeries lane(int slot, int l) const {
    LongSeries result;
    for (int k = 0; k <= (varies(slot) ? order_ : 0); ++k) result[k] = series(slot)[k][l];
    return result;
  }
  void set_lane(int slot, int l, const LongSeries& value) {
    for (int k = 0; k <= (varies(slot) ? order_ : 0); ++k) series(slot)[k][l] = value[k];
  }

  std::size_t stride() const { return static_cast<std::size_t>(order_) + 1; }
  void set_constant(int slot, const Real& value) {
    series(slot)[0] = Pack::Constant(value);
    set_varies(slot, false);
  }

  int order_ = 0;
  std::vector<Pack> packs_;
  std::vector<char> varies_;
};

extern template class Evaluation<double, 1>;
extern template class Evaluation<double, lanes>;
extern template class Evaluation<Extended, 1>;

}  // namespace eigentrail
