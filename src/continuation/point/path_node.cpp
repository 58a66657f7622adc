#include "eigentrail/continuation/path_node.hpp"

#include <algorithm>

#include "continuation/archived_parts.hpp"

namespace eigentrail {
namespace {

void add(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& part) {
  sum.resize(std::max(sum.size(), part.size()), 0);
  for (std::size_t i = 0; i < part.size(); ++i) sum[i] += part[i];
}

void add(EvaluationCounts& sum, const EvaluationCounts& part) {
  add(sum.residual, part.residual);
  add(sum.linearization, part.linearization);
}

template <class Count>
void add(Count& sum, const Count& part) {
  sum += part;
}

}  // namespace

RunCounts& RunCounts::operator+=(const RunCounts& other) {
  const auto add_all = [&other](auto&... sums) {
    const auto add_parts = [&](const auto&... parts) { (add(sums, parts), ...); };
    visit_members(other, add_parts);
  };
  visit_members(*this, add_all);
  return *this;
}

}  // namespace eigentrail
