#include "model/readers.hpp"

#include <algorithm>

#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

constexpr int fewest_blades = 3;
constexpr int most_blades = 24;
constexpr double exactly_on_axis = 1e-12;  ///< distance from the axis in m, and sine of the inclination

int read_blade_count(TableReader& table) {
  const Expression blades = table.expression("blades");
  for (const double few : {1.0, 2.0}) {
    if (!is_number(blades, few)) continue;
    table.fail("blades", "expected at least 3, found " + exact_text(few) +
                             ": the inertia of one or two blades differs along and across them, so that seen "
                             "from the support coefficients change with the azimuth in any coordinates, and "
                             "averaging them would be wrong; on a support that is the same in all directions "
                             "describe the whole rotor in the turning frame, without [rotor]");
  }
  return table.whole_number("blades", fewest_blades, most_blades);
}

/// Marks the triples of the point, body or beam with this name.
void mark_standing(const Draft& draft, const std::string& name, std::vector<bool>& stands) {
  for (std::size_t i = 0; i < draft.points.size(); ++i) {
    if (draft.points[i] == name) stands[i] = true;
  }
  const bool is_beam = std::any_of(draft.beams.begin(), draft.beams.end(),
                                   [&](const BeamDraft& beam) { return beam.name == name; });
  for (const BodyDraft& body : draft.bodies) {
    if (body.name == name || (is_beam && body.name.starts_with(name + ".")))
      std::fill_n(stands.begin() + body.triple, 4, true);
  }
}

void read_support(const Draft& draft, TableReader& table, std::vector<bool>& stands) {
  if (!table.has("support")) return;
  std::vector<std::string> known = draft.points;
  for (const auto& names : {names_of(draft.beams), names_of(draft.bodies)})
    known.insert(known.end(), names.begin(), names.end());
  for (const std::string& name : table.texts("support")) {
    index_of(name, known, table, "support", "point, body or beam");
    mark_standing(draft, name, stands);
  }
}

/// The hub must be on the axis and upright, or its blades are not alike.
void check_hub(const Draft& draft, const TableReader& table, const BodyDraft& hub) {
  draft.require(
      table, "hub", "'" + hub.name + "' must be at [0, 0, z], on the axis of rotation; it is not",
      [&](std::size_t i) { return !(draft.vector_at(hub.position, i).head<2>().norm() > exactly_on_axis); });
  draft.require(table, "hub", "the z axis of '" + hub.name + "' must be that of the frame; it is not",
                [&](std::size_t i) {
                  const Eigen::Vector3d axis = draft.vector_at(hub.rotation[2], i);
                  return axis.head<2>().norm() <= exactly_on_axis && axis[2] > 0.0;
                });
}

}  // namespace

std::optional<BladedRotorDraft> read_bladed_rotor(Draft& draft) {
  const std::vector<const Table*> found = tables(draft.scene, "rotor");
  if (found.empty()) return std::nullopt;
  if (found.size() > 1)
    throw scene_error(draft.scene, found[1]->where, "[rotor]: a scene has one of these at most");
  TableReader table = draft.reader(*found[0], "[rotor]");
  BladedRotorDraft rotor;
  rotor.where = found[0]->where;
  rotor.blades = read_blade_count(table);
  rotor.hub = draft.read_body(table, "hub");
  rotor.stands.assign(draft.guess.size() / 3, false);
  const BodyDraft& hub = draft.bodies[static_cast<std::size_t>(rotor.hub)];
  mark_standing(draft, hub.name, rotor.stands);
  read_support(draft, table, rotor.stands);
  table.finish();
  check_hub(draft, table, hub);
  if (std::find(rotor.stands.begin(), rotor.stands.end(), false) == rotor.stands.end())
    throw scene_error(
        draft.scene, rotor.where,
        "[rotor]: the scene has no blade; what is neither the hub nor in `support` belongs to it");
  return rotor;
}

Expression rotor_speed(const Draft& draft, const std::optional<ExpressionVector>& rotation) {
  if (!rotation)
    throw scene_error(draft.scene, draft.rotor->where,
                      "[rotor]: needs [frame] angular_velocity = [0, 0, speed], the frame in which its "
                      "blades are described");
  for (std::size_t i = 0; i < draft.check_at.size(); ++i) {
    const Eigen::Vector3d w = draft.vector_at(*rotation, i);
    if (w.head<2>().norm() <= exactly_on_axis * w.norm()) continue;
    throw scene_error(draft.scene, tables(draft.scene, "frame")[0]->find("angular_velocity")->where,
                      "[frame] angular_velocity: a [rotor] turns about the z axis; expected [0, 0, speed]");
  }
  return draft.is_left_out("frame") ? Expression(0.0) : (*rotation)[2];
}

std::vector<FieldHelp> bladed_rotor_fields() {
  return {
      {"blades", "", "number of equal blades, 3 to " + std::to_string(most_blades)},
      {"hub", "name of a body",
       "carries the blades: it turns with them for the blades, and stands for the support; on the z axis"},
      {"support", "names",
       "points, bodies and beams that stand, besides the hub; all others belong to the blade", "none"}};
}

}  // namespace eigentrail
