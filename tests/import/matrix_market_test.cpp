// Families and samples from files of the Matrix Market.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "eigentrail/import/importer.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "scene/input_error.hpp"
#include "support/folder.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::matrix_market_test {
namespace {

class MatrixMarket : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() + "/" + name) << text;
    return folder_.path() + "/" + name;
  }

  /// A diagonal matrix 2 x 2.
  std::string diagonal(const std::string& name, double a, double b) const {
    return write(name, "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 " + std::to_string(a) +
                           "\n2 2 " + std::to_string(b) + "\n");
  }

  static Imported read(const std::vector<std::string>& files,
                       const std::map<std::string, std::string>& options = {}) {
    return importer("matrix-market").read({files, options});
  }

  static std::string message(const std::vector<std::string>& files,
                             const std::map<std::string, std::string>& options = {}) {
    return test::input_error([&] { read(files, options); });
  }

  test::Folder folder_;
};

TEST_F(MatrixMarket, PowersBecomeAFamily) {
  const Imported imported =
      read({diagonal("M0.mtx", 1, 1), diagonal("rotor_K0.mtx", 1, 2), diagonal("K_2.mtx", 3, -1)},
           {{"parameter", "speed"}, {"unit", "rad/s"}, {"to", "0.5"}});
  ASSERT_TRUE(imported.family);
  EXPECT_EQ(imported.parameter, "speed");
  EXPECT_FALSE(imported.one_point());
  EXPECT_TRUE(imported.warnings.empty());
  EXPECT_EQ(imported.family->M.size(), 1u);
  ASSERT_EQ(imported.family->K.size(), 3u);
  EXPECT_EQ(imported.family->K[1].size(), 0);
  EXPECT_EQ(imported.family->K[2].dense(), (Matrix{{3.0, 0.0}, {0.0, -1.0}}));

  const std::string scene = write_import(imported, folder_.path() + "/out", "model", false);
  const TraceSetup setup = prepare_trace(read_scene(scene), {});
  EXPECT_EQ(setup.options.from, 0.0);
  EXPECT_EQ(setup.options.to, 0.5);
}

TEST_F(MatrixMarket, FirstOrderFamilyWithNames) {
  const std::string names = write("names", "flap\n\nlag, blade 1\n");
  const Imported imported =
      read({diagonal("E.mtx", 1, 2), diagonal("A1.mtx", -1, -2), diagonal("A0.mtx", -1, -3)},
           {{"state-names", names}});
  ASSERT_TRUE(imported.family);
  EXPECT_EQ(imported.family->state_names, (std::vector<std::string>{"flap", "lag, blade 1"}));
  EXPECT_EQ(imported.warnings.size(), 1u);  // the range is a guess
  const std::string scene = write_import(imported, folder_.path(), "model", false);
  const TraceSetup setup = prepare_trace(read_scene(scene), {});
  EXPECT_EQ(setup.model->description().coordinate_names, imported.family->state_names);
}

/// A chain of n masses, sparse; and its stiffness that grows with the parameter.
TEST_F(MatrixMarket, LargeSparseMatricesStaySparse) {
  constexpr int n = 6000;
  std::string mass = "%%MatrixMarket matrix coordinate real symmetric\n6000 6000 6000\n";
  std::string chain = "%%MatrixMarket matrix coordinate real symmetric\n6000 6000 11999\n";
  for (int i = 1; i <= n; ++i) {
    const std::string place = std::to_string(i) + " " + std::to_string(i);
    mass += place + " 1\n";
    chain += place + " 2\n";
    if (i > 1) chain += std::to_string(i) + " " + std::to_string(i - 1) + " -1\n";
  }
  const Imported imported =
      read({write("M0.mtx", mass), write("K0.mtx", chain), write("K1.mtx", mass)}, {{"to", "1e-3"}});
  ASSERT_TRUE(imported.family);
  EXPECT_TRUE(imported.family->K[0].is_sparse());
  EXPECT_EQ(imported.family->K[0].sparse().nonZeros(), 3 * n - 2);
  const std::string scene = write_import(imported, folder_.path(), "model", false);
  const TraceSetup setup = prepare_trace(read_scene(scene), {});
  EXPECT_EQ(setup.options.modes.count, 6);  // all modes of so large a model cannot be followed
  const auto& family = dynamic_cast<const SparseFamily&>(*setup.model);
  EXPECT_EQ((SparseMatrix(family.pencil().K[0].matrix - imported.family->K[0].sparse())).norm(), 0.0);
  EXPECT_LT(std::filesystem::file_size(folder_.path() + "/model.h5"), 2'000'000U);
}

TEST_F(MatrixMarket, LargeSparseMatricesNeedAPower) {
  const std::string one =
      write("M0.mtx", "%%MatrixMarket matrix coordinate real general\n200 200 1\n1 1 1\n");
  const std::string other =
      write("K0.mtx", "%%MatrixMarket matrix coordinate real general\n200 200 1\n1 1 1\n");
  EXPECT_TRUE(test::contains(message({one, other}), "a large model needs one, such as K1.mtx"));
}

TEST_F(MatrixMarket, ConstraintsBesideMAndK) {
  const std::string row = write("A0.mtx", "%%MatrixMarket matrix array real general\n1 2\n1\n1\n");
  const Imported imported =
      read({row, diagonal("M0.mtx", 1, 1), diagonal("K0.mtx", 1, 2), diagonal("K1.mtx", 1, 0)});
  const std::string scene = write_import(imported, folder_.path(), "model", false);
  EXPECT_EQ(prepare_trace(read_scene(scene), {}).model->description().constraint_names.size(), 1u);
}

TEST_F(MatrixMarket, ConstantsAreOneSample) {
  const Imported imported = read({diagonal("M.mtx", 1, 1), diagonal("K.mtx", 1, 2)});
  EXPECT_TRUE(imported.one_point());
  EXPECT_EQ(imported.samples.K, (std::vector<Matrix>{Matrix{{1.0, 0.0}, {0.0, 2.0}}}));
  const std::string scene = write_import(imported, folder_.path(), "model", false);
  EXPECT_NO_THROW(prepare_trace(read_scene(scene), {}, Purpose::operating_point));
}

TEST_F(MatrixMarket, TableOfSamples) {
  diagonal("a.mtx", -1, -2);
  diagonal("b.mtx", -2, -2);
  diagonal("e.mtx", 1, 1);
  const Imported imported = read({write("t.csv", "wind [m/s],A,E\n3,a.mtx,e.mtx\n5,b.mtx,e.mtx\n")});
  EXPECT_EQ(imported.parameter, "wind");
  EXPECT_EQ(imported.title, "t");
  EXPECT_EQ(imported.samples.parameter_unit, "m/s");
  EXPECT_EQ(imported.samples.values, (std::vector<double>{3.0, 5.0}));
  EXPECT_EQ(imported.samples.A[1](0, 0), -2.0);
  EXPECT_EQ(imported.samples.E[0], imported.samples.E[1]);
}

TEST_F(MatrixMarket, NamesThatDoNotSayWhat) {
  const std::string good = diagonal("K0.mtx", 1, 2);
  EXPECT_TRUE(test::contains(message({diagonal("K.5.mtx", 1, 2)}), "the name does not say"));
  EXPECT_TRUE(test::contains(message({diagonal("K17.mtx", 1, 2)}), "powers of the parameter up to 16"));
  EXPECT_TRUE(test::contains(message({good, diagonal("b_K0.mtx", 1, 2)}), "is power 0 of K, and so is"));
}

TEST_F(MatrixMarket, MatricesThatDoNotFit) {
  const std::string M = diagonal("M0.mtx", 1, 1), K = diagonal("K0.mtx", 1, 2), A = diagonal("A0.mtx", 1, 2);
  const std::string K1 = diagonal("K1.mtx", 1, 1), E = diagonal("E0.mtx", 1, 1);
  const std::string wide = write("A3.mtx", "%%MatrixMarket matrix array real general\n1 2\n1\n1\n");
  EXPECT_TRUE(test::contains(message({K, K1}), "expected K with M, C or both"));
  EXPECT_TRUE(test::contains(message({E}), "E without A"));
  EXPECT_TRUE(test::contains(message({E, K, M}), "E belongs to E x' = A x"));
  EXPECT_TRUE(
      test::contains(message({wide}), "A3.mtx: the matrix is 1 x 2; expected 2 x 2, a square matrix"));
  EXPECT_TRUE(test::contains(message({M, K, A}), "no matrix has a power of the parameter"));
  EXPECT_TRUE(test::contains(message({M, K, A, wide, K1}), "A3.mtx: the matrix is 1 x 2; expected 2 x 2"));
}

TEST_F(MatrixMarket, TablesThatDoNotFit) {
  const std::string K = diagonal("K0.mtx", 1, 2);
  EXPECT_TRUE(test::contains(message({write("c.csv", "p,K,K\n1,K0.mtx,K0.mtx\n")}), "has two columns K"));
  EXPECT_TRUE(test::contains(message({K, write("e.csv", "p,A\n1,K0.mtx\n")}), "expected one table (.csv)"));
  write("small.mtx", "%%MatrixMarket matrix array real general\n1 1\n1\n");
  EXPECT_TRUE(test::contains(message({write("f.csv", "p,A\n1,K0.mtx\n2,small.mtx\n")}),
                             "small.mtx: the matrix is 1 x 1; expected 2 x 2"));
}

TEST_F(MatrixMarket, OptionsThatDoNotFit) {
  const std::vector<std::string> files{diagonal("M0.mtx", 1, 1), diagonal("K0.mtx", 1, 2),
                                       diagonal("K1.mtx", 1, 1)};
  EXPECT_TRUE(test::contains(message(files, {{"to", "far"}}), "--to: expected a number, found 'far'"));
  EXPECT_TRUE(test::contains(message(files, {{"to", "0"}}), "--to: equals --from"));
  EXPECT_TRUE(test::contains(message(files, {{"digits", "6"}}), "--digits: holds for samples"));
  EXPECT_TRUE(test::contains(message(files, {{"parameter", "wind speed"}}), "--parameter: expected a name"));
  EXPECT_TRUE(test::contains(message(files, {{"state-names", write("n1", "a\n")}}),
                             "n1:1: the file ends after 1 names"));
  EXPECT_TRUE(
      test::contains(message(files, {{"state-names", write("n3", "a\nb\nc\n")}}), "n3:3: a name too many"));
  EXPECT_TRUE(test::contains(message({files[0], files[1]}, {{"to", "1"}}), "do not depend on a parameter"));
}

}  // namespace
}  // namespace eigentrail::test::matrix_market_test
