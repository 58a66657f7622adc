#include "eigentrail/store/boundary_writer.hpp"

#include <array>
#include <utility>

#include "core/hdf5_writer.hpp"
#include "eigentrail/core/text.hpp"
#include "store/labelled_datasets.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

class BoundaryFile {
 public:
  BoundaryFile(const BoundarySetup& setup, const BoundaryResult& result, const Parameter& first,
               const Parameter& second)
      : file_(Hdf5Writer::in_memory("boundary file")),
        setup_(setup),
        result_(result),
        first_(first),
        second_(second) {}

  /// The whole file.
  Hdf5Writer& write() {
    write_attributes();
    write_dimensions();
    write_points();
    write_steps();
    write_curves();
    write_corners();
    return file_;
  }

 private:
  template <class Value>
  void dimension(const std::string& name, const std::vector<Value>& values, const std::string& long_name) {
    write_dimension(file_, {name, "1", long_name}, values);
  }

  /// Of `records` along the first dimension.
  template <class Record, class Field>
  void column(const DatasetLabel& label, const std::vector<std::string>& dimensions,
              const std::vector<Record>& records, Field field,
              std::map<std::string, std::string> attributes = {}) {
    if (dimensions[0] == "point" && label.name != first_.name && label.name != second_.name)
      attributes["coordinates"] = first_.name + " " + second_.name;
    write_column(file_, label, dimensions, records, field, std::move(attributes));
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
  dimension("point", counted(points), "point of a curve");
  dimension("step", counted(steps), "step from a point of a curve to the next");
  dimension("curve", counted(result_.curves.size()), "curve");
  dimension("corner", counted(result_.corners.size()), "point that belongs to two curves");
  dimension("coordinate", setup_.model->description().coordinate_names, "coordinate");
  dimension("parameter", std::vector<std::string>{first_.name, second_.name}, "parameter of the plane");
  dimension("function",
            std::vector<std::string>{first_.name, second_.name, "mean", "squared half difference"},
            "what is interpolated: the parameters, and of the pair s, conj s the mean tau and delta; "
            "s = tau + sqrt(delta)");
  dimension("end", std::vector<std::string>{"left", "right"}, "end of a step");
  dimension("order", counted(static_cast<std::size_t>(setup_.options.trace.order.value_or(usual_order)) + 1),
            "power of the distance from the end of the step");
  dimension("bound", std::vector<std::string>{"lowest", "highest"}, "bound of an extent");
  dimension("member", std::vector<std::string>{"first", "second"}, "the two curves that meet in a corner");
}

/// A point, or a step and the number of its first point, with the number of its curve.
struct PointOfCurve {
  const BoundaryPoint* point;
  std::size_t curve;
};
struct StepOfCurve {
  const BoundaryStep* step;
  std::size_t curve, first;
};

/// Rows of the functions, of each the series at both ends.
std::vector<double> series_of(const BoundaryStep& step) {
  std::vector<double> series;
  for (Eigen::Index row = 0; row < step.left.rows(); ++row) {
    for (const Matrix* end : {&step.left, &step.right})
      series.insert(series.end(), end->row(row).begin(), end->row(row).end());
  }
  return series;
}

void BoundaryFile::write_points() {
  std::vector<PointOfCurve> points;
  for (std::size_t i = 0; i < result_.curves.size(); ++i) {
    for (const BoundaryPoint& point : result_.curves[i].points) points.push_back({&point, i});
  }
  const auto of_point = [](auto member) {
    return [member](const PointOfCurve& one) { return one.point->*member; };
  };
  const auto coordinate = [](int i) { return [i](const PointOfCurve& one) { return one.point->place[i]; }; };
  column({first_.name, label_unit(first_.unit), "first parameter " + first_.name}, {"point"}, points,
         coordinate(0));
  column({second_.name, label_unit(second_.unit), "second parameter " + second_.name}, {"point"}, points,
         coordinate(1));
  column({"point_curve", "1", "curve that the point belongs to"}, {"point"}, points, &PointOfCurve::curve);
  column({"eigenvalue", "1/s", "eigenvalue s on the boundary, Im s >= 0"}, {"point"}, points,
         of_point(&BoundaryPoint::s));
  column({"tangent", "1",
          "direction of the curve in the parameters' units, of unit length where the window has side one"},
         {"point", "parameter"}, points, of_point(&BoundaryPoint::tangent));
  column({"other_unstable", "1",
          "number of other modes that are unstable (less damped); 0: the point bounds the stable region"},
         {"point"}, points, of_point(&BoundaryPoint::others));
  column({"mode_shape", "1",
          "mode shape in physical coordinates, unit M-norm, its largest component real and positive"},
         {"point", "coordinate"}, points, of_point(&BoundaryPoint::shape));
  column({"equilibrium", setup_.model->description().coordinate_units[0], "steady equilibrium x0"},
         {"point", "coordinate"}, points, of_point(&BoundaryPoint::equilibrium));
  column({"flags", "1", "what is special about the point"}, {"point"}, points,
         of_point(&BoundaryPoint::flags), {{"flag_meanings", "seed:1 edge:2 takens_bogdanov:4"}});
}

void BoundaryFile::write_steps() {
  std::vector<StepOfCurve> steps;
  std::size_t first = 0;
  for (std::size_t i = 0; i < result_.curves.size(); ++i) {
    const BoundaryCurve& curve = result_.curves[i];
    for (std::size_t k = 0; k < curve.steps.size(); ++k) steps.push_back({&curve.steps[k], i, first + k});
    first += curve.points.size();
  }
  column({"step_curve", "1", "curve that the step belongs to"}, {"step"}, steps, &StepOfCurve::curve);
  column({"step_point", "1", "point at the left end of the step; the next one is at its right end"}, {"step"},
         steps, &StepOfCurve::first);
  column({"step_length", "1", "length of the step's chord where the window has side one"}, {"step"}, steps,
         [](const StepOfCurve& one) { return one.step->length; });
  column({"dense_output", "1", "series of the functions in the distance along the chord at both ends"},
         {"step", "function", "end", "order"}, steps,
         [](const StepOfCurve& one) { return series_of(*one.step); });
}

void BoundaryFile::write_curves() {
  using Curve = BoundaryCurve;
  const auto write = [this](const DatasetLabel& label, auto field) {
    column(label, {"curve"}, result_.curves, field);
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
  column({"curve_extent", "1", "lowest and highest parameters, in their units"},
         {"curve", "parameter", "bound"}, result_.curves, [](const Curve& curve) {
           const auto [low, high] = curve.extent();
           return std::array{low[0], high[0], low[1], high[1]};
         });
}

void BoundaryFile::write_corners() {
  const std::vector<Corner>& corners = result_.corners;
  column({"corner_kind", "1",
          "intersection: two curves intersect; takens_bogdanov: a curve of pairs ends on one of divergence"},
         {"corner"}, corners, [](const Corner& corner) { return corner_name(corner.kind); });
  column({"corner_parameter", "1", "place, in the parameters' units"}, {"corner", "parameter"}, corners,
         &Corner::place);
  column({"corner_eigenvalue", "1/s", "eigenvalues of both curves"}, {"corner", "member"}, corners,
         &Corner::s);
  column({"corner_curve", "1", "both curves"}, {"corner", "member"}, corners, &Corner::curves);
}

}  // namespace

void check_boundary_names(const BoundarySetup& setup) {
  const BoundaryResult none;
  Parameter first, second;
  first.name = "first parameter";
  second.name = "second parameter";
  BoundaryFile file(setup, none, first, second);
  require_other_names(setup.scene, {setup.options.trace.parameter, setup.options.second}, file.write(),
                      "plane", "the boundary file");
}

std::string boundary_file(const BoundarySetup& setup, const BoundaryResult& result) {
  const Parameters& parameters = setup.scene.parameters;
  return BoundaryFile(setup, result, parameters.at(setup.options.trace.parameter),
                      parameters.at(setup.options.second))
      .write()
      .image();
}

}  // namespace eigentrail
