// The message of an error, for tests.
#pragma once

#include <string>

#include "eigentrail/core/errors.hpp"

namespace eigentrail::test {

/// The message of the InputError thrown by `action`; if none is thrown, a text that is no message.
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
