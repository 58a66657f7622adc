// Traces a planted family and checks errors, events and labels.
#pragma once

#include <string>
#include <vector>

#include "hard_cases/run_case.hpp"
#include "properties/planted_family.hpp"

namespace eigentrail::test {

struct FamilyReport {
  bool completed = false;
  std::string message;
  Accuracy accuracy;
  EventComparison events;
  LabelCount labels;
  std::vector<std::string> wrong_modes;  ///< events that name modes which do not take part

  /// In one line; empty where nothing failed.
  std::string problems() const;
};

/// Tolerance, direction and first step of a seed.
RunSetting setting_of(std::uint64_t seed);

FamilyReport run_family(const PlantedFamily& family, const RunSetting& setting);

}  // namespace eigentrail::test
