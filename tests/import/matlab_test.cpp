// Files of MATLAB, version 4; tests/cli/import_test.py has those of scipy.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>

#include "eigentrail/import/importer.hpp"
#include "scene/input_error.hpp"
#include "support/folder.hpp"

namespace eigentrail::test::matlab_test {
namespace {

/// A variable of version 4: type, rows, columns, imaginary parts, length of the name; name and numbers.
std::string variable(const std::string& name, std::int32_t rows, std::int32_t columns,
                     const std::vector<double>& values, bool complex = false) {
  const std::int32_t head[5] = {0, rows, columns, complex ? 1 : 0,
                                static_cast<std::int32_t>(name.size() + 1)};
  std::string result(sizeof head, '\0');
  std::memcpy(result.data(), head, sizeof head);
  result += name + '\0';
  std::string data(8 * values.size(), '\0');
  std::memcpy(data.data(), values.data(), data.size());
  return result + data;
}

class Matlab : public testing::Test {
 protected:
  std::string write(const std::string& bytes) const {
    const std::string path = folder_.path() + "/a.mat";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  Imported read(const std::string& bytes) const { return importer("matlab").read({{write(bytes)}, {}}); }
  std::string message(const std::string& bytes) const {
    return test::input_error([&] { read(bytes); });
  }

  test::Folder folder_;
};

TEST_F(Matlab, ColumnsComeFirst) {
  const Imported imported = read(variable("A1", 2, 2, {1, 2, 3, 4}) + variable("A2", 2, 2, {5, 6, 7, 8}) +
                                 variable("speed", 1, 2, {10, 20}));
  EXPECT_EQ(imported.parameter, "speed");
  EXPECT_EQ(imported.samples.A[0], (Matrix{{1.0, 3.0}, {2.0, 4.0}}));
  EXPECT_EQ(imported.samples.A[1], (Matrix{{5.0, 7.0}, {6.0, 8.0}}));
}

TEST_F(Matlab, ComplexNumbersNeedImaginaryPartsOfZero) {
  EXPECT_EQ(read(variable("A", 1, 1, {3, 0}, true)).samples.A[0](0, 0), 3.0);
  EXPECT_TRUE(test::contains(message(variable("A", 1, 1, {3, 1}, true)),
                             "variable A is complex; expected real numbers"));
}

TEST_F(Matlab, Faults) {
  EXPECT_TRUE(
      test::contains(message(variable("A", 1, 2, {1, 2})), "array A is 1 x 2; expected a matrix n x n"));
  EXPECT_TRUE(test::contains(test::input_error([&] {
                               importer("matlab").read({{folder_.path() + "/none.mat"}, {}});
                             }),
                             "none.mat: no such file"));
  EXPECT_TRUE(test::contains(test::input_error([&] {
                               importer("matlab").read({{"a.mat", "b.mat"}, {}});
                             }),
                             "expected one .mat file"));
}

}  // namespace
}  // namespace eigentrail::test::matlab_test
