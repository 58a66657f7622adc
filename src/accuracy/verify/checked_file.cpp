#include "accuracy/verify/checked_file.hpp"

#include <algorithm>
#include <sstream>

#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

Event event_of(const LociFile& loci, const LociEvent& stored) {
  const EventKindInfo* kind = find_event_kind(stored.kind);
  if (kind == nullptr) throw InputError(loci.path + ": has a special point of unknown kind " + stored.kind);
  Event event;
  event.kind = kind->kind;
  event.p = stored.parameter;
  event.s = stored.s;
  event.half_width = stored.half_width;
  event.puiseux = stored.puiseux;
  event.direction = stored.direction;
  event.value = stored.value;
  event.node = stored.node;
  std::istringstream numbers(stored.modes);
  for (std::string number; std::getline(numbers, number, ';');)
    event.modes.push_back(std::atoi(number.c_str()) - 1);
  const auto exists = [&](int mode) { return mode >= 0 && mode < static_cast<int>(loci.modes.size()); };
  const bool fits = std::all_of(event.modes.begin(), event.modes.end(), exists);
  if (!fits)
    throw InputError(loci.path + ": the modes of " + event_line(event) + " do not fit the other datasets");
  return event;
}

}  // namespace

PathPosition CheckedFile::node(std::size_t number) const {
  const bool is_last = number > 0 && number == loci.steps.size();
  return is_last ? PathPosition{number - 1, 1.0} : PathPosition{number, 0.0};
}

bool CheckedFile::is_meeting(std::size_t number) const {
  constexpr double near = 1e-6;       // share of the steps on both sides
  constexpr double near_turn = 1e-5;  // share of the range, where the stiffness is singular
  const std::size_t before = number > 0 ? number - 1 : 0;
  const std::size_t behind = std::min(number + 1, loci.n_nodes() - 1);
  const double p = loci.p[number];
  const double length = std::abs(loci.p[behind] - p) + std::abs(p - loci.p[before]);
  const double range = loci.highest() - loci.lowest();
  return std::any_of(events.begin(), events.end(), [&](const Event& event) {
    const bool meets = event.kind == EventKind::collision || event.kind == EventKind::crossing;
    const bool turns = is_static(event.kind);
    const double distance = std::abs(event.p - p);
    return (meets && distance <= near * length) || (turns && distance <= near_turn * range);
  });
}

std::vector<std::size_t> CheckedFile::plain_nodes(std::size_t most) const {
  std::vector<std::size_t> plain;
  for (std::size_t node = 0; node < loci.n_nodes(); ++node) {
    if (!is_meeting(node)) plain.push_back(node);
  }
  const std::size_t count = std::min(plain.size(), most);
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < count; ++i) nodes.push_back(plain[i * plain.size() / count]);
  return nodes;
}

std::string CheckedFile::at(double p) const {
  return loci.parameter + " = " + exact_text(p);
}

std::string CheckedFile::mode_at(Eigen::Index mode, double p) const {
  return loci.modes[static_cast<std::size_t>(mode)] + " at " + at(p);
}

CheckedFile checked_file(const LociFile& loci, const TraceSetup& setup) {
  CheckedFile file{loci, setup, {setup.options.tolerance, loci.number("reference")}, {}};
  for (const LociEvent& event : loci.events) file.events.push_back(event_of(loci, event));
  return file;
}

std::string count_text(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace eigentrail
