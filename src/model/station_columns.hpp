// Properties at stations along a span: keys of a table, or columns of a file.
#pragma once

#include <map>

#include "model/draft.hpp"

namespace eigentrail {

/// A station and its part in a value between two of them.
struct StationShare {
  std::size_t station = 0;
  double weight = 0.0;
};

/// The stations on both sides of s, with their weights in linear interpolation. `span` ascends from 0 to 1,
/// or is a single station for all s.
std::vector<StationShare> station_shares(const std::vector<double>& span, double s);

/// Reads keys that may be one number for all stations or a list of one per station.
class StationColumns {
 public:
  using Column = std::vector<Expression>;

  /// `file_fields`: columns that the file of the key `file` may have.
  StationColumns(Draft& draft, TableReader& table, const std::vector<FieldHelp>& file_fields);

  const std::vector<double>& span() const { return span_; }
  std::size_t stations() const { return span_.size(); }
  bool has(const std::string& key) { return table_.has(key) || file_.contains(key); }
  bool in_file(const std::string& key) const { return file_.contains(key); }

  /// One entry per station.
  Column required(const std::string& key, std::string_view unit, Range range);
  Column optional(const std::string& key, std::string_view unit, Range range = Range::any,
                  double otherwise = 0.0);

 private:
  /// From the scene, or else from the file.
  Column list(const std::string& key, WantedUnit unit);
  void read_span();

  Draft& draft_;
  TableReader& table_;
  std::map<std::string, std::vector<double>> file_;
  std::vector<double> span_ = {0.0};
};

}  // namespace eigentrail
