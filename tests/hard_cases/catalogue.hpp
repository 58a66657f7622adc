// Hard cases: matrix families and scenes whose eigenvalues are difficult to follow, each with its spectrum
// from an independent source and all special points of its range.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "hard_cases/wide_pencil.hpp"

namespace eigentrail::test {

/// A special point of a spectrum along a parameter. Kinds:
///   flutter     a complex pair crosses the imaginary axis (Re s = 0)
///   divergence  a real root passes zero
///   collision   defective multiple eigenvalue at a real parameter: a pair meets, touches or leaves the
///               real axis, or modes coalesce
///   crossing    semisimple coincidence of two or more modes
///   veering     defective double eigenvalue at parameter + j half_width, or - j half_width, or both
///               (veerings that are symmetric about the real axis are listed once)
///   fold        the equilibrium path turns back
///   branch_point  another equilibrium path crosses
///   infinite    the mass is singular and an eigenvalue infinite; s is not used
/// A collision at which undamped modes leave the imaginary axis is not repeated as flutter, one at s = 0 not
/// as divergence, and the zero eigenvalue of a fold or branch point not at all. Of conjugates the one with
/// Im s >= 0 is listed.
struct SpecialPoint {
  std::string kind;
  double parameter = 0.0;   ///< in the traced parameter's unit
  Complex s;                ///< the eigenvalue there; of a veering, at one of the two complex parameters
  double half_width = 0.0;  ///< veering: distance of the exceptional point from the real axis
  int branch = 0;           ///< entry of HardCase::spectrum that has it
  double rounding = 0.0;    ///< how far rounding of the matrices moves it; the comparison allows as much
};

/// One multiset of eigenvalues per equilibrium branch.
using Spectra = std::vector<std::vector<Complex>>;

struct HardCase {
  std::string name;   ///< letters, digits and underscores
  std::string scene;  ///< complete TOML text with [trace]
  double from = 0.0, to = 0.0;

  /// The multiset of finite eigenvalues (1/s) at p (traced parameter, its unit) of every equilibrium branch
  /// that the trace passes, the one at `from` first; empty where a branch has no equilibrium. A closed form
  /// where there is one, else the eigenvalues of `pencil` in extended precision.
  std::function<Spectra(double p)> spectrum;

  /// Every special point between `from` and `to`, ends included. Veerings: those with half_width up to
  /// reach |to - from|; their number agrees with the winding number of the discriminant round that
  /// rectangle of complex parameters (reference_methods.py).
  std::vector<SpecialPoint> special;
  double reach = 0.1;
  std::string source;  ///< of the family and of its numbers

  /// Analytic continuation of every mode along the real parameter, through crossings and past veerings, where
  /// a closed form exists. One of each complex pair and every real root. Where a pair passes the real axis
  /// its branch goes on below it: the conjugate is then the member with Im s >= 0.
  bool has_branches = false;
  std::vector<std::function<Complex(double)>> branches = {};

  /// The reduced pencil on an equilibrium branch, analytic in p. Its basis is not the library's.
  std::function<WidePencil(WideComplex p, int branch)> pencil = {};
};

/// The name, for messages of GoogleTest.
void PrintTo(const HardCase& hard_case, std::ostream* out);

/// All hard cases, by name in the order of the list: H (families), C (with constraints), own ones.
const std::vector<HardCase>& hard_cases();

/// The case of that name; throws std::out_of_range.
const HardCase& hard_case(const std::string& name);

}  // namespace eigentrail::test
