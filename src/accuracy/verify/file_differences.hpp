// Compares a loci file with another one of the same scene, number by number.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "accuracy/verify/checked_file.hpp"

namespace eigentrail {

struct FileDifferences {
  std::size_t numbers = 0;            ///< that were compared
  std::vector<std::string> faults;    ///< one per dataset and attribute that differs: the first difference
  std::set<std::string> different;    ///< names of the datasets that differ
};

/// What differs in the file from `traced`, the bytes of a loci file of a new trace. Datasets and attributes
/// that only the first file has do not count: other programs may have added them. Nor do the work, the time
/// and the program's version.
FileDifferences file_differences(const CheckedFile& file, std::string_view traced);

}  // namespace eigentrail
