// The kinds of events: what files, tables and pages call them and say of them. Everything that names a kind
// reads this table, so that a new kind is a row here, and its function in events/criterion.cpp where a scene
// asks for it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "eigentrail/continuation/event.hpp"

namespace eigentrail {

/// What the remark on an event is made of; fields as in Event.
struct EventFacts {
  double half_width = NAN;
  Complex puiseux = {};
  int direction = 0;
  double value = NAN;
};

/// How a scene asks for a kind of event: a key of [events] with one number or a list.
struct EventRequest {
  std::string_view key;               ///< empty: the kind is always looked for, or by a switch of its own
  std::string_view help;              ///< for the reference of scene tables
  std::string_view expected;          ///< of each number, in words
  bool (*accepts)(double) = nullptr;  ///< whether a number can be asked for
  bool of_excitation = false;         ///< the numbers are multiples of the excitation frequency
};

struct EventKindInfo {
  EventKind kind;
  std::string_view name;       ///< in files, CSV and JSON
  std::string_view long_name;  ///< in tables and pictures
  std::string_view symbol;     ///< of the mark in pictures, by Plotly's names
  bool labelled;               ///< written beside its mark: what changes stability, or the path
  /// What the event is beside its kind and place, in a few words; may be empty.
  std::string (*remark)(const EventFacts& facts);
  EventRequest request = {};
};

/// All kinds, in the order of EventKind.
std::span<const EventKindInfo> event_kinds();

/// Throws std::out_of_range for a number that is no kind.
const EventKindInfo& event_kind(EventKind kind);

/// Whether a number, perhaps from a damaged file, is a kind.
bool is_event_kind(EventKind kind);

/// The kind of that name, or null: a file may be from another version of the program.
const EventKindInfo* find_event_kind(std::string_view name);

}  // namespace eigentrail
