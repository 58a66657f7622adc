// Compares a loci file with another one of the same scene, number by number.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "accuracy/verify/checked_file.hpp"

namespace eigentrail {

struct FileDifferences {
  std::size_t numbers = 0;  ///< that were compared
  std::vector<std::string>
      faults;  ///< per dataset: whether it is missing or longer, and its first difference
  std::set<std::string> different;  ///< names of the datasets of which numbers differ that both files have
};

/// What differs in the datasets of the file from `traced`, the bytes of a loci file of a new trace. Datasets
/// that only the first file has do not count: other programs may have added them.
FileDifferences file_differences(const CheckedFile& file, std::string_view traced);

}  // namespace eigentrail
