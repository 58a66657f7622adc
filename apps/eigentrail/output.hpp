// Numbers and small tables for people and scripts.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/event.hpp"

namespace eigentrail::app {

/// Text with `digits` significant digits.
std::string rounded(double value, int digits = 6);

/// "order 3", or "order 3 (auto)" where the program chose it.
std::string order_text(int order, bool chosen);

/// "-0.01994 + 17.88j"
std::string complex_text(double real, double imag, int digits = 6);

/// Cells that describe a special point to people.
std::vector<std::string> event_row(const Event& event, const std::string& parameter);

/// Prints rows with aligned columns, two spaces apart, indented by two.
void print_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace eigentrail::app
