// A family of matrices that a function of the caller's computes: p -> M, C, K of M x'' + C x' + K x = 0, or E
// and A of E x' = A x.
//
// The function may be expensive. It is called only when the model is made: the matrices are interpolated by
// polynomials in pieces, through Chebyshev points (Trefethen, Approximation Theory and Approximation
// Practice, SIAM 2013, Sects. 2, 8), and the trace works with these. Where the matrices are smooth, each
// further call gains digits: about 20 to 80 calls are enough for most ranges. The others, a hundred by
// default, look for what is narrower than those would show.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "eigentrail/model/matrix_model.hpp"

namespace eigentrail {

/// The matrices at one value of the parameter, all n x n, the same ones at every value: K with M, C or both,
/// or A with or without E.
struct MatricesAt {
  Matrix M = {}, C = {}, K = {};
  Matrix E = {}, A = {};  ///< E x' = A x; without E it is the identity
};

struct FunctionFamilyOptions {
  std::string parameter = "p";  ///< its name, by which a trace names it
  std::string unit = {};        ///< only shown: the function gets the parameter as the trace has it
  double from = 0.0;            ///< beginning of the range, finite; from < to
  double to = 1.0;              ///< end of the range, finite
  /// Largest error of every entry, relative to its own largest magnitude on the range; 1e-14 <= tolerance
  /// < 1. Rounding in an entry is taken to be up to 1e-14 of the largest entries beside it. The eigenvalues
  /// get errors of this size times their condition: choose a hundredth of the tolerance of the trace, or
  /// less.
  double tolerance = 1e-11;
  int max_calls = 1000;  ///< at least 2
  /// Width, as a share of the range, of the features that are looked for between the points that a smooth
  /// function needs: no two calls are farther apart. Narrower ones may be missed. 0 < resolution <= 1
  double resolution = 0.01;
  /// Places inside the range where derivatives of the matrices jump, if they are known: pieces begin there.
  /// The two sides of a jump are two families. A kink at any other place costs some 40 calls per halving of
  /// the pieces until `max_calls`.
  std::vector<double> breaks = {};
  std::vector<std::string> state_names = {};  ///< n, or empty for x1, x2, ...
  std::vector<std::string> state_units = {};  ///< n, or empty for 1
};

/// Thrown if the tolerance is not met within the calls that are allowed, or by pieces of any length.
class NotResolved : public std::runtime_error {
 public:
  NotResolved(const std::string& message, double begin, double end)
      : std::runtime_error(message), from(begin), to(end) {}
  double from, to;  ///< the piece of the range that is not resolved
};

/// A part of the range on which the matrices are polynomials in p.
struct FamilyPiece {
  double from = 0.0, to = 0.0;
  int degree = 0;
  /// M, C and K as Chebyshev series: the factors of T_j(x), x from -1 to 1, lowest j first, at most degree
  /// + 1.
  std::vector<Matrix> M, C, K;
};

/// The model of a trace over options.parameter. Immutable; the function is not called any more once it is
/// made.
///
/// Neighbouring pieces agree at the place where they meet, and their derivatives agree within the tolerance
/// times the powers of the degree; steps of a trace pass it like any other.
class FunctionFamily final : public MatrixModel {
 public:
  using Function = std::function<MatricesAt(double p)>;

  /// Calls `function` at values of p from options.from to options.to, in no order, never twice at the same p.
  ///
  /// Throws std::invalid_argument for invalid options, for matrices of unexpected sizes, and for entries that
  /// are not finite, with p; NotResolved as described there. What the function throws passes through.
  FunctionFamily(const Function& function, const FunctionFamilyOptions& options);

  /// Number of calls of the function.
  int calls() const { return calls_; }
  /// The pieces, ascending.
  const std::vector<FamilyPiece>& pieces() const { return pieces_; }

  Structure structure(int traced_parameter) const override;
  /// A fault for values of the parameter beside the range.
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override;
  CoefficientMatrices coefficient_matrices(const Vector&, int) const override;
  /// Places where pieces meet, no closer than features that were looked for; and sharper ones, from both
  /// sides.
  std::vector<double> landings(int traced_parameter) const override;
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override;

 private:
  struct Interpolated {
    ModelDescription description;
    std::vector<FamilyPiece> pieces;
    int calls = 0;
    double resolved = 0.0;
  };
  explicit FunctionFamily(Interpolated interpolated);

  template <class Real, int Q>
  EvaluationFault evaluate_all(const BasicPath<Real>& path, int order, BasicLinearization<Real>& result,
                               EvaluationCounts& counts) const;
  const FamilyPiece* piece_at(double p, double slope) const;

  int calls_ = 0;
  double resolved_ = 0.0;  ///< width of the features that were looked for
  std::vector<FamilyPiece> pieces_;
};

}  // namespace eigentrail
