// The linearized equations of a scene at single values of the traced parameter, for other programs.
//
//   M dx'' + C dx' + K dx + A^T dlambda = F du,   A dx = 0                     (all coordinates)
//   dx = T q,   T^T M T q'' + T^T C T q' + T^T K T q = T^T F du   (seed paper, Eqs. 12a, 26)
//   E z' = G z + B du,   z = [q; q'], without the rates of those q that have no mass
//
// du are changes of parameters of the scene, the inputs: a force of the scene that is an expression of a
// parameter becomes an input by its name. F has the forces of their values, not those of their rates, as of
// the speed of a frame.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Motions about the equilibrium at p, in SI units; inputs are in the units of their parameters.
struct LinearModel {
  double p = 0.0;                     ///< in the unit of the parameter
  Vector x = {};                      ///< equilibrium, n
  Vector lambda = {};                 ///< multipliers of the constraints there, m
  Vector trimmed = {};                ///< values of the parameters that conditions determine, in their units
  Matrix M = {}, C = {}, K = {};      ///< n x n; K contains (A^T lambda)_/x
  Matrix A = {};                      ///< m x n, derivative of the constraints
  Matrix F = {};                      ///< n x inputs
  Matrix T = {};                      ///< n x f, orthonormal; those of all values are close to the first one
  Matrix Mq = {}, Cq = {}, Kq = {};   ///< f x f: T^T M T and so forth
  Matrix Fq = {};                     ///< f x inputs
  Matrix E = {}, G = {};              ///< states x states; E may be singular
  Matrix B = {};                      ///< states x inputs
  std::vector<Eigen::Index> rates{};  ///< the q whose rates are the last states, in their order
};

/// Models at several values, all with the same freedoms and states.
struct LinearModels {
  std::vector<LinearModel> found;
  std::vector<std::pair<double, std::string>> faults;  ///< values without equations, and why
  std::vector<std::string> notes;                      ///< sentences: of inputs without a force
};

/// The equations at values of the traced parameter, in its unit. Throws InputError for an input that is no
/// parameter, is defined by others or moves a constraint, for inputs of rotors and families of matrices, for
/// a number of freedoms that is zero or differs, and for more coordinates than fit into dense matrices
/// (limits::matrix_rows).
LinearModels linear_models(const TraceSetup& setup, const std::vector<double>& values,
                           const std::vector<std::string>& inputs);

/// Arrays with names, one per value of the parameter, or texts that hold for all.
struct NamedSamples {
  std::string name;
  int rank = 0;                      ///< of each: 0 a number, 1 a vector, 2 a matrix
  std::vector<Matrix> samples = {};  ///< of a vector a column
  std::vector<std::string> texts = {};
};

/// All arrays of the models, as files and Python have them: M, C, K and F in the coordinates q, M_full,
/// C_full, K_full and F_full in all coordinates, constraints (A), T, x, lambda, trimmed, state_E, state_A
/// (G), state_B, the values of the parameter under its name, and the names: state_names of q, rate_names of
/// the q whose rates follow them in z, coordinate_names with their units, constraint_names, trimmed_names,
/// input_names. What is empty is left out.
std::vector<NamedSamples> arrays_of(const TraceSetup& setup, const std::vector<LinearModel>& models,
                                    const std::vector<std::string>& inputs);

}  // namespace eigentrail
