// The message of an error that a test expects.
#pragma once

#include <string>

#include "eigentrail/core/errors.hpp"

namespace eigentrail::test {

/// What the InputError thrown by `action` says; a text that no message equals when none is thrown.
template <class Action>
std::string input_error(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError was thrown";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace eigentrail::test
