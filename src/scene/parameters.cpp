#include "eigentrail/scene/parameters.hpp"

#include <algorithm>

namespace eigentrail {
namespace {

enum class Mark { unseen, open, done };

/// Depth-first order of the derived parameters. A parameter that is reached again while its own definition is
/// being followed closes a cycle.
class DefinitionOrder {
 public:
  explicit DefinitionOrder(const std::vector<Parameter>& list)
      : list_(list), marks_(list.size(), Mark::unseen) {
    for (std::size_t i = 0; i < list.size(); ++i) visit(static_cast<int>(i));
  }

  std::vector<int> order;

 private:
  void visit(int i) {
    if (marks_[i] == Mark::done) return;
    if (marks_[i] == Mark::open) fail(i);
    marks_[i] = Mark::open;
    chain_.push_back(i);
    if (list_[i].definition) {
      for (const int used : list_[i].definition->parameters()) visit(used);
      order.push_back(i);
    }
    chain_.pop_back();
    marks_[i] = Mark::done;
  }

  [[noreturn]] void fail(int i) const {
    std::string cycle = list_[i].name;
    for (auto at = std::find(chain_.begin(), chain_.end(), i) + 1; at != chain_.end(); ++at) {
      cycle += " -> " + list_[*at].name;
    }
    throw ParameterCycle("is defined through itself: " + cycle + " -> " + list_[i].name, i);
  }

  const std::vector<Parameter>& list_;
  std::vector<Mark> marks_;
  std::vector<int> chain_;
};

}  // namespace

Parameters::Parameters(std::vector<Parameter> list) : list_(std::move(list)) {
  for (const Parameter& parameter : list_) names_.push_back(parameter.name);
  derived_order_ = DefinitionOrder(list_).order;
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
  const Vector si = in_si(values);
  for (const int i : derived_order_) values[i] = si[i] / list_[i].factor;
  return values;
}

std::set<int> Parameters::with_definitions(const std::set<int>& parameters) const {
  std::set<int> reached;
  std::vector<int> open(parameters.begin(), parameters.end());
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    if (!reached.insert(i).second || !list_[i].definition) continue;
    const auto& used = list_[i].definition->parameters();
    open.insert(open.end(), used.begin(), used.end());
  }
  return reached;
}

bool Parameters::depends_on(const Expression& expression, int traced) const {
  const auto& used = expression.parameters();
  return !used.empty() && with_definitions({used.begin(), used.end()}).contains(traced);
}

}  // namespace eigentrail
