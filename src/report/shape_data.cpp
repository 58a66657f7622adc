#include <algorithm>
#include <cmath>
#include <set>

#include "report/file_data.hpp"

namespace eigentrail {
namespace {

constexpr double whole = 32767.0;  ///< the integer of 16 bits that represents the largest component

/// Displacements of the nodes of shafts, x, y and z each, from the coordinates of a rotor.
class ShaftNodes {
 public:
  /// Empty if the file has no shafts.
  explicit ShaftNodes(const Hdf5File& file) {
    if (!file.has("shaft_node")) return;
    names_ = file.read_texts("shaft_node");
    places_ = file.read_real("shaft_place");
    numbers_ = file.read_integers("shaft_number");
    coordinates_ = file.read_integers("shaft_coordinate");
    if (places_.size() != names_.size() || numbers_.size() != names_.size() ||
        coordinates_.size() != 2 * names_.size())
      throw InputError("the datasets of shafts do not fit each other");
    if (file.has("projection_basis")) basis_ = file.read_real("projection_basis");
  }

  bool empty() const { return names_.empty(); }
  std::size_t size() const { return 3 * names_.size(); }

  /// `shape`: n coordinates of one mode.
  std::vector<Complex> displacements(const Complex* shape, std::size_t n) const {
    std::vector<Complex> result;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      for (const std::size_t axis : {0U, 1U})
        result.push_back(component(shape, n, coordinates_[2 * i + axis]));
      result.emplace_back(0.0);
    }
    return result;
  }

  std::vector<double> at_rest() const {
    std::vector<double> result;
    for (const double place : places_) result.insert(result.end(), {0.0, 0.0, place});
    return result;
  }

  /// As geometry_data: the nodes, and lines between neighbours of one shaft.
  Json geometry() const {
    Json carriers = Json::array(), places = Json::array(), lines = Json::array();
    for (std::size_t i = 0; i < names_.size(); ++i) {
      carriers.push_back({{"name", names_[i]}, {"first", 3 * i}, {"body", false}});
      places.push_back({{"carrier", i}, {"at", Json::array({Json::array({0, 0, 0})})}});
      if (i > 0 && numbers_[i] == numbers_[i - 1])
        lines.push_back({{"kind", "shaft"}, {"from", i - 1}, {"to", i}});
    }
    return {{"carriers", carriers}, {"places", places}, {"lines", lines}};
  }

 private:
  Complex component(const Complex* shape, std::size_t n, std::int64_t coordinate) const {
    if (coordinate < 0) return 0.0;
    const auto row = static_cast<std::size_t>(coordinate);
    if (basis_.empty()) return row < n ? shape[row] : 0.0;
    Complex sum = 0.0;
    for (std::size_t k = 0; k < n && row * n + k < basis_.size(); ++k) sum += basis_[row * n + k] * shape[k];
    return sum;
  }

  std::vector<std::string> names_;
  std::vector<double> places_, basis_;
  std::vector<std::int64_t> numbers_, coordinates_;
};

/// The points of the trace at which the page shows shapes: all of them if there are at most `room`. Otherwise
/// those of events (at most room / 2 of them) and others spread evenly from the first point to the last.
std::vector<std::size_t> chosen_nodes(const LociFile& loci, std::size_t room) {
  const std::size_t n = loci.n_nodes();
  std::set<std::size_t> chosen;
  for (const LociEvent& event : loci.events) {
    if (room < n && chosen.size() < room / 2) chosen.insert(static_cast<std::size_t>(event.node));
  }
  const std::size_t others = std::min(room, n) - chosen.size();
  for (std::size_t i = 0; i < others; ++i) chosen.insert(others < 2 ? 0 : i * (n - 1) / (others - 1));
  return {chosen.begin(), chosen.end()};
}

/// Appends the shape of one mode, scaled so that its largest component has the magnitude `whole`. All zeros
/// if the mode does not exist.
void append_shape(const std::vector<Complex>& shape, std::vector<std::int16_t>& numbers) {
  double size = 0.0;
  for (const Complex component : shape) {
    if (std::isfinite(std::abs(component))) size = std::max(size, std::abs(component));
  }
  for (const Complex component : shape) {
    const bool known = size > 0.0 && std::isfinite(std::abs(component));
    for (const double part : {component.real(), component.imag()})
      numbers.push_back(static_cast<std::int16_t>(known ? std::round(part / size * whole) : 0.0));
  }
}

}  // namespace

Json shapes_data(const LociFile& loci, const Hdf5File& file, const ReportBudget& budget) {
  const std::size_t n = loci.coordinates.size();
  const ShaftNodes shafts(file);
  const std::size_t shown = shafts.empty() ? n : shafts.size();
  const std::size_t bytes_per_node =
      loci.modes.size() * 2 * shown * sizeof(std::int16_t) + shown * sizeof(float);
  const std::size_t room = budget.shapes / std::max<std::size_t>(bytes_per_node, 1);
  if (room < 2 || n == 0) return nullptr;
  const std::vector<std::size_t> nodes = chosen_nodes(loci, room);
  std::vector<std::int16_t> numbers;
  std::vector<double> equilibrium;
  for (const std::size_t node : nodes) {
    const std::vector<Complex> shapes = file.read_complex_row("mode_shape", node);
    if (shapes.size() != loci.modes.size() * n)
      throw InputError(loci.path + ": mode_shape does not fit the other datasets");
    for (const Complex* shape = shapes.data(); shape < shapes.data() + shapes.size(); shape += n)
      append_shape(shafts.empty() ? std::vector(shape, shape + n) : shafts.displacements(shape, n), numbers);
    const auto row = loci.equilibrium.row(static_cast<Eigen::Index>(node));
    const std::vector<double> rest = shafts.empty() ? std::vector(row.begin(), row.end()) : shafts.at_rest();
    equilibrium.insert(equilibrium.end(), rest.begin(), rest.end());
  }
  return {{"nodes", nodes},
          {"shapes", base64(numbers)},
          {"equilibrium", base64<float>(equilibrium)},
          {"coordinates", shown},
          {"geometry", shafts.empty() ? geometry_data(loci, nodes) : shafts.geometry()}};
}

}  // namespace eigentrail
