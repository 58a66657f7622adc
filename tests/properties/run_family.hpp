// Traces a planted family and checks errors, events and labels.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "hard_cases/run_case.hpp"
#include "properties/planted_family.hpp"

namespace eigentrail::test {

struct KindCount {
  int planted = 0;  ///< that must be found
  int found = 0;
  int invented = 0;
};

struct FamilyReport {
  RunSetting setting;
  bool completed = false;
  std::string message;
  int nodes = 0;
  Accuracy accuracy;
  EventComparison events;
  LabelCount labels;
  std::vector<std::string> wrong_modes;  ///< events that name modes which do not take part
  double certified_share = 0.0;          ///< of modes times steps
  std::map<std::string, KindCount> kinds;

  bool passed() const { return failures().empty(); }
  /// What failed, a short word each: "ended", "error", "labels", "missing veering", ...
  std::vector<std::string> failures() const;
  /// In one line; empty where nothing failed.
  std::string problems() const;
};

/// Tolerance, direction and first step of a seed.
RunSetting setting_of(std::uint64_t seed);

FamilyReport run_family(const PlantedFamily& family, const RunSetting& setting);

}  // namespace eigentrail::test
