// Import of real linearizations of OpenFAST (data/README.md).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <fstream>
#include <numbers>

#include "eigentrail/import/importer.hpp"
#include "import/text_lines.hpp"
#include "scene/input_error.hpp"
#include "support/folder.hpp"

namespace eigentrail::test::openfast_test {
namespace {

std::string file(int i) {
  return std::string(EIGENTRAIL_IMPORT_DATA) + "/ws03.0." + std::to_string(i) + ".lin";
}

Imported imported(const std::vector<std::string>& files,
                  const std::map<std::string, std::string>& options = {}) {
  return importer("openfast").read({files, options});
}

/// Natural frequency in Hz and damping in per cent of the oscillatory modes, lowest first.
std::vector<std::pair<double, double>> modes_of(const Matrix& A) {
  std::vector<std::pair<double, double>> modes;
  const ComplexVector eigenvalues = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
  for (const Complex& s : eigenvalues) {
    if (s.imag() > 1e-3 * std::abs(s))
      modes.emplace_back(std::abs(s) / (2.0 * std::numbers::pi), -100.0 * s.real() / std::abs(s));
  }
  std::sort(modes.begin(), modes.end());
  return modes;
}

/// The expected numbers are printed with these digits.
TEST(OpenFast, ModesAreThoseOfTheToolbox) {
  const auto modes = modes_of(imported({file(1), file(13), file(34)}).samples.A[0]);
  ASSERT_GE(modes.size(), 3u);
  const double expected[3][2] = {{0.31403, 0.439}, {0.33141, 6.034}, {0.62634, 2.481}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(modes[i].first, expected[i][0], 0.5e-5) << i;
    EXPECT_NEAR(modes[i].second, expected[i][1], 0.5e-3) << i;
  }
}

TEST(OpenFast, StatesAreThoseOfTheRotorAsAWhole) {
  const Imported result = imported({file(1), file(13), file(34)});
  const std::vector<std::string>& names = result.samples.state_names;
  ASSERT_EQ(names.size(), 30u);
  EXPECT_EQ(names[0], "1st tower fore-aft");
  for (const char* name :
       {"1st flap collective", "1st flap cosine", "1st flap sine", "1st edge sine velocity"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  EXPECT_EQ(result.parameter, "wind_speed");
  EXPECT_EQ(result.samples.parameter_unit, "m/s");
  EXPECT_EQ(result.samples.values, std::vector<double>{3.0});
  EXPECT_EQ(result.samples.state_frames, std::vector<StateFrame>(30, StateFrame::fixed));
  EXPECT_TRUE(result.warnings.empty());
}

TEST(OpenFast, OneAzimuthIsWorthAWarning) {
  const Imported result = imported({file(1)});
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_TRUE(test::contains(result.warnings[0], "one azimuth only"));
}

TEST(OpenFast, EachAzimuthOnce) {
  EXPECT_TRUE(test::contains(test::input_error([&] {
                               imported({file(1), file(1)});
                             }),
                             "give each azimuth once"));
}

TEST(OpenFast, OperatingPointsBecomeSamples) {
  const test::Folder folder;
  std::string text = read_text_file(file(1));
  const std::string wind = "3.0000 m/s";
  text.replace(text.find(wind), wind.size(), "5.0000 m/s");
  std::ofstream(folder.path() + "/b.lin") << text;
  const Imported result = imported({folder.path() + "/b.lin", file(1)});
  EXPECT_EQ(result.samples.values, (std::vector<double>{3.0, 5.0}));
  EXPECT_EQ(result.samples.A[0], result.samples.A[1]);
}

TEST(OpenFast, FilesOfDifferentStatesDoNotFit) {
  const test::Folder folder;
  std::string text = read_text_file(file(1));
  const std::string state = "ED Nacelle yaw DOF";
  text.replace(text.find(state), state.size(), "ED Nacelle nod DOF");
  std::ofstream(folder.path() + "/b.lin") << text;
  const std::string message = test::input_error([&] { imported({file(1), folder.path() + "/b.lin"}); });
  EXPECT_TRUE(test::contains(message, "has no state 'ED Nacelle yaw DOF")) << message;
}

TEST(OpenFast, OptionsThatDoNotFit) {
  const std::string message = test::input_error([&] { imported({file(1)}, {{"parameter", "humidity"}}); });
  EXPECT_TRUE(test::contains(message, "no state, input or output has 'humidity'")) << message;
  EXPECT_EQ(imported({file(1)}, {{"parameter", "rotor_speed"}}).parameter, "rotor_speed");
}

}  // namespace
}  // namespace eigentrail::test::openfast_test
