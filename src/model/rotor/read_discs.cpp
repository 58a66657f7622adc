// Reads the [[disc]] tables: rigid discs on nodes of shafts.
#include <numbers>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "model/rotor/rotor_draft.hpp"

namespace eigentrail {
namespace {

struct DiscInertia {
  Expression mass, diametral, polar;
};

/// m = rho pi (Do^2 - Di^2) w / 4, Ip = m (Do^2 + Di^2) / 8, Id = Ip / 2 + m w^2 / 12.
DiscInertia inertia_of_cylinder(const Draft& draft, TableReader& table) {
  const Expression outer = draft.read_number(table, "outer", "m", Range::positive);
  const Expression inner = draft.read_number(table, "inner", "m", Range::non_negative, 0.0);
  const Expression width = draft.read_number(table, "width", "m", Range::positive);
  const Expression density = draft.read_number(table, "density", "kg/m^3", Range::positive);
  const std::vector<double> outside = draft.check_values(outer), inside = draft.check_values(inner);
  for (std::size_t i = 0; i < outside.size(); ++i) {
    if (!(inside[i] < outside[i]))
      table.fail("inner", "must be less than the outer diameter, " + exact_text(outside[i]) + " m; found " +
                              exact_text(inside[i]) + " m" + Draft::where_on_trace(i));
  }
  const Expression squares = outer * outer, holes = inner * inner;
  const Expression mass = Expression(std::numbers::pi / 4.0) * density * (squares - holes) * width;
  const Expression polar = mass * (squares + holes) / Expression(8.0);
  return {mass, polar / Expression(2.0) + mass * width * width / Expression(12.0), polar};
}

DiscInertia inertia_of_numbers(const Draft& draft, TableReader& table) {
  for (const char* key : {"outer", "inner", "width", "density"}) {
    if (table.has(key))
      table.fail(key, "the mass is given already; a disc has mass, Id and Ip, or outer, width and density");
  }
  const DiscInertia disc{draft.read_number(table, "mass", "kg", Range::non_negative),
                         draft.read_number(table, "Id", "kg m^2", Range::non_negative, 0.0),
                         draft.read_number(table, "Ip", "kg m^2", Range::non_negative, 0.0)};
  const std::vector<double> diametral = draft.check_values(disc.diametral);
  const std::vector<double> polar = draft.check_values(disc.polar);
  constexpr double rounding = 1e-9;  // of a thin disc whose Id and Ip = 2 Id are given with few digits less
  for (std::size_t i = 0; i < polar.size(); ++i) {
    if (polar[i] > 2.0 * diametral[i] * (1.0 + rounding))
      table.fail("Ip", "no disc has more than 2 Id, here " + exact_text(2.0 * diametral[i]) +
                           " kg m^2 (thin disc: Ip = 2 Id); found " + exact_text(polar[i]) +
                           Draft::where_on_trace(i));
  }
  return disc;
}

void add_disc(RotorDraft& rotor, const NodePlace& place, const DiscInertia& disc) {
  const NodeCoordinates& at = rotor.at(place);
  const Expression& speed = rotor.shafts[place.shaft].speed;
  MatrixSum& inertia = rotor.sum(RotorEffect::disc).M;
  for (const NodeFreedom freedom : {along_x, along_y, along_z})
    inertia.add(at[freedom], at[freedom], disc.mass);
  for (const NodeFreedom freedom : {about_x, about_y}) inertia.add(at[freedom], at[freedom], disc.diametral);
  inertia.add(at[about_z], at[about_z], disc.polar);
  MatrixSum& gyroscopic = rotor.sum(RotorEffect::gyroscopic).C;
  gyroscopic.add_product(at[about_x], at[about_y], speed, disc.polar, 1.0);
  gyroscopic.add_product(at[about_y], at[about_x], speed, disc.polar, -1.0);
  rotor.count(RotorEffect::disc);
  rotor.count(RotorEffect::gyroscopic);
}

}  // namespace

void read_discs(RotorDraft& rotor) {
  rotor.draft.for_each_table("disc", [&](TableReader& table, std::size_t i) {
    const std::vector<NodePlace> places = rotor.read_nodes(table, "node");
    const DiscInertia disc = table.has("mass") || !table.has("outer")
                                 ? inertia_of_numbers(rotor.draft, table)
                                 : inertia_of_cylinder(rotor.draft, table);
    if (table.has("name")) (void)table.text("name");
    table.finish();
    std::string where;
    for (const NodePlace& place : places) {
      add_disc(rotor, place, disc);
      where += (where.empty() ? "" : ", ") + rotor.name_of(place);
    }
    rotor.draft.notes.emplace_back("disc " + std::to_string(i + 1),
                                   short_text(rotor.first_value(disc.mass), 6) + " kg at " + where);
  });
}

}  // namespace eigentrail
