#include <algorithm>
#include <cmath>
#include <set>

#include "report/file_data.hpp"

namespace eigentrail {
namespace {

constexpr double whole = 32767.0;  ///< the integer of 16 bits that represents the largest component

std::size_t bytes_per_node(const LociFile& loci) {
  const std::size_t n = loci.coordinates.size();
  return loci.modes.size() * (2 * n * sizeof(std::int16_t)) + n * sizeof(float);
}

/// The points of the trace at which the page shows shapes: all of them if there are at most `room`. Otherwise
/// those of events (at most room / 2 of them) and others spread evenly from the first point to the last.
std::vector<std::size_t> chosen_nodes(const LociFile& loci, const Hdf5File& file, std::size_t room) {
  const std::size_t n = loci.n_nodes();
  std::set<std::size_t> chosen;
  if (room >= n) {
    for (std::size_t i = 0; i < n; ++i) chosen.insert(i);
    return {chosen.begin(), chosen.end()};
  }
  for (const std::int64_t node : file.read_integers("event_node")) {
    if (node >= 0 && static_cast<std::size_t>(node) < n && chosen.size() < room / 2)
      chosen.insert(static_cast<std::size_t>(node));
  }
  const std::size_t others = room - chosen.size();
  for (std::size_t i = 0; i < others; ++i) chosen.insert(others < 2 ? 0 : i * (n - 1) / (others - 1));
  return {chosen.begin(), chosen.end()};
}

/// Appends the shape of one mode, scaled so that its largest component has the magnitude `whole`. All zeros
/// if the mode does not exist.
void append_shape(const Complex* shape, std::size_t n, std::vector<std::int16_t>& numbers) {
  double size = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isfinite(std::abs(shape[i]))) size = std::max(size, std::abs(shape[i]));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const bool known = size > 0.0 && std::isfinite(std::abs(shape[i]));
    for (const double part : {shape[i].real(), shape[i].imag()})
      numbers.push_back(static_cast<std::int16_t>(known ? std::round(part / size * whole) : 0.0));
  }
}

}  // namespace

Json shapes_data(const LociFile& loci, const Hdf5File& file, const ReportBudget& budget) {
  const std::size_t n = loci.coordinates.size();
  const std::size_t room = budget.shapes / std::max<std::size_t>(bytes_per_node(loci), 1);
  if (room < 2 || n == 0) return nullptr;
  const std::vector<std::size_t> nodes = chosen_nodes(loci, file, room);
  std::vector<std::int16_t> numbers;
  std::vector<float> equilibrium;
  for (const std::size_t node : nodes) {
    const std::vector<Complex> shapes = file.read_complex_row("mode_shape", node);
    if (shapes.size() != loci.modes.size() * n)
      throw InputError(loci.path + ": mode_shape does not fit the other datasets");
    for (std::size_t mode = 0; mode < loci.modes.size(); ++mode)
      append_shape(shapes.data() + mode * n, n, numbers);
    for (const double x : loci.equilibrium.row(static_cast<Eigen::Index>(node)))
      equilibrium.push_back(static_cast<float>(x));
  }
  return {{"nodes", nodes},
          {"shapes", base64(numbers)},
          {"equilibrium", base64(equilibrium)},
          {"geometry", geometry_data(loci, nodes)}};
}

}  // namespace eigentrail
