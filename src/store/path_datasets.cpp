#include "store/path_datasets.hpp"

#include <cmath>
#include <numeric>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

using RowMajorComplex = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorReal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The blocks of a step.
class StepBlocks {
 public:
  StepBlocks(const PathArrays& arrays, std::size_t n_modes, const std::string& name, std::size_t step)
      : arrays_(arrays),
        n_modes_(n_modes),
        name_(name),
        step_(step),
        functions_(arrays.shape[1]),
        modes_(functions_) {
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const std::int64_t block = arrays.mode_block[step * n_modes + mode];
      require(block >= -1 && block < static_cast<std::int64_t>(functions_), "mode_block");
      if (block >= 0) modes_[static_cast<std::size_t>(block)].push_back(static_cast<int>(mode));
    }
  }

  std::vector<DenseBlock> read() const {
    std::vector<DenseBlock> blocks;
    for (std::size_t i = 0; i < functions_; ++i) {
      const bool begins = block_of(i) == static_cast<std::int64_t>(i);
      require(begins || modes_[i].empty(), "mode_block");
      if (begins) blocks.push_back(block(i));
    }
    return blocks;
  }

 private:
  void require(bool fits, const std::string& dataset) const { require_fit(fits, name_, dataset); }
  std::int64_t block_of(std::size_t function) const { return arrays_.block[step_ * functions_ + function]; }

  /// The block whose first function is `first`.
  DenseBlock block(std::size_t first) const {
    const std::size_t orders = arrays_.shape[3];
    std::size_t size = 0;
    while (first + size < functions_ && block_of(first + size) == static_cast<std::int64_t>(first)) ++size;
    // One, two, or the k^2 entries of a matrix.
    const auto members = static_cast<std::size_t>(block_size(static_cast<Eigen::Index>(size)));
    require(modes_[first].size() <= members && (size <= 2 || members * members == size), "dense_block");
    DenseBlock block;
    block.chart = arrays_.chart[step_ * functions_ + first] == 1 ? Chart::reciprocal : Chart::finite;
    block.modes = modes_[first];
    const RowMajorComplex ends = Eigen::Map<const RowMajorComplex>(
        arrays_.output.data() + (step_ * functions_ + first) * 2 * orders, static_cast<Eigen::Index>(size),
        static_cast<Eigen::Index>(2 * orders));
    require(ends.allFinite(), "dense_output");
    block.left = ends.leftCols(static_cast<Eigen::Index>(orders));
    block.right = ends.rightCols(static_cast<Eigen::Index>(orders));
    block.certified = std::all_of(block.modes.begin(), block.modes.end(), [&](int mode) {
      return arrays_.certified[step_ * n_modes_ + static_cast<std::size_t>(mode)] == 1;
    });
    return block;
  }

  const PathArrays& arrays_;
  std::size_t n_modes_;
  const std::string& name_;
  std::size_t step_, functions_;
  std::vector<std::vector<int>> modes_;  ///< of every block; the index is that of its first function
};

}  // namespace

void require_fit(bool fits, const std::string& name, const std::string& dataset) {
  if (!fits) throw InputError(name + ": " + dataset + " does not fit the other datasets");
}

void require_finite(const std::vector<double>& values, const std::string& name, const std::string& dataset) {
  const auto bad = std::find_if_not(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (bad == values.end()) return;
  throw InputError(name + ": " + dataset + " holds " + exact_text(*bad) + " as its number " +
                   std::to_string(bad - values.begin() + 1) + " where a finite number is needed");
}

RecordedPath path_of(PathArrays arrays, std::size_t n_modes, const std::string& name) {
  const auto add_size = [](double sum, double length) { return sum + std::abs(length); };
  require_fit(std::isfinite(std::accumulate(arrays.length.begin(), arrays.length.end(), 0.0, add_size)), name,
              "step_length");
  RecordedPath path;
  path.eigenvalues =
      Eigen::Map<const RowMajorComplex>(arrays.eigenvalue.data(), static_cast<Eigen::Index>(arrays.p.size()),
                                        static_cast<Eigen::Index>(n_modes));
  for (std::size_t step = 0; step < arrays.shape[0]; ++step) {
    const std::size_t orders = arrays.shape[3];
    path.steps.push_back({arrays.length[step],
                          Eigen::Map<const RowMajorReal>(arrays.parameter.data() + step * 2 * orders, 2,
                                                         static_cast<Eigen::Index>(orders)),
                          StepBlocks(arrays, n_modes, name, step).read()});
  }
  path.p = std::move(arrays.p);
  return path;
}

}  // namespace eigentrail
