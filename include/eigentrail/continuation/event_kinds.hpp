// Table of the kinds of events: their names, marks and remarks in files, tables and pictures. All code that
// names a kind reads this table. A new kind needs a row in it and, if a scene can request it, its function
// of the eigenvalue in events/criterion.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "eigentrail/continuation/event.hpp"

namespace eigentrail {

/// The data of an event that its remark is written from; fields as in Event.
struct EventFacts {
  double half_width = NAN;
  Complex puiseux = {};
  int direction = 0;
  double value = NAN;
};

/// How a scene requests a kind of event: a key of [events] with one number or a list of numbers.
struct EventRequest {
  std::string_view key;               ///< empty: the kind is always searched for, or has its own switch
  std::string_view help;              ///< for the reference of scene tables
  std::string_view expected;          ///< the condition on each number, in words
  bool (*accepts)(double) = nullptr;  ///< whether a number can be requested
  bool of_excitation = false;         ///< the numbers are multiples of the excitation frequency
};

struct EventKindInfo {
  EventKind kind;
  std::string_view name;       ///< in files, CSV and JSON
  std::string_view long_name;  ///< in tables and pictures
  std::string_view symbol;     ///< mark in pictures, a Plotly symbol name
  bool labelled;               ///< whether pictures write the name beside the mark
  /// A few words on the event besides its kind and place; may be empty.
  std::string (*remark)(const EventFacts& facts);
  EventRequest request = {};
};

/// All kinds, in the order of EventKind.
std::span<const EventKindInfo> event_kinds();

/// The row of a kind. Throws std::out_of_range for a value that is no kind.
const EventKindInfo& event_kind(EventKind kind);

/// The kind of that name, or null. A file of another version of the program may have kinds that this version
/// does not know.
const EventKindInfo* find_event_kind(std::string_view name);

}  // namespace eigentrail
