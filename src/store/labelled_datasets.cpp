#include "store/labelled_datasets.hpp"

#include <numeric>

namespace eigentrail {

std::vector<std::int64_t> counted(std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
  return numbers;
}

Matrix read_matrix(const Hdf5File& file, const std::string& name, std::size_t rows, std::size_t columns) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  file.require_fit(file.shape(name) == Shape{rows, columns}, name);
  const std::vector<double> data = rows * columns == 0 ? std::vector<double>() : file.read_real(name);
  return Eigen::Map<const RowMajor>(data.data(), static_cast<Eigen::Index>(rows),
                                    static_cast<Eigen::Index>(columns));
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
