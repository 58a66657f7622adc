// Describes the keys of the tables of a rotor.
#include "model/model_readers.hpp"

namespace eigentrail {

const std::vector<std::string>& rotor_tables() {
  static const std::vector<std::string> names = {"shaft", "disc", "bearing", "support"};
  return names;
}

std::vector<EffectHelp> rotor_reference() {
  const std::string node = "3, or \"inner node 3\" with several shafts, from 1; a list: the same at each";
  return {
      {"shaft",
       "flexible shaft along the z axis, of Timoshenko beam elements with gyroscopic terms; makes the scene "
       "a rotor",
       {{"name", "text", "before the names of its nodes; required with several shafts", "none"},
        {"stations", "table, or CSV file",
         "{ length, outer, inner } or { position, outer, inner }: a list each with a value per segment, or "
         "one value; position has both ends of every segment, inner is 0 by default (m); a CSV file has "
         "these headings"},
        {"elements", "number or list", "of each segment", "1"},
        {"E", "Pa", "Young's modulus"},
        {"G", "Pa", "shear modulus; this or nu", "E / (2 (1 + nu))"},
        {"nu", "", "Poisson's ratio; this or G", "E / (2 G) - 1"},
        {"density", "kg/m^3", "of the material; 0: without mass"},
        {"position", "m", "of node 1 along the z axis; for pictures of several shafts", "0"},
        {"speed", "rad/s", "its rotation about the z axis", "0"},
        {"shear_coefficient", "", "of all sections", "Cowper's, of each section"},
        {"alpha", "1/s", "damping that does not rotate: alpha times the shaft's mass matrix", "0"},
        {"beta", "s", "and beta times its stiffness matrix", "0"},
        {"internal_damping", "s", "damping that rotates with the shaft, times its stiffness matrix", "0"},
        {"refined", "true or false",
         "inner freedoms, two in each plane of an element: few elements, also shorter than thick", "false"},
        {"axial", "true or false", "whether nodes move along z", "false"},
        {"torsion", "true or false", "whether nodes turn about z, beside the speed", "false"}}},
      {"disc",
       "rigid disc on a node of a shaft, by numbers or by its shape",
       {{"node", "node", node},
        {"mass", "kg", "with Id and Ip"},
        {"Id", "kg m^2", "moment of inertia about a diameter", "0"},
        {"Ip", "kg m^2", "moment of inertia about the axis", "0"},
        {"outer", "m", "outer diameter; with width and density, in place of the mass", "none"},
        {"inner", "m", "inner diameter", "0"},
        {"width", "m", "along the axis", "none"},
        {"density", "kg/m^3", "of the material", "none"}}},
      {"bearing",
       "bearing or seal on a node of a shaft: forces -K d - C d' - M d'' on its displacement along x and y",
       {{"node", "node", node},
        {"between", "two nodes", "in place of node: forces on the difference of both", "none"},
        {"kxx", "N/m", "stiffness; kxy: force along x per displacement along y", "0"},
        {"kxy", "N/m", "likewise", "0"},
        {"kyx", "N/m", "likewise", "0"},
        {"kyy", "N/m", "likewise", "kxx"},
        {"cxx", "N s/m", "damping", "0"},
        {"cxy", "N s/m", "likewise", "0"},
        {"cyx", "N s/m", "likewise", "0"},
        {"cyy", "N s/m", "likewise", "cxx"},
        {"mxx", "kg", "added mass", "0"},
        {"mxy", "kg", "likewise", "0"},
        {"myx", "kg", "likewise", "0"},
        {"myy", "kg", "likewise", "mxx"},
        {"kzz", "N/m", "along the axis", "0"},
        {"czz", "N s/m", "likewise", "0"},
        {"table", "CSV file",
         "coefficients over the speed: first column the speed (\"speed [rpm]\"), then columns such as kxx",
         "none"},
        {"over", "expression", "what the first column of the table is", "the speed of the shaft"},
        {"degree", "whole number", "degree of the polynomials between the rows, 1 to 15, without poles",
         "chosen by leaving out rows"},
        {"exact", "true or false", "the interpolant is what is meant: no errors between the rows", "false"}}},
      {"support",
       "holds freedoms of a node of a shaft",
       {{"node", "node", node},
        {"holds", "list of \"x\", \"y\", \"rx\", \"ry\", \"z\", \"rz\"",
         "displacements and rotations that are zero", "[\"x\", \"y\"]: a pin"}}}};
}

}  // namespace eigentrail
