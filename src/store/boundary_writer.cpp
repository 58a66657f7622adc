#include "eigentrail/store/boundary_writer.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/hdf5_writer.hpp"
#include "eigentrail/core/text.hpp"
#include "store/labelled_datasets.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

const std::array<std::string, 34> boundary_names = {"point",
                                                    "step",
                                                    "curve",
                                                    "corner",
                                                    "coordinate",
                                                    "parameter",
                                                    "function",
                                                    "end",
                                                    "order",
                                                    "bound",
                                                    "member",
                                                    "eigenvalue",
                                                    "tangent",
                                                    "other_unstable",
                                                    "mode_shape",
                                                    "equilibrium",
                                                    "flags",
                                                    "point_curve",
                                                    "step_point",
                                                    "step_curve",
                                                    "step_length",
                                                    "dense_output",
                                                    "curve_kind",
                                                    "curve_mode",
                                                    "curve_begin",
                                                    "curve_end",
                                                    "curve_closed",
                                                    "curve_first",
                                                    "curve_points",
                                                    "curve_extent",
                                                    "corner_kind",
                                                    "corner_parameter",
                                                    "corner_eigenvalue",
                                                    "corner_curve"};

std::vector<std::int64_t> count_to(std::size_t n) {
  std::vector<std::int64_t> list(n);
  std::iota(list.begin(), list.end(), std::int64_t{0});
  return list;
}

class BoundaryFile {
 public:
  BoundaryFile(const BoundarySetup& setup, const BoundaryResult& result)
      : file_(Hdf5Writer::in_memory("boundary file")),
        setup_(setup),
        result_(result),
        first_(setup.scene.parameters.at(setup.options.trace.parameter)),
        second_(setup.scene.parameters.at(setup.options.second)) {}

  /// The bytes of the whole file.
  std::string write() {
    write_attributes();
    write_dimensions();
    write_points();
    write_steps();
    write_curves();
    write_corners();
    return file_.image();
  }

 private:
  template <class Value>
  void dimension(const std::string& name, const std::vector<Value>& values, const std::string& long_name) {
    write_dimension(file_, {name, "1", long_name}, values);
  }

  template <class Value>
  void dataset(const DatasetLabel& label, const std::vector<std::string>& dimensions,
               const std::vector<Value>& data, std::map<std::string, std::string> attributes = {}) {
    if (dimensions[0] == "point" && label.name != first_.name && label.name != second_.name)
      attributes["coordinates"] = first_.name + " " + second_.name;
    write_dataset(file_, label, dimensions, data, std::move(attributes));
  }

  void write_attributes();
  void write_dimensions();
  void write_points();
  void write_steps();
  void write_curves();
  void write_corners();

  Hdf5Writer file_;
  const BoundarySetup& setup_;
  const BoundaryResult& result_;
  const Parameter& first_;
  const Parameter& second_;
};

void BoundaryFile::write_attributes() {
  const BoundaryOptions& options = setup_.options;
  const auto number = [this](const std::string& name, auto value) {
    file_.set_attribute(name, static_cast<std::int64_t>(value));
  };
  write_provenance(file_, boundary_format, boundary_schema_version, setup_.scene, options.trace);
  file_.set_attribute("second_parameter", second_.name);
  file_.set_attribute("second_from", options.second_from);
  file_.set_attribute("second_to", options.second_to);
  file_.set_attribute("damping_ratio", options.damping_ratio ? exact_text(*options.damping_ratio) : "none");
  number("lines", options.lines);
  file_.set_attribute("reference", result_.s_ref);
  write_notes(file_, result_.notes);
  file_.set_attribute("status", result_.status == BoundaryStatus::completed ? "completed" : "incomplete");
  file_.set_attribute("message", result_.message);
  file_.set_attribute("seconds", result_.seconds);
  number("count_curves", result_.curves.size());
  number("count_corners", result_.corners.size());
  number("count_lines", result_.lines);
  number("count_seeds", result_.seeds);
  number("count_walks", result_.walks);
  number("count_islands", result_.islands);
  number("count_rejected_steps", result_.rejected_steps);
  number("count_mode_factorizations", result_.counts.modes.factorizations);
  number("count_spectra", result_.counts.spectra);
  number("count_equilibrium_factorizations", result_.counts.equilibrium_factorizations);
}

void BoundaryFile::write_dimensions() {
  std::size_t points = 0;
  std::size_t steps = 0;
  for (const BoundaryCurve& curve : result_.curves) {
    points += curve.points.size();
    steps += curve.steps.size();
  }
  dimension("point", count_to(points), "point of a curve");
  dimension("step", count_to(steps), "step from a point of a curve to the next");
  dimension("curve", count_to(result_.curves.size()), "curve");
  dimension("corner", count_to(result_.corners.size()), "point that belongs to two curves");
  dimension("coordinate", setup_.model->description().coordinate_names, "coordinate");
  dimension("parameter", std::vector<std::string>{first_.name, second_.name}, "parameter of the plane");
  dimension("function",
            std::vector<std::string>{first_.name, second_.name, "mean", "squared half difference"},
            "what is interpolated: the parameters, and of the pair s, conj s the mean tau and delta; "
            "s = tau + sqrt(delta)");
  dimension("end", std::vector<std::string>{"left", "right"}, "end of a step");
  dimension("order", count_to(static_cast<std::size_t>(setup_.options.trace.order.value_or(usual_order)) + 1),
            "power of the distance from the end of the step");
  dimension("bound", std::vector<std::string>{"lowest", "highest"}, "bound of an extent");
  dimension("member", std::vector<std::string>{"first", "second"}, "the two curves that meet in a corner");
}

void BoundaryFile::write_points() {
  std::vector<double> P, Q, tangent, equilibrium;
  std::vector<Complex> eigenvalue, shape;
  std::vector<std::int64_t> curve_number, others, flags;
  for (std::size_t i = 0; i < result_.curves.size(); ++i) {
    for (const BoundaryPoint& point : result_.curves[i].points) {
      P.push_back(point.place[0]);
      Q.push_back(point.place[1]);
      tangent.insert(tangent.end(), point.tangent.begin(), point.tangent.end());
      eigenvalue.push_back(point.s);
      shape.insert(shape.end(), point.shape.begin(), point.shape.end());
      equilibrium.insert(equilibrium.end(), point.equilibrium.begin(), point.equilibrium.end());
      curve_number.push_back(static_cast<std::int64_t>(i));
      others.push_back(point.others);
      flags.push_back(point.flags);
    }
  }
  dataset({first_.name, label_unit(first_.unit), "first parameter " + first_.name}, {"point"}, P);
  dataset({second_.name, label_unit(second_.unit), "second parameter " + second_.name}, {"point"}, Q);
  dataset({"point_curve", "1", "curve that the point belongs to"}, {"point"}, curve_number);
  dataset({"eigenvalue", "1/s", "eigenvalue s on the boundary, Im s >= 0"}, {"point"}, eigenvalue);
  dataset({"tangent", "1",
           "direction of the curve in the parameters' units, of unit length where the window has side one"},
          {"point", "parameter"}, tangent);
  dataset({"other_unstable", "1",
           "number of other modes that are unstable (less damped); 0: the point bounds the stable region"},
          {"point"}, others);
  dataset({"mode_shape", "1",
           "mode shape in physical coordinates, unit M-norm, its largest component real and positive"},
          {"point", "coordinate"}, shape);
  dataset({"equilibrium", setup_.model->description().coordinate_units[0], "steady equilibrium x0"},
          {"point", "coordinate"}, equilibrium);
  dataset({"flags", "1", "what is special about the point"}, {"point"}, flags,
          {{"flag_meanings", "seed:1 edge:2 takens_bogdanov:4"}});
}

void BoundaryFile::write_steps() {
  std::vector<double> length, dense;
  std::vector<std::int64_t> curve_number, left_point;
  std::int64_t first = 0;
  for (std::size_t i = 0; i < result_.curves.size(); ++i) {
    const BoundaryCurve& curve = result_.curves[i];
    for (std::size_t k = 0; k < curve.steps.size(); ++k) {
      const BoundaryStep& step = curve.steps[k];
      length.push_back(step.length);
      curve_number.push_back(static_cast<std::int64_t>(i));
      left_point.push_back(first + static_cast<std::int64_t>(k));
      for (Eigen::Index row = 0; row < step.left.rows(); ++row) {
        for (const Matrix* end : {&step.left, &step.right})
          dense.insert(dense.end(), end->row(row).begin(), end->row(row).end());
      }
    }
    first += static_cast<std::int64_t>(curve.points.size());
  }
  dataset({"step_curve", "1", "curve that the step belongs to"}, {"step"}, curve_number);
  dataset({"step_point", "1", "point at the left end of the step; the next one is at its right end"},
          {"step"}, left_point);
  dataset({"step_length", "1", "length of the step's chord where the window has side one"}, {"step"}, length);
  dataset({"dense_output", "1", "series of the functions in the distance along the chord at both ends"},
          {"step", "function", "end", "order"}, dense);
}

void BoundaryFile::write_curves() {
  std::vector<std::string> kind, mode, begin, end;
  std::vector<std::int64_t> closed, first, count;
  std::vector<double> extent;
  std::int64_t points = 0;
  for (const BoundaryCurve& curve : result_.curves) {
    kind.push_back(boundary_name(curve.kind));
    mode.push_back(curve.mode);
    begin.push_back(curve_end_name(curve.begin) +
                    (curve.begin_reason.empty() ? "" : ": " + curve.begin_reason));
    end.push_back(curve_end_name(curve.end) + (curve.end_reason.empty() ? "" : ": " + curve.end_reason));
    closed.push_back(curve.closed() ? 1 : 0);
    first.push_back(points);
    count.push_back(static_cast<std::int64_t>(curve.points.size()));
    points += count.back();
    const auto [low, high] = curve.extent();
    for (const Eigen::Index i : {0, 1}) extent.insert(extent.end(), {low[i], high[i]});
  }
  dataset({"curve_kind", "1", "flutter, divergence or damping_ratio"}, {"curve"}, kind);
  dataset({"curve_mode", "1", "mode by ascending abs(s) where it was found"}, {"curve"}, mode);
  dataset({"curve_begin", "1", "how the curve begins"}, {"curve"}, begin);
  dataset({"curve_end", "1", "how the curve ends"}, {"curve"}, end);
  dataset({"curve_closed", "1", "1: it is closed"}, {"curve"}, closed);
  dataset({"curve_first", "1", "its first point"}, {"curve"}, first);
  dataset({"curve_points", "1", "number of its points; a closed curve repeats its first"}, {"curve"}, count);
  dataset({"curve_extent", "1", "lowest and highest parameters, in their units"},
          {"curve", "parameter", "bound"}, extent);
}

void BoundaryFile::write_corners() {
  std::vector<std::string> kind;
  std::vector<double> place;
  std::vector<Complex> eigenvalue;
  std::vector<std::int64_t> curves;
  for (const Corner& corner : result_.corners) {
    kind.push_back(corner_name(corner.kind));
    place.insert(place.end(), corner.place.begin(), corner.place.end());
    eigenvalue.insert(eigenvalue.end(), corner.s.begin(), corner.s.end());
    curves.insert(curves.end(), corner.curves.begin(), corner.curves.end());
  }
  dataset({"corner_kind", "1",
           "intersection: two curves intersect; takens_bogdanov: a curve of pairs ends on one of divergence"},
          {"corner"}, kind);
  dataset({"corner_parameter", "1", "place, in the parameters' units"}, {"corner", "parameter"}, place);
  dataset({"corner_eigenvalue", "1/s", "eigenvalues of both curves"}, {"corner", "member"}, eigenvalue);
  dataset({"corner_curve", "1", "both curves"}, {"corner", "member"}, curves);
}

}  // namespace

void check_boundary_names(const Scene& scene, const BoundaryOptions& options) {
  for (const std::string& name : {options.trace.parameter, options.second}) {
    if (std::find(boundary_names.begin(), boundary_names.end(), name) != boundary_names.end())
      throw scene_error(scene, scene.parameters.at(name).where,
                        "[parameters] " + name + ": a parameter of the plane cannot be called '" + name +
                            "', the boundary file has a dataset of that name; rename it");
  }
}

std::string boundary_file(const BoundarySetup& setup, const BoundaryResult& result) {
  return BoundaryFile(setup, result).write();
}

}  // namespace eigentrail
