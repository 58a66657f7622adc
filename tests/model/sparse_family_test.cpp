// Families with sparse matrices in files, and with factors that are functions of parameters.
#include <gtest/gtest.h>

#include <fstream>

#include "core/hdf5_writer.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "scene/input_error.hpp"
#include "support/folder.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::sparse_family_test {
namespace {

void write(Hdf5Writer& file, const std::string& name, const std::vector<double>& data,
           const std::vector<std::int64_t>& indices, const std::vector<std::int64_t>& starts) {
  file.create_dataset({name + "/data", ElementType::real, {data.size()}, false, {}});
  if (!data.empty()) file.write_rows(name + "/data", 0, data);
  file.create_dataset({name + "/indices", ElementType::integer, {indices.size()}, false, {}});
  if (!indices.empty()) file.write_rows(name + "/indices", 0, indices);
  file.create_dataset({name + "/indptr", ElementType::integer, {starts.size()}, false, {}});
  file.write_rows(name + "/indptr", 0, starts);
}

/// M = I, K0 = [[2, -1], [-1, 3]], K2 = diag(0.5, 0), K of a spring on the second coordinate.
class SparseFamilyFile : public ::testing::Test {
 protected:
  SparseFamilyFile() {
    Hdf5Writer file = Hdf5Writer::in_memory("family.h5");
    write(file, "M/0", {1.0, 1.0}, {0, 1}, {0, 1, 2});
    write(file, "K/0", {2.0, -1.0, -1.0, 3.0}, {0, 1, 0, 1}, {0, 2, 4});
    write(file, "K/2", {0.5}, {0}, {0, 1, 1});
    write(file, "K/spring", {1.0}, {1}, {0, 0, 1});
    put(file);
  }

  void put(Hdf5Writer& file) const {
    const std::string image = file.image();
    std::ofstream(folder_.path() + "/family.h5", std::ios::binary) << image;
  }

  Setting setting(const std::string& family = "factors = { spring = \"k/2\" }") const {
    const std::string path = folder_.path() + "/scene.toml";
    std::ofstream(path) << "[parameters]\np = 0\nk = 3\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n"
                           "[matrix_family]\nfile = \"family.h5\"\n" +
                               family + "\n";
    Setting result;
    static_cast<TraceSetup&>(result) = prepare_trace(read_scene(path), {});
    return result;
  }

  Folder folder_;
};

TEST_F(SparseFamilyFile, MatricesAreSumsOfTermsWithTheirFactors) {
  const Setting given = setting();
  const auto& family = dynamic_cast<const SparseFamily&>(*given.model);
  Vector parameters(2);
  parameters << 0.6, 3.0;
  const Matrix K = family.at(parameters).K.front().matrix;
  EXPECT_NEAR(K(0, 0), 2.0 + 0.5 * 0.36, 1e-15);
  EXPECT_NEAR(K(1, 1), 3.0 + 1.5, 1e-15);
  EXPECT_EQ(K(0, 1), -1.0);
  EXPECT_TRUE(family.coefficient_matrices(family.description().parameters.declared_values(), 0)
                  .K.empty());  // of size n^2
}

TEST_F(SparseFamilyFile, LinearizationIsTheSeriesOfTheSum) {
  const Setting given = setting();
  Path path;
  path.parameters = VectorSeries::Zero(2, 2);
  path.parameters << 0.6, 1.0, 3.0, 0.0;
  path.x = Vector::Zero(2);
  Linearization series;
  EvaluationCounts counts = given.model->new_counts();
  ASSERT_FALSE(given.model->linearize(path, 4, series, counts));
  ASSERT_EQ(series.K.size(), 3U);
  EXPECT_TRUE(series.K[0].is_sparse());
  EXPECT_NEAR(series.K[1](0, 0), 0.5 * 2 * 0.6, 1e-15);
  EXPECT_NEAR(series.K[2](0, 0), 0.5, 1e-15);
  EXPECT_EQ(series.M.size(), 1U);
}

TEST_F(SparseFamilyFile, SmallOnesAreTracedByTheDenseEngine) {
  const RecordedTrace trace = completed_trace(setting());
  const ComplexVector s = trace.eigenvalues_at(0.6);
  const double a = 2.18, b = 4.5, mean = 0.5 * (a + b), half = std::sqrt(0.25 * (a - b) * (a - b) + 1.0);
  EXPECT_NEAR(s[0].imag(), std::sqrt(mean - half), 1e-6);
  EXPECT_NEAR(s[1].imag(), std::sqrt(mean + half), 1e-6);
}

TEST_F(SparseFamilyFile, MatricesWithNamesNeedFactors) {
  const std::string message = input_error([&] { (void)setting(""); });
  EXPECT_TRUE(contains(message, "/K/spring")) << message;
  EXPECT_TRUE(contains(message, "factors = { spring")) << message;
}

TEST_F(SparseFamilyFile, FactorsNeedMatrices) {
  const std::string message = input_error([&] { (void)setting("factors = { spring = \"k\", sprng = 2 }"); });
  EXPECT_TRUE(contains(message, "'sprng' is the name of no matrix in the file; it has spring")) << message;
}

TEST_F(SparseFamilyFile, DamagedMatricesAreRefused) {
  const auto refused = [&](const std::vector<double>& data, const std::vector<std::int64_t>& indices,
                           const std::vector<std::int64_t>& starts, const std::string& expected) {
    Hdf5Writer file = Hdf5Writer::in_memory("family.h5");
    write(file, "M/0", {1.0, 1.0}, {0, 1}, {0, 1, 2});
    write(file, "K/0", data, indices, starts);
    put(file);
    const std::string message = input_error([&] { (void)setting("factors = {}"); });
    EXPECT_TRUE(contains(message, expected)) << message;
    EXPECT_TRUE(contains(message, "/K/0")) << message;
  };
  refused({1.0, 2.0}, {0, 1}, {0, 2, 1}, "indptr does not ascend");
  refused({1.0, 2.0}, {0, 1}, {0, 1, 3}, "indptr does not ascend");
  refused({1.0, 2.0}, {0, 1}, {1, 1, 2}, "indptr does not ascend");
  refused({1.0, 2.0}, {0, 2}, {0, 1, 2}, "an entry in column 2 (from 0)");
  refused({1.0, 2.0}, {0, -1}, {0, 1, 2}, "an entry in column -1");
  refused({1.0, 2.0}, {0}, {0, 1, 2}, "lists data and indices of one length");
  refused({1.0, NAN}, {0, 1}, {0, 1, 2}, "not finite");
  refused({1.0}, {0}, {0, 1, 1, 1}, "all have the same size");
}

TEST_F(SparseFamilyFile, AMatrixWithoutDataIsRefused) {
  Hdf5Writer file = Hdf5Writer::in_memory("family.h5");
  file.create_dataset({"K/0/indptr", ElementType::integer, {3}, false, {}});
  put(file);
  EXPECT_TRUE(contains(input_error([&] { (void)setting("factors = {}"); }), "has no dataset data"));
}

TEST_F(SparseFamilyFile, StatesMayHaveNames) {
  const Setting named = setting("factors = { spring = \"k\" }\nstate_names = [\"flap\", \"lag\"]");
  EXPECT_EQ(named.model->description().coordinate_names, (std::vector<std::string>{"flap", "lag"}));
  const auto message = [&](const std::string& names) {
    return input_error([&] { (void)setting("factors = { spring = \"k\" }\nstate_names = " + names); });
  };
  EXPECT_TRUE(contains(message(R"(["flap"])"), "has 1 names for 2 states"));
  EXPECT_TRUE(contains(message(R"(["flap", "flap"])"), "has 'flap' twice, for states 1 and 2"));
}

}  // namespace
}  // namespace eigentrail::test::sparse_family_test
