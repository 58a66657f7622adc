#include "model/readers.hpp"

#include <algorithm>
#include <numbers>

namespace eigentrail {
namespace {

/// Starting guess of the mean inflow: this part of the speed of the tips, and of the wind.
constexpr double of_tip_speed = 0.05, of_wind = 0.25;

/// Directions x and y so that x, y and the axis are at right angles, x along the least component of the axis.
std::array<ExpressionVector, 2> across(const Draft& draft, const ExpressionVector& axis) {
  const Eigen::Vector3d a = draft.vector_at(axis, 0);
  Eigen::Index least = 0;
  a.cwiseAbs().minCoeff(&least);
  const ExpressionVector e = unit_vector(static_cast<std::size_t>(least));
  const ExpressionVector x = normalized(e - dot(e, axis) * axis);
  return {x, cross(axis, x)};
}

void check_axis(const Draft& draft, const TableReader& table, const std::string& key,
                const ExpressionVector& axis, const ExpressionVector& vector) {
  const std::string message = key == "axis" ? "[frame] angular_velocity must be parallel to it"
                                            : "must be parallel to axis: only axial flow has a steady inflow";
  draft.require(table, key, message + "; it is not", [&](std::size_t i) {
    const Eigen::Vector3d v = draft.vector_at(vector, i);
    return draft.vector_at(axis, i).cross(v).norm() <= 1e-9 * v.norm();
  });
}

/// Whether the axis of an inflow is that of the [rotor], 1, or opposite to it, -1. Its centre must be on that
/// axis, or blades are not alike.
int sense_of_rotor(const Draft& draft, const TableReader& table, const ExpressionVector& axis,
                   const ExpressionVector& centre) {
  const int sense = draft.vector_at(axis, 0)[2] > 0.0 ? 1 : -1;
  draft.require(table, "axis", "with [rotor] it must not change its sense; it does",
                [&](std::size_t i) { return draft.vector_at(axis, i)[2] * sense >= 0.0; });
  draft.require(table, "centre", "with [rotor] expected [0, 0, z], on the axis of rotation; it is not",
                [&](std::size_t i) { return draft.vector_at(centre, i).head<2>().norm() <= 1e-12; });
  return sense;
}

/// New coordinates (v_0, v_x, v_y).
Place add_velocity(Draft& draft, const InflowDraft& inflow) {
  if (draft.rotor) draft.rotor->inflows.push_back(inflow.sense);
  const Place velocity = draft.point_place(static_cast<int>(draft.guess.size()) / 3);
  for (const Expression& e : {inflow.guess, Expression(0.0), Expression(0.0)}) draft.guess.push_back(e);
  return velocity;
}

void hold_gradients(Draft& draft, const Inflow& inflow, const std::string& label) {
  std::vector<ConstraintRow> rows;
  for (int i = 1; i < 3; ++i) rows.push_back({{inflow.velocity, {}}, {}, i, draft.quantity(0.0)});
  draft.add_constraint("fixed", label, std::move(rows));
}

ExpressionVector expressions_of(const std::array<Quantity, 3>& vector) {
  return {vector[0].expression, vector[1].expression, vector[2].expression};
}

InflowDraft read_disc(Draft& draft, TableReader& table, const ExpressionVector& rotation) {
  InflowDraft inflow;
  inflow.name = table.text("name");
  if (inflow.name.empty()) table.fail("name", "must not be empty");
  const std::string model = table.has("model") ? table.text("model") : "pitt_peters";
  if (model != "uniform" && model != "pitt_peters" && model != "annular")
    table.fail("model", "expected \"uniform\", \"annular\" or \"pitt_peters\", found \"" + model + "\"");
  inflow.annular = model == "annular";
  inflow.radius = draft.read_number(table, "radius", "m", Range::positive);
  const ExpressionVector centre = draft.read_vector(table, "centre", "m", Range::any, ExpressionVector{});
  const ExpressionVector axis =
      normalized(draft.read_vector(table, "axis", any_unit, Range::positive, unit_vector(2)));
  const ExpressionVector wind = draft.read_vector(table, "wind", "m/s", Range::any, ExpressionVector{});
  check_axis(draft, table, "wind", axis, wind);
  check_axis(draft, table, "axis", axis, rotation);
  if (table.has("blades") && draft.rotor)
    table.fail("blades", "with [rotor] their number is stated there; leave it out here");
  if (table.has("blades") && model == "pitt_peters")
    table.fail("blades",
               "needs model = \"uniform\" or \"annular\"; with pitt_peters the scene has all blades");
  if (table.has("tip_loss")) inflow.tip_loss = table.flag("tip_loss");
  if (inflow.tip_loss && !inflow.annular) table.fail("tip_loss", "needs model = \"annular\"");
  const Expression blades = draft.read_number(table, "blades", "", Range::positive, 1.0);
  inflow.blades = draft.rotor ? Expression(draft.rotor->blades) : blades;
  const Expression tip = Expression(of_tip_speed) * inflow.radius * dot(rotation, axis);
  const Expression drift = Expression(of_wind) * dot(wind, axis);
  inflow.guess = sqrt(tip * tip + drift * drift);
  if (table.has("guess")) inflow.guess = draft.read_number(table, "guess", "m/s", Range::any);
  const Expression density = draft.read_number(table, "density", "kg/m^3", Range::positive, 1.225);
  table.finish();

  if (draft.rotor) inflow.sense = sense_of_rotor(draft, table, axis, centre);
  if (!inflow.annular) inflow.element.velocity = add_velocity(draft, inflow);
  inflow.element.axis = inflow.disc.axis = draft.vector(axis);
  inflow.element.wind = draft.vector(wind);
  // With [rotor] the axes x, y of the disc stand; without gradients they do not matter.
  const bool stands = draft.rotor && model == "pitt_peters";
  inflow.element.angular_velocity = draft.vector(stands ? ExpressionVector{} : rotation);
  inflow.element.radius = draft.quantity(inflow.radius);
  inflow.element.density = draft.quantity(density);
  const auto [x, y] = across(draft, axis);
  inflow.disc.centre = draft.vector(centre);
  inflow.disc.x = draft.vector((Expression(1.0) / inflow.radius) * x);
  inflow.disc.y = draft.vector((Expression(1.0) / inflow.radius) * y);
  inflow.disc.blades = draft.quantity(blades);
  if (model == "uniform") hold_gradients(draft, inflow.element, inflow.name + " uniform");
  return inflow;
}

}  // namespace

std::vector<InflowDraft> read_inflow(Draft& draft, const std::optional<ExpressionVector>& rotation) {
  std::vector<InflowDraft> result;
  if (draft.is_left_out(Inflow::name)) return result;
  draft.for_each_table(Inflow::name, [&](TableReader& table, std::size_t) {
    InflowDraft inflow = read_disc(draft, table, rotation.value_or(ExpressionVector{}));
    check_is_new(table, "[[inflow]]", inflow.name, names_of(result));
    result.push_back(std::move(inflow));
    if (!result.back().annular) draft.inflow_names.push_back(result.back().name);
  });
  return result;
}

void add_annulus(Draft& draft, const TableReader& table, InflowDraft& inflow, Strip& strip,
                 const Expression& width) {
  const ExpressionVector axis = expressions_of(inflow.disc.axis);
  const ExpressionVector arm = draft.at_guess(strip.quarter_chord) - expressions_of(inflow.disc.centre);
  const ExpressionVector outward = arm - dot(arm, axis) * axis;
  const Expression r = sqrt(dot(outward, outward));
  const std::vector<double> inside = draft.check_values(inflow.radius - r);
  const bool is_inside = std::all_of(inside.begin(), inside.end(), [](double d) { return d > 0.0; });
  if (!is_inside) table.fail("inflow", "a strip lies outside the radius of '" + inflow.name + "'");
  Inflow annulus = inflow.element;
  annulus.area = draft.quantity(Expression(2.0 * std::numbers::pi) * r * width);
  if (inflow.tip_loss) {
    const Expression half = Expression(0.5) * inflow.blades;
    annulus.to_the_tip = draft.quantity(half * (inflow.radius - r) / r);
    annulus.at_radius = draft.quantity(r);
  }
  annulus.velocity = add_velocity(draft, inflow);
  const std::string label = inflow.label(inflow.annuli.size());
  hold_gradients(draft, annulus, label);
  draft.inflow_names.push_back(label);
  strip.inflow = annulus.velocity;
  inflow.annuli.push_back(std::move(annulus));
}

std::vector<FieldHelp> inflow_fields() {
  return {{"name", "text", "what [[strips]] call it"},
          {"model", "\"uniform\", \"annular\" or \"pitt_peters\"",
           "mean inflow alone, by momentum theory with the inertia of the air; or the same for the annulus "
           "of every strip; or mean inflow with gradients over the disc, three states",
           "pitt_peters"},
          {"radius", "m", "of the rotor"},
          {"centre", "[x, y, z] m", "of the rotor, in the frame", "[0, 0, 0]"},
          {"axis", "[x, y, z]", "of the rotor, in the frame, in the direction of thrust", "[0, 0, 1]"},
          {"wind", "[x, y, z] m/s",
           "velocity of the air along the axis: against it in climb, along it at a turbine", "[0, 0, 0]"},
          {"blades", "",
           "with uniform and annular inflow, and without [rotor]: the number of blades for which every strip "
           "stands",
           "1"},
          {"tip_loss", "true or false", "of annular inflow: Prandtl's loss at the tips", "false"},
          {"density", "kg/m^3", "density of the air", "1.225"},
          {"guess", "m/s", "of the mean inflow, from which the equilibrium is found",
           "by speeds of tips and wind"}};
}

}  // namespace eigentrail
