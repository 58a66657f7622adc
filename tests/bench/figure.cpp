#include "bench/figure.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "bench/text.hpp"

namespace eigentrail::test {
namespace {

std::string target_text(const Figure& figure) {
  if (!figure.target) return "";
  const bool upper = figure.target->sense == Target::Sense::at_most;
  return (upper ? "<= " : ">= ") + short_text(figure.target->limit);
}

}  // namespace

bool Figure::reached() const {
  if (!target) return true;
  return target->sense == Target::Sense::at_most ? value <= target->limit : value >= target->limit;
}

void write_table_head(std::ostream& out) {
  out << "| benchmark | figure | measured | target | reached | from |\n|---|---|---|---|---|---|\n";
}

void write_table_lines(const std::vector<Figure>& figures, std::ostream& out) {
  for (const Figure& figure : figures) {
    out << "| " << figure.benchmark << " | " << figure.quantity << " | " << short_text(figure.value) << " | "
        << target_text(figure) << " | "
        << (!figure.target     ? ""
            : figure.reached() ? "yes"
                               : "no")
        << " | " << figure.detail << " |\n";
  }
}

void write_json(const std::vector<Figure>& figures, bool smoke, std::ostream& out) {
  nlohmann::json list = nlohmann::json::array();
  for (const Figure& figure : figures) {
    nlohmann::json entry{{"benchmark", figure.benchmark},
                         {"quantity", figure.quantity},
                         {"value", figure.value},
                         {"detail", figure.detail}};
    if (figure.target) {
      entry["target"] = figure.target->limit;
      entry["sense"] = figure.target->sense == Target::Sense::at_most ? "at most" : "at least";
      entry["reached"] = figure.reached();
    }
    list.push_back(std::move(entry));
  }
  out << nlohmann::json{{"smoke", smoke}, {"figures", std::move(list)}}.dump(2) << '\n';
}

}  // namespace eigentrail::test
