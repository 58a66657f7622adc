#include "ranges.hpp"

#include <algorithm>
#include <cstdio>

#include "eigentrail/core/text.hpp"
#include "output.hpp"

namespace eigentrail::app {
namespace {

std::string end_text(const RangeEnd& end, Stability kind) {
  std::string text = end.cause;
  if (end.mode >= 0) text += ", mode " + std::to_string(end.mode + 1);
  const bool at_margin = kind == Stability::stable && end.margin != 0.0;
  return at_margin ? text + ", margin " + rounded(end.margin, 4) : text;
}

}  // namespace

std::vector<Permanence> permanence_of_modes(const LociFile& loci) {
  // Files of early versions lack the reference.
  if (!loci.attributes.contains("reference"))
    return std::vector<Permanence>(loci.modes.size(), Permanence::none);
  return eigentrail::permanence_of_modes(loci, {loci.number("tolerance"), loci.number("reference")});
}

void print_permanent(const std::vector<Permanence>& all, const std::vector<std::string>& names) {
  const auto list = [&](Permanence wanted) {
    std::string text;
    for (std::size_t mode = 0; mode < all.size(); ++mode) {
      if (all[mode] != wanted) continue;
      text += (text.empty() ? "" : ", ") + std::to_string(mode + 1);
      if (mode < names.size() && !names[mode].empty()) text += " (" + printable(names[mode]) + ")";
    }
    return text;
  };
  const std::string zeros = list(Permanence::zero);
  if (!zeros.empty()) {
    std::printf(
        "  zero throughout  modes %s: rigid-body motions, integrators or placeholders; stable ranges leave "
        "them out\n",
        zeros.c_str());
  }
  const std::string constants = list(Permanence::constant);
  if (!constants.empty()) std::printf("  constant  modes %s\n", constants.c_str());
}

void print_ranges(const std::vector<StableRange>& ranges, const std::string& parameter) {
  std::printf("  stable ranges%s\n", ranges.empty() ? "  none" : "");
  std::vector<std::vector<std::string>> rows;
  double low = 0.0, high = 0.0;
  for (const StableRange& range : ranges) {
    low = std::min({low, range.from.p, range.to.p});
    high = std::max({high, range.from.p, range.to.p});
  }
  for (const StableRange& range : ranges) {
    std::string margins;
    if (range.kind == Stability::stable) {
      margins = "margin " + rounded(range.least_margin, 4) + " to " + rounded(range.largest_margin, 4) +
                " 1/s, largest at " + rounded(range.largest_at, 6);
    }
    rows.push_back({"  " + stability_name(range.kind) + (range.whole ? "" : " among the followed modes"),
                    parameter + " = " + rounded(without_rounding(range.from.p, low, high), 12) + " -> " +
                        rounded(without_rounding(range.to.p, low, high), 12),
                    "from " + end_text(range.from, range.kind), "to " + end_text(range.to, range.kind),
                    margins});
  }
  print_table(rows);
}

}  // namespace eigentrail::app
