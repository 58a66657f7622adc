// Mass, damping and stiffness of Nastran.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "eigentrail/import/importer.hpp"
#include "scene/input_error.hpp"
#include "support/folder.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::nastran_test {
namespace {

/// A matrix 2 x 2 as text of OUTPUT4.
std::string op4(const std::string& name, double a, double b, double c, double d) {
  std::string padded = name;
  padded.resize(8, ' ');
  const auto number = [](double x) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%23.16E", x);
    return std::string(text.data());
  };
  return "       2       2       1       2" + padded + "1P,3E23.16\n       1       1       2\n" + number(a) +
         number(c) + "\n       2       1       2\n" + number(b) + number(d) + "\n       3       1       1\n" +
         number(1.0) + "\n";
}

class Nastran : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() + "/" + name) << text;
    return folder_.path() + "/" + name;
  }
  static Imported read(const std::vector<std::string>& files,
                       const std::map<std::string, std::string>& options = {}) {
    return importer("nastran").read({files, options});
  }
  static std::string message(const std::vector<std::string>& files,
                             const std::map<std::string, std::string>& options = {}) {
    return test::input_error([&] { read(files, options); });
  }

  test::Folder folder_;
};

const std::string bulk =
    "DMIG,MAAX,0,6,2\nDMIG,MAAX,2,3,,2,3,2.0\nDMIG,MAAX,1,1,,1,1,1.0\n"
    "DMIG,KAAX,0,6,2\nDMIG,KAAX,1,1,,1,1,5.0,,+\n+,2,3,-1.0\nDMIG,KAAX,2,3,,2,3,7.0\nDMIG,KAAX,9,0,,9,0,3."
    "0\n";

TEST_F(Nastran, Output4) {
  const std::string file =
      write("a.op4", op4("MAA", 1, 0, 0, 2) + op4("BAA", 0.1, 0, 0, 0) + op4("KAA", 4, -1, -2, 3));
  const Imported imported = read({file});
  EXPECT_TRUE(imported.one_point());
  EXPECT_EQ(imported.samples.M[0], (Matrix{{1.0, 0.0}, {0.0, 2.0}}));
  EXPECT_EQ(imported.samples.C[0](0, 0), 0.1);
  EXPECT_EQ(imported.samples.K[0], (Matrix{{4.0, -1.0}, {-2.0, 3.0}}));
  EXPECT_EQ(imported.samples.digits, std::nullopt);
  const std::string scene = write_import(imported, folder_.path(), "model", false);
  EXPECT_NO_THROW(prepare_trace(read_scene(scene), {}, Purpose::operating_point));
}

TEST_F(Nastran, MatricesOfOnePointInSeveralFiles) {
  const Imported imported =
      read({write("m.op4", op4("MGG", 1, 0, 0, 2)), write("k.op4", op4("K2GG", 4, 0, 0, 3))});
  EXPECT_EQ(imported.samples.K[0](0, 0), 4.0);
  EXPECT_TRUE(imported.samples.C.empty());
}

TEST_F(Nastran, BulkDataHaveNames) {
  const Imported imported = read({write("a.pch", bulk)});
  EXPECT_EQ(imported.samples.state_names, (std::vector<std::string>{"grid 1, T1", "grid 2, T3", "point 9"}));
  EXPECT_EQ(imported.samples.M[0], (Matrix{{1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 0.0}}));
  EXPECT_EQ(imported.samples.K[0], (Matrix{{5.0, -1.0, 0.0}, {-1.0, 7.0, 0.0}, {0.0, 0.0, 3.0}}));
}

TEST_F(Nastran, FilesWithValuesAreSamples) {
  const std::string M = op4("MAA", 1, 0, 0, 1);
  const std::vector<std::string> files{write("0.op4", M + op4("KAA", 1, 0, 0, 2)),
                                       write("1.op4", M + op4("KAA", 3, 0, 0, 2))};
  const Imported imported = read(files, {{"parameter", "speed"}, {"unit", "rpm"}, {"values", "0, 1e2"}});
  EXPECT_EQ(imported.parameter, "speed");
  EXPECT_EQ(imported.samples.values, (std::vector<double>{0.0, 100.0}));
  EXPECT_EQ(imported.samples.K[1](0, 0), 3.0);
  const std::string table = write("t.csv", "speed [rpm],file\n0,0.op4\n100,1.op4\n");
  const Imported again = read({table});
  EXPECT_EQ(again.parameter, "speed");
  EXPECT_EQ(again.samples.parameter_unit, "rpm");
  EXPECT_EQ(again.samples.K, imported.samples.K);
  const std::string scene = write_import(again, folder_.path(), "model", false);
  EXPECT_EQ(prepare_trace(read_scene(scene), {}).options.to, 100.0);
}

TEST_F(Nastran, NamesOfMatrices) {
  const std::string file =
      write("a.op4", op4("MAA", 1, 0, 0, 2) + op4("MGG", 5, 0, 0, 2) + op4("XK", 4, 0, 0, 3) +
                         op4("K4AA", 9, 9, 9, 9) + op4("BAA", 1, 1, 1, 1));
  EXPECT_TRUE(test::contains(message({file}, {{"stiffness", "xk"}}),
                             "the mass may be MAA or MGG; name it with --mass"));
  const Imported imported = read({file}, {{"mass", "mgg"}, {"stiffness", "XK"}, {"damping", "none"}});
  EXPECT_EQ(imported.samples.M[0](0, 0), 5.0);
  EXPECT_TRUE(imported.samples.C.empty());
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_EQ(imported.warnings[0], "K4AA is structural damping, which is not read");
  EXPECT_TRUE(
      test::contains(message({file}, {{"mass", "MAA"}}), "no stiffness; found MAA, MGG, XK, K4AA, BAA"));
  EXPECT_TRUE(test::contains(message({file}, {{"mass", "MAX"}}), "--mass: no matrix 'MAX'; found MAA"));
}

TEST_F(Nastran, DigitsAreThoseOfThePrint) {
  EXPECT_EQ(read({write("a.pch", bulk)}).samples.digits, std::nullopt);
  const std::regex number("(-?[0-9])[.]0");
  std::string printed = std::regex_replace(bulk, number, "$1.000000001D+00");
  EXPECT_EQ(read({write("b.pch", printed)}).samples.digits, 10);
  printed.replace(printed.find("KAAX,0,6,2"), 10, "KAAX,0,6,1");
  EXPECT_EQ(read({write("c.pch", printed)}).samples.digits, 7);
  EXPECT_EQ(read({write("c.pch", printed)}, {{"digits", "all"}}).samples.digits, std::nullopt);
}

TEST_F(Nastran, MatricesThatCannotBeUsed) {
  const std::string M = op4("MAA", 1, 0, 0, 1);
  EXPECT_TRUE(test::contains(message({write("c.op4", op4("KAA", 1, 0, 0, 1))}), "c.op4: no mass; found KAA"));
  EXPECT_TRUE(test::contains(message({write("f.pch", "DMIG,K,0,6,2\nDMIG,M,0,6,2\n")}),
                             "the matrices have no entries"));
  EXPECT_TRUE(
      test::contains(message({write("g.op4", M), write("k.pch", bulk.substr(bulk.find("DMIG,KAAX,0")))}),
                     "are DMIG and OUTPUT4"));
  EXPECT_TRUE(test::contains(message({folder_.path() + "/none.op4"}), "none.op4: no such file"));
}

/// Off-diagonal entries of a symmetric matrix may be given on both sides, if they agree.
TEST_F(Nastran, BothSidesOfASymmetricMatrix) {
  std::string both = bulk;
  both += "DMIG,KAAX,2,3,,1,1,-1.0\n";
  EXPECT_EQ(read({write("a.pch", both)}).samples.K[0](0, 1), -1.0);
  both += "DMIG,KAAX,9,0,,1,1,1.0\nDMIG,KAAX,1,1,,9,0,2.0\n";
  EXPECT_TRUE(test::contains(message({write("b.pch", both)}),
                             "has two entries for row point 9 and column grid 1, T1"));
}

TEST_F(Nastran, PointsThatDoNotFit) {
  const std::map<std::string, std::string> values{{"values", "1,2"}};
  const std::string a = write("a.pch", bulk);
  std::string other = bulk;
  other.replace(other.find("KAAX,9,0,,9,0"), 13, "KAAX,8,0,,8,0");
  EXPECT_TRUE(test::contains(message({a, write("b.pch", other)}, values), "b.pch: lacks point 9, which"));
  other.replace(other.find("KAAX,8,0,,8,0"), 13, "KAAX,9,0,,9,0");
  EXPECT_TRUE(test::contains(message({a, write("c.pch", other + "DMIG,KAAX,10,,,10,,1.0\n")}, values),
                             "c.pch: has point 10, which"));
  EXPECT_TRUE(
      test::contains(message({a, write("d.pch", bulk + "DMIG,BAAX,0,6,2\nDMIG,BAAX,1,1,,1,1,1.0\n")}, values),
                     "d.pch: has a damping matrix, unlike"));
  const std::string K1 =
      "       1       1       1       2KAA     1P,5E16.9\n       2       1       1\n 1.000000000E+00\n";
  const std::string M = op4("MAA", 1, 0, 0, 1);
  EXPECT_TRUE(test::contains(message({write("e.op4", M + K1)}), "matrix KAA has 1 rows; expected 2"));
}

TEST_F(Nastran, OptionsThatDoNotFit) {
  const std::string a = write("a.pch", bulk);
  EXPECT_TRUE(test::contains(message({a}, {{"values", "1,2"}}), "--values: has 2 numbers for 1 files"));
  EXPECT_TRUE(
      test::contains(message({a}, {{"values", "1;2"}}), "--values: expected numbers separated by commas"));
  EXPECT_TRUE(test::contains(message({a, a}, {{"values", "1,1"}}), "--values: has 1 twice"));
  EXPECT_TRUE(test::contains(message({a}, {{"parameter", "2"}}), "--parameter: expected a name"));
  EXPECT_TRUE(test::contains(message({a, write("t.csv", "p,f\n1,a.pch\n")}), "expected one table (.csv)"));
  EXPECT_TRUE(test::contains(
      message({a, a}), "the mass may be MAAX or MAAX; files of one operating point have each matrix once"));
}

}  // namespace
}  // namespace eigentrail::test::nastran_test
