#include "store/shaft_datasets.hpp"

#include <algorithm>
#include <array>

#include "store/labelled_datasets.hpp"

namespace eigentrail {
namespace {

const std::array<std::string, 5> shaft_names = {"shaft_node", "shaft_axis", "shaft_number", "shaft_place",
                                                "shaft_coordinate"};

}  // namespace

bool is_shaft_dataset(const std::string& name) {
  return std::find(shaft_names.begin(), shaft_names.end(), name) != shaft_names.end();
}

void write_shafts(Hdf5Writer& file, const ModelDescription& description) {
  if (description.shafts.empty()) return;
  std::vector<std::string> names;
  std::vector<std::int64_t> numbers, coordinates;
  std::vector<double> places;
  std::int64_t number = 0;
  for (const SpinningShaft& shaft : description.shafts) {
    for (std::size_t i = 0; i < shaft.nodes.size(); ++i) {
      names.push_back((shaft.name.empty() ? "" : shaft.name + " ") + "node " + std::to_string(i + 1));
      numbers.push_back(number);
      places.push_back(shaft.places[i]);
      for (const Eigen::Index coordinate : shaft.nodes[i]) coordinates.push_back(coordinate);
    }
    ++number;
  }
  write_dimension(file, {"shaft_node", "1", "node of a shaft"}, names);
  write_dimension(file, {"shaft_axis", "1", "direction of a displacement"},
                  std::vector<std::string>{"x", "y"});
  write_dataset(file, {"shaft_number", "1", "shaft that the node belongs to, from 0"}, {"shaft_node"},
                numbers);
  write_dataset(file, {"shaft_place", "m", "place of the node along the z axis"}, {"shaft_node"}, places);
  write_dataset(
      file,
      {"shaft_coordinate", "1",
       "index of the coordinate that is the displacement of the node (of the freedom, if the model is "
       "projected), from 0; -1: held"},
      {"shaft_node", "shaft_axis"}, coordinates);
}

}  // namespace eigentrail
