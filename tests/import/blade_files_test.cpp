// Blade files of ElastoDyn and BeamDyn.
#include "import/blade_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "eigentrail/import/importer.hpp"
#include "import/text_lines.hpp"
#include "scene/input_error.hpp"

namespace eigentrail::test::blade_files_test {
namespace {

const std::string nrel = std::string(EIGENTRAIL_IMPORT_DATA) + "/NRELOffshrBsline5MW_Blade.dat";

const std::string elastodyn = R"(------- ELASTODYN V1.00.* INDIVIDUAL BLADE INPUT FILE ---
A blade
          2   NBlInpSt    - Number of blade input stations (-)
   0.5        BldFlDmp(1) - Blade flap mode #1 structural damping in percent of critical (%)
   0.6        BldFlDmp(2) - second flap
   0.7        BldEdDmp(1) - edge
          1   FlStTunr(1) - Blade flapwise modal stiffness tuner, 1st mode (-)
        1.1   AdjBlMs     - Factor to adjust blade mass density (-)  !a comment
    BlFract      PitchAxis      StrcTwst       BMassDen        FlpStff        EdgStff
      (-)           (-)          (deg)          (kg/m)         (Nm^2)         (Nm^2)
! the root
0.0  0.25  13.0  6.0D+02  1.8+010  2.0E+10
1.0  0.25  0.0   1.0E+01  1.8E+05  2.0E+06  ! the tip
---------------------- BLADE MODE SHAPES ---------------------------------------
)";

std::string row(const std::string& diagonal, int place) {
  std::string text;
  for (int i = 0; i < 6; ++i) text += (i == place ? diagonal : "0.0") + std::string("  ");
  return text + "\n";
}

std::string station(const std::string& at) {
  std::string text = at + "\n";
  for (int i = 0; i < 6; ++i) text += row(std::to_string(i + 1) + "0.0E+06", i);
  text += "\n";
  for (int i = 0; i < 6; ++i) text += row(i < 3 ? "7.0" : i == 5 ? "5.0" : i == 3 ? "3.0" : "2.0", i);
  return text;
}

const std::string beamdyn_blade = R"(   ------- BEAMDYN V1.00.* INDIVIDUAL BLADE INPUT FILE ---
 Test Format 1
------ Blade Parameters ---
2   station_total    - Number of blade input stations (-)
1   damp_type        - Damping type: 0: no damping; 1: damped
------ Stiffness-Proportional Damping [used only if damp_type=1] ---
   mu1        mu2        mu3        mu4        mu5        mu6
   (-)        (-)        (-)        (-)        (-)        (-)
1.0E-03    2.0E-03    3.0E-03     4.0E-03      5.0E-03     6.0E-03
------ Distributed Properties ---
)" + station("0.0") + "\n" + station("1.0");

const std::string beamdyn_axis = R"(--------- BEAMDYN V1.01.* INPUT FILE ---
A blade
1     member_total   - Total number of member (-)
3     kp_total       - Total number of key point (-)
1    3               - Member number; Number of key points in this member
    kp_xr      kp_yr     kp_zr    initial_twist
    (m)         (m)       (m)      (deg)
  0.0   0.0   0.0  13.0
  0.5   0.2   5.0   6.0
  2.0   0.8  10.0   0.0
"beamdyn_blade.dat"  BldFile - Name of file containing properties for blade
)";

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  EXPECT_NE(text.find(old), std::string::npos) << old;
  return text.replace(text.find(old), old.size(), replacement);
}

TEST(BladeFiles, ElastoDynsTable) {
  const ElastoDynBlade blade = parse_elastodyn_blade(elastodyn, "a.dat");
  EXPECT_EQ(blade.damping, (std::array{0.5, 0.6, 0.7}));
  EXPECT_EQ(blade.mass_factor, 1.1);
  EXPECT_EQ(blade.columns.at("FlpStff"), (std::vector{1.8e10, 1.8e5}));  // Fortran's exponents
  EXPECT_EQ(blade.columns.at("BMassDen"), (std::vector{600.0, 10.0}));
  const ElastoDynBlade real = parse_elastodyn_blade(read_text_file(nrel), nrel);
  EXPECT_EQ(real.columns.at("BlFract").size(), 49u);
  EXPECT_EQ(real.columns.at("EdgStff").back(), 5.01e6);
  EXPECT_EQ(real.mass_factor, 1.04536);
}

TEST(BladeFiles, WrongElastoDynFilesSayWhatAndWhere) {
  const auto message = [](const std::string& bad) {
    return test::input_error([&] { parse_elastodyn_blade(bad, "a.dat"); });
  };
  const std::pair<std::string, std::string> cases[] = {
      {with(elastodyn, "          2   NBl", "          3   NBl"), "station 3 of NBlInpSt = 3"},
      {with(elastodyn, "          2   NBl", "         -1   NBl"), "whole number from 1"},
      {elastodyn.substr(0, elastodyn.find("1.0  0.25")), "the file ends before it"},
      {elastodyn.substr(0, elastodyn.find("    BlFract")), "no table that begins with BlFract"},
      {with(elastodyn, "EdgStff", "EdgStif"), "no column EdgStff"},
      {with(elastodyn, "1.8+010  2.0E+10", "1.8+010"), "has 5 numbers; expected 6"},
      {with(elastodyn, "1.8+010  2.0E+10", "1.8+010 2 3"), "more than 6 numbers"},
      {with(elastodyn, "6.0D+02", "much"), "'much'"},
      {with(elastodyn, "6.0D+02", "-6"), "BMassDen must be positive"},
      {with(elastodyn, "1.0  0.25", "0.9  0.25"), "BlFract must end at 1"},
      {with(elastodyn, "\n0.0  0.25", "\n0.1  0.25"), "BlFract must begin with 0"},
      {with(elastodyn, "          2   NBl", "          1   NBl"), "BlFract must end at 1"},
      {"", "no table"}};
  for (const auto& [text, expected] : cases) {
    EXPECT_NE(message(text).find(expected), std::string::npos) << message(text);
    EXPECT_NE(message(text).find("a.dat:"), std::string::npos) << message(text);
  }
}

TEST(BladeFiles, ElastoDynsRotor) {
  const std::string text =
      "63.0 TipRad - tip\n 1.5 HubRad - hub\n -2.5 PreCone(1) - cone\n12.1 RotSpeed - speed\n\"b.dat\" "
      "BldFile(1) - blade\n";
  const ElastoDynRotor rotor = parse_elastodyn_rotor(text, "a.dat");
  EXPECT_EQ(rotor.tip_radius, 63.0);
  EXPECT_EQ(rotor.precone, -2.5);
  EXPECT_EQ(rotor.blade_file, "b.dat");
  EXPECT_NE(test::input_error([&] {
              parse_elastodyn_rotor(with(text, "1.5 Hub", "70 Hub"), "a.dat");
            }).find("HubRad < TipRad"),
            std::string::npos);
}

TEST(BladeFiles, BeamDynsMatrices) {
  const BeamDynBlade blade = parse_beamdyn_blade(beamdyn_blade, "a.dat");
  EXPECT_EQ(blade.span, (std::vector{0.0, 1.0}));
  EXPECT_EQ(blade.stiffness[1](4, 4), 50e6);
  EXPECT_EQ(blade.mass[0](5, 5), 5.0);
  EXPECT_EQ(blade.mu[5], 6e-3);
  const BeamDynAxis axis = parse_beamdyn_axis(beamdyn_axis, "a.dat");
  EXPECT_EQ(axis.points[2], Eigen::Vector3d(2.0, 0.8, 10.0));
  EXPECT_EQ(axis.twist[1], 6.0);
  EXPECT_EQ(axis.blade_file, "beamdyn_blade.dat");
}

TEST(BladeFiles, WrongBeamDynFilesSayWhatAndWhere) {
  const std::pair<std::string, std::string> blades[] = {
      {with(beamdyn_blade, "2   station_total", "3   station_total"), "station 3 of station_total = 3"},
      {with(beamdyn_blade, "2   station_total", "2.5 station_total"), "whole number"},
      {beamdyn_blade.substr(0, beamdyn_blade.rfind('\n', beamdyn_blade.size() - 90) + 1), "cut short"},
      {with(beamdyn_blade, "\n1.0\n", "\n0.9\n"), "end at 1"},
      {with(beamdyn_blade, "20.0E+06", "-2.0E+06"), "positive definite"},
      {with(beamdyn_blade, "0.0  20.0E+06", "9.0e6  20.0E+06"), "symmetric"},
      {with(beamdyn_blade, "0.0  20.0E+06", "20.0E+06"), "has 5 numbers"},
      {with(beamdyn_blade, "1   damp_type", "7   damp_type"), "damp_type"},
      {with(beamdyn_blade, "------ Distributed", "------ Other"), "Distributed"}};
  for (const auto& [text, expected] : blades) {
    const std::string found = test::input_error([&, &bad = text] { parse_beamdyn_blade(bad, "a.dat"); });
    EXPECT_NE(found.find(expected), std::string::npos) << found;
  }
  const std::pair<std::string, std::string> axes[] = {
      {with(beamdyn_axis, "3     kp_total", "4     kp_total"), "key point 4 of kp_total = 4"},
      {with(beamdyn_axis, "5.0   6.0", "50.0   6.0"), "kp_zr must increase"},
      {with(beamdyn_axis, "0.0   0.0   0.0  13", "0.0   0.1   0.0  13"), "the root"},
      {with(beamdyn_axis, "kp_xr", "kp_ab"), "no key points"},
      {with(beamdyn_axis, "BldFile", "Bld"), "no BldFile"}};
  for (const auto& [text, expected] : axes) {
    const std::string found = test::input_error([&, &bad = text] { parse_beamdyn_axis(bad, "a.dat"); });
    EXPECT_NE(found.find(expected), std::string::npos) << found;
  }
}

class Import : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / ("blade_files_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    write("beamdyn_blade.dat", beamdyn_blade);
    write("beamdyn.dat", beamdyn_axis);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; }

  std::filesystem::path folder;
};

TEST_F(Import, BeamDynsAxesBecomeThoseOfABlade) {
  const Imported imported = importer("beamdyn").read({{(folder / "beamdyn.dat").string()}, {}});
  const std::string& csv = imported.stations->csv;
  // x along the blade, y to the leading edge, z to the suction side: the twist and the sweep change their
  // sign.
  EXPECT_EQ(
      csv.substr(0, csv.find('\n')),
      "span, twist [deg], mass, inertia_flap, inertia_lag, sweep, prebend, S11, S22, S33, S44, S55, S66");
  EXPECT_NE(csv.find("1, 0, 7, 2, 3, -0.8, 2, 3e+07, 2e+07, 1e+07, 6e+07, 5e+07, 4e+07"), std::string::npos)
      << csv;
  EXPECT_NE(imported.stations->tables.find("time = [0.003, 0.002, 0.001, 0.006, 0.005, 0.004]"),
            std::string::npos)
      << imported.stations->tables;
}

TEST_F(Import, ElastoDynNeedsALength) {
  EXPECT_NE(test::input_error([&] {
              importer("elastodyn").read({{nrel}, {}});
            }).find("--length"),
            std::string::npos);
  const Imported imported = importer("elastodyn").read({{nrel}, {{"length", "61.5"}, {"hub-radius", "1.5"}}});
  EXPECT_NE(imported.stations->tables.find("to = 12.1\n"), std::string::npos);
  EXPECT_NE(imported.stations->tables.find("damping_flap = 0.00477465"), std::string::npos);
}

TEST_F(Import, ASecondFileOfAKindIsRefused) {
  EXPECT_NE(test::input_error([&] {
              importer("elastodyn").read({{nrel, nrel}, {}});
            }).find("second"),
            std::string::npos);
  EXPECT_NE(test::input_error([&] {
              importer("beamdyn").read({{(folder / "beamdyn_blade.dat").string()}, {}});
            }).find("main file"),
            std::string::npos);
}

}  // namespace
}  // namespace eigentrail::test::blade_files_test
