#include "store/shaft_datasets.hpp"

#include "store/loci_schema.hpp"

namespace eigentrail {
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
  write_whole(file, whole_dataset("shaft_number"), numbers);
  write_whole(file, whole_dataset("shaft_place"), places);
  write_whole(file, whole_dataset("shaft_coordinate"), coordinates);
}

}  // namespace eigentrail
