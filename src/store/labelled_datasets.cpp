#include "store/labelled_datasets.hpp"

#include <numeric>

namespace eigentrail {

void create_dataset(Hdf5Writer& file, const DatasetLabel& label, ElementType type,
                    const std::vector<std::string>& dimensions, bool growing,
                    std::map<std::string, std::string> attributes) {
  Shape shape;
  for (const std::string& dimension : dimensions) shape.push_back(file.shape(dimension)[0]);
  attributes["units"] = label.units;
  attributes["long_name"] = label.long_name;
  file.create_dataset({label.name, type, shape, growing, attributes});
  for (std::size_t d = 0; d < dimensions.size(); ++d)
    file.attach_scale(label.name, dimensions[d], static_cast<unsigned>(d));
}

std::vector<std::int64_t> counted(std::size_t count, std::size_t first) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), static_cast<std::int64_t>(first));
  return numbers;
}

std::pair<Parameter, Parameter> parameters_of_other_names() {
  std::pair<Parameter, Parameter> both;
  both.first.name = "first parameter";
  both.second.name = "second parameter";
  return both;
}

void require_other_names(const Scene& scene, const std::vector<std::string>& parameters,
                         const Hdf5Writer& written, const std::string& of, const std::string& file) {
  for (const std::string& name : parameters) {
    if (!written.has(name)) continue;
    throw scene_error(scene, scene.parameters.at(name).where,
                      "[parameters] " + name + ": a parameter of the " + of + " cannot be called '" + name +
                          "', " + file + " has a dataset of that name; rename it");
  }
}

}  // namespace eigentrail
