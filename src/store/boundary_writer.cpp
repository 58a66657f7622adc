#include "eigentrail/store/boundary_writer.hpp"

#include <array>
#include <utility>

#include "core/hdf5_writer.hpp"
#include "eigentrail/core/text.hpp"
#include "store/labelled_datasets.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

void write_outcome(Hdf5Writer& file, const BoundaryOptions& options, const BoundaryResult& result) {
  file.set_attribute("second_from", options.second_from);
  file.set_attribute("second_to", options.second_to);
  file.set_attribute("damping_ratio", options.damping_ratio ? exact_text(*options.damping_ratio) : "none");
  file.set_attribute("lines", options.lines);
  file.set_attribute("reference", result.s_ref);
  write_notes(file, result.notes);
  file.set_attribute("status", result.status == BoundaryStatus::completed ? "completed" : "incomplete");
  file.set_attribute("message", result.message);
  file.set_attribute("seconds", result.seconds);
  file.set_attribute("count_curves", result.curves.size());
  file.set_attribute("count_corners", result.corners.size());
  file.set_attribute("count_lines", result.lines);
  file.set_attribute("count_seeds", result.seeds);
  file.set_attribute("count_walks", result.walks);
  file.set_attribute("count_islands", result.islands);
  file.set_attribute("count_rejected_steps", result.rejected_steps);
  file.set_attribute("count_mode_factorizations", result.counts.modes.factorizations);
  file.set_attribute("count_spectra", result.counts.spectra);
  file.set_attribute("count_equilibrium_factorizations", result.counts.equilibrium_factorizations);
}

void write_dimensions(Hdf5Writer& file, const BoundarySetup& setup, const BoundaryResult& result,
                      const Parameter& first, const Parameter& second) {
  const auto dimension = [&file](const char* name, const auto& values, const char* long_name) {
    write_dimension(file, {name, "1", long_name}, values);
  };
  std::size_t points = 0;
  std::size_t steps = 0;
  for (const BoundaryCurve& curve : result.curves) {
    points += curve.points.size();
    steps += curve.steps.size();
  }
  dimension("point", counted(points), "point of a curve");
  dimension("step", counted(steps), "step from a point of a curve to the next");
  dimension("curve", counted(result.curves.size()), "curve");
  dimension("corner", counted(result.corners.size()), "point that belongs to two curves");
  dimension("coordinate", setup.model->description().coordinate_names, "coordinate");
  dimension("parameter", std::vector<std::string>{first.name, second.name}, "parameter of the plane");
  dimension("function", std::vector<std::string>{first.name, second.name, "mean", "squared half difference"},
            "what is interpolated: the parameters, and of the pair s, conj s the mean tau and delta; "
            "s = tau + sqrt(delta)");
  dimension("end", std::vector<std::string>{"left", "right"}, "end of a step");
  dimension("order", counted(static_cast<std::size_t>(setup.options.trace.order.value_or(usual_order)) + 1),
            "power of the distance from the end of the step");
  dimension("bound", std::vector<std::string>{"lowest", "highest"}, "bound of an extent");
  dimension("member", std::vector<std::string>{"first", "second"}, "the two curves that meet in a corner");
}

/// Rows of the functions, of each the series at both ends.
std::vector<double> series_of(const BoundaryStep* step) {
  std::vector<double> series;
  for (Eigen::Index row = 0; row < step->left.rows(); ++row) {
    for (const Matrix* end : {&step->left, &step->right})
      series.insert(series.end(), end->row(row).begin(), end->row(row).end());
  }
  return series;
}

void write_points(Hdf5Writer& file, const BoundarySetup& setup, const BoundaryResult& result,
                  const Parameter& first, const Parameter& second) {
  std::vector<const BoundaryPoint*> points;
  std::vector<std::int64_t> curves;
  for (std::size_t i = 0; i < result.curves.size(); ++i) {
    for (const BoundaryPoint& point : result.curves[i].points) points.push_back(&point);
    curves.resize(points.size(), static_cast<std::int64_t>(i));
  }
  const auto coordinate = [](int i) { return [i](const BoundaryPoint* point) { return point->place[i]; }; };
  write_column(file, {first.name, label_unit(first.unit), "first parameter " + first.name}, {"point"}, points,
               coordinate(0));
  write_column(file, {second.name, label_unit(second.unit), "second parameter " + second.name}, {"point"},
               points, coordinate(1));
  std::map<std::string, std::string> attributes{{"coordinates", first.name + " " + second.name}};
  const auto write = [&](const DatasetLabel& label, const std::vector<std::string>& dimensions, auto field) {
    write_column(file, label, dimensions, points, field, attributes);
  };
  write_dataset(file, {"point_curve", "1", "curve that the point belongs to"}, {"point"}, curves, attributes);
  write({"eigenvalue", "1/s", "eigenvalue s on the boundary, Im s >= 0"}, {"point"}, &BoundaryPoint::s);
  write({"tangent", "1",
         "direction of the curve in the parameters' units, of unit length where the window has side one"},
        {"point", "parameter"}, &BoundaryPoint::tangent);
  write({"other_unstable", "1",
         "number of other modes that are unstable (less damped); 0: the point bounds the stable region"},
        {"point"}, &BoundaryPoint::others);
  write({"mode_shape", "1",
         "mode shape in physical coordinates, unit M-norm, its largest component real and positive"},
        {"point", "coordinate"}, &BoundaryPoint::shape);
  write({"equilibrium", setup.model->description().coordinate_units[0], "steady equilibrium x0"},
        {"point", "coordinate"}, &BoundaryPoint::equilibrium);
  attributes["flag_meanings"] = "seed:1 edge:2 takens_bogdanov:4";
  write({"flags", "1", "what is special about the point"}, {"point"}, &BoundaryPoint::flags);
}

void write_steps(Hdf5Writer& file, const BoundaryResult& result) {
  std::vector<const BoundaryStep*> steps;
  std::vector<std::int64_t> curves, points;
  std::int64_t first = 0;
  for (std::size_t i = 0; i < result.curves.size(); ++i) {
    const BoundaryCurve& curve = result.curves[i];
    for (const BoundaryStep& step : curve.steps) {
      points.push_back(first + (&step - curve.steps.data()));
      steps.push_back(&step);
    }
    curves.resize(steps.size(), static_cast<std::int64_t>(i));
    first += static_cast<std::int64_t>(curve.points.size());
  }
  write_dataset(file, {"step_curve", "1", "curve that the step belongs to"}, {"step"}, curves);
  write_dataset(file,
                {"step_point", "1", "point at the left end of the step; the next one is at its right end"},
                {"step"}, points);
  write_column(file, {"step_length", "1", "length of the step's chord where the window has side one"},
               {"step"}, steps, &BoundaryStep::length);
  write_column(file,
               {"dense_output", "1", "series of the functions in the distance along the chord at both ends"},
               {"step", "function", "end", "order"}, steps, series_of);
}

void write_curves(Hdf5Writer& file, const BoundaryResult& result) {
  using Curve = BoundaryCurve;
  const auto write = [&](const DatasetLabel& label, auto field) {
    write_column(file, label, {"curve"}, result.curves, field);
  };
  const auto end_text = [](CurveEnd end, const std::string& reason) {
    return curve_end_name(end) + (reason.empty() ? "" : ": " + reason);
  };
  write({"curve_kind", "1", "flutter, divergence or damping_ratio"},
        [](const Curve& curve) { return boundary_name(curve.kind); });
  write({"curve_mode", "1", "mode by ascending abs(s) where it was found"}, &Curve::mode);
  write({"curve_begin", "1", "how the curve begins"},
        [&](const Curve& curve) { return end_text(curve.begin, curve.begin_reason); });
  write({"curve_end", "1", "how the curve ends"},
        [&](const Curve& curve) { return end_text(curve.end, curve.end_reason); });
  write({"curve_closed", "1", "1: it is closed"}, &Curve::closed);
  write({"curve_first", "1", "its first point"}, [next = std::size_t{0}](const Curve& curve) mutable {
    return std::exchange(next, next + curve.points.size());
  });
  write({"curve_points", "1", "number of its points; a closed curve repeats its first"},
        [](const Curve& curve) { return curve.points.size(); });
  write_column(file, {"curve_extent", "1", "lowest and highest parameters, in their units"},
               {"curve", "parameter", "bound"}, result.curves, [](const Curve& curve) {
                 const auto [low, high] = curve.extent();
                 return std::array{low[0], high[0], low[1], high[1]};
               });
}

void write_corners(Hdf5Writer& file, const BoundaryResult& result) {
  const std::vector<Corner>& corners = result.corners;
  write_column(
      file,
      {"corner_kind", "1",
       "intersection: two curves intersect; takens_bogdanov: a curve of pairs ends on one of divergence"},
      {"corner"}, corners, [](const Corner& corner) { return corner_name(corner.kind); });
  write_column(file, {"corner_parameter", "1", "place, in the parameters' units"}, {"corner", "parameter"},
               corners, &Corner::place);
  write_column(file, {"corner_eigenvalue", "1/s", "eigenvalues of both curves"}, {"corner", "member"},
               corners, &Corner::s);
  write_column(file, {"corner_curve", "1", "both curves"}, {"corner", "member"}, corners, &Corner::curves);
}

Hdf5Writer boundary_writer(const BoundarySetup& setup, const BoundaryResult& result, const Parameter& first,
                           const Parameter& second) {
  Hdf5Writer file = Hdf5Writer::in_memory("boundary file");
  write_provenance(file, boundary_format, boundary_schema_version, setup.scene, setup.options.trace);
  file.set_attribute("second_parameter", second.name);
  write_outcome(file, setup.options, result);
  write_dimensions(file, setup, result, first, second);
  write_points(file, setup, result, first, second);
  write_steps(file, result);
  write_curves(file, result);
  write_corners(file, result);
  return file;
}

}  // namespace

void check_boundary_names(const BoundarySetup& setup) {
  const auto [first, second] = parameters_of_other_names();
  require_other_names(setup.scene, {setup.options.trace.parameter, setup.options.second},
                      boundary_writer(setup, {}, first, second), "plane", "the boundary file");
}

std::string boundary_file(const BoundarySetup& setup, const BoundaryResult& result) {
  const Parameters& parameters = setup.scene.parameters;
  return boundary_writer(setup, result, parameters.at(setup.options.trace.parameter),
                         parameters.at(setup.options.second))
      .image();
}

}  // namespace eigentrail
