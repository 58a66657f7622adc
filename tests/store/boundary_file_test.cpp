// The file of stability boundaries.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/hdf5_file.hpp"
#include "eigentrail/store/boundary_writer.hpp"
#include "eigentrail/store/output_file.hpp"
#include "stability/boundaries.hpp"

namespace eigentrail::test::boundary_file_test {
namespace {

namespace fs = std::filesystem;

class BoundaryFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = testing::TempDir() + "eigentrail_boundary_" +
             testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder);
    fs::create_directory(folder);
    path = folder + "/flutter.h5";
  }
  void TearDown() override { fs::remove_all(folder); }

  std::vector<std::string> contents() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    return names;
  }

  std::string folder, path;
};

struct Found {
  BoundarySetup setup;
  BoundaryResult result;
};

Found find_in(const std::string& scene) {
  Found all{prepare_boundary(parse_scene(scene, "test.toml"), square_window()), {}};
  all.result = find_boundaries(*all.setup.model, all.setup.options);
  return all;
}

/// Two curves that intersect.
Found two_lines() {
  return find_in(freedoms({{"Q / 2 - P", "1"}, {"0.3 - Q - P", "4"}}));
}

TEST_F(BoundaryFileTest, HoldsWhatWasFound) {
  const auto [setup, result] = two_lines();
  write_durably(path, {boundary_file(setup, result)});
  const Hdf5File file = Hdf5File::open(path);
  const auto P = file.read_real("P");
  const auto Q = file.read_real("Q");
  const auto s = file.read_complex("eigenvalue");
  const auto others = file.read_integers("other_unstable");
  const auto series = file.read_real("dense_output");
  const auto length = file.read_real("step_length");
  const auto left = file.read_integers("step_point");
  std::size_t i = 0, step = 0, element = 0;
  for (const BoundaryCurve& curve : result.curves) {
    for (const BoundaryStep& dense : curve.steps) {
      EXPECT_EQ(length[step], dense.length);
      EXPECT_EQ(static_cast<std::size_t>(left[step++]), i);
      for (Eigen::Index row = 0; row < 4; ++row) {
        for (const Matrix* end : {&dense.left, &dense.right}) {
          for (Eigen::Index k = 0; k < end->cols(); ++k) EXPECT_EQ(series[element++], (*end)(row, k));
        }
      }
      ++i;
    }
    i -= curve.steps.size();
    for (const BoundaryPoint& point : curve.points) {
      EXPECT_EQ(Place(P[i], Q[i]), point.place);
      EXPECT_EQ(s[i], point.s);
      EXPECT_EQ(others[i++], point.others);
    }
  }
  EXPECT_EQ(i, P.size());
  EXPECT_EQ(element, series.size());
  ASSERT_EQ(file.read_texts("corner_kind").size(), 1U);
  const auto corner = file.read_real("corner_parameter");
  EXPECT_EQ(Place(corner[0], corner[1]), result.corners[0].place);
  EXPECT_EQ(file.text_attribute("status"), "completed");
}

TEST_F(BoundaryFileTest, NothingFoundIsAFileWithEmptyLists) {
  const auto [setup, result] = find_in(freedoms({{"3 + P + Q", "1"}}));
  write_durably(path, {boundary_file(setup, result)});
  const Hdf5File file = Hdf5File::open(path);
  for (const char* name :
       {"point", "step", "curve", "corner", "P", "Q", "eigenvalue", "dense_output", "curve_kind"})
    EXPECT_EQ(file.shape(name)[0], 0U) << name;
  EXPECT_EQ(file.shape("parameter")[0], 2U);
}

TEST_F(BoundaryFileTest, OneThatCannotBeMadeIsAnError) {
  Found broken = two_lines();
  broken.result.curves[0].points.pop_back();  // its datasets no longer fit
  broken.result.curves[0].steps[0].left.setZero(4, 1);
  EXPECT_THROW(boundary_file(broken.setup, broken.result), std::runtime_error);
}

TEST_F(BoundaryFileTest, ParametersNamedLikeADatasetAreRefused) {
  for (const std::string name : {"eigenvalue", "curve", "step_point"}) {
    const std::string scene = "[parameters]\nQ = 0\n" + name +
                              " = 1\n[trace]\nparameter = \"Q\"\nfrom = 0\nto = 1\n[matrix_family]\n"
                              "M = [[[1]]]\nC = [[[\"" +
                              name + "\"]]]\nK = [[[\"1 + Q\"]]]\n";
    BoundaryRequest request = square_window();
    request.second = name;
    const BoundarySetup setup = prepare_boundary(parse_scene(scene, "test.toml"), request);
    EXPECT_THROW(check_boundary_names(setup), InputError) << name;
  }
}

}  // namespace
}  // namespace eigentrail::test::boundary_file_test
