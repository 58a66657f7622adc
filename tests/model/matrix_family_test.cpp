// Families of matrices: polynomials in the traced parameter, entries that are expressions.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/hdf5_writer.hpp"
#include "scene/input_error.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::matrix_family_test {
namespace {

constexpr double tolerance = 1e-14;

const std::string flutter = R"(
[trace]
parameter = "p"
from = 0
to = 0.4
[matrix_family]
M = [ [[1, 0], [0, 1]] ]
K = [ [[1, 0], [0, 2]], [[0, 1], [-1, 0]] ]
)";

Linearization linearize(const Setting& setting, double p, int order) {
  Path path;
  path.parameters = VectorSeries::Zero(static_cast<Eigen::Index>(setting.scene.parameters.size()), 2);
  path.parameters.col(0) = setting.scene.parameters.declared_values();
  const int traced = setting.parameter(setting.options.parameter);
  path.parameters(traced, 0) = p;
  path.parameters(traced, 1) = 1.0;
  path.x = Vector::Zero(setting.model->n_coordinates());
  path.lambda = Vector::Zero(setting.model->n_constraints());
  Linearization lin;
  EvaluationCounts counts = setting.model->new_counts();
  EXPECT_FALSE(setting.model->linearize(path, order, lin, counts));
  return lin;
}

TEST(MatrixFamily, PolynomialIsExpandedAboutThePoint) {
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = [ [[1]] ]\nK = [ [[5]], [[3]], "
      "[[-2]], [[4]] ]\n");
  const double p = 0.7;
  const Linearization lin = linearize(setting, p, 4);
  ASSERT_EQ(lin.K.size(), 4U);  // the cubic ends at order 3
  EXPECT_NEAR(lin.K[0](0, 0), 5 + 3 * p - 2 * p * p + 4 * p * p * p, tolerance * 10);
  EXPECT_NEAR(lin.K[1](0, 0), 3 - 4 * p + 12 * p * p, tolerance * 10);
  EXPECT_NEAR(lin.K[2](0, 0), -2 + 12 * p, tolerance * 10);
  EXPECT_NEAR(lin.K[3](0, 0), 4, tolerance * 10);
  EXPECT_EQ(lin.M.size(), 1U);  // constants have one coefficient
  EXPECT_EQ(lin.C.size(), 1U);
}

/// Structure of K(p) with these rows of its lowest power; C as well.
Structure structure_of(const std::string& K, const std::string& C) {
  const Setting setting = make_setting(
      "[parameters]\nk = 100\nc = 3\nl = 2\n[trace]\nparameter = \"v\"\nfrom = 0\nto = 1\n[matrix_family]\n"
      "M = [ [[1, 0], [0, \"1 + 0*(k + c + l)\"]] ]\nC = [ " +
      C + " ]\nK = [ " + K + ", [[0, 1], [1, 0]] ]\n");
  return setting.model->structure(setting.parameter("v"));
}

TEST(MatrixFamily, SymmetryOfExpressionsIsSeen) {
  const std::string no_damping = "[[0, 0], [0, 0]]";
  for (const std::string K : {R"([["2*k", "-k"], ["-k", "k"]])", R"([["k", "k*l"], ["l*k", 1]])",
                              R"([["k", 2], [2, "k"]])", R"([["k^2", "-k*l"], ["-l*k", "k"]])"})
    EXPECT_FALSE(structure_of(K, no_damping).circulatory) << K;
  for (const std::string K : {R"([["2*k", "-k"], ["k", "k"]])", R"([["2*k", "-k"], [-100, "k"]])",
                              R"([["2*k", "k"], ["l", "k"]])", R"([["2*k", "k"], [0, "k"]])",
                              // Equal at the values of the scene, and nowhere else.
                              R"([["2*k", "k"], ["50*l", "k"]])"})
    EXPECT_TRUE(structure_of(K, no_damping).circulatory) << K;
}

TEST(MatrixFamily, SkewDampingOfExpressionsIsGyroscopic) {
  const std::string K = R"([["k", 0], [0, "k"]])";
  const Structure skew = structure_of(K, R"([[0, "c*l"], ["-l*c", 0]])");
  EXPECT_TRUE(skew.gyroscopic && !skew.damped);
  const Structure symmetric = structure_of(K, R"([["c", "-c"], ["-c", "2*c"]])");
  EXPECT_TRUE(!symmetric.gyroscopic && symmetric.damped);
  const Structure neither = structure_of(K, R"([["c", "c*l"], ["-l*c", 0]])");
  EXPECT_TRUE(neither.gyroscopic && neither.damped);
}

/// x'' + c x' + (2 + p) x = 0 and another one, coupled; in both orders.
TEST(MatrixFamily, FirstOrderFormHasTheSameLociAsTheSecondOrderForm) {
  const std::string range =
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 2\ntolerance = 1e-9\n[matrix_family]\n";
  const Setting second = make_setting(range +
                                      "M = [ [[1, 0], [0, 2]] ]\nC = [ [[0.1, 0.5], [-0.5, 0.2]] ]\nK = [ "
                                      "[[2, 0], [0, 9]], [[1, 0.3], [0.2, 0]] ]\n");
  const Setting first =
      make_setting(range +
                   "E = [ [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]] ]\n"
                   "A = [ [[0, 0, 1, 0], [0, 0, 0, 1], [-2, 0, -0.1, -0.5], [0, -9, 0.5, -0.2]],\n"
                   "[[0, 0, 0, 0], [0, 0, 0, 0], [\"-1\", -0.3, 0, 0], [-0.2, 0, 0, 0]] ]\n"
                   "state_names = [\"x\", \"y\", \"u\", \"v\"]\n");
  EXPECT_EQ(first.model->description().coordinate_names, (std::vector<std::string>{"x", "y", "u", "v"}));
  const RecordedTrace one = record_trace(first);
  const RecordedTrace two = record_trace(second);
  ASSERT_EQ(one.result.status, TraceStatus::completed);
  EXPECT_EQ(one.result.n_infinite, 0);
  EXPECT_GT(one.result.counts.modes.modal_bases, 0u) << "all modes at once";
  EXPECT_EQ(one.result.certified_steps, one.result.mode_steps);
  const std::size_t last = one.nodes.size() - 1;
  EXPECT_LT((one.eigenvalues_of_node(last) - two.eigenvalues_of_node(two.nodes.size() - 1)).norm(), 1e-12);
  for (const double p : {0.3, 0.9, 1.7})
    EXPECT_LT((one.eigenvalues_at(p) - two.eigenvalues_at(p)).norm(), 1e-8);
}

TEST(MatrixFamily, EIsTheIdentityAndMIsZeroIfAbsent) {
  const std::string range = "[trace]\nparameter = \"p\"\nfrom = 0\nto = 2\n[matrix_family]\n";
  const Linearization state =
      linearize(make_setting(range + "A = [ [[0, 1], [-1, -1]], [[0, 0], [0, 1]] ]\n"), 0.5, 2);
  const Linearization mixed = linearize(
      make_setting(range + "C = [ [[1, 0], [0, 1]] ]\nK = [ [[0, -1], [1, 1]], [[0, 0], [0, -1]] ]\n"), 0.5,
      2);
  for (const Linearization* lin : {&state, &mixed}) {
    EXPECT_EQ(lin->M[0](1, 1), 0.0);
    EXPECT_EQ(lin->C[0](1, 1), 1.0);
    EXPECT_NEAR(lin->K[0](1, 1), 0.5, tolerance);
    EXPECT_NEAR(lin->K[1](1, 1), -1.0, tolerance);
  }
}

TEST(MatrixFamily, FirstOrderFormsThatMakeNoSenseAreRefused) {
  const std::string range = "[trace]\nparameter = \"p\"\nfrom = 0\nto = 2\n[matrix_family]\n";
  const auto message = [&](const std::string& matrices) {
    return input_error([&] { make_setting(range + matrices); });
  };
  EXPECT_NE(message("E = [ [[1]] ]\nK = [ [[1]], [[1]] ]\n").find("beside M, C and K"), std::string::npos);
  EXPECT_NE(message("E = [ [[1]] ]\n").find("E without A"), std::string::npos);
  EXPECT_NE(message("A = [ [[1, 2]] ]\n").find("A: is 1 x 2; expected a square matrix"), std::string::npos);
  EXPECT_NE(message("E = [ [[1, 0], [0, 1]] ]\nA = [ [[1]], [[1]] ]\n").find("E: is 2 x 2, A is 1 x 1"),
            std::string::npos);
  EXPECT_NE(message("A = [ [[1]], [[1]] ]\nstate_names = [\"a\", \"b\"]\n").find("2 names for 1 states"),
            std::string::npos);
}

TEST(MatrixFamily, EntriesMayBeExpressionsOfTheTracedParameter) {
  const Setting setting = make_setting(
      "[parameters]\na = 0.5\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 6\n"
      "[matrix_family]\nM = [ [[1]] ]\nC = [ [[\"2*(1 + a*cos(p))\"]] ]\nK = [ [[1]] ]\n");
  const double p = 1.3;
  const Linearization lin = linearize(setting, p, 4);
  const double expected[] = {2 + std::cos(p), -std::sin(p), -std::cos(p) / 2, std::sin(p) / 6,
                             std::cos(p) / 24};
  for (int k = 0; k <= 4; ++k)
    EXPECT_NEAR(lin.C[static_cast<std::size_t>(k)](0, 0), expected[k], tolerance * 4) << k;
}

/// A family in an HDF5 file beside the scene.
class FamilyFile : public testing::Test {
 protected:
  void SetUp() override {
    file = std::string("eigentrail_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
    std::filesystem::remove(folder + file);
  }
  void TearDown() override { std::filesystem::remove(folder + file); }

  void add(Hdf5Writer& target, const std::string& dataset, double value) {
    DatasetSpec spec;
    spec.name = dataset;
    spec.shape = {1, 1};
    target.create_dataset(spec);
    target.write_rows(dataset, 0, std::vector<double>{value});
  }
  Setting setting() const {
    return {prepare_trace(
        parse_scene(
            "[trace]\nparameter = \"p\"\nfrom = 0\nto = 2\n[matrix_family]\nfile = \"" + file + "\"\n",
            folder + "scene.toml"),
        {})};
  }

  std::string folder = testing::TempDir();
  std::string file;
};

TEST_F(FamilyFile, PowersThatAreMissingAreZero) {
  {
    Hdf5Writer target = Hdf5Writer::create(folder + file);
    add(target, "M/0", 1.0);
    add(target, "K/0", 4.0);
    add(target, "K/2", 3.0);
    add(target, "C/1", 0.5);
  }
  const Linearization lin = linearize(setting(), 2.0, 2);
  EXPECT_EQ(lin.K[0](0, 0), 16.0);
  EXPECT_EQ(lin.K[1](0, 0), 12.0);
  EXPECT_EQ(lin.C[0](0, 0), 1.0);
}

TEST_F(FamilyFile, UnknownGroupsAndPowersAreRefused) {
  for (const char* wrong : {"D/0", "c/0", "K/one", "K/17"}) {
    std::filesystem::remove(folder + file);
    {
      Hdf5Writer target = Hdf5Writer::create(folder + file);
      add(target, "M/0", 1.0);
      add(target, "K/0", 4.0);
      add(target, "K/1", 4.0);
      add(target, wrong, 1.0);
    }
    EXPECT_THROW((void)setting(), InputError) << wrong;
  }
}

TEST_F(FamilyFile, LinksOutOfTheFolderAreNotFollowed) {
  const std::filesystem::path elsewhere = std::filesystem::path(folder) / "eigentrail_elsewhere";
  const std::filesystem::path beside = std::filesystem::path(folder) / "eigentrail_scene_folder";
  std::filesystem::remove_all(elsewhere);
  std::filesystem::remove_all(beside);
  std::filesystem::create_directories(elsewhere);
  std::filesystem::create_directories(beside);
  {
    Hdf5Writer target = Hdf5Writer::create((elsewhere / file).string());
    add(target, "M/0", 1.0);
    add(target, "K/0", 4.0);
    add(target, "K/1", 3.0);
  }
  std::filesystem::create_symlink(elsewhere / file, beside / file);
  folder = beside.string() + "/";
  EXPECT_TRUE(contains(input_error([&] { (void)setting(); }), "leads out of the scene's folder, to "));
  std::filesystem::remove(beside / file);
  std::filesystem::copy_file(elsewhere / file, beside / "real.h5");
  std::filesystem::create_symlink("real.h5", beside / file);
  EXPECT_NO_THROW((void)setting()) << "a link within the folder";
  std::filesystem::remove_all(elsewhere);
  std::filesystem::remove_all(beside);
}

TEST_F(FamilyFile, HoldsNoMoreNumbersThanItsLimit) {
  {
    Hdf5Writer target = Hdf5Writer::create(folder + file);
    DatasetSpec spec;
    spec.name = "M/0";
    spec.shape = {5001, 1};
    target.create_dataset(spec);
    add(target, "K/0", 4.0);
  }
  EXPECT_TRUE(contains(input_error([&] { (void)setting(); }), "expected a matrix of at most 5000 rows"));
}

TEST(MatrixFamily, VariableMayBeDerivedAndHasItsSiValueEverywhere) {
  const std::string matrices = "[matrix_family]\nM = [ [[1]] ]\nK = [ [[1]], [[1]] ]\n";
  const Setting derived = make_setting(
      "[parameters]\nb = 0.1\np = \"2 * b\"\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 0.4\n" + matrices,
      {{"parameter", "b"}, {"from", "0"}, {"to", "0.4"}});
  const RecordedTrace recorded = record_trace(derived);
  EXPECT_NEAR(recorded.nodes.back().s(0, 0).imag(), std::sqrt(1.8), 1e-12);
  const Setting rpm = make_setting(
      "[parameters]\np = { value = 0, unit = \"rpm\" }\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 60\n" +
      matrices);
  EXPECT_NEAR(record_trace(rpm).nodes.back().s(0, 0).imag(), std::sqrt(1.0 + 2.0 * M_PI), 1e-12);
}

TEST(MatrixFamily, AnotherTracedParameterLeavesTheVariableWhereItsTraceBegins) {
  const Setting setting = make_setting(
      "[parameters]\nb = 0.5\n[trace]\nparameter = \"p\"\nfrom = \"b + 1\"\nto = 4\n[matrix_family]\nM = [ "
      "[[1]] ]\n"
      "C = [ [[\"b\"]] ]\nK = [ [[0]], [[1]] ]\n",
      {{"parameter", "b"}, {"from", "0"}, {"to", "0.5"}});
  EXPECT_NEAR(record_trace(setting).nodes.front().s(0, 0).imag(), std::sqrt(1.5), 1e-12);
}

TEST(MatrixFamily, EquilibriumIsKnownAndNeverSolved) {
  const Setting setting = make_setting(flutter);
  const Structure structure = setting.model->structure(0);
  EXPECT_TRUE(structure.known_equilibrium && structure.constant_mass && structure.circulatory);
  EXPECT_FALSE(structure.constant_stiffness || structure.damped || structure.gyroscopic);
  const RecordedTrace recorded = completed_trace(setting);
  EXPECT_EQ(recorded.result.counts.equilibrium_iterations, 0U);
  EXPECT_EQ(recorded.result.counts.equilibrium_factorizations, 0U);
}

TEST(MatrixFamily, ConstraintsThatTurnWithTheParameterTurnTheBasis) {
  // A(p) = [cos p, sin p]: the free direction is {-sin p, cos p}, so s^2 = -(k1 sin^2 p + k2 cos^2 p).
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 6\ntolerance = 1e-9\n[matrix_family]\nM = [ [[1, 0], [0, "
      "1]] ]\n"
      "K = [ [[1, 0], [0, 4]] ]\nA = [ [[\"cos(p)\", \"sin(p)\"]] ]\n");
  const RecordedTrace recorded = completed_trace(setting);
  for (int i = 0; i <= 300; ++i) {
    const double p = 6.0 * i / 300.0;
    const double expected = std::sqrt(std::pow(std::sin(p), 2) + 4.0 * std::pow(std::cos(p), 2));
    EXPECT_NEAR(recorded.eigenvalues_at(p)[0].imag(), expected, 4e-9 * expected);
  }
}

}  // namespace
}  // namespace eigentrail::test::matrix_family_test
