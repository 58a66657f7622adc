#include "model/strips.hpp"

#include <cmath>
#include <numbers>

#include "model/gauss_points.hpp"
#include "model/whole_number.hpp"

namespace eigentrail {
namespace {

constexpr int most_strips = 64;
constexpr int usual_strips = 4;  ///< default: exact for loads of degree up to 7 along the span

/// Data that all strips of a blade share.
struct Blade {
  int body = 0;
  ExpressionVector root, tip, leading, lift;  ///< in body axes
  int strips = 0;
};

Blade read_blade(Draft& draft, TableReader& table) {
  Blade blade;
  blade.body = draft.read_body(table, "body");
  blade.root = draft.read_vector(table, "root", "m", Range::any);
  blade.tip = draft.read_vector(table, "tip", "m", Range::any);
  draft.check_range(table, "tip", blade.tip - blade.root, Range::positive);
  blade.leading = normalized(draft.read_vector(table, "leading", any_unit, Range::positive));
  blade.lift = read_lift(draft, table, blade.leading);
  blade.strips = read_strip_count(table, usual_strips);
  return blade;
}

/// Air that moves across the axis of a rotor meets its blades once per revolution.
void check_axial(const Draft& draft, const TableReader& table, const ExpressionVector& inflow) {
  for (std::size_t i = 0; i < draft.request.check_at.size(); ++i) {
    const Eigen::Vector3d v = draft.vector_at(inflow, i);
    if (v.head<2>().norm() <= 1e-12 * v.norm()) continue;
    table.fail("inflow",
               "must be [0, 0, w], along the axis of the [rotor]; across it, the loads of the blades change "
               "with the azimuth, and there is no steady state" +
                   Draft::where_on_trace(i));
  }
}

}  // namespace

ExpressionVector read_lift(Draft& draft, TableReader& table, const ExpressionVector& leading,
                           std::optional<ExpressionVector> otherwise) {
  const ExpressionVector lift =
      draft.read_vector(table, "lift", any_unit, Range::positive, std::move(otherwise));
  const ExpressionVector across = lift - dot(lift, leading) * leading;
  for (std::size_t i = 0; i < draft.request.check_at.size(); ++i) {
    if (draft.vector_at(across, i).norm() <= 1e-9 * draft.vector_at(lift, i).norm())
      table.fail("lift", "must not be parallel to leading; it is" + Draft::where_on_trace(i));
  }
  return normalized(across);
}

int read_strip_count(TableReader& table, int otherwise) {
  return table.has("strips") ? whole_number(table, "strips", 1, most_strips) : otherwise;
}

std::vector<std::pair<BladeElement, std::string>> read_strips(
    Draft& draft, const std::optional<ExpressionVector>& rotation) {
  std::vector<std::pair<BladeElement, std::string>> result;
  draft.for_each_table(BladeElement::name, [&](TableReader& table, std::size_t i) {
    const Blade blade = read_blade(draft, table);
    const Expression chord = draft.read_number(table, "chord", "m", Range::non_negative);
    const Expression density = draft.read_number(table, "density", "kg/m^3", Range::non_negative, 1.225);
    const Expression lift_slope =
        draft.read_number(table, "lift_slope", "1/rad", Range::any, 2.0 * std::numbers::pi);
    const Expression drag = draft.read_number(table, "profile_drag", "", Range::non_negative, 0.0);
    const Expression pitch = draft.read_number(table, "pitch", "rad", Range::any, 0.0);
    const ExpressionVector inflow = draft.read_vector(table, "inflow", "m/s", Range::any, ExpressionVector{});
    const bool stands = draft.stands(draft.bodies[static_cast<std::size_t>(blade.body)].triple);
    if (draft.rotor && !stands) check_axial(draft, table, inflow);
    const std::string label = label_of(table, BladeElement::name, i);
    table.finish();
    const ExpressionVector span = blade.tip - blade.root;
    const Expression length = sqrt(dot(span, span));
    const Carrier carrier{blade.body, -1};
    int number = 0;
    for (const auto& [at, weight] : gauss_points(blade.strips)) {
      BladeElement strip;
      strip.point = draft.on_body(blade.body, blade.root + Expression(at) * span);
      strip.leading = draft.direction_on(carrier, blade.leading);
      strip.lift = draft.direction_on(carrier, blade.lift);
      strip.angular_velocity =
          draft.vector(stands ? ExpressionVector{} : rotation.value_or(ExpressionVector{}));
      strip.inflow = draft.vector(inflow);
      strip.width = draft.quantity(Expression(weight) * length);
      strip.chord = draft.quantity(chord);
      strip.density = draft.quantity(density);
      strip.lift_slope = draft.quantity(lift_slope);
      strip.profile_drag = draft.quantity(drag);
      strip.pitch = draft.quantity(pitch);
      result.emplace_back(strip, label + ", strip " + std::to_string(++number));
    }
  });
  return result;
}

std::vector<FieldHelp> strip_fields() {
  return {{"body", "name of a body", "the blade"},
          {"root", "[x, y, z] m", "where the lifting part begins, in the body's axes"},
          {"tip", "[x, y, z] m", "where it ends"},
          {"leading", "[x, y, z]", "direction from trailing to leading edge, in the body's axes"},
          {"lift", "[x, y, z]", "direction of lift, in the body's axes"},
          {"chord", "m", "chord"},
          {"lift_slope", "1/rad", "slope of the lift coefficient", "2 pi"},
          {"profile_drag", "", "profile drag coefficient", "0"},
          {"pitch", "rad", "pitch of the sections, nose up, besides that of the body", "0"},
          {"inflow", "[x, y, z] m/s", "velocity of the air in the frame", "[0, 0, 0]"},
          {"density", "kg/m^3", "density of the air", "1.225"},
          {"strips", "", "number of strips, 1 to 64", "4"}};
}

}  // namespace eigentrail
