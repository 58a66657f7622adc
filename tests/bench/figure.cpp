#include "bench/figure.hpp"

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

void write_table_lines(const std::string& benchmark, const std::vector<Figure>& figures, std::ostream& out) {
  for (const Figure& figure : figures) {
    out << "| " << benchmark << " | " << figure.quantity << " | " << short_text(figure.value) << " | "
        << target_text(figure) << " | "
        << (!figure.target     ? ""
            : figure.reached() ? "yes"
                               : "no")
        << " | " << figure.detail << " |\n";
  }
}

}  // namespace eigentrail::test
