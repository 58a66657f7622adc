#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <variant>

#include "core/hdf5_file.hpp"
#include "eigentrail/import/importer.hpp"
#include "eigentrail/report/report.hpp"
#include "engine.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace eigentrail::python {
namespace {

/// Writes a scene and its matrices to `folder`, as `eigentrail import` does.
py::dict import_files(const std::string& format, const std::vector<std::string>& files,
                      const std::map<std::string, std::string>& options, const std::string& folder) {
  Imported imported;
  std::string scene;
  {
    const py::gil_scoped_release released;
    imported = importer(format).read({files, options});
    scene = write_import(imported, folder, "model", true);
  }
  return py::dict("scene"_a = scene, "title"_a = imported.title, "parameter"_a = imported.parameter,
                  "understood"_a = imported.understood, "warnings"_a = imported.warnings);
}

std::map<std::string, std::map<std::string, std::string>> formats() {
  std::map<std::string, std::map<std::string, std::string>> result;
  for (const Importer& importer : importers()) result[importer.format] = importer.options;
  return result;
}

struct StoredArray {
  Shape shape;
  std::variant<std::vector<double>, std::vector<Complex>, std::vector<std::int64_t>, std::vector<std::string>>
      values;
};

StoredArray stored_array(const Hdf5File& file, const std::string& name) {
  switch (file.element_type(name)) {
    case ElementType::real:
      return {file.shape(name), file.read_real(name)};
    case ElementType::complex:
      return {file.shape(name), file.read_complex(name)};
    case ElementType::integer:
      return {file.shape(name), file.read_integers(name)};
    default:
      return {file.shape(name), file.read_texts(name)};
  }
}

/// An array of NumPy that owns its values; texts are objects.
py::array as_numpy(const StoredArray& stored) {
  const auto with_values = [&]<class Element>(const std::vector<Element>& values) -> py::array {
    const std::vector<py::ssize_t> shape(stored.shape.begin(), stored.shape.end());
    if constexpr (std::is_same_v<Element, std::string>) {
      py::list texts;
      for (const std::string& text : values) texts.append(text);
      return py::array(py::module_::import("numpy").attr("array")(texts, "object")).reshape(shape);
    } else {
      return py::array_t<Element>(shape, values.data());
    }
  };
  return std::visit(with_values, stored.values);
}

/// Those of the datasets `names` that a loci file has, its traced parameter, and its attributes that are
/// texts: {name: array}, {name: text}. Other threads of Python run while the file is read.
std::pair<py::dict, std::map<std::string, std::string>> read_datasets(const py::bytes& image,
                                                                      std::vector<std::string> names) {
  const std::string_view bytes = image;
  std::map<std::string, StoredArray> arrays;
  std::map<std::string, std::string> texts;
  {
    const py::gil_scoped_release released;
    const Hdf5Turn turn;
    const Hdf5File file = Hdf5File::from_image("result", bytes);
    names.push_back(file.text_attribute("parameter"));
    for (const std::string& name : names) {
      if (file.has(name)) arrays.emplace(name, stored_array(file, name));
    }
    for (const std::string& name : file.attribute_names()) {
      if (file.is_text_attribute(name)) texts.emplace(name, file.text_attribute(name));
    }
  }
  py::dict result;
  for (const auto& [name, array] : arrays) result[py::str(name)] = as_numpy(array);
  return {result, texts};
}

}  // namespace

void add_files(py::module_& module) {
  module.def("import_files", &import_files, py::arg("format"), py::arg("files"), py::arg("options"),
             py::arg("folder"));
  module.def("import_formats", &formats);
  module.def("read_datasets", &read_datasets, py::arg("image"), py::arg("names"));
  module.def("drawing_data", &drawing_data, py::arg("path"), py::arg("node"),
             py::call_guard<py::gil_scoped_release>());
  module.def("write_report", &write_report, py::arg("files"), py::arg("path"),
             py::call_guard<py::gil_scoped_release>());
}

}  // namespace eigentrail::python
