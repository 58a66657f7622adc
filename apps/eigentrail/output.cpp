#include "output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "eigentrail/continuation/event_kinds.hpp"

namespace eigentrail::app {

std::string rounded(double value, int digits) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
  return buffer.data();
}

std::string order_text(int order, bool chosen) {
  return "order " + std::to_string(order) + (chosen ? " (auto)" : "");
}

std::string complex_text(double real, double imag, int digits) {
  return rounded(real, digits) + (std::signbit(imag) ? " - " : " + ") + rounded(std::abs(imag), digits) + "j";
}

std::vector<std::string> event_row(const Event& event, const std::string& parameter) {
  std::string modes;
  for (const int mode : event.modes) modes += (modes.empty() ? "" : ", ") + std::to_string(mode + 1);
  const std::string remark =
      event_kind(event.kind).remark({event.half_width, event.puiseux, event.direction, event.value});
  return {"  " + event_name(event.kind), parameter + " = " + rounded(event.p, 12),
          "s = " + complex_text(event.s.real(), event.s.imag(), 8), modes.empty() ? "" : "modes " + modes,
          remark};
}

std::string interval_text(const EventInterval& interval) {
  return "between " + rounded(interval.from, 6) + " and " + rounded(interval.to, 6);
}

void print_table(const std::vector<std::vector<std::string>>& rows) {
  // Width in characters: continuation bytes of UTF-8 do not count.
  const auto width = [](const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
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
    std::printf("%s\n", line.c_str());
  }
}

}  // namespace eigentrail::app
