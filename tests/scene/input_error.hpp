// The message of an error, for tests.
#pragma once

#include <string>

#include "eigentrail/core/errors.hpp"

namespace eigentrail::test {

/// The message of the error thrown by `action`; if none is thrown, a text that is no message.
template <class Error, class Action>
std::string error_text(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error was thrown";
}

template <class Action>
std::string input_error(const Action& action) {
  return error_text<InputError>(action);
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace eigentrail::test
