// The data of boundary files, stability maps and accuracy studies.
#include <span>

#include "eigentrail/stability/boundary.hpp"
#include "report/file_data.hpp"

namespace eigentrail {
namespace {

constexpr int samples_per_step = 24;

/// A file over two parameters, with these.
Json plane(const Hdf5File& file, const char* kind) {
  const auto axis = [&file](const std::string& name) -> Json {
    return {{"name", name}, {"unit", file.text_attribute(name, "units")}};
  };
  return {{"kind", kind},
          {"first", axis(file.text_attribute("parameter"))},
          {"second", axis(file.text_attribute("second_parameter"))}};
}

/// A step of a boundary, sampled: both parameters (`first`, `second`) and the eigenvalue (`real`, `imag`),
/// and whether it bounds the stable region (`bounds`).
Json step_data(const BoundaryStep& step, bool bounds) {
  std::vector<double> first, second, real, imag;
  for (int k = 0; k <= samples_per_step; ++k) {
    const Eigen::Vector4d f = evaluate_step(step, static_cast<double>(k) / samples_per_step);
    const Complex s = f[2] + std::sqrt(Complex(f[3]));
    first.push_back(f[0]);
    second.push_back(f[1]);
    real.push_back(s.real());
    imag.push_back(std::abs(s.imag()));
  }
  return {{"first", first}, {"second", second}, {"real", real}, {"imag", imag}, {"bounds", bounds}};
}

/// Adds the steps of a boundary file to its curves, from its dense output.
void add_steps(const Hdf5File& file, Json& curves) {
  const Shape shape = file.shape("dense_output");
  const auto dense = file.read_real("dense_output"), length = file.read_real("step_length");
  const auto curve = file.read_integers("step_curve"), points = file.read_integers("step_point"),
             others = file.read_integers("other_unstable");
  const bool fits = shape.size() == 4 && shape[0] == length.size() && shape[1] == 4 && shape[2] == 2 &&
                    shape[3] >= 2 && curve.size() == shape[0] && points.size() == shape[0];
  file.require_fit(fits, "dense_output");
  for (std::size_t i = 0; i < length.size(); ++i) {
    const auto of_curve = static_cast<std::size_t>(curve[i]), point = static_cast<std::size_t>(points[i]);
    if (of_curve >= curves.size()) continue;
    const bool known = points[i] >= 0 && point + 1 < others.size();
    const BoundaryStep step =
        boundary_step(length[i], dense.data() + i * 8 * shape[3], static_cast<Eigen::Index>(shape[3]));
    curves[of_curve]["steps"].push_back(
        step_data(step, known && others[point] == 0 && others[point + 1] == 0));
  }
}

Json corners(const Hdf5File& file) {
  const auto kinds = file.read_texts("corner_kind");
  const auto places = file.read_real("corner_parameter");
  file.require_fit(places.size() == 2 * kinds.size(), "corner_parameter");
  Json list = Json::array();
  for (std::size_t i = 0; i < kinds.size(); ++i)
    list.push_back({{"kind", kinds[i]}, {"first", places[2 * i]}, {"second", places[2 * i + 1]}});
  return list;
}

}  // namespace

Json boundary_data(const Hdf5File& file) {
  Json data = plane(file, "boundary");
  const auto kinds = file.read_texts("curve_kind");
  const auto modes = file.read_texts("curve_mode");
  const auto begins = file.read_texts("curve_begin");
  const auto ends = file.read_texts("curve_end");
  const auto extent = file.read_real("curve_extent");
  const std::size_t n = kinds.size();
  if (modes.size() != n || begins.size() != n || ends.size() != n || extent.size() != 4 * n)
    file.fail("the datasets of curves do not fit each other");
  data["curves"] = Json::array();
  for (std::size_t i = 0; i < n; ++i) {
    data["curves"].push_back({{"kind", kinds[i]},
                              {"mode", modes[i]},
                              {"begin", begins[i]},
                              {"end", ends[i]},
                              {"extent", std::span(extent).subspan(4 * i, 4)},
                              {"steps", Json::array()}});
  }
  if (n > 0) add_steps(file, data["curves"]);
  data["corners"] = corners(file);
  data["window"] = {{"first", {file.text_attribute("option_from"), file.text_attribute("option_to")}},
                    {"second", {file.real_attribute("second_from"), file.real_attribute("second_to")}}};
  return data;
}

Json map_data(const Hdf5File& file) {
  Json data = plane(file, "map");
  for (const char* axis : {"first", "second"}) data[axis]["values"] = file.read_real(data[axis]["name"]);
  const Shape window{data["second"]["values"].size(), data["first"]["values"].size()};
  for (const char* name : {"unstable", "margin", "damping_ratio"})
    file.require_fit(file.shape(name) == window, name);
  for (const char* name : {"axis_line", "axis_kind", "axis_frequency"})
    file.require_fit(file.shape(name) == file.shape("axis_parameter"), name);
  data["unstable"] = base64<std::int32_t>(file.read_integers("unstable"));
  for (const char* name : {"margin", "damping_ratio"}) data[name] = base64<float>(file.read_real(name));
  data["axis_points"] = {{"line", file.read_integers("axis_line")},
                         {"parameter", file.read_real("axis_parameter")},
                         {"kind", file.read_texts("axis_kind")},
                         {"frequency", file.read_real("axis_frequency")}};
  return data;
}

Json accuracy_data(const Hdf5File& file) {
  Json data{{"kind", "accuracy"}};
  const Shape runs = file.shape("method");
  for (const char* name : {"method", "status"}) data[name] = file.read_texts(name);
  for (const char* name : {"run_tolerance", "error", "error_parameter", "wall_time"})
    data[name] = file.read_real(name);
  for (const char* name : {"order", "points", "factorizations", "spectra"})
    data[name] = file.read_integers(name);
  for (const auto& [name, values] : data.items())
    file.require_fit(name == "kind" || file.shape(name) == runs, name);
  return data;
}

}  // namespace eigentrail
