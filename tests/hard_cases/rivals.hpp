// The usual method, for comparison ("rivals"): a full spectrum by QZ at equally spaced parameters, with
// labels carried from each to the next.
#pragma once

#include <vector>

#include "eigentrail/continuation/trace_options.hpp"
#include "hard_cases/catalogue.hpp"
#include "hard_cases/reference_labels.hpp"

namespace eigentrail::test {

enum class Carrier {
  nearest,     ///< every track takes the eigenvalue nearest to its last one, also one that another took
  assignment,  ///< one to one with the least sum of distances
  assurance    ///< one to one with the largest sum of modal assurance criteria
};

/// Eigenvalues in the order of the labels. All 2 n of them are carried: the number of pairs changes on the
/// way.
struct LabelledLoci {
  std::vector<double> p;
  std::vector<std::vector<Complex>> s;  ///< s[k][label] at p[k]; an infinite eigenvalue has no finite parts
  bool complete = true;                 ///< false: stopped where the equilibrium could not be found
};

/// Spectra with physical vectors at equally spaced parameters, by LAPACK's dggev on the unscaled companion
/// pencil.
struct GridSpectra {
  struct Point {
    double p;
    std::vector<Complex> s;
    ComplexMatrix vectors;  ///< columns: v = T z, unit length
    Matrix mass;            ///< weight of the modal assurance criterion
  };
  std::vector<Point> points;
  bool complete = true;
};

/// `n_points` >= 2 from one end of a range to the other. The reduced pencils are the library's, each
/// equilibrium solved from the one before; ends early where there is none.
GridSpectra spectra_on_grid(const TraceSetup& setup, double from, double to, int n_points);

/// The same on the range of a case.
GridSpectra spectra_on_grid(const HardCase& hard_case, int n_points);

/// Carries the labels. One O(n^3) assignment per point.
LabelledLoci carry_labels(const GridSpectra& spectra, Carrier carrier);

/// How many tracks are on another mode somewhere, counted once for each stretch between coincidences.
/// Compares loci with the case's analytic branches, which run through crossings, or where it has none with
/// its reference labels. Conjugates are the same mode. A label counts as wrong where another mode is at least
/// twice as close to it as its own and the two modes are apart.
int count_wrong_tracks(const HardCase& hard_case, const LabelledLoci& loci);

}  // namespace eigentrail::test
