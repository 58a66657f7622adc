// Samples of a model's matrices at values of one parameter, as other programs compute them, and the HDF5 file
// that holds them (docs/sampled-families.md).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Frame in which a state is measured.
enum class StateFrame { fixed, rotating };

/// Either A and optionally E are given (E x' = A x), or K with M, C or both (M x'' + C x' + K x = 0). Each
/// list is empty or has one n x n matrix per value.
struct SampledData {
  std::vector<double> values;       ///< of the parameter, in `parameter_unit`; distinct, in any order
  std::string parameter_unit;       ///< empty: none, or not known
  std::string parameter_name = {};  ///< empty: not known; scenes give their own
  std::vector<Matrix> M, C, K, E, A;

  std::vector<std::string> state_names;  ///< n, or empty
  std::vector<std::string> state_units;  ///< n, or empty
  std::vector<int> derivative_order;     ///< n, or empty: 1 for first-order states, 2 for second-order ones
  std::vector<StateFrame> state_frames;  ///< n, or empty: not known
  /// Bounds of the errors of the entries of A, absolute, n x n per value; empty: not known. They replace
  /// `digits` for A.
  std::vector<Matrix> A_error;
  std::optional<int> digits;  ///< significant digits of the entries; empty: all of a double
  std::string source;         ///< where the samples come from, in words

  std::size_t count() const { return values.size(); }
  bool first_order() const { return !A.empty(); }
  /// Number of states n; 0 if there is no matrix.
  Eigen::Index size() const;
};

/// Throws std::invalid_argument if the lists do not fit each other, with a message that says what was
/// expected and what was found.
void check(const SampledData& data);

/// Brings the samples in the order of states of the first one, by name. `names`: those of each sample, n
/// each; empty if all have the same order. Throws std::invalid_argument if a sample has other states.
void match_states(SampledData& data, const std::vector<std::vector<std::string>>& names);

/// One of the matrices and its name.
struct SampledMatrix {
  const char* name;
  std::vector<Matrix> SampledData::*samples;
};
const std::array<SampledMatrix, 5>& sampled_matrices();

/// Reads such a file and brings the samples in ascending order of the parameter, all with the order of states
/// of the first sample of the file. Throws Hdf5Error or std::invalid_argument with a message that names the
/// dataset.
SampledData read_samples(const std::string& path);

/// Values of the parameter that differ by this share of the largest are the same.
inline constexpr double same_value = 1e-12;

/// Why a value of the parameter `name` cannot be looked at, and what to do; empty if it lies within the
/// samples. `samples`: values of the samples, ascending, at least one, in the unit of `value`.
std::string outside_samples(const std::string& name, double value, const std::vector<double>& samples);

/// Whether a file is such a file, as far as a look at it tells: HDF5 with a dataset `parameter`, and not one
/// of this program's results. Throws Hdf5Error if it cannot be read.
bool holds_samples(const std::string& path);

}  // namespace eigentrail
