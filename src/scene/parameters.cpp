#include "eigentrail/scene/parameters.hpp"

#include <algorithm>

namespace eigentrail {
namespace {

enum class Mark { unseen, open, done };

/// Depth-first order of the derived parameters; a parameter met while still open closes a cycle.
void visit(const std::vector<Parameter>& list, int i, std::vector<Mark>& marks, std::vector<int>& order) {
  if (marks[i] == Mark::done) return;
  if (marks[i] == Mark::open) {
    throw std::invalid_argument("parameter '" + list[i].name + "' is defined through itself");
  }
  marks[i] = Mark::open;
  if (list[i].definition) {
    for (const int used : list[i].definition->parameters()) visit(list, used, marks, order);
    order.push_back(i);
  }
  marks[i] = Mark::done;
}

}  // namespace

Parameters::Parameters(std::vector<Parameter> list) : list_(std::move(list)) {
  for (const Parameter& parameter : list_) names_.push_back(parameter.name);
  std::vector<Mark> marks(list_.size(), Mark::unseen);
  for (std::size_t i = 0; i < list_.size(); ++i) visit(list_, static_cast<int>(i), marks, derived_order_);
}

std::optional<int> Parameters::index(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? std::nullopt : std::optional(static_cast<int>(found - names_.begin()));
}

const Parameter& Parameters::at(std::string_view name) const {
  const auto i = index(name);
  if (!i) throw std::out_of_range("no parameter is called '" + std::string(name) + "'");
  return list_[static_cast<std::size_t>(*i)];
}

Vector Parameters::declared_values() const {
  Vector values(static_cast<Eigen::Index>(size()));
  for (std::size_t i = 0; i < size(); ++i) values[static_cast<Eigen::Index>(i)] = list_[i].value;
  Vector si = values;
  to_si(std::span<double>(si.data(), size()));
  for (const int i : derived_order_) values[i] = si[i] / list_[i].factor;
  return values;
}

bool Parameters::depends_on(int parameter, int traced) const {
  if (parameter == traced) return true;
  const auto& definition = list_[parameter].definition;
  return definition && depends_on(*definition, traced);
}

bool Parameters::depends_on(const Expression& expression, int traced) const {
  const auto& used = expression.parameters();
  return std::any_of(used.begin(), used.end(), [&](int i) { return depends_on(i, traced); });
}

}  // namespace eigentrail
