// What import writes: a scene that can be used without a hand edit.
#include <gtest/gtest.h>

#include <filesystem>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/import/importer.hpp"
#include "support/folder.hpp"
#include "support/scenes.hpp"

namespace eigentrail {
namespace {

Imported oscillator(const std::vector<double>& values) {
  Imported imported;
  imported.title = "an \"oscillator\"";
  imported.parameter = "wind";
  for (const double p : values) {
    imported.samples.values.push_back(p);
    imported.samples.A.push_back(Matrix{{0.0, 1.0}, {-p, -0.1}});
  }
  return imported;
}

TEST(WriteImport, SceneCanBeTraced) {
  const test::Folder folder;
  const std::string scene = write_import(oscillator({1.0, 2.0, 4.0}), folder.path(), "model", false);
  const TraceSetup setup = prepare_trace(read_scene(scene), {});
  EXPECT_EQ(setup.scene.title, "an \"oscillator\"");
  EXPECT_EQ(setup.options.from, 1.0);
  EXPECT_EQ(setup.options.to, 4.0);
}

TEST(WriteImport, OneSampleIsAnOperatingPoint) {
  const test::Folder folder;
  const std::string scene = write_import(oscillator({3.0}), folder.path(), "model", false);
  EXPECT_EQ(prepare_trace(read_scene(scene), {}, Purpose::operating_point).options.from, 3.0);
  EXPECT_THROW(prepare_trace(read_scene(scene), {}), InputError);
}

TEST(WriteImport, ReplacesNothingWithoutForce) {
  const test::Folder folder;
  write_import(oscillator({1.0, 2.0}), folder.path(), "model", false);
  EXPECT_THROW(write_import(oscillator({1.0, 3.0}), folder.path(), "model", false), InputError);
  const std::string scene = write_import(oscillator({1.0, 3.0}), folder.path(), "model", true);
  EXPECT_EQ(prepare_trace(read_scene(scene), {}).options.to, 3.0);
}

TEST(WriteImport, SamplesThatDoNotFitLeaveNoFile) {
  const test::Folder folder;
  Imported imported = oscillator({1.0, 2.0});
  imported.samples.A.pop_back();
  EXPECT_THROW(write_import(imported, folder.path() + "/new", "model", false), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/new/model.toml"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/new/model.h5"));
}

TEST(WriteImport, ErrorsOfEntriesSurviveTheRoundTrip) {
  const test::Folder folder;
  Imported imported = oscillator({2.0, 1.0});
  imported.samples.A_error = {Matrix::Constant(2, 2, 0.2), Matrix::Constant(2, 2, 0.1)};
  write_import(imported, folder.path(), "model", false);
  const SampledData read = read_samples(folder.path() + "/model.h5");
  ASSERT_EQ(read.A_error.size(), 2u);
  EXPECT_EQ(read.A_error[0](1, 0), 0.1);
  EXPECT_EQ(read.A_error[1](1, 0), 0.2);
  imported.samples.A_error[0](0, 1) = -0.2;
  EXPECT_THROW(write_import(imported, folder.path(), "model", true), std::invalid_argument);
}

}  // namespace
}  // namespace eigentrail
