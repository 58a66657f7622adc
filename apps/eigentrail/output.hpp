// Formats numbers and prints small tables.
#pragma once

#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "core/texts.hpp"
#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/continuation/event.hpp"

namespace eigentrail::app {

/// The exit code that belongs to an error.
int exit_code_of(const std::exception& error);

/// Prints an error. Returns the exit code that belongs to it.
int report_error(const std::exception& error);

/// A number as text with `digits` significant digits.
inline std::string rounded(double value, int digits = 6) {
  return short_text(value, digits);
}

/// A share of one as text, for example "12.5 %".
std::string percent(double share, int digits);

/// "order 3", or "order 3 (auto)" if the program has chosen the order (`chosen`).
std::string order_text(int order, bool chosen);

/// A complex number as text, for example "-0.01994 + 17.88j".
std::string complex_text(double real, double imag, int digits = 6);

/// An eigenvalue in which a part that is zero but for rounding is zero: eigenvalues are known to 1e-12 of
/// their magnitude at best, or of the `reference`.
Complex without_rounding(Complex s, double reference);

/// A value of the parameter in which what is zero but for rounding is zero: places are known to 1e-12 of the
/// range from `from` to `to` at best.
double without_rounding(double p, double from, double to);

/// An eigenvalue as text, without rounding.
std::string eigenvalue_text(Complex s, int digits);

/// Logarithmic decrement -2 pi Re s / |Im s|; NaN for real eigenvalues and at infinity.
double log_decrement(Complex s);

/// "modes 1, 2"; empty if an event has none.
std::string modes_text(const Event& event);

/// The cells of a table row that describe an event.
std::vector<std::string> event_row(const Event& event, const std::string& parameter);

/// "between 16.6 and 16.7"; an end that is one of the range `from` ... `to` of the trace is marked as such:
/// the event may lie beyond it. Empty where the ends agree to the digits in which events are printed.
std::string interval_text(const EventInterval& interval, double from, double to);

/// Whether the interval ends where the range of the trace does: at its low end, at its high end.
std::array<bool, 2> is_cut(const EventInterval& interval, double from, double to);

/// A description for a column of a table: cut in the middle where it is long.
std::string cell_text(const std::string& text);

/// Prints rows with aligned columns, two spaces apart, indented by two.
void print_table(const std::vector<std::vector<std::string>>& rows, std::FILE* to = stdout);

/// Prints a heading and the rows below it; nothing without rows.
void print_section(std::FILE* to, const char* heading, const std::vector<std::vector<std::string>>& rows);

/// Prints the title of a scene, if it has one.
void print_title(const std::string& title, std::FILE* to = stdout);

}  // namespace eigentrail::app
