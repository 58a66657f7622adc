#include "hard_cases/catalogue.hpp"

#include <algorithm>
#include <iterator>
#include <ostream>
#include <stdexcept>

#include "hard_cases/parts.hpp"

namespace eigentrail::test {
namespace {

std::vector<HardCase> collect() {
  std::vector<HardCase> all;
  for (const auto& part : {veerings_and_crossings, flutter_families, structures, rotating_mass_cases,
                           constrained_cases, own_clusters, own_structures}) {
    std::vector<HardCase> cases = part();
    std::move(cases.begin(), cases.end(), std::back_inserter(all));
  }
  // By number: H before C before the own ones, which keep their order.
  const auto rank = [](const HardCase& c) -> std::string {
    const bool listed = c.name.size() > 2 && c.name[1] >= '0' && c.name[1] <= '9';
    if (!listed) return "3";
    return (c.name[0] == 'H' ? "1" : "2") + c.name.substr(1, 2);
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const HardCase& a, const HardCase& b) { return rank(a) < rank(b); });
  return all;
}

}  // namespace

void PrintTo(const HardCase& hard_case, std::ostream* out) {
  *out << hard_case.name;
}

const std::vector<HardCase>& hard_cases() {
  static const std::vector<HardCase> all = collect();
  return all;
}

const HardCase& hard_case(const std::string& name) {
  const auto& all = hard_cases();
  const auto found = std::find_if(all.begin(), all.end(), [&](const HardCase& c) { return c.name == name; });
  if (found == all.end()) throw std::out_of_range("no hard case " + name);
  return *found;
}

}  // namespace eigentrail::test
