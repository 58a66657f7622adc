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
std::vector<DenseBlock> blocks_of(const PathArrays& arrays, std::size_t n_modes, const std::string& name,
                                  std::size_t step) {
  const std::size_t functions = arrays.shape[1], orders = arrays.shape[3];
  // Of every block; the index is that of its first function.
  std::vector<std::vector<int>> modes(functions);
  for (std::size_t mode = 0; mode < n_modes; ++mode) {
    const std::int64_t block = arrays.mode_block[step * n_modes + mode];
    require_fit(block >= -1 && block < static_cast<std::int64_t>(functions), name, "mode_block");
    if (block >= 0) modes[static_cast<std::size_t>(block)].push_back(static_cast<int>(mode));
  }
  const auto belongs_to = [&](std::size_t function, std::size_t first) {
    return function < functions &&
           arrays.block[step * functions + function] == static_cast<std::int64_t>(first);
  };
  std::vector<DenseBlock> blocks;
  for (std::size_t first = 0; first < functions; ++first) {
    require_fit(belongs_to(first, first) || modes[first].empty(), name, "mode_block");
    if (!belongs_to(first, first)) continue;
    std::size_t size = 0;
    while (belongs_to(first + size, first)) ++size;
    // One, two, or the k^2 entries of a matrix.
    const auto members = static_cast<std::size_t>(block_size(static_cast<Eigen::Index>(size)));
    require_fit(modes[first].size() <= members && (size <= 2 || members * members == size), name,
                "dense_block");
    const RowMajorComplex ends = Eigen::Map<const RowMajorComplex>(
        arrays.output.data() + (step * functions + first) * 2 * orders, static_cast<Eigen::Index>(size),
        static_cast<Eigen::Index>(2 * orders));
    require_fit(ends.allFinite(), name, "dense_output");
    DenseBlock& block = blocks.emplace_back();
    block.chart = arrays.chart[step * functions + first] == 1 ? Chart::reciprocal : Chart::finite;
    block.modes = modes[first];
    block.left = ends.leftCols(static_cast<Eigen::Index>(orders));
    block.right = ends.rightCols(static_cast<Eigen::Index>(orders));
    block.certified = std::ranges::all_of(modes[first], [&](int mode) {
      return arrays.certified[step * n_modes + static_cast<std::size_t>(mode)] == 1;
    });
  }
  return blocks;
}

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
                          blocks_of(arrays, n_modes, name, step)});
  }
  path.p = std::move(arrays.p);
  return path;
}

}  // namespace eigentrail
