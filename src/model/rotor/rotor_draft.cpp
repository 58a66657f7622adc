#include "model/rotor/rotor_draft.hpp"

#include <algorithm>

#include "core/texts.hpp"

namespace eigentrail {
namespace {

/// "inner node 3", "inner 3", "node 3" and "3": the name before the number, without the word "node".
std::string shaft_part(std::string text) {
  const auto strip = [&text] {
    while (!text.empty() && text.back() == ' ') text.pop_back();
  };
  strip();
  constexpr std::string_view word = "node";
  const bool whole = text == word;
  if (whole || text.ends_with(" node")) text.resize(text.size() - word.size());
  strip();
  return text;
}

}  // namespace

std::string ShaftDraft::node_name(std::size_t node) const {
  return (name.empty() ? "" : name + " ") + "node " + std::to_string(node + 1);
}

std::string ShaftDraft::element_name(std::size_t element) const {
  return (name.empty() ? "" : name + " ") + "element " + std::to_string(element + 1);
}

std::vector<NodePlace> RotorDraft::read_nodes(TableReader& table, const std::string& key) const {
  std::vector<NodePlace> places;
  const std::vector<std::string> names = names_of(shafts);
  for (const std::string& text : table.texts(key)) {
    const std::size_t digits = text.find_last_not_of("0123456789") + 1;
    const auto number = parsed_number<long>(std::string_view(text).substr(digits));
    const std::string expected = shafts.size() == 1 ? "3" : "\"" + names.front() + " node 3\"";
    if (!number)
      table.fail(key, "expected the number of a node, such as " + expected + ", found \"" + text + "\"");
    const std::string name = shaft_part(text.substr(0, digits));
    std::size_t shaft = 0;
    if (!name.empty() || shafts.size() > 1) {
      if (name.empty())
        table.fail(key, "say of which shaft, such as " + expected + "; found \"" + text + "\"");
      shaft = index_of(name, names, table, key, "shaft");
    }
    const std::size_t count = shafts[shaft].held.size();
    if (*number < 1 || *number > static_cast<long>(count))
      table.fail(key, "there is no " + shafts[shaft].node_name(static_cast<std::size_t>(*number - 1)) +
                          "; the nodes are numbered from 1 to " + std::to_string(count));
    places.push_back({shaft, static_cast<std::size_t>(*number - 1)});
  }
  if (places.empty()) table.fail(key, "expected a node, found an empty list");
  return places;
}

double RotorDraft::first_value(const Expression& expression) const {
  const std::vector<double> values = draft.check_values(expression);
  if (!values.empty()) return values.front();
  const Parameters& parameters = draft.scene.parameters;
  return expression.value(parameters.in_si(parameters.declared_values()));
}

MatrixSum::Part& MatrixSum::part(const Expression& factor,
                                 const std::shared_ptr<const TabulatedFactor>& table,
                                 const Expression& scale) {
  const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const Part& one) {
    return one.table == table && one.factor == factor && one.scale == scale;
  });
  if (found != parts_.end()) return *found;
  return parts_.emplace_back(Part{factor, table, scale});
}

void MatrixSum::add(Eigen::Index row, Eigen::Index column, const Expression& factor, double value,
                    const std::shared_ptr<const TabulatedFactor>& table) {
  const bool fixed = !table && factor.is_constant();
  if (fixed) value *= factor.value();
  if (row < 0 || column < 0 || value == 0.0) return;
  part(fixed ? 1.0 : factor, table).entries[{row, column}] += value;
}

void MatrixSum::add_product(Eigen::Index row, Eigen::Index column, const Expression& factor,
                            const Expression& entry, double value) {
  if (entry.is_constant()) {
    add(row, column, factor, value * entry.value());
  } else {
    add(row, column, factor * entry, value);
  }
}

void MatrixSum::add(const MatrixSum& other, const Expression& strength) {
  for (const Part& one : other.parts_) {
    const bool whole = strength == Expression(1.0);
    Part& own = whole       ? part(one.factor, one.table, one.scale)
                : one.table ? part(one.factor, one.table, one.scale * strength)
                            : part(one.factor * strength, nullptr);
    for (const auto& [at, value] : one.entries) own.entries[at] += value;
  }
}

template <class Storage>
std::vector<AffineTerm<Storage>> MatrixSum::terms(Eigen::Index n) const {
  std::vector<AffineTerm<Storage>> result;
  for (const Part& one : parts_) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [at, value] : one.entries) {
      if (value != 0.0) entries.emplace_back(at.first, at.second, value);
    }
    SparseMatrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    result.emplace_back(one.factor, Storage(matrix));
    result.back().table = one.table;
    result.back().scale = one.scale;
  }
  return result;
}

template std::vector<AffineTerm<SparseMatrix>> MatrixSum::terms(Eigen::Index) const;
template std::vector<AffineTerm<Matrix>> MatrixSum::terms(Eigen::Index) const;

}  // namespace eigentrail
