#include "continuation/tracks/mode_copies.hpp"

#include <algorithm>

#include "continuation/tracks/members.hpp"
#include "eigentrail/reduction/tangent_basis.hpp"

namespace eigentrail {
namespace {

/// Numbers of some modes in a copy, counted from 0; empty where one of them is not followed there.
std::vector<int> in_copy(const ModeCopies& copies, const std::vector<int>& modes, std::size_t copy) {
  std::vector<int> there;
  for (const int mode : modes) {
    const std::vector<int>& numbers = copies.of(mode);
    if (copy < numbers.size()) there.push_back(numbers[copy]);
  }
  return there;
}

std::size_t most_copies(const ModeCopies& copies, const std::vector<int>& modes) {
  std::size_t most = 0;
  for (const int mode : modes) most = std::max(most, copies.of(mode).size());
  return most;
}

}  // namespace

const std::vector<int>& ModeCopies::of(int mode) const {
  static const std::vector<int> none;
  const auto found = numbers.find(mode);
  return found == numbers.end() ? none : found->second;
}

ModeCopies starting_copies(const std::vector<StartingMode>& modes, int n_modes) {
  ModeCopies copies;
  // Equal modes are equal numbers. Where a part has an eigenvalue more than once, its modes and those of a
  // copy belong together in their order.
  const auto same_before = [&](int i) {
    return std::count_if(modes.begin(), modes.begin() + i, [&](const StartingMode& other) {
      const StartingMode& mode = modes[static_cast<std::size_t>(i)];
      return other.part == mode.part && other.copy == mode.copy && other.s == mode.s;
    });
  };
  for (int i = 0; i < n_modes; ++i) {
    const StartingMode& mode = modes[static_cast<std::size_t>(i)];
    if (mode.copy == 0) continue;
    for (int j = 0; j < n_modes; ++j) {
      const StartingMode& first = modes[static_cast<std::size_t>(j)];
      if (first.part != mode.part || first.copy != 0 || first.s != mode.s || same_before(j) != same_before(i))
        continue;
      std::vector<int>& numbers = copies.numbers[j];
      if (static_cast<int>(numbers.size()) == mode.copy - 1) numbers.push_back(i);
    }
  }
  for (int i = 0; i < n_modes; ++i) {
    if (modes[static_cast<std::size_t>(i)].copy == 0) copies.numbers.try_emplace(i);
  }
  return copies;
}

void number_copies(const PathNode& node, ModeNumbers& numbers, ModeCopies& copies) {
  for (const Track& track : node.tracks) {
    const auto count = static_cast<std::size_t>(n_copies(node.basis, track.pair.part));
    for (const int mode : track.modes) {
      if (mode < 0 || count == 0 || copies.numbers.contains(mode)) continue;
      const auto partner = numbers.partners.find(mode);
      const bool known = partner != numbers.partners.end() && copies.numbers.contains(partner->second);
      const std::size_t own = known ? copies.of(partner->second).size() : count;
      for (std::size_t i = 0; i < own; ++i) copies.numbers[mode].push_back(numbers.count++);
      copies.numbers.try_emplace(mode);
    }
  }
}

PathStep with_copies(const ModeCopies& copies, PathStep step) {
  const std::size_t tracks = step.blocks.size();
  for (std::size_t i = 0; i < tracks; ++i) {
    const std::size_t count = most_copies(copies, step.blocks[i].modes);
    for (std::size_t copy = 0; copy < count; ++copy) {
      DenseBlock block = step.blocks[i];
      block.modes = in_copy(copies, block.modes, copy);
      step.blocks.push_back(std::move(block));
    }
  }
  return step;
}

std::vector<Event> with_copies(const ModeCopies& copies, const Event& event) {
  std::vector<Event> all{event};
  all.front().copies.clear();
  for (std::size_t copy = 0; copy < event.copies.size(); ++copy) {
    Event other = all.front();
    other.modes = sorted_modes(in_copy(copies, event.modes, copy));
    if (other.modes.empty()) continue;
    other.shape = event.copies[copy].shape;
    other.sensitivity = event.copies[copy].sensitivity;
    other.shift = event.copies[copy].shift;
    all.push_back(std::move(other));
  }
  if (!event.copies.empty()) return all;
  std::vector<int>& modes = all.front().modes;
  for (const int mode : event.modes) modes = united(modes, copies.of(mode));
  modes = sorted_modes(std::move(modes));
  return all;
}

std::string equal_modes_text(const ModeCopies& copies, const std::vector<int>& modes) {
  std::string text;
  for (const int mode : modes) {
    for (const int other : copies.of(mode))
      text += (text.empty() ? " and the equal modes " : ", ") + std::to_string(other + 1);
  }
  return text;
}

}  // namespace eigentrail
