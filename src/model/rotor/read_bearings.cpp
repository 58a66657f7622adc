// Reads the [[bearing]] tables of a rotor: bearings and seals on nodes, with constant coefficients,
// expressions or a table over the speed.
#include <algorithm>
#include <optional>

#include "model/coefficient_table.hpp"
#include "model/rotor/rotor_draft.hpp"

namespace eigentrail {
namespace {

/// The coefficient of one entry of one matrix.
struct BearingCoefficient {
  Expression value;  ///< or the argument of the table
  std::shared_ptr<const TabulatedFactor> table = {};
};

/// The coefficients of a bearing by the name of their key; those that are zero are missing.
using BearingCoefficients = std::vector<std::pair<std::string, BearingCoefficient>>;

/// Forces between two nodes, or a node and the ground.
struct BearingEnds {
  const NodeCoordinates* node;
  const NodeCoordinates* other;  ///< null: the ground
};

MatrixSum& matrix_of(PencilSum& sum, const std::string& key) {
  return key[0] == 'k' ? sum.K : key[0] == 'c' ? sum.C : sum.M;
}

void add_bearing(PencilSum& sum, const BearingEnds& ends, const BearingCoefficients& coefficients) {
  const auto freedom = [](char axis) { return axis == 'x' ? along_x : axis == 'y' ? along_y : along_z; };
  for (const auto& [key, one] : coefficients) {
    MatrixSum& to = matrix_of(sum, key);
    const NodeFreedom row = freedom(key[1]), column = freedom(key[2]);
    for (const NodeCoordinates* a : {ends.node, ends.other}) {
      for (const NodeCoordinates* b : {ends.node, ends.other}) {
        if (a != nullptr && b != nullptr)
          to.add((*a)[row], (*b)[column], one.value, a == b ? 1.0 : -1.0, one.table);
      }
    }
  }
}

const char* unit_of(const std::string& key) {
  return key[0] == 'k' ? "N/m" : key[0] == 'c' ? "N s/m" : "kg";
}

TableColumns bearing_columns(const std::string& unit) {
  TableColumns columns{"the speed, or what 'over' says", unit, {}};
  for (const char* name :
       {"kxx", "kxy", "kyx", "kyy", "cxx", "cxy", "cyx", "cyy", "mxx", "mxy", "myx", "myy", "kzz", "czz"})
    columns.known.push_back({name, unit_of(name)});
  return columns;
}

/// The coefficients that the scene gives as numbers or expressions. A missing one along y is that along x.
BearingCoefficients read_coefficients(RotorDraft& rotor, TableReader& table,
                                      const CoefficientTable* columns) {
  BearingCoefficients result;
  const auto read = [&](const std::string& key) -> std::optional<BearingCoefficient> {
    const auto column = columns == nullptr ? nullptr : columns->find(key);
    if (table.has(key) && column != nullptr)
      table.fail(key, "the table has a column of this name already; leave one of both out");
    if (column != nullptr) return BearingCoefficient{columns->argument, column};
    if (!table.has(key)) return std::nullopt;
    return BearingCoefficient{rotor.draft.read_number(table, key, unit_of(key), Range::any)};
  };
  for (const std::string kind : {"k", "c", "m"}) {
    const std::optional<BearingCoefficient> first = read(kind + "xx");
    for (const std::string axes : {"xx", "xy", "yx", "yy", "zz"}) {
      if (kind == "m" && axes == "zz") continue;
      std::optional<BearingCoefficient> one = axes == "xx" ? first : read(kind + axes);
      if (!one && axes == "yy") one = first;
      if (one) result.emplace_back(kind + axes, std::move(*one));
    }
  }
  return result;
}

/// The table of a bearing over its argument: the speed of the shaft, or the expression `over`.
std::optional<CoefficientTable> read_columns(RotorDraft& rotor, TableReader& table, const NodePlace& place) {
  if (!table.has("table")) {
    for (const auto& [key, what] : {std::pair{"over", "is the argument"},
                                    {"degree", "is of the interpolant"},
                                    {"exact", "is a property"}}) {
      if (table.has(key)) table.fail(key, std::string(what) + " of a table; there is no 'table'");
    }
    return std::nullopt;
  }
  const Expression argument = table.has("over")
                                  ? rotor.draft.read_number(table, "over", std::nullopt, Range::any)
                                  : rotor.shafts[place.shaft].speed;
  TableColumns known = bearing_columns(table.has("over") ? "" : "rad/s");
  if (table.has("degree")) known.degree = table.whole_number("degree", 1, highest_degree);
  if (table.has("exact")) known.exact = table.flag("exact");
  CoefficientTable columns = read_coefficient_table(rotor.draft.scene, table, "table", argument, known);
  const std::vector<double> arguments = rotor.draft.check_values(argument);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (const std::string fault = columns.outside(arguments[i]); !fault.empty())
      table.fail("table", columns.path + ": " + fault + Draft::where_on_trace(i));
  }
  return columns;
}

/// The pairs of nodes that a bearing connects.
std::vector<std::pair<NodePlace, std::optional<NodePlace>>> read_ends(const RotorDraft& rotor,
                                                                      TableReader& table) {
  std::vector<std::pair<NodePlace, std::optional<NodePlace>>> result;
  if (table.has("between")) {
    if (table.has("node")) table.fail("node", "'between' names the nodes already; leave one of both out");
    const std::vector<NodePlace> both = rotor.read_nodes(table, "between");
    if (both.size() != 2) table.fail("between", "expected two nodes, found " + std::to_string(both.size()));
    if (both[0].shaft == both[1].shaft && both[0].node == both[1].node)
      table.fail("between", "names " + rotor.name_of(both[0]) + " twice");
    result.emplace_back(both[0], both[1]);
    return result;
  }
  for (const NodePlace& place : rotor.read_nodes(table, "node")) result.emplace_back(place, std::nullopt);
  return result;
}

}  // namespace

void read_bearings(RotorDraft& rotor) {
  rotor.draft.for_each_table("bearing", [&](TableReader& table, std::size_t i) {
    const auto ends = read_ends(rotor, table);
    const std::optional<CoefficientTable> columns = read_columns(rotor, table, ends.front().first);
    const BearingCoefficients coefficients = read_coefficients(rotor, table, columns ? &*columns : nullptr);
    if (table.has("name")) (void)table.text("name");
    table.finish();
    if (coefficients.empty())
      table.fail("kxx", "is missing; expected coefficients such as kxx = 1e6, cxx = 100, or a table");
    std::string where;
    const bool has_mass = std::any_of(coefficients.begin(), coefficients.end(),
                                      [](const auto& one) { return one.first[0] == 'm'; });
    const RotorEffect effect = has_mass ? RotorEffect::seal : RotorEffect::bearing;
    for (const auto& [node, other] : ends) {
      rotor.count(effect);
      add_bearing(rotor.sum(effect), {&rotor.at(node), other ? &rotor.at(*other) : nullptr}, coefficients);
      where +=
          (where.empty() ? "" : ", ") + rotor.name_of(node) + (other ? " and " + rotor.name_of(*other) : "");
    }
    std::string text = (ends.front().second ? "between " : "at ") + where;
    if (columns) text += "; " + columns->in_words();
    rotor.draft.notes.emplace_back("bearing " + std::to_string(i + 1), text);
  });
}

}  // namespace eigentrail
