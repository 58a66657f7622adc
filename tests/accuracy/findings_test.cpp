// What is found on a path that has been traced.
#include "eigentrail/accuracy/findings.hpp"

#include <gtest/gtest.h>

#include "support/scenes.hpp"
#include "support/traced_path.hpp"

namespace eigentrail::test::findings_test {
namespace {

TEST(Findings, StabilityThatChangesAtNoSpecialPointIsNoted) {
  // s^2 + p s + 1 = 0 begins to grow where p = 0.
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 1\nto = -1\n[matrix_family]\nM = [[[1]]]\nC = [[[0]], [[1]]]\nK = "
      "[[[1]]]\n");
  TracedPath traced = trace_path(*setting.model, setting.options);
  const auto notes = [&] {
    TraceResult result = traced.result;
    find_ranges_and_errors(*setting.model, setting.options, traced.path, result);
    return result.notes;
  };
  EXPECT_TRUE(notes().empty());
  traced.result.events.clear();
  ASSERT_EQ(notes().size(), 1U);
  EXPECT_NE(notes()[0].find("where no special point was located"), std::string::npos) << notes()[0];
}

}  // namespace
}  // namespace eigentrail::test::findings_test
