// Formats numbers and prints small tables.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/continuation/event.hpp"

namespace eigentrail::app {

/// A number as text with `digits` significant digits.
std::string rounded(double value, int digits = 6);

/// "order 3", or "order 3 (auto)" if the program has chosen the order (`chosen`).
std::string order_text(int order, bool chosen);

/// A complex number as text, for example "-0.01994 + 17.88j".
std::string complex_text(double real, double imag, int digits = 6);

/// The cells of a table row that describe an event.
std::vector<std::string> event_row(const Event& event, const std::string& parameter);

/// "between 16.6 and 16.7".
std::string interval_text(const EventInterval& interval);

/// Prints rows with aligned columns, two spaces apart, indented by two.
void print_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace eigentrail::app
