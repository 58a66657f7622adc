// Writes a work-precision study (HDF5, format "eigentrail-accuracy", schema 1; docs/accuracy.md).
#pragma once

#include <string>

#include "eigentrail/accuracy/study.hpp"

namespace eigentrail {

inline constexpr int accuracy_schema_version = 1;
inline constexpr const char* accuracy_format = "eigentrail-accuracy";

/// The bytes of the file. Throws std::runtime_error if HDF5 cannot make it.
std::string study_file(const TraceSetup& setup, const StudyOptions& options, const Study& study);

}  // namespace eigentrail
