// Input files of OpenFAST that describe blades (text): ElastoDyn's blade and main file, BeamDyn's blade and
// main file. Lines that begin with !, # or % are comments, numbers may have Fortran's exponents, and what
// follows a value on its line is its name and description.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace eigentrail {

/// ElastoDyn's blade file: a table with a row per station, and factors.
struct ElastoDynBlade {
  std::string path;
  std::array<double, 3> damping{};  ///< of first and second flap and first edge mode, % of critical
  double mass_factor = 1.0, flap_factor = 1.0, edge_factor = 1.0;  ///< AdjBlMs, AdjFlSt, AdjEdSt
  std::array<double, 2> tuners = {1.0, 1.0};                       ///< FlStTunr(1), FlStTunr(2)
  /// By the names of the file, such as "BlFract"; all of the same length.
  std::map<std::string, std::vector<double>> columns;
};

/// What ElastoDyn's main file says of the rotor.
struct ElastoDynRotor {
  std::string path;
  double tip_radius = 0.0, hub_radius = 0.0;  ///< m, along the blade
  double precone = 0.0;                       ///< of blade 1, deg
  double rotor_speed = 0.0;                   ///< rpm
  std::string blade_file;                     ///< of blade 1, as in the file; empty: none
};

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// BeamDyn's blade file. Axes of a section: x to the suction side, y to the trailing edge, z along the blade.
struct BeamDynBlade {
  std::string path;
  int damping_type = 0;              ///< 0: none, 1: by mu, 2: by ratios of modes
  std::array<double, 6> mu{};        ///< s
  std::vector<double> modal_ratios;  ///< of modes 1, 2, ...
  std::vector<double> span;          ///< from 0 to 1, along the axis of the blade
  std::vector<Matrix6> stiffness;    ///< forces x y z, moments x y z by strains and curvatures
  std::vector<Matrix6> mass;
};

/// The axis of a blade from BeamDyn's main file, by key points.
struct BeamDynAxis {
  std::string path;
  std::vector<Eigen::Vector3d> points;  ///< m, from the root
  std::vector<double> twist;            ///< deg, about the negative z axis
  std::string blade_file;               ///< as in the file
};

// Each reads the text of a file, and throws InputError that names file and line.

ElastoDynBlade parse_elastodyn_blade(std::string_view text, const std::string& path);
ElastoDynRotor parse_elastodyn_rotor(std::string_view text, const std::string& path);
BeamDynBlade parse_beamdyn_blade(std::string_view text, const std::string& path);
BeamDynAxis parse_beamdyn_axis(std::string_view text, const std::string& path);

/// Whether some line has this name behind its value, or among its first words.
bool names_value(std::string_view text, std::string_view name);

}  // namespace eigentrail
