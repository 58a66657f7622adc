// The states of linearizations of OpenFAST at several azimuths and operating points, and the multiblade
// coordinates that those of the blades become.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/model/sampled_data.hpp"
#include "import/lin_file.hpp"
#include "import/multiblade.hpp"
#include "import/openfast_states.hpp"

namespace eigentrail {

/// The states of all files, in the order of the first one. Keeps a reference to the files.
class LinStates {
 public:
  /// Throws InputError if the files have different states.
  explicit LinStates(const std::vector<LinFile>& files);

  Eigen::Index size() const { return static_cast<Eigen::Index>(parsed_.size()); }
  const std::vector<BladeStates>& tuples() const { return tuples_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  std::size_t n_blades() const { return n_blades_; }
  /// Whether states in the rotating frame are left.
  bool rotating_states_left() const { return left_rotating_; }

  /// A of a file with its states in the order of the first file.
  Matrix matrix(std::size_t file) const;

  /// Names, units, orders and frames in multiblade coordinates.
  void describe(SampledData& data) const;

 private:
  std::vector<Eigen::Index> places_in(const LinFile& file) const;
  void find_frames();
  void find_tuples();

  const std::vector<LinFile>& files_;
  std::vector<OpenFastState> parsed_;
  std::vector<std::vector<Eigen::Index>> places_;  ///< per file
  std::vector<bool> rotating_;
  std::vector<BladeStates> tuples_;
  std::vector<std::string> warnings_;
  std::size_t n_blades_ = 0;
  bool left_rotating_ = false;
};

}  // namespace eigentrail
