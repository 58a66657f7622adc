// What the page holds of one file, by kind.
#pragma once

#include <string>

#include "core/hdf5_file.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "report/encode.hpp"

namespace eigentrail {

/// Shares of the page's size, in bytes before base64. What does not fit is made coarser or thinned out, and
/// the page says so.
struct ReportBudget {
  std::size_t curves = 5'000'000;
  std::size_t shapes = 2'500'000;
  std::size_t roots = 10'000'000;  ///< of blocks: not bytes but time, about a second
};

/// Reads a file of any kind. Throws InputError when it cannot be read, or holds nothing to show.
Json file_data(const std::string& path, const ReportBudget& budget);

/// Root attributes as text, in alphabetical order.
Json attributes_data(const Hdf5File& file);

/// A loci file: curves, events, stable ranges, modes.
Json loci_data(const LociFile& loci, const Hdf5File& file, const ReportBudget& budget);

/// Eigenvalues of every mode, and the parameter, along the path (curve_data.cpp).
Json curves_data(const LociFile& loci, const ReportBudget& budget);

/// Mode shapes at as many points as the budget has room for, all of them where it has (shape_data.cpp).
Json shapes_data(const LociFile& loci, const Hdf5File& file, const ReportBudget& budget);

/// Places on points and bodies, and what connects them, as the scene says; nothing for families of matrices
/// (geometry_data.cpp).
Json geometry_data(const LociFile& loci, const std::vector<std::size_t>& nodes);

Json boundary_data(const Hdf5File& file);
Json map_data(const Hdf5File& file);
Json accuracy_data(const Hdf5File& file);

}  // namespace eigentrail
