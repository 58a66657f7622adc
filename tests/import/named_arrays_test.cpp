// Samples from arrays with names.
#include "import/named_arrays.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "scene/input_error.hpp"

namespace eigentrail::test::named_arrays_test {
namespace {

NamedArray numbers(const std::string& name, const std::vector<std::size_t>& shape,
                   const std::vector<double>& values, bool last_fastest = true) {
  NamedArray array{name, shape, {}, values, {}, false};
  array.set_order(last_fastest);
  return array;
}

NamedArray texts(const std::string& name, const std::vector<std::size_t>& shape,
                 const std::vector<std::string>& values) {
  NamedArray array{name, shape, {}, {}, values, true};
  array.set_order(true);
  return array;
}

Imported read(const std::vector<NamedArray>& arrays, const std::map<std::string, std::string>& options = {},
              bool samples_first = true) {
  return from_arrays(arrays, {{"dir/model.npz"}, options}, samples_first);
}

std::string message(const std::vector<NamedArray>& arrays,
                    const std::map<std::string, std::string>& options = {}) {
  return test::input_error([&] { read(arrays, options); });
}

const NamedArray A = numbers("A", {2, 2, 2}, {1, 2, 3, 4, 5, 6, 7, 8});
const NamedArray speed = numbers("speed", {2}, {10, 20});
const Matrix first{{1.0, 2.0}, {3.0, 4.0}}, second{{5.0, 6.0}, {7.0, 8.0}};

TEST(NamedArrays, Cubes) {
  const Imported imported = read({A, speed});
  EXPECT_EQ(imported.title, "model");
  EXPECT_EQ(imported.parameter, "speed");
  EXPECT_EQ(imported.samples.values, (std::vector<double>{10.0, 20.0}));
  EXPECT_EQ(imported.samples.A, (std::vector<Matrix>{first, second}));
}

/// A(:,:,i) of MATLAB: the first index varies fastest, and the last one counts samples.
TEST(NamedArrays, SamplesAlongTheLastIndex) {
  const Imported imported =
      read({numbers("A", {2, 2, 2}, {1, 3, 2, 4, 5, 7, 6, 8}, false), speed}, {}, false);
  EXPECT_EQ(imported.samples.A, (std::vector<Matrix>{first, second}));
  // An array n x n x k or k x n x n is told by its shape.
  std::vector<double> values(12);
  std::iota(values.begin(), values.end(), 0.0);
  const NamedArray three = numbers("p", {3}, {1, 2, 3});
  EXPECT_EQ(read({numbers("A", {2, 2, 3}, values), three}).samples.A[1], (Matrix{{1.0, 4.0}, {7.0, 10.0}}));
  EXPECT_EQ(read({numbers("A", {3, 2, 2}, values), three}, {}, false).samples.A[1],
            (Matrix{{4.0, 5.0}, {6.0, 7.0}}));
}

TEST(NamedArrays, NumberedOnes) {
  const Imported imported = read({numbers("A_2", {2, 2}, {5, 6, 7, 8}), numbers("A_1", {2, 2}, {1, 2, 3, 4}),
                                  numbers("w01", {}, {3}), numbers("w02", {1}, {4})});
  EXPECT_EQ(imported.parameter, "w");
  EXPECT_EQ(imported.samples.values, (std::vector<double>{3.0, 4.0}));
  EXPECT_EQ(imported.samples.A, (std::vector<Matrix>{first, second}));
}

TEST(NamedArrays, ConstantsHoldForAllSamples) {
  const Imported imported =
      read({numbers("K", {2, 2, 2}, {1, 2, 3, 4, 5, 6, 7, 8}), numbers("M", {2, 2}, {1, 0, 0, 1}), speed});
  EXPECT_EQ(imported.samples.M.size(), 2u);
  EXPECT_EQ(imported.samples.M[1], Matrix::Identity(2, 2));
}

TEST(NamedArrays, OutputsOfAStateSpaceModelAreNoDamping) {
  EXPECT_TRUE(read({A, speed, numbers("C", {1, 2}, {1, 1})}).samples.C.empty());
}

TEST(NamedArrays, Parameter) {
  const NamedArray other = numbers("temperature", {2}, {5, 4}), noise = numbers("noise", {2}, {5, 5});
  EXPECT_EQ(read({A, speed, noise}).parameter, "speed");
  EXPECT_EQ(read({A, speed, other}, {{"parameter", "temperature"}, {"unit", "K"}}).samples.values[0], 5.0);
  EXPECT_EQ(read({A, speed, numbers("parameter", {2}, {1, 2})}).parameter, "p");
  EXPECT_TRUE(test::contains(message({A, speed, other}),
                             "the parameter may be any of speed, temperature; name it with"));
  EXPECT_TRUE(test::contains(message({A, noise}),
                             "no values of a parameter: expected an array 'parameter' of 2 numbers"));
  EXPECT_TRUE(test::contains(message({A, speed}, {{"parameter", "sped"}}), "did you mean 'speed'?"));
  EXPECT_TRUE(test::contains(message({A, speed, numbers("x", {3}, {1, 2, 3})}, {{"parameter", "x"}}),
                             "parameter 'x': expected an array of 2 numbers, one per sample, found 3"));
}

TEST(NamedArrays, OneSample) {
  const Imported imported = read({numbers("A", {2, 2}, {1, 2, 3, 4})});
  EXPECT_TRUE(imported.one_point());
  EXPECT_EQ(imported.parameter, "p");
}

TEST(NamedArrays, States) {
  const Imported imported =
      read({A, speed, texts("state_names", {2}, {"flap", "lag"}), texts("state_units", {2}, {"rad", "rad/s"}),
            numbers("derivative_order", {2}, {2, 1}), texts("frame", {2}, {"fixed", "rotating"})});
  EXPECT_EQ(imported.samples.state_names, (std::vector<std::string>{"flap", "lag"}));
  EXPECT_EQ(imported.samples.state_units, (std::vector<std::string>{"rad", "rad/s"}));
  EXPECT_EQ(imported.samples.derivative_order, (std::vector<int>{2, 1}));
  EXPECT_EQ(imported.samples.state_frames,
            (std::vector<StateFrame>{StateFrame::fixed, StateFrame::rotating}));
}

TEST(NamedArrays, SamplesAreMatchedByNames) {
  const Imported imported = read({A, speed, texts("names", {2, 2}, {"flap", "lag", "lag", "flap"})});
  EXPECT_EQ(imported.samples.A[1], (Matrix{{8.0, 7.0}, {6.0, 5.0}}));
  EXPECT_TRUE(test::contains(message({A, speed, texts("names", {2, 2}, {"flap", "lag", "lag", "pitch"})}),
                             "state_names: sample 2 has no state 'flap'"));
}

TEST(NamedArrays, FaultsNameTheArray) {
  EXPECT_TRUE(test::contains(message({speed}),
                             "no matrices: expected arrays A (and E), or K with M or C; found speed"));
  EXPECT_TRUE(test::contains(message({}), "found none"));
  EXPECT_TRUE(test::contains(message({A, numbers("E", {1, 1}, {1}), speed}), "sample 1 is"));
  EXPECT_TRUE(
      test::contains(message({numbers("K", {1, 1}, {1})}), "expected A (and optionally E), or K with M, C"));
  EXPECT_TRUE(
      test::contains(message({A, speed, texts("frame", {2}, {"fixed", "moving"})}), "found 'moving'"));
  EXPECT_TRUE(
      test::contains(message({A, speed, numbers("order", {2}, {2, 3})}), "order: expected 0, 1 or 2"));
  EXPECT_TRUE(test::contains(message({A, speed, numbers("names", {2}, {2, 3})}),
                             "names: expected texts, found numbers"));
  EXPECT_TRUE(
      test::contains(message({A, speed, texts("names", {3}, {"a", "b", "c"})}), "state_names has 3 entries"));
  EXPECT_TRUE(test::contains(message({A, speed}, {{"digits", "x"}}), "--digits: expected"));
  EXPECT_TRUE(
      test::contains(message({numbers("A", {2, 0, 0}, {})}), "array A is 2 x 0 x 0, without entries"));
  EXPECT_TRUE(test::contains(message({numbers("A", {0, 0}, {})}), "array A is 0 x 0, without entries"));
  NamedArray huge = numbers("A", {6000, 6000}, {});
  EXPECT_TRUE(test::contains(message({huge}), "at most 5000 rows"));
}

}  // namespace
}  // namespace eigentrail::test::named_arrays_test
