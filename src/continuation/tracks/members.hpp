// Members of a block: ascending indices of some of its eigenvalues, and the numbers of their modes.
#pragma once

#include <vector>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Mode numbers in ascending order without repetitions. Negative entries (Track::no_mode, Track::guard) are
/// left out.
std::vector<int> sorted_modes(const std::vector<int>& modes);

/// Union of two ascending lists, ascending.
std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b);

/// Whether a list of members or of modes has an entry.
bool contains(const std::vector<int>& list, int entry);

/// The indices below `size` that are not among the members, ascending.
std::vector<int> other_members(Eigen::Index size, const std::vector<int>& members);

/// Largest distance of two members of a block from each other.
double diameter(const ComplexVector& roots, const std::vector<int>& members);

/// Least distance of members of a block from its other eigenvalues; infinite when there are none.
double distance_from_others(const ComplexVector& roots, const std::vector<int>& members);

/// The eigenvalues of a track with these indices.
std::vector<Complex> roots_of(const Track& track, const std::vector<int>& members);

/// Index of the eigenvalue that is nearest to a number.
Eigen::Index nearest_root(const ComplexVector& roots, Complex s);

/// Index of the conjugate of an eigenvalue of a real block: its own, of a real one.
Eigen::Index conjugate_of(const ComplexVector& roots, Eigen::Index member);

/// Whether Im s < 0, of an eigenvalue in its chart. The mode of a complex pair is the other member.
bool is_lower(Complex root, Chart chart);

/// The eigenvalues of a track in a chart.
ComplexVector roots_in_chart(const Track& track, Chart chart);
/// A series that a track has in its chart, in another chart; empty where it is infinite there.
ComplexVector in_chart(ComplexVector series, const Track& track, Chart chart);

/// Series of an eigenvalue of a track in a chart; empty where it is not simple, or infinite there.
ComplexVector root_series(const Track& track, Complex root, Chart chart);

/// Errors of the eigenvalues of a track by rounding of the entries of the pencil, in its chart, in the order
/// of `roots`: those that its functions have at the point or near it.
Vector rounding_of_roots(const Track& track, const ComplexVector& functions, const ComplexVector& roots,
                         const RoundingThresholds& thresholds);
/// The same at the point of the track.
Vector rounding_of_roots(const Track& track, const RoundingThresholds& thresholds);

}  // namespace eigentrail
