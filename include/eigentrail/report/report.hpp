// One self-contained HTML page from files of eigentrail: loci, boundaries, maps, accuracy studies.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace eigentrail {

/// The page of these files. Throws InputError if a file cannot be read or contains nothing to show.
std::string report_page(const std::vector<std::string>& files);

/// What a picture of a trace shows that its file has only in the scene, as a JSON object. `excitation`: the
/// frequency (rad/s) at equidistant values of the parameter and the harmonics named in the scene; null if the
/// scene has no excitation and the parameter is no angular velocity. `geometry`: points, bodies, places on
/// them and the links between these at the stored point `node`; null for matrices. `loci_file`: the bytes of
/// the file. Throws InputError if it is no loci file or has no such point.
std::string drawing_data(std::string_view loci_file, std::size_t node);

/// How every such page begins.
inline constexpr std::string_view report_signature = "<!DOCTYPE html>\n<!-- eigentrail report -->";

}  // namespace eigentrail
