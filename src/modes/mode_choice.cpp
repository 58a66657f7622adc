#include "eigentrail/modes/mode_choice.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

double damping_ratio(Complex s) {
  const double size = std::abs(s);
  return size > 0.0 ? -s.real() / size : 1.0;
}

/// How far an eigenvalue is from what is wanted: distance from the band in rad/s, and excess of damping.
std::tuple<double, double> distance_from_wanted(const ModeChoice& choice, Complex s) {
  const double from_band =
      choice.band ? std::max({choice.band->lowest - s.imag(), s.imag() - choice.band->highest, 0.0}) : 0.0;
  const double excess = choice.damping_below ? std::max(damping_ratio(s) - *choice.damping_below, 0.0) : 0.0;
  return {from_band, excess};
}

}  // namespace

bool ModeChoice::wants(Complex s) const {
  if (band && !(s.imag() >= band->lowest && s.imag() <= band->highest)) return false;
  return !damping_below || damping_ratio(s) < *damping_below;
}

void mark_permanent_zeros(const IndependentParts& parts, std::vector<StartingMode>& modes) {
  for (StartingMode& mode : modes)
    mode.is_permanent_zero =
        parts.is_free(parts.ranges[static_cast<std::size_t>(mode.part)]) && mode.s == 0.0;
}

int choose_modes(const ModeChoice& choice, std::vector<StartingMode>& modes) {
  if (modes.empty()) return 0;
  auto end = std::stable_partition(modes.begin(), modes.end(), [&](const StartingMode& mode) {
    return choice.is_all() || (choice.wants(mode.s) && !mode.is_permanent_zero);
  });
  if (end == modes.begin()) {
    const auto nearest =
        std::min_element(modes.begin(), modes.end(), [&](const StartingMode& a, const StartingMode& b) {
          return distance_from_wanted(choice, a.s) < distance_from_wanted(choice, b.s);
        });
    std::iter_swap(modes.begin(), nearest);
    end = modes.begin() + 1;
  }
  if (choice.near) {
    const Complex target(0.0, *choice.near);
    std::stable_sort(modes.begin(), end, [&](const StartingMode& a, const StartingMode& b) {
      return std::abs(a.s - target) < std::abs(b.s - target);
    });
  }
  const auto wanted = static_cast<int>(end - modes.begin());
  const int count = std::min(choice.count.value_or(wanted), wanted);
  std::stable_sort(modes.begin(), modes.begin() + count, comes_before);
  std::stable_sort(modes.begin() + count, modes.end(), comes_before);
  return count;
}

std::string text_of(const ModeChoice& choice) {
  ModeChoice only_count;
  only_count.count = choice.count;
  if (choice == only_count) return choice.count ? std::to_string(*choice.count) : "all";
  std::string text;
  const auto add = [&text](const std::string& entry) { text += (text.empty() ? "" : ", ") + entry; };
  if (choice.count) add("count = " + std::to_string(*choice.count));
  if (choice.band)
    add("band = [" + exact_text(choice.band->lowest) + ", " + exact_text(choice.band->highest) + "]");
  if (choice.damping_below) add("damping_below = " + exact_text(*choice.damping_below));
  if (choice.near) add("near = " + exact_text(*choice.near));
  return text;
}

std::string in_words(const ModeChoice& choice) {
  const auto rounded = [](double value) { return short_text(value, 6); };
  if (choice.is_all()) return "all modes";
  std::string text = "the ";
  if (choice.count) text += std::to_string(*choice.count) + " ";
  if (choice.count && !choice.near) text += "lowest ";
  text += "modes";
  if (choice.near) text += (choice.count ? " nearest to " : " about ") + rounded(*choice.near) + " rad/s";
  if (choice.band)
    text += " with Im s between " + rounded(choice.band->lowest) + " and " + rounded(choice.band->highest) +
            " rad/s";
  if (choice.damping_below)
    text += std::string(choice.band ? " and" : " with") + " a damping ratio below " +
            rounded(*choice.damping_below);
  return text;
}

}  // namespace eigentrail
