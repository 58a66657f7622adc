#include "store/loci_schema.hpp"

#include <algorithm>
#include <array>

#include "eigentrail/modes/whirl.hpp"
#include "store/labelled_datasets.hpp"
#include "store/mode_motions.hpp"

namespace eigentrail {
namespace {

const std::array<std::string, 47> loci_names = {"node",
                                                "step",
                                                "mode",
                                                "function",
                                                "end",
                                                "coordinate",
                                                "coordinate_unit",
                                                "motion",
                                                "kinetic_energy_share",
                                                "mode_name",
                                                "constraint",
                                                "order",
                                                "event",
                                                "eigenvalue",
                                                "eigenvalue_derivative",
                                                "frequency",
                                                "damped_frequency",
                                                "damping_ratio",
                                                "mode_shape",
                                                "whirl",
                                                "whirl_reverse",
                                                "residual",
                                                "condition",
                                                "rounding",
                                                "growing_unfollowed",
                                                "equilibrium",
                                                "multiplier",
                                                "step_length",
                                                "step_parameter",
                                                "dense_output",
                                                "dense_block",
                                                "dense_chart",
                                                "mode_block",
                                                "certified",
                                                "events",
                                                "event_parameter",
                                                "event_eigenvalue",
                                                "event_half_width",
                                                "event_puiseux",
                                                "event_node",
                                                "event_direction",
                                                "event_value",
                                                "event_shape",
                                                "event_sensitivity",
                                                "event_shift",
                                                "scene_parameter",
                                                "scene_parameter_unit"};

/// The unit of all coordinates; "coordinate_unit", the name of the dataset with the units, if they differ.
std::string common_unit(const ModelDescription& description) {
  const auto& units = description.coordinate_units;
  const bool same =
      std::all_of(units.begin(), units.end(), [&](const auto& unit) { return unit == units[0]; });
  return same ? units[0] : "coordinate_unit";
}

/// Datasets along the dimension `node`.
void add_points(std::vector<GrowingDataset>& list, const Model& model, const std::string& parameter,
                const std::string& unit) {
  const ModelDescription& description = model.description();
  const std::string per_unit = unit == "1" ? "1/s" : "1/s/(" + unit + ")";
  list.push_back({parameter, ElementType::real, {"node"}, unit, "traced parameter " + parameter});
  list.push_back({"eigenvalue", ElementType::complex, {"node", "mode"}, "1/s", "eigenvalue s"});
  list.push_back(
      {"eigenvalue_derivative", ElementType::complex, {"node", "mode"}, per_unit, "ds/d" + parameter});
  list.push_back({"frequency", ElementType::real, {"node", "mode"}, "rad/s", "natural frequency abs(s)"});
  list.push_back(
      {"damped_frequency", ElementType::real, {"node", "mode"}, "rad/s", "damped frequency abs(Im(s))"});
  list.push_back({"damping_ratio", ElementType::real, {"node", "mode"}, "1", "-Re(s)/abs(s)"});
  list.push_back(
      {"mode_shape",
       ElementType::complex,
       {"node", "mode", "coordinate"},
       "1",
       description.rotor
           ? "mode shape, unit M-norm; blades in multiblade coordinates: blade k at the azimuth psi_k moves "
             "by collective + cosine cos(psi_k) + sine sin(psi_k) + ..."
           : "mode shape in physical coordinates, unit M-norm"});
  list.push_back({"residual",
                  ElementType::real,
                  {"node", "mode"},
                  "1",
                  "normwise backward error of the eigenpair, or of its block"});
  list.push_back({"condition",
                  ElementType::real,
                  {"node", "mode"},
                  "1",
                  "relative condition number of the eigenvalue, or of its block"});
  list.push_back({"rounding",
                  ElementType::real,
                  {"node", "mode"},
                  "1/s",
                  "error of the eigenvalue by rounding of the entries of the matrices"});
  list.push_back({"growing_unfollowed",
                  ElementType::integer,
                  {"node"},
                  "1",
                  "number of growing modes that are not followed; -1: not known"});
  list.push_back({"equilibrium",
                  ElementType::real,
                  {"node", "coordinate"},
                  common_unit(description),
                  "steady equilibrium x0"});
  if (model.n_constraints() > 0) {
    list.push_back({"multiplier",
                    ElementType::real,
                    {"node", "constraint"},
                    "1",
                    "Lagrange multiplier lambda0 (unit: force over gradient of the constraint)"});
  }
}

/// The datasets of trimmed parameters.
void add_trims(std::vector<GrowingDataset>& list, const ModelDescription& description) {
  for (const Trim& trim : description.trims) {
    const Parameter& parameter = description.parameters[static_cast<std::size_t>(trim.parameter)];
    const std::string unit = label_unit(parameter.unit);
    list.push_back({parameter.name,
                    ElementType::real,
                    {"node"},
                    unit,
                    "trimmed parameter " + parameter.name + ": " + trim.condition});
    list.push_back({step_dataset(parameter.name),
                    ElementType::real,
                    {"step", "end", "order"},
                    unit,
                    "series of " + parameter.name + " in the path's coordinate at both ends"});
  }
}

void add_dense_output(std::vector<GrowingDataset>& list, const std::string& parameter,
                      const std::string& unit) {
  list.push_back(
      {"step_length", ElementType::real, {"step"}, "1", "length of the step in the path's coordinate"});
  list.push_back({"step_parameter",
                  ElementType::real,
                  {"step", "end", "order"},
                  unit,
                  "series of " + parameter + " in the path's coordinate at both ends"});
  list.push_back({"dense_output",
                  ElementType::complex,
                  {"step", "function", "end", "order"},
                  "1",
                  "series of the smooth functions in the path's coordinate at both ends"});
  list.push_back({"dense_block",
                  ElementType::integer,
                  {"step", "function"},
                  "1",
                  "block that the function belongs to, numbered by its first function; -1: not in use"});
  list.push_back({"dense_chart",
                  ElementType::integer,
                  {"step", "function"},
                  "1",
                  "what the block follows: 0 for s, 1 for 1/s"});
  list.push_back({"mode_block",
                  ElementType::integer,
                  {"step", "mode"},
                  "1",
                  "block that the mode belongs to on the step; -1: the mode does not exist there"});
  list.push_back(
      {"certified",
       ElementType::integer,
       {"step", "mode"},
       "1",
       "1: the mode is certified to be the same at both ends of the step; 0: it is not; -1: it does not "
       "exist there"});
}

void add_events(std::vector<GrowingDataset>& list, const std::string& parameter, const std::string& unit) {
  list.push_back({"events", ElementType::text, {"event"}, "1", "kind,parameter,real,imag,modes"});
  list.push_back({"event_parameter", ElementType::real, {"event"}, unit, "value of " + parameter});
  list.push_back({"event_eigenvalue", ElementType::complex, {"event"}, "1/s", "eigenvalue s"});
  list.push_back({"event_half_width",
                  ElementType::real,
                  {"event"},
                  unit,
                  "veering: distance of the exceptional point from the real " + parameter + " axis"});
  list.push_back(
      {"event_puiseux",
       ElementType::complex,
       {"event"},
       "1/s",
       "collision of m eigenvalues: s = s* + puiseux (" + parameter + " - " + parameter + "*)^(1/m)"});
  list.push_back(
      {"event_node", ElementType::integer, {"event"}, "1", "first path point at or behind the event"});
  list.push_back({"event_direction",
                  ElementType::integer,
                  {"event"},
                  "1",
                  "1: less stable with growing " + parameter +
                      ", resonance: the frequency outgrows the excitation, extremum: least damping; -1: the "
                      "reverse; 0: none"});
  list.push_back({"event_value",
                  ElementType::real,
                  {"event"},
                  "1",
                  "damping ratio of a damping_ratio or an extremum, harmonic of a resonance"});
  list.push_back({"event_shape",
                  ElementType::complex,
                  {"event", "coordinate"},
                  "1",
                  "mode shape in physical coordinates, unit M-norm"});
  list.push_back({"event_sensitivity",
                  ElementType::complex,
                  {"event", "scene_parameter"},
                  "1/s per scene_parameter_unit",
                  "ds/dq for every parameter q of the scene"});
  list.push_back({"event_shift",
                  ElementType::real,
                  {"event", "scene_parameter"},
                  unit + " per scene_parameter_unit",
                  "d" + parameter + "/dq: how the event moves"});
}

/// Datasets on the orbits of what spins.
void add_whirl(std::vector<GrowingDataset>& list) {
  list.push_back(
      {"whirl",
       ElementType::real,
       {"node", "mode"},
       "1",
       "areas of the orbits over the circles about them: 1 circles forward, -1 backward, 0 lines"});
  list.push_back({"whirl_reverse",
                  ElementType::real,
                  {"node", "mode"},
                  "1",
                  "the smaller one of the shares of both senses: 0 if all nodes go round in one sense"});
}

/// Datasets on the motions in each mode.
void add_motions(std::vector<GrowingDataset>& list) {
  list.push_back({"kinetic_energy_share",
                  ElementType::real,
                  {"end", "mode", "motion"},
                  "1",
                  "share of the mode's kinetic energy, where the mode first (left) and last (right) exists"});
}

}  // namespace

std::vector<GrowingDataset> growing_datasets(const Model& model, const TraceOptions& options) {
  const std::string& parameter = options.parameter;
  const std::string unit = label_unit(model.description().parameters.at(parameter).unit);
  std::vector<GrowingDataset> list;
  add_points(list, model, parameter, unit);
  const ModelDescription& description = model.description();
  add_trims(list, description);
  if (has_whirl(description)) add_whirl(list);
  add_dense_output(list, parameter, unit);
  add_events(list, parameter, unit);
  if (!description.masses.empty()) add_motions(list);
  if (!description.masses.empty() || !description.shafts.empty() || named_by_coordinates(description) ||
      named_by_freedoms(model) != nullptr || !options.mode_names.empty())
    list.push_back(
        {"mode_name", ElementType::text, {"mode"}, "1", "what moves in the mode where it first exists"});
  return list;
}

std::vector<std::string> trimmed_names(const ModelDescription& description) {
  std::vector<std::string> names;
  for (const Trim& trim : description.trims)
    names.push_back(description.parameters.names()[static_cast<std::size_t>(trim.parameter)]);
  return names;
}

std::string trimmed_list(const ModelDescription& description) {
  std::string list;
  for (const std::string& name : trimmed_names(description)) list += (list.empty() ? "" : ",") + name;
  return list;
}

bool is_loci_dataset(const std::string& name) {
  return std::find(loci_names.begin(), loci_names.end(), name) != loci_names.end();
}

}  // namespace eigentrail
