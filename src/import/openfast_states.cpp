#include "import/openfast_states.hpp"

#include <algorithm>
#include <array>
#include <regex>
#include <utility>

#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

/// Terms of OpenFAST and the shorter ones of the field.
const std::array<std::pair<const char*, const char*>, 16> terms{{
    {"flapwise bending-mode", "flap"},
    {"edgewise bending-mode", "edge"},
    {" bending mode", ""},
    {" bending-mode", ""},
    {"Platform horizontal surge translation", "platform surge"},
    {"Platform horizontal sway translation", "platform sway"},
    {"Platform vertical heave translation", "platform heave"},
    {"Platform roll tilt rotation", "platform roll"},
    {"Platform pitch tilt rotation", "platform pitch"},
    {"Platform yaw rotation", "platform yaw"},
    {"Nacelle yaw", "nacelle yaw"},
    {"Drivetrain rotational-flexibility", "drivetrain torsion"},
    {"Variable speed generator", "generator azimuth"},
    {"Rotor-furl", "rotor furl"},
    {"Tail-furl", "tail furl"},
    {"Blade pitch", "blade pitch"},
}};

void replace(std::string& text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  if (at != std::string::npos) text.replace(at, what.size(), with);
}

/// Removes what matches and returns its group, or an empty text.
std::string take(std::string& text, const std::regex& pattern) {
  std::smatch match;
  if (!std::regex_search(text, match, pattern)) return "";
  const std::string group = match.size() > 1 ? match[1].str() : match[0].str();
  text = match.prefix().str() + match.suffix().str();
  return group;
}

}  // namespace

OpenFastState openfast_state(const std::string& description) {
  static const std::regex unit(R"(,\s*([^,()\s]+)\s*$)");
  static const std::regex index(R"(\s*\(internal DOF index[^)]*\)?\)?)");
  static const std::regex rate(R"(First time derivative of\s*)");
  static const std::regex beam(R"(\bBD_(\d{1,2})\s+)");
  static const std::regex module(R"(^(ED|HD|AD|SrvD|SD|MD|MAP|SeaSt|ExtPtfm|IfW|SED)\s+)");
  static const std::regex blade(R"(,?\s*(?:of |on |at )?[Bb]lade ?(\d{1,2})\b,?)");
  OpenFastState result;
  std::string text = description;
  result.unit = take(text, unit);
  take(text, index);
  take(text, module);
  result.is_rate = !take(text, rate).empty();
  take(text, module);
  std::string number = take(text, beam);
  if (number.empty()) number = take(text, blade);
  if (!number.empty()) result.blade = std::stoi(number);
  replace(text, " DOF", "");
  for (const auto& [what, with] : terms) replace(text, what, with);
  static const std::regex blanks(R"(\s+)");
  text = std::regex_replace(text, blanks, " ");
  while (!text.empty() && (text.back() == ' ' || text.back() == ',')) text.pop_back();
  while (!text.empty() && text.front() == ' ') text.erase(0, 1);
  result.motion = text.empty() ? description : text;
  return result;
}

std::string short_name(const OpenFastState& state) {
  return state.motion + (state.blade > 0 ? ", blade " + std::to_string(state.blade) : "") +
         (state.is_rate ? " velocity" : "");
}

std::vector<std::string> short_openfast_names(const std::vector<std::string>& names) {
  const auto described = [](const std::string& name) {
    return name.find("internal DOF index") != std::string::npos ||
           name.find("First time derivative of") != std::string::npos;
  };
  if (std::none_of(names.begin(), names.end(), described)) return names;
  std::vector<std::string> result;
  for (const std::string& name : names) result.push_back(short_name(openfast_state(name)));
  return first_repetition(result) ? names : result;
}

}  // namespace eigentrail
