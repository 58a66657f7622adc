#include <pybind11/stl.h>

#include "eigentrail/scene/settings.hpp"
#include "eigentrail/scene/traced_parameter.hpp"
#include "eigentrail/values.hpp"
#include "engine.hpp"

namespace py = pybind11;

namespace eigentrail::python {
namespace {

/// The entries of a matrix, without a copy.
MatrixInMemory view_of(const Doubles& entries) {
  const auto release = [](py::object* array) {
    const py::gil_scoped_acquire acquired;
    delete array;
  };
  const std::shared_ptr<py::object> owner(new py::object(entries), release);
  return {entries.data(), entries.shape(0), entries.shape(1), entries.shape(1), 1, owner};
}

using Arrays = std::map<std::string, std::map<std::string, Doubles>>;

Scene parse(std::string text, const std::string& path, const std::map<std::string, py::bytes>& files,
            const std::map<std::string, Arrays>& matrices, bool generated) {
  Scene scene = parse_scene(std::move(text), path, generated);
  for (const auto& [name, bytes] : files)
    scene.files[name] = std::make_shared<const std::string>(static_cast<std::string>(bytes));
  for (const auto& [file, groups] : matrices) {
    MatricesInMemory& in_memory = scene.matrices[file];
    for (const auto& [group, arrays] : groups) {
      for (const auto& [name, array] : arrays) in_memory[group][name] = view_of(array);
    }
  }
  return scene;
}

/// Names, units and values of the parameters.
std::vector<std::tuple<std::string, std::string, double>> parameters(const Scene& scene) {
  const Vector values = scene.parameters.declared_values();
  std::vector<std::tuple<std::string, std::string, double>> result;
  for (std::size_t i = 0; i < scene.parameters.size(); ++i)
    result.emplace_back(scene.parameters[i].name, scene.parameters[i].unit,
                        values[static_cast<Eigen::Index>(i)]);
  return result;
}

}  // namespace

void add_scenes(py::module_& module) {
  py::class_<Scene>(module, "Scene")
      .def_readonly("text", &Scene::text)
      .def_readonly("path", &Scene::path)
      .def_readonly("title", &Scene::title)
      .def_property_readonly("parameters", &parameters)
      .def_property_readonly("traced", &traced_parameter)
      .def("with_settings",
           [](const Scene& scene, const std::vector<std::string>& settings, const std::string& option) {
             ChangedScene changed = with_settings(scene, settings, option);
             return std::pair(std::move(changed.scene), std::move(changed.warnings));
           });
  module.def("read_scene", &read_scene);
  module.def("parse_scene", &parse);
  // What the program says of an option stays as it is: a ValueError.
  module.def("option_value", [](const std::string& option, const std::string& text, const std::string& name,
                                const std::string& unit) {
    try {
      return app::read_value(option, text, app::parameter_of_file(name, unit));
    } catch (const InputError& error) {
      throw py::value_error(error.what());
    }
  });
  module.def("suggestion", [](const std::string& name, const std::vector<std::string>& known) {
    return suggestion(name, known);
  });
}

}  // namespace eigentrail::python
