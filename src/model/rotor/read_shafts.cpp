// Reads the [[shaft]] tables: geometry, material, rotation and damping.
#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "model/rotor/rotor_draft.hpp"

namespace eigentrail {
namespace {

constexpr int most_elements = 100'000;  ///< of all shafts together

/// Columns of `stations`, as many segments.
struct Stations {
  std::vector<Expression> length, outer, inner;
  std::vector<double> elements;  ///< empty: not given
};

std::vector<Expression> constants(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

/// Lengths between successive positions.
std::vector<Expression> differences(const std::vector<Expression>& positions) {
  std::vector<Expression> result;
  for (std::size_t i = 1; i < positions.size(); ++i) result.push_back(positions[i] - positions[i - 1]);
  return result;
}

/// One value is that of all segments; else there must be as many as segments.
void spread(const TableReader& table, const std::string& key, auto& values, std::size_t segments) {
  if (values.size() == 1) values.resize(segments, values.front());
  if (values.size() != segments)
    table.fail(key, "has " + std::to_string(values.size()) + " values, and there are " +
                        std::to_string(segments) + " segments");
}

/// A CSV file: a row per segment with its length, or per end of a segment with its position; the last of
/// these closes the shaft and has no segment.
Stations stations_of_file(const CsvTable& table) {
  const std::vector<std::string> known = {"length", "position", "outer", "inner", "elements"};
  for (const CsvColumn& column : table.columns) {
    if (std::find(known.begin(), known.end(), column.name) == known.end())
      throw InputError(table.path + ": unknown column '" + column.name + "'; " +
                       suggestion(column.name, known));
  }
  const bool by_position = table.find("position") != nullptr;
  if (by_position == (table.find("length") != nullptr))
    throw InputError(table.path + ": expected a column 'length' or a column 'position'");
  if (table.find("outer") == nullptr)
    throw InputError(table.path + ": expected a column 'outer', the outer diameter");
  const std::size_t count = table.rows() - (by_position ? 1 : 0);
  if (count == 0) throw InputError(table.path + ": has one position; a segment lies between two");
  const auto column = [&](const std::string& name, const std::string& unit) {
    return si_values(table, *table.find(name), unit);
  };
  Stations result;
  if (by_position) {
    const std::vector<double> positions = column("position", "m");
    for (std::size_t i = 1; i < positions.size(); ++i) {
      if (!(positions[i] > positions[i - 1]))
        throw InputError(table.path + ":" + std::to_string(table.lines[i]) +
                         ": the positions must ascend; found " + exact_text(positions[i]) + " m behind " +
                         exact_text(positions[i - 1]) + " m");
    }
    result.length = differences(constants(positions));
  } else {
    result.length = constants(column("length", "m"));
  }
  const auto cut = [count](std::vector<double> values) {
    values.resize(count);
    return values;
  };
  result.outer = constants(cut(column("outer", "m")));
  result.inner = table.find("inner") == nullptr ? std::vector<Expression>(count, Expression(0.0))
                                                : constants(cut(column("inner", "m")));
  if (table.find("elements") != nullptr) result.elements = cut(column("elements", ""));
  return result;
}

/// The same as a table of the scene: each column a list, or one value for all segments.
Stations stations_of_scene(TableReader& shaft) {
  TableReader table = shaft.table("stations");
  const bool by_position = table.has("position");
  if (by_position && table.has("length"))
    table.fail("position", "the lengths are given already; leave one of both out");
  Stations result;
  result.length = by_position ? differences(table.list("position", "m")) : table.list("length", "m");
  if (result.length.empty()) table.fail("position", "expected the ends of the segments, two at least");
  std::size_t count = result.length.size();
  result.outer = table.list("outer", "m");
  result.inner = table.has("inner") ? table.list("inner", "m") : std::vector<Expression>{0.0};
  for (const auto* column : {&result.outer, &result.inner}) {
    if (count == 1) count = column->size();
  }
  spread(table, by_position ? "position" : "length", result.length, count);
  spread(table, "outer", result.outer, count);
  spread(table, "inner", result.inner, count);
  table.finish();
  return result;
}

std::vector<double> read_elements(const RotorDraft& rotor, TableReader& shaft, std::size_t segments) {
  std::vector<double> result;
  for (const Expression& one : shaft.list("elements", "")) {
    if (!one.is_constant()) shaft.fail("elements", "expected whole numbers, found an expression");
    result.push_back(rotor.first_value(one));
  }
  spread(shaft, "elements", result, segments);
  return result;
}

void check_segment(const RotorDraft& rotor, TableReader& shaft, const ShaftSegment& segment,
                   std::size_t index) {
  const std::string which = "segment " + std::to_string(index + 1) + ": ";
  const auto refuse = [&](const std::string& what, double found, std::size_t at) {
    shaft.fail("stations", which + what + "; found " + exact_text(found) + " m" + Draft::where_on_trace(at));
  };
  const std::vector<double> length = rotor.draft.check_values(segment.length);
  const std::vector<double> outer = rotor.draft.check_values(segment.outer);
  const std::vector<double> inner = rotor.draft.check_values(segment.inner);
  for (std::size_t i = 0; i < length.size(); ++i) {
    if (!(length[i] > 0.0) || !std::isfinite(length[i])) refuse("its length must be positive", length[i], i);
    if (!(outer[i] > 0.0) || !std::isfinite(outer[i]))
      refuse("its outer diameter must be positive", outer[i], i);
    if (!(inner[i] >= 0.0)) refuse("its inner diameter must not be negative", inner[i], i);
    if (!(inner[i] < outer[i]))
      refuse("its inner diameter must be less than the outer one, " + exact_text(outer[i]) + " m", inner[i],
             i);
  }
}

void read_segments(RotorDraft& rotor, TableReader& table, ShaftDraft& shaft) {
  if (!table.has("stations"))
    table.fail("stations", "is missing; expected { length = [...], outer = [...] } or a CSV file");
  Stations stations = table.is_table("stations")
                          ? stations_of_scene(table)
                          : read_csv(rotor.draft.scene, table, "stations", stations_of_file);
  const std::size_t count = stations.length.size();
  if (table.has("elements")) {
    if (!stations.elements.empty())
      table.fail("elements", "the stations have a column 'elements' already; leave one of both out");
    stations.elements = read_elements(rotor, table, count);
  }
  if (stations.elements.empty()) stations.elements.assign(count, 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double elements = stations.elements[i];
    if (!(elements >= 1.0 && elements <= most_elements) || elements != std::floor(elements))
      table.fail("elements", "expected whole numbers from 1 to " + std::to_string(most_elements) +
                                 ", found " + exact_text(elements));
    shaft.segments.push_back(
        {stations.length[i], stations.outer[i], stations.inner[i], static_cast<int>(elements)});
    check_segment(rotor, table, shaft.segments.back(), i);
  }
}

void read_material(RotorDraft& rotor, TableReader& table, ShaftDraft& shaft) {
  Draft& draft = rotor.draft;
  shaft.E = draft.read_number(table, "E", "Pa", Range::positive);
  if (table.has("G") == table.has("nu"))
    table.fail(table.has("G") ? "nu" : "G", "give one of G and nu (G = E / (2 (1 + nu)))");
  if (table.has("G")) {
    shaft.G = draft.read_number(table, "G", "Pa", Range::positive);
    shaft.nu = shaft.E / (Expression(2.0) * shaft.G) - Expression(1.0);
  } else {
    shaft.nu = draft.read_number(table, "nu", "", Range::any);
    shaft.G = shaft.E / (Expression(2.0) * (Expression(1.0) + shaft.nu));
  }
  const std::vector<double> ratios = draft.check_values(shaft.nu);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    if (!(ratios[i] > -1.0 && ratios[i] <= 0.5))
      table.fail(table.has("G") ? "G" : "nu", "Poisson's ratio must lie between -1 and 0.5; found " +
                                                  exact_text(ratios[i]) + Draft::where_on_trace(i));
  }
  shaft.density = draft.read_number(table, "density", "kg/m^3", Range::non_negative);
  if (table.has("shear_coefficient"))
    shaft.shear = draft.read_number(table, "shear_coefficient", "", Range::positive);
}

std::string read_shaft_name(const RotorDraft& rotor, TableReader& table, bool needed) {
  if (!table.has("name")) {
    if (needed) table.fail("name", "is missing; with more than one shaft each needs a name");
    return "";
  }
  std::string name = printable(table.text("name"));
  if (name.empty()) table.fail("name", "must not be empty");
  check_is_new(table, "shaft", name, names_of(rotor.shafts));
  return name;
}

}  // namespace

void read_shafts(RotorDraft& rotor) {
  Draft& draft = rotor.draft;
  const bool several = tables(draft.scene, "shaft").size() > 1;
  long elements = 0;
  draft.for_each_table("shaft", [&](TableReader& table, std::size_t) {
    ShaftDraft shaft;
    shaft.name = read_shaft_name(rotor, table, several);
    read_segments(rotor, table, shaft);
    read_material(rotor, table, shaft);
    shaft.position = draft.read_number(table, "position", "m", Range::any, 0.0);
    shaft.speed = draft.read_number(table, "speed", "rad/s", Range::any, 0.0);
    shaft.alpha = draft.read_number(table, "alpha", "1/s", Range::any, 0.0);
    shaft.beta = draft.read_number(table, "beta", "s", Range::any, 0.0);
    shaft.internal = draft.read_number(table, "internal_damping", "s", Range::non_negative, 0.0);
    shaft.refined = table.has("refined") && table.flag("refined");
    shaft.axial = table.has("axial") && table.flag("axial");
    shaft.torsion = table.has("torsion") && table.flag("torsion");
    table.finish();
    std::size_t nodes = 1;
    for (const ShaftSegment& segment : shaft.segments) nodes += static_cast<std::size_t>(segment.elements);
    elements += static_cast<long>(nodes);
    if (elements > most_elements)
      table.fail("elements", "the shafts have more than " + std::to_string(most_elements) + " elements");
    std::array<bool, 6> held{};
    held[along_z] = !shaft.axial;
    held[about_z] = !shaft.torsion;
    shaft.held.assign(nodes, held);
    rotor.shafts.push_back(std::move(shaft));
  });
}

}  // namespace eigentrail
