// What import writes: a scene that can be used without a hand edit.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/import/importer.hpp"
#include "scene/input_error.hpp"
#include "support/folder.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::write_import_test {
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

Imported polynomial() {
  Imported imported;
  imported.title = "shaft";
  imported.parameter = "speed";
  PolynomialData& family = imported.family.emplace();
  family.M = {Matrix::Identity(2, 2)};
  family.K = {Matrix{{1.0, 0.25}, {0.0, 2.0}}, Matrix(), Matrix{{0.0, 0.0}, {3.0, 0.0}}};
  family.state_names = {"x", "y"};
  family.parameter_unit = "rad/s";
  family.from = -1.0;
  family.to = 2.0;
  return imported;
}

TEST(WriteImport, PolynomialsAreAMatrixFamily) {
  const test::Folder folder;
  const std::string scene = write_import(polynomial(), folder.path(), "model", false);
  const TraceSetup setup = prepare_trace(read_scene(scene), {});
  EXPECT_EQ(setup.options.from, -1.0);
  EXPECT_EQ(setup.options.to, 2.0);
  EXPECT_EQ(setup.model->description().coordinate_names, (std::vector<std::string>{"x", "y"}));
  const Hdf5File file = Hdf5File::open(folder.path() + "/model.h5");
  EXPECT_EQ(file.members("/K"), (std::vector<std::string>{"0", "2"}));
  EXPECT_EQ(file.read_real("/K/0"), (std::vector<double>{1.0, 0.25, 0.0, 2.0}));
  EXPECT_EQ(file.read_real("/K/2"), (std::vector<double>{0.0, 0.0, 3.0, 0.0}));
}

TEST(WriteImport, PolynomialsThatDoNotFitLeaveNothing) {
  const auto message = [](const std::function<void(PolynomialData&)>& change) -> std::string {
    const test::Folder folder;
    Imported imported = polynomial();
    change(*imported.family);
    const std::string result = error_text<std::invalid_argument>(
        [&] { write_import(imported, folder.path() + "/new", "model", false); });
    EXPECT_FALSE(std::filesystem::exists(folder.path() + "/new"));
    return result;
  };
  EXPECT_EQ(message([](auto& f) { f.K[2] = Matrix::Zero(3, 3); }), "K, power 2 is 3 x 3; expected 2 x 2");
  EXPECT_EQ(message([](auto& f) { f.K[0] = Matrix(f.K[0].dense() * NAN); }),
            "K, power 0 has an entry that is not finite");
  EXPECT_EQ(message([](auto& f) { f.K.clear(); }), "expected K with M, C or both, or A and optionally E");
  EXPECT_EQ(message([](auto& f) { f.E = f.M; }), "E cannot stand beside M, C or K");
  EXPECT_EQ(message([](auto& f) {
              f.M.clear();
              f.K.clear();
            }),
            "no matrix K or A");
  EXPECT_EQ(message([](auto& f) { f.state_names = {"x"}; }), "1 names for 2 states");
  EXPECT_EQ(message([](auto& f) {
              f.A = {Matrix::Ones(1, 2), Matrix::Ones(2, 2)};
            }),
            "A, power 1 is 2 x 2; expected 1 x 2");
}

}  // namespace
}  // namespace eigentrail::test::write_import_test
