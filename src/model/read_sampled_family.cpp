#include "model/model_readers.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/hdf5_file.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/units.hpp"
#include "model/beside_scene.hpp"
#include "model/draft.hpp"
#include "model/family_tables.hpp"
#include "model/sampled_family.hpp"

namespace eigentrail {
namespace {

/// Factor from the file's unit of the parameter to its SI unit in the scene. A parameter that the scene
/// declares without a unit has that of the file.
double unit_of_values(TableReader& table, const Parameter& variable, const std::string& unit) {
  const bool none = unit.empty() || unit == "1";
  if (none || variable.unit.empty() || unit == variable.unit) return variable.factor;
  const auto factor = unit_factor(unit);
  if (!factor) {
    table.fail("file", "its values of the parameter are in '" + unit + "', those of " + variable.name +
                           " of the scene in '" + variable.unit +
                           "'; declare the same unit, or one that is understood");
  }
  return *factor;
}

/// Indices of the samples at which the scene declares a kink.
std::vector<std::size_t> read_kinks(TableReader& table, const SampledData& data, double factor) {
  std::vector<std::size_t> places;
  if (!table.has("kinks")) return places;
  for (const Expression& expression : table.list("kinks")) {
    if (!expression.is_constant()) table.fail("kinks", "expected numbers, found an expression");
    const double kink = expression.value() * factor;
    const auto nearest = std::min_element(data.values.begin(), data.values.end(), [kink](double a, double b) {
      return std::abs(a - kink) < std::abs(b - kink);
    });
    const double size = std::max(std::abs(data.values.front()), std::abs(data.values.back()));
    if (!(std::abs(*nearest - kink) <= same_value * size)) {
      table.fail("kinks", exact_text(kink / factor) + " is not among the samples; the nearest one is at " +
                              exact_text(*nearest / factor));
    }
    const auto at = static_cast<std::size_t>(nearest - data.values.begin());
    if (at > 0 && at + 1 < data.count()) places.push_back(at);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

SampledData read_data(TableReader& table, const Scene& scene) {
  const std::string name = table.text("file");
  try {
    return read_samples(open_beside_scene(scene, table));
  } catch (const Hdf5Error& error) {
    table.fail("file", error.what());
  } catch (const std::invalid_argument& error) {
    table.fail("file", name + ": " + error.what());
  }
}

void check_within(const Scene& scene, const Parameter& variable, int index, const SampledData& data,
                  const std::vector<Vector>& check_at) {
  std::vector<double> samples = data.values;
  for (double& value : samples) value /= variable.factor;
  for (const Vector& si : check_at) {
    const std::string fault = outside_samples(variable.name, si[index] / variable.factor, samples);
    if (!fault.empty()) throw InputError(scene.path + ": [trace]: " + fault);
  }
}

std::string number(double x) {
  return short_text(x, 6);
}

/// "-20, 31 + 4j": in the unit of the parameter.
std::string poles_text(const Denominator& denominator, double factor) {
  std::string text;
  for (const Complex pole : denominator.poles)
    text += (text.empty() ? "" : ", ") + number(pole.real() / factor) +
            (pole.imag() != 0.0 ? " +- " + number(pole.imag() / factor) + "j" : "");
  return text;
}

/// What `explain` says about the samples and their interpolant.
std::vector<std::pair<std::string, std::string>> describe_samples(const SampledData& data,
                                                                  const std::vector<SamplePiece>& pieces,
                                                                  const Parameter& variable) {
  const double factor = variable.factor;
  const auto at = [&](double x) { return number(x / factor); };
  std::vector<std::pair<std::string, std::string>> result{
      {"samples", std::to_string(data.count()) + " at " + variable.name + " = " + at(data.values.front()) +
                      (data.count() > 1 ? " to " + at(data.values.back()) : "") +
                      (variable.unit.empty() ? "" : " " + variable.unit)}};
  for (const SamplePiece& piece : pieces) {
    const RationalInterpolant& interpolant = piece.interpolant;
    const std::string poles = poles_text(interpolant.denominator(), factor);
    const std::string where = pieces.size() == 1 ? ""
                                                 : ", from " + at(interpolant.nodes().front()) + " to " +
                                                       at(interpolant.nodes().back());
    if (data.count() > 1)
      result.emplace_back("interpolant", "degree " + std::to_string(interpolant.degree()) +
                                             (poles.empty() ? ", no poles" : ", poles at " + poles) + where);
  }
  std::string kinks;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    kinks += (i == 1 ? "" : ", ") + at(pieces[i].interpolant.nodes().front());
  result.emplace_back("kinks", kinks.empty() ? "none declared" : kinks);
  std::string digits =
      data.digits ? std::to_string(*data.digits) + " significant" : "not stated: entries count as exact";
  if (!data.A_error.empty()) digits = "errors of the entries of A are given";
  result.emplace_back("digits", digits);
  if (!data.source.empty()) result.emplace_back("source", data.source);
  return result;
}

}  // namespace

std::unique_ptr<Model> read_sampled_family(const Scene& scene, const ModelRequest& request) {
  Draft draft(scene, request);
  TableReader table = draft.reader(only_table(scene, "sampled_family"), "[sampled_family]");
  const int index = traced_index(scene, "sampled_family", "the parameter of the samples");
  const Parameter& variable = scene.parameters[static_cast<std::size_t>(index)];
  draft.used.insert(index);
  SampledData data = read_data(table, scene);
  const double factor = unit_of_values(table, variable, data.parameter_unit);
  for (double& value : data.values) value *= factor;
  const std::vector<std::size_t> kinks = read_kinks(table, data, variable.factor);
  std::optional<int> degree;
  if (table.has("degree")) degree = table.whole_number("degree", 1, highest_degree);
  if (table.has("digits")) data.digits = table.whole_number("digits", 1, 17);
  table.finish();
  std::vector<int> unused = unused_parameters(scene, draft.used);
  check_within(scene, variable, index, data, draft.check_at);
  std::vector<SamplePiece> pieces = interpolate_samples(data, data.values, kinks, degree);
  ModelDescription description = describe_states(data.size(), data.state_names, data.state_units);
  description.parameters = scene.parameters;
  description.unused_parameters = std::move(unused);
  description.data = describe_samples(data, pieces, variable);
  return std::make_unique<SampledFamily>(std::move(description), index, data, std::move(pieces));
}

}  // namespace eigentrail
