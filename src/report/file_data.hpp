// The data of one file that the page contains, for each kind of file.
#pragma once

#include <string>

#include "core/hdf5_file.hpp"
#include "eigentrail/scene/scene.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "report/encode.hpp"

namespace eigentrail {

/// Limits of the size of a page and of the time to make it. If the data are larger, curves become less
/// accurate, and shapes are given at fewer points, which the page says.
struct ReportBudget {
  std::size_t curves = 5'000'000;  ///< bytes of curves before base64
  std::size_t shapes = 2'500'000;  ///< bytes of mode shapes before base64
  /// Number of eigenvalues that may be computed from the functions of blocks of several modes (ten million
  /// take about a second). It grows with the file; exceeding it is an error (curve_data.cpp).
  std::size_t roots = 10'000'000;
};

/// Reads a file of any kind. Throws InputError if it cannot be read or contains nothing to show.
Json file_data(const std::string& path, const ReportBudget& budget);

/// A loci file: curves, events, stable ranges, modes.
Json loci_data(const LociFile& loci, const Hdf5File& file, const ReportBudget& budget);

/// A list of objects with kind, from, to and margins. from and to are objects with parameter, cause, margin
/// and mode (from 1; null if none is known).
Json ranges_data(const std::vector<StableRange>& ranges);

/// Eigenvalues of every mode, and the parameter, along the path (curve_data.cpp).
Json curves_data(const LociFile& loci, const ReportBudget& budget);

/// Mode shapes at all points, or at as many as the budget allows (shape_data.cpp).
Json shapes_data(const LociFile& loci, const Hdf5File& file, const ReportBudget& budget);

/// The excitation frequency (rad/s) at equidistant parameter values, whose harmonics pictures draw, and the
/// harmonics named in the scene. It is the excitation of the scene, or the traced parameter if that has a
/// unit of frequency; otherwise the result is null (loci_data.cpp).
Json excitation_data(const LociFile& loci);

/// Values of the parameters of a scene in SI where the traced one, if the scene has it, is p (loci_data.cpp).
std::vector<double> si_values(const Scene& scene, const std::string& parameter, double p);

/// Points, bodies, places on them and the links between these, from the scene; null for matrix families
/// (geometry_data.cpp). `nodes`: points of the trace at which the parameters are evaluated.
Json geometry_data(const LociFile& loci, const std::vector<std::size_t>& nodes);

// Boundaries, stability maps (both plane_data.cpp) and accuracy studies.
Json boundary_data(const Hdf5File& file);
Json map_data(const Hdf5File& file);
Json accuracy_data(const Hdf5File& file);

}  // namespace eigentrail
