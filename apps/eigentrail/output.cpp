#include "output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <numbers>

#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail::app {
namespace {

/// What is smaller than this, relative to its scale, is rounding.
constexpr double known_digits = 1e-12;

}  // namespace

int exit_code_of(const std::exception& error) {
  return dynamic_cast<const InputError*>(&error) != nullptr ? bad_input : numbers_failed;
}

int report_error(const std::exception& error) {
  const bool no_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  std::fprintf(stderr, "eigentrail: %s\n", no_memory ? "not enough memory" : printable(error.what()).c_str());
  return exit_code_of(error);
}

std::string percent(double share, int digits) {
  return rounded(100.0 * share + 0.0, digits) + " %";
}

std::string order_text(int order, bool chosen) {
  return "order " + std::to_string(order) + (chosen ? " (auto)" : "");
}

std::string complex_text(double real, double imag, int digits) {
  return rounded(real, digits) + (std::signbit(imag) ? " - " : " + ") + rounded(std::abs(imag), digits) + "j";
}

Complex without_rounding(Complex s, double reference) {
  if (!std::isfinite(std::abs(s))) return s;
  const double least = known_digits * std::max(std::abs(s), reference);
  const auto cleaned = [least](double part) { return std::abs(part) <= least ? 0.0 : part; };
  return {cleaned(s.real()), cleaned(s.imag())};
}

double without_rounding(double p, double from, double to) {
  return std::abs(p) <= known_digits * std::abs(to - from) ? 0.0 : p;
}

std::string eigenvalue_text(Complex s, int digits) {
  const Complex clean = without_rounding(s, 0.0);
  return complex_text(clean.real(), clean.imag(), digits);
}

double log_decrement(Complex s) {
  const bool oscillates = s.imag() != 0.0 && std::isfinite(s.real());
  return oscillates ? -2.0 * std::numbers::pi * s.real() / std::abs(s.imag()) : NAN;
}

std::string modes_text(const Event& event) {
  if (event.modes.empty()) return "";
  return (event.modes.size() == 1 ? "mode " : "modes ") +
         joined(event.modes, ", ", [](int mode) { return std::to_string(mode + 1); });
}

std::vector<std::string> event_row(const Event& event, const std::string& parameter) {
  const std::string remark =
      event_kind(event.kind).remark({event.half_width, event.puiseux, event.direction, event.value});
  return {"  " + event_name(event.kind), parameter + " = " + rounded(event.p, 12),
          "s = " + complex_text(event.s.real(), event.s.imag(), 8), modes_text(event), remark};
}

std::array<bool, 2> is_cut(const EventInterval& interval, double from, double to) {
  return {interval.from <= std::min(from, to), interval.to >= std::max(from, to)};
}

std::string interval_text(const EventInterval& interval, double from, double to) {
  constexpr int usual_digits = 6, most_digits = 12;
  int digits = usual_digits;
  while (digits < most_digits && rounded(interval.from, digits) == rounded(interval.to, digits)) ++digits;
  const std::string low = rounded(interval.from, digits), high = rounded(interval.to, digits);
  if (low == high) return "";
  const auto [cut_low, cut_high] = is_cut(interval, from, to);
  const std::string between = "between " + low + " and " + high;
  if (cut_low && cut_high) return between + ", or beyond the range";
  if (cut_low || cut_high) return between + ", or beyond " + (cut_low ? low : high) + " (end of the range)";
  return between;
}

std::string cell_text(const std::string& text) {
  constexpr std::size_t most = 100, kept = 48;
  const std::string line = printable(text);
  if (line.size() <= most) return line;
  // Not within a character of UTF-8.
  const auto inside = [&line](std::size_t at) { return (line[at] & 0xC0) == 0x80; };
  std::size_t head = kept, tail = line.size() - kept;
  while (head > 0 && inside(head)) --head;
  while (tail < line.size() && inside(tail)) ++tail;
  return line.substr(0, head) + " ... " + line.substr(tail);
}

void print_table(const std::vector<std::vector<std::string>>& rows, std::FILE* to) {
  // Width in characters: continuation bytes of UTF-8 do not count.
  const auto width = [](const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
  };
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += "  " + row[i];
      if (i + 1 < row.size()) line += std::string(widths[i] - width(row[i]), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    std::fprintf(to, "%s\n", line.c_str());
  }
}

void print_section(std::FILE* to, const char* heading, const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return;
  std::fprintf(to, "%s\n", heading);
  print_table(rows, to);
}

void print_title(const std::string& title, std::FILE* to) {
  if (!title.empty()) std::fprintf(to, "%s\n", printable(title).c_str());
}

}  // namespace eigentrail::app
