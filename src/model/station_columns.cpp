#include "model/station_columns.hpp"

#include <cmath>

#include "core/gaps.hpp"
#include "model/station_file.hpp"

namespace eigentrail {

std::vector<StationShare> station_shares(const std::vector<double>& span, double s) {
  if (span.size() == 1) return {{0, 1.0}};
  const std::size_t right = gap_of(span, s) + 1;
  const double weight = (s - span[right - 1]) / (span[right] - span[right - 1]);
  return {{right - 1, 1.0 - weight}, {right, weight}};
}

StationColumns::StationColumns(Draft& draft, TableReader& table, const std::vector<FieldHelp>& file_fields)
    : draft_(draft), table_(table) {
  if (table.has("file")) file_ = read_station_file(draft.scene, table, file_fields);
  read_span();
}

StationColumns::Column StationColumns::required(const std::string& key, std::string_view unit, Range range) {
  Column column = list(key, unit);
  if (column.size() == 1) column.assign(stations(), Expression(column[0]));
  if (column.size() != stations()) {
    table_.fail(key, stations() == 1
                         ? "a list needs the places of its stations; give span as well"
                         : "expected one number, or one for each of the " + std::to_string(stations()) +
                               " stations of span; found " + std::to_string(column.size()));
  }
  for (const Expression& e : column) draft_.check_range(table_, key, e, range);
  return column;
}

StationColumns::Column StationColumns::optional(const std::string& key, std::string_view unit, Range range,
                                                double otherwise) {
  return has(key) ? required(key, unit, range) : Column(stations(), Expression(otherwise));
}

StationColumns::Column StationColumns::list(const std::string& key, WantedUnit unit) {
  if (table_.has(key) || !file_.contains(key)) return table_.list(key, unit);
  const std::vector<double>& values = file_.at(key);
  return {values.begin(), values.end()};
}

void StationColumns::read_span() {
  if (!has("span")) return;
  span_.clear();
  for (const Expression& e : list("span", {})) {
    if (!e.is_constant()) table_.fail("span", "expected numbers, found an expression of parameters");
    span_.push_back(e.evaluate(std::span<const double>()));
    const std::size_t n = span_.size();
    if (!std::isfinite(span_.back()) || (n > 1 && !(span_[n - 1] > span_[n - 2])))
      table_.fail("span", "expected numbers that increase from station to station");
  }
  if (span_.size() < 2) table_.fail("span", "expected at least two stations");
  const double first = span_.front();
  const double length = span_.back() - first;
  for (double& s : span_) s = (s - first) / length;
}

}  // namespace eigentrail
