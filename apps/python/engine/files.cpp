#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cerrno>
#include <system_error>
#include <variant>

#include "core/hdf5_file.hpp"
#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/import/importer.hpp"
#include "eigentrail/report/report.hpp"
#include "eigentrail/store/output_file.hpp"
#include "engine.hpp"
#include "report/file_data.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace eigentrail::python {
py::object as_text(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

namespace {

/// Writes a scene and its matrices to `folder`, as `eigentrail import` does.
py::dict import_files(const std::string& format, const std::vector<std::string>& files,
                      const std::map<std::string, std::string>& options, const std::string& folder) {
  Imported imported;
  {
    const py::gil_scoped_release released;
    imported = importer(format).read({files, options});
    write_import(imported, folder, "model", true);
  }
  return py::dict("title"_a = imported.title, "parameter"_a = imported.parameter,
                  "understood"_a = imported.understood, "warnings"_a = imported.warnings);
}

std::map<std::string, std::map<std::string, std::string>> formats() {
  std::map<std::string, std::map<std::string, std::string>> result;
  for (const Importer& importer : importers()) result[importer.format] = importer.options;
  return result;
}

/// An array of NumPy that owns its values; texts are objects.
py::array as_numpy(const StoredArray& stored) {
  const auto with_values = [&]<class Element>(const std::vector<Element>& values) -> py::array {
    const std::vector<py::ssize_t> shape(stored.shape.begin(), stored.shape.end());
    if constexpr (std::is_same_v<Element, std::string>) {
      py::list texts;
      for (const std::string& text : values) texts.append(as_text(text));
      return py::array(py::module_::import("numpy").attr("array")(texts, "object")).reshape(shape);
    } else {
      return py::array_t<Element>(shape, values.data());
    }
  };
  return std::visit(with_values, stored.elements);
}

/// Single values become scalars of NumPy and texts.
py::dict as_python(const std::map<std::string, StoredArray>& attributes) {
  py::dict result;
  for (const auto& [name, value] : attributes) result[as_text(name)] = as_numpy(value)[py::tuple()];
  return result;
}

/// The datasets of a file, {name: (array, attributes)}, and its attributes. The attribute DIMENSION_LIST of a
/// dataset has the names of its dimensions. Other threads of Python run while the file is read. Throws
/// InputError if the file, called `called`, is no HDF5 file or damaged.
std::pair<py::dict, py::dict> read_file(const py::bytes& image, const std::string& called) {
  const std::string_view bytes = image;
  std::vector<std::tuple<std::string, StoredArray, std::map<std::string, StoredArray>>> datasets;
  std::map<std::string, StoredArray> attributes;
  {
    const py::gil_scoped_release released;
    const Hdf5File file = Hdf5File::from_image(called, bytes);
    attributes = file.attributes("/");
    for (const std::string& name : file.members("/")) {
      if (std::optional<StoredArray> array = file.read(name))
        datasets.emplace_back(name, std::move(*array), file.attributes(name));
    }
  }
  py::dict result;
  for (const auto& [name, array, of_dataset] : datasets)
    result[as_text(name)] = py::make_tuple(as_numpy(array), as_python(of_dataset));
  return {result, as_python(attributes)};
}

/// Whether the files may be replaced, as existing_pair says; FileExistsError where one of them is to be kept.
Existing existing(const std::vector<NewFile>& files, bool overwrite) {
  try {
    return existing_pair(files.front().path, files.back().path, overwrite,
                         "give another name, or overwrite=True");
  } catch (const InputError& error) {
    PyErr_SetObject(PyExc_FileExistsError, as_text(error.what()).ptr());
    throw py::error_already_set();
  }
}

/// Writes bytes to one or two paths, as write_durably does. Errors of the system become OSError.
void write_files(const std::vector<std::pair<std::string, py::bytes>>& contents, bool overwrite) {
  std::vector<NewFile> files;
  for (const auto& [path, bytes] : contents) files.push_back({path, {std::string_view(bytes)}});
  const Existing treated = existing(files, overwrite);
  try {
    const py::gil_scoped_release released;
    write_durably(files, treated);
  } catch (const std::system_error& error) {
    errno = error.code().value();
    PyErr_SetFromErrnoWithFilename(PyExc_OSError, contents.front().first.c_str());
    throw py::error_already_set();
  }
}

/// Per kind of event: its mark, its name, and whether pictures write the name beside the mark.
py::dict kinds_of_events() {
  py::dict result;
  for (const EventKindInfo& kind : event_kinds())
    result[py::cast(kind.name)] = py::make_tuple(kind.symbol, kind.long_name, kind.labelled);
  return result;
}

}  // namespace

void add_files(py::module_& module) {
  module.def("import_files", &import_files);
  module.def("event_kinds", &kinds_of_events);
  module.def("import_formats", &formats);
  module.def("read_file", &read_file);
  module.def("write_files", &write_files);
  module.def("carriers", [](const std::vector<std::string>& coordinates) {
    return page_json(carriers_data(coordinates));
  });
  module.def("drawing_data", &drawing_data, py::call_guard<py::gil_scoped_release>());
}

}  // namespace eigentrail::python
