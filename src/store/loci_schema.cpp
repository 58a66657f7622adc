#include "store/loci_schema.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "core/texts.hpp"
#include "eigentrail/modes/whirl.hpp"
#include "store/labelled_datasets.hpp"
#include "store/mode_motions.hpp"

namespace eigentrail {

namespace loci_schema {
namespace {

using enum ElementType;

/// What a trace must have for a dataset to be in its file.
enum class Needs { nothing, blades, no_blades, constraints, whirl, masses, names };

/// In units and long names {parameter} stands for the traced parameter, {unit} for its unit, {per unit} for
/// the unit of ds/dp, and {coordinates} for the unit of all coordinates.
struct Row {
  const char* name;
  ElementType type;
  const char* dimensions;  ///< separated by blanks
  const char* units;
  const char* long_name;
  Needs needs = Needs::nothing;
};

constexpr Row rows[] = {
    {"eigenvalue", complex, "node mode", "1/s", "eigenvalue s"},
    {"eigenvalue_derivative", complex, "node mode", "{per unit}", "ds/d{parameter}"},
    {"frequency", real, "node mode", "rad/s", "natural frequency abs(s)"},
    {"damped_frequency", real, "node mode", "rad/s", "damped frequency abs(Im(s))"},
    {"damping_ratio", real, "node mode", "1", "-Re(s)/abs(s)"},
    {"mode_shape", complex, "node mode coordinate", "1",
     "mode shape, unit M-norm; blades in multiblade coordinates: blade k at the azimuth psi_k moves by "
     "collective + cosine cos(psi_k) + sine sin(psi_k) + ...",
     Needs::blades},
    {"mode_shape", complex, "node mode coordinate", "1", "mode shape in physical coordinates, unit M-norm",
     Needs::no_blades},
    {"residual", real, "node mode", "1", "normwise backward error of the eigenpair, or of its block"},
    {"condition", real, "node mode", "1", "relative condition number of the eigenvalue, or of its block"},
    {"rounding", real, "node mode", "1/s",
     "error of the eigenvalue by rounding of the entries of the matrices"},
    {"growing_unfollowed", integer, "node", "1",
     "number of growing modes that are not followed; -1: not known"},
    {"equilibrium", real, "node coordinate", "{coordinates}", "steady equilibrium x0"},
    {"multiplier", real, "node constraint", "1",
     "Lagrange multiplier lambda0 (unit: force over gradient of the constraint)", Needs::constraints},
    {"whirl", real, "node mode", "1",
     "areas of the orbits over the circles about them: 1 circles forward, -1 backward, 0 lines",
     Needs::whirl},
    {"whirl_reverse", real, "node mode", "1",
     "the smaller one of the shares of both senses: 0 if all nodes go round in one sense", Needs::whirl},
    {"step_length", real, "step", "1", "length of the step in the path's coordinate"},
    {"step_parameter", real, "step end order", "{unit}",
     "series of {parameter} in the path's coordinate at both ends"},
    {"dense_output", complex, "step function end order", "1",
     "series of the smooth functions in the path's coordinate at both ends"},
    {"dense_block", integer, "step function", "1",
     "block that the function belongs to, numbered by its first function; -1: not in use"},
    {"dense_chart", integer, "step function", "1", "what the block follows: 0 for s, 1 for 1/s"},
    {"mode_block", integer, "step mode", "1",
     "block that the mode belongs to on the step; -1: the mode does not exist there"},
    {"certified", integer, "step mode", "1",
     "1: the mode is certified to be the same at both ends of the step; 0: it is not; -1: it does not exist "
     "there"},
    {"events", text, "event", "1", "kind,parameter,real,imag,modes"},
    {"event_parameter", real, "event", "{unit}", "value of {parameter}"},
    {"event_eigenvalue", complex, "event", "1/s", "eigenvalue s"},
    {"event_half_width", real, "event", "{unit}",
     "veering: distance of the exceptional point from the real {parameter} axis"},
    {"event_puiseux", complex, "event", "1/s",
     "collision of m eigenvalues: s = s* + puiseux ({parameter} - {parameter}*)^(1/m)"},
    {"event_node", integer, "event", "1", "first path point at or behind the event"},
    {"event_direction", integer, "event", "1",
     "1: less stable with growing {parameter}, resonance: the frequency outgrows the excitation, extremum: "
     "least damping; -1: the reverse; 0: none"},
    {"event_value", real, "event", "1",
     "damping ratio of a damping_ratio or an extremum, harmonic of a resonance"},
    {"event_shape", complex, "event coordinate", "1", "mode shape in physical coordinates, unit M-norm"},
    {"event_sensitivity", complex, "event scene_parameter", "1/s per scene_parameter_unit",
     "ds/dq for every parameter q of the scene"},
    {"event_shift", real, "event scene_parameter", "{unit} per scene_parameter_unit",
     "d{parameter}/dq: how the event moves"},
    {"kinetic_energy_share", real, "end mode motion", "1",
     "share of the mode's kinetic energy, where the mode first (left) and last (right) exists",
     Needs::masses},
    {"mode_name", text, "mode", "1", "what moves in the mode where it first exists", Needs::names}};

/// Datasets that are written as a whole.
constexpr Row whole[] = {
    {"stable_from", real, "range", "{unit}", "where the range begins, as the trace goes"},
    {"stable_to", real, "range", "{unit}", "where the range ends, as the trace goes"},
    {"stable_kind", text, "range", "1",
     "stable: all modes decay; marginal: none grows, some stay on the imaginary axis; undecided: "
     "errors of the data leave it open"},
    {"stable_cause", text, "range end", "1",
     "what ends the range: an event, start or end of the trace, infinity, or sign change"},
    {"stable_margin", real, "range end", "1/s", "-max Re s of the followed modes"},
    {"stable_mode", integer, "range end", "1",
     "number of the mode that meets the imaginary axis or has the margin; -1: none stands out"},
    {"stable_least_margin", real, "range", "1/s", "least margin of the range"},
    {"stable_largest_margin", real, "range", "1/s", "largest margin of the range"},
    {"stable_largest_at", real, "range", "{unit}", "where the margin is largest"},
    {"stable_whole", integer, "range", "1",
     "1: no mode of the whole model grows; 0: no followed mode grows, others are not known"},
    {"interpolation_error", real, "step mode", "1/s",
     "bound of the error of the eigenvalue between the samples of the model"},
    {"digits_error", real, "step mode", "1/s",
     "bound of the error of the eigenvalue from the digits of the samples"},
    {"event_interval", real, "event end", "{unit}",
     "where the event lies as far as the errors of the data tell"},
    {"shaft_number", integer, "shaft_node", "1", "shaft that the node belongs to, from 0"},
    {"shaft_place", real, "shaft_node", "m", "place of the node along the z axis"},
    {"shaft_coordinate", integer, "shaft_node shaft_axis", "1",
     "index of the coordinate that is the displacement of the node (of the freedom, if the model is "
     "projected), from 0; -1: held"},
    {"projection_basis", real, "freedom coordinate", "1",
     "the large model's vectors are this times the coordinates"}};

/// Dimensions, and datasets that describe them, separated by blanks.
constexpr const char* dimensions =
    "node step mode function end coordinate motion constraint order event coordinate_unit scene_parameter "
    "scene_parameter_unit range shaft_node shaft_axis freedom projection_place";

/// What a trace has of what datasets need.
std::set<Needs> had_by(const Model& model, const TraceOptions& options) {
  const ModelDescription& description = model.description();
  std::set<Needs> had{Needs::nothing, description.rotor ? Needs::blades : Needs::no_blades};
  if (model.n_constraints() > 0) had.insert(Needs::constraints);
  if (has_whirl(description)) had.insert(Needs::whirl);
  if (!description.masses.empty()) had.insert({Needs::masses, Needs::names});
  if (!description.shafts.empty() || named_by_coordinates(description) ||
      named_by_freedoms(model) != nullptr || !options.mode_names.empty())
    had.insert(Needs::names);
  return had;
}

/// The unit of all coordinates; "coordinate_unit", the name of the dataset with the units, if they differ.
std::string common_unit(const ModelDescription& description) {
  const auto& units = description.coordinate_units;
  const bool same = std::ranges::all_of(units, [&](const auto& unit) { return unit == units[0]; });
  return same ? units[0] : "coordinate_unit";
}

std::vector<std::string> words(const char* text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// A text with what its words in braces stand for.
std::string filled(std::string text, const std::map<std::string, std::string>& words_for) {
  for (const auto& [word, replacement] : words_for) text = replaced_all(text, word, replacement);
  return text;
}

}  // namespace
}  // namespace loci_schema

std::vector<LociDataset> growing_datasets(const Model& model, const TraceOptions& options) {
  const ModelDescription& description = model.description();
  const std::string& parameter = options.parameter;
  const std::string unit = label_unit(description.parameters.at(parameter).unit);
  const std::map<std::string, std::string> words_for{
      {"{parameter}", parameter},
      {"{unit}", unit},
      {"{per unit}", unit == "1" ? "1/s" : "1/s/(" + unit + ")"},
      {"{coordinates}", loci_schema::common_unit(description)}};
  std::vector<LociDataset> list{
      {{parameter, unit, "traced parameter " + parameter}, ElementType::real, {"node"}}};
  const std::set<loci_schema::Needs> had = loci_schema::had_by(model, options);
  for (const loci_schema::Row& row : loci_schema::rows) {
    if (had.contains(row.needs))
      list.push_back({{row.name, loci_schema::filled(row.units, words_for),
                       loci_schema::filled(row.long_name, words_for)},
                      row.type,
                      loci_schema::words(row.dimensions)});
  }
  for (const Trim& trim : description.trims) {
    const Parameter& trimmed = description.parameters[static_cast<std::size_t>(trim.parameter)];
    const std::string trimmed_unit = label_unit(trimmed.unit);
    list.push_back({{trimmed.name, trimmed_unit, "trimmed parameter " + trimmed.name + ": " + trim.condition},
                    ElementType::real,
                    {"node"}});
    list.push_back({{step_dataset(trimmed.name), trimmed_unit,
                     "series of " + trimmed.name + " in the path's coordinate at both ends"},
                    ElementType::real,
                    {"step", "end", "order"}});
  }
  return list;
}

std::vector<std::string> trimmed_names(const ModelDescription& description) {
  std::vector<std::string> names;
  for (const Trim& trim : description.trims)
    names.push_back(description.parameters.names()[static_cast<std::size_t>(trim.parameter)]);
  return names;
}

bool is_loci_dataset(const std::string& name) {
  const auto has_it = [&](const loci_schema::Row& row) { return row.name == name; };
  return std::ranges::count(loci_schema::words(loci_schema::dimensions), name) > 0 ||
         std::ranges::any_of(loci_schema::rows, has_it) || std::ranges::any_of(loci_schema::whole, has_it);
}

std::vector<std::string> datasets_of_events() {
  std::vector<std::string> names{"event"};
  for (const loci_schema::Row& row : loci_schema::rows) {
    if (loci_schema::words(row.dimensions).front() == "event") names.emplace_back(row.name);
  }
  return names;
}

LociDataset whole_dataset(const std::string& name, const std::string& parameter_unit) {
  const auto* row = std::ranges::find(loci_schema::whole, name, &loci_schema::Row::name);
  return {{name, loci_schema::filled(row->units, {{"{unit}", parameter_unit}}), row->long_name},
          row->type,
          loci_schema::words(row->dimensions)};
}

std::vector<LociDataset> datasets_of_ranges() {
  std::vector<LociDataset> list;
  for (const loci_schema::Row& row : loci_schema::whole) {
    LociDataset dataset = whole_dataset(row.name);
    if (dataset.dimensions.front() == "range") list.push_back(std::move(dataset));
  }
  return list;
}

}  // namespace eigentrail
