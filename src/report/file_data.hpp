// The data of one file that the page contains, for each kind of file, and how numbers are encoded in it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/hdf5_file.hpp"
#include "core/texts.hpp"
#include "eigentrail/scene/scene.hpp"
#include "eigentrail/store/loci_file.hpp"

namespace eigentrail {

static_assert(std::endian::native == std::endian::little, "pages hold numbers lowest byte first");

using Json = nlohmann::ordered_json;

/// Base64 of bytes.
inline std::string base64_of(std::span<const std::byte> bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8u | (k < n ? std::to_integer<unsigned>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

/// Base64 of the bytes of the elements, little-endian, as numbers of another type if one is named.
template <class Stored = void, class Element>
std::string base64(const std::vector<Element>& values) {
  if constexpr (std::is_void_v<Stored> || std::is_same_v<Stored, Element>) {
    return base64_of(std::as_bytes(std::span(values)));
  } else {
    return base64(std::vector<Stored>(values.begin(), values.end()));
  }
}

/// JSON text for a script element of a page. It contains no '<', so it cannot end the element. Bytes that are
/// not UTF-8 are replaced. Numbers that are not finite become null.
inline std::string page_json(const Json& json) {
  return replaced_all(json.dump(-1, ' ', false, Json::error_handler_t::replace), "<", "\\u003c");
}

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
Vector si_values(const Scene& scene, const std::string& parameter, double p);

/// Points (3 coordinates) and bodies (12 coordinates: origin and three axes) by the names of all coordinates:
/// objects with name, first, the index of the first coordinate, and body (geometry_data.cpp).
Json carriers_data(const std::vector<std::string>& coordinates);

/// Points, bodies, places on them and the links between these, from the scene; null for matrix families
/// (geometry_data.cpp). `nodes`: points of the trace at which the parameters are evaluated.
Json geometry_data(const LociFile& loci, const std::vector<std::size_t>& nodes);

// Boundaries, stability maps (both plane_data.cpp) and accuracy studies.
Json boundary_data(const Hdf5File& file);
Json map_data(const Hdf5File& file);
Json accuracy_data(const Hdf5File& file);

}  // namespace eigentrail
