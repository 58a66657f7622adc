#include "model/readers.hpp"

#include <numbers>

#include "model/add_element.hpp"
#include "model/beam_axis.hpp"

namespace eigentrail {
namespace {

constexpr int most_strips = 64;
constexpr int usual_strips = 4;  ///< default: exact for loads of degree up to 7 along the span

/// Air that moves across the axis of a rotor meets its blades once per revolution.
void check_axial(const Draft& draft, const TableReader& table, const ExpressionVector& inflow) {
  draft.require(table, "inflow",
                "must be [0, 0, w], along the axis of the [rotor]; across it, the loads of the blades change "
                "with the azimuth, and there is no steady state",
                [&](std::size_t i) {
                  const Eigen::Vector3d v = draft.vector_at(inflow, i);
                  return v.head<2>().norm() <= 1e-12 * v.norm();
                });
}

}  // namespace

BodyLine read_body_line(Draft& draft, TableReader& table, int body,
                        const std::optional<std::array<ExpressionVector, 2>>& usual_axes) {
  const auto usual = [&](std::size_t i) {
    return usual_axes ? std::optional((*usual_axes)[i]) : std::nullopt;
  };
  BodyLine line;
  line.body = body;
  line.root = draft.read_vector(table, "root", "m", Range::any);
  line.tip = draft.read_vector(table, "tip", "m", Range::any);
  draft.check_range(table, "tip", line.tip - line.root, Range::positive);
  line.y = normalized(draft.read_vector(table, "leading", any_unit, Range::positive, usual(0)));
  const ExpressionVector lift = draft.read_vector(table, "lift", any_unit, Range::positive, usual(1));
  const ExpressionVector across = lift - dot(lift, line.y) * line.y;
  draft.require(table, "lift", "must not be parallel to leading; it is", [&](std::size_t i) {
    return draft.vector_at(across, i).norm() > 1e-9 * draft.vector_at(lift, i).norm();
  });
  line.z = normalized(across);
  return line;
}

int read_strip_count(TableReader& table, int otherwise) {
  return table.has("strips") ? table.whole_number("strips", 1, most_strips) : otherwise;
}

void read_strips(Draft& draft, const std::optional<ExpressionVector>& rotation) {
  draft.for_each_table(BladeElement::name, [&](TableReader& table, std::size_t i) {
    const BodyLine line = read_body_line(draft, table, draft.read_body(table, "body"));
    const int strips = read_strip_count(table, usual_strips);
    BladeElement strip;
    strip.chord = draft.quantity(draft.read_number(table, "chord", "m", Range::non_negative));
    strip.density = draft.quantity(draft.read_number(table, "density", "kg/m^3", Range::non_negative, 1.225));
    strip.lift_slope =
        draft.quantity(draft.read_number(table, "lift_slope", "1/rad", Range::any, 2.0 * std::numbers::pi));
    strip.profile_drag =
        draft.quantity(draft.read_number(table, "profile_drag", "", Range::non_negative, 0.0));
    strip.pitch = draft.quantity(draft.read_number(table, "pitch", "rad", Range::any, 0.0));
    const ExpressionVector inflow = draft.read_vector(table, "inflow", "m/s", Range::any, ExpressionVector{});
    const bool stands = draft.stands(draft.bodies[static_cast<std::size_t>(line.body)].triple);
    if (draft.rotor && !stands) check_axial(draft, table, inflow);
    strip.inflow = draft.vector(inflow);
    strip.angular_velocity =
        draft.vector(stands ? ExpressionVector{} : rotation.value_or(ExpressionVector{}));
    strip.leading = draft.direction_on({line.body, -1}, line.y);
    strip.lift = draft.direction_on({line.body, -1}, line.z);
    const std::string label = label_of(table, BladeElement::name, i);
    table.finish();
    const ExpressionVector span = line.tip - line.root;
    const Expression length = sqrt(dot(span, span));
    int count = 0;
    for (const auto& [at, weight] : gauss_points(strips)) {
      strip.point = draft.on_body(line.body, line.root + Expression(at) * span);
      strip.width = draft.quantity(Expression(weight) * length);
      add_element(draft, strip, label + ", strip " + std::to_string(++count));
    }
  });
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
