// Peak memory of a piece of work.
#pragma once

#include <malloc.h>

#include <fstream>
#include <limits>
#include <string>

namespace eigentrail::test {

/// A line of /proc/self/status, in bytes: "VmHWM" is the largest resident set so far, "VmRSS" that of now.
inline double resident_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key + ":", 0) == 0) return 1024.0 * std::stod(line.substr(key.size() + 1));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// By how much the resident set grows at most while `work` runs, in bytes.
template <class Work>
double peak_bytes_of(Work&& work) {
  malloc_trim(0);                                 // what was freed before is not used again unseen
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins anew
  const double before = resident_bytes("VmRSS");
  work();
  return resident_bytes("VmHWM") - before;
}

}  // namespace eigentrail::test
