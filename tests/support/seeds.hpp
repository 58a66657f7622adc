// Seeds of random families, the parameters of tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace eigentrail::test {

/// The seeds from 1 to `count`; to EIGENTRAIL_SEEDS where the environment has it, for runs of hours.
inline auto first_seeds(int count) {
  const char* more = std::getenv("EIGENTRAIL_SEEDS");
  return testing::Range(1, 1 + (more == nullptr ? count : std::atoi(more)));
}

inline std::string seed_name(const testing::TestParamInfo<int>& tested) {
  return "seed_" + std::to_string(tested.param);
}

}  // namespace eigentrail::test
