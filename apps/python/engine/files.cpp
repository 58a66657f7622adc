#include <pybind11/stl.h>

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

}  // namespace

void add_files(py::module_& module) {
  module.def("import_files", &import_files, py::arg("format"), py::arg("files"), py::arg("options"),
             py::arg("folder"));
  module.def("import_formats", &formats);
  module.def("drawing_data", &drawing_data, py::arg("path"), py::arg("node"),
             py::call_guard<py::gil_scoped_release>());
  module.def("write_report", &write_report, py::arg("files"), py::arg("path"),
             py::call_guard<py::gil_scoped_release>());
}

}  // namespace eigentrail::python
