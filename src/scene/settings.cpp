#include "eigentrail/scene/settings.hpp"

#include <toml++/toml.h>

#include <cmath>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/measure.hpp"

namespace eigentrail {
namespace {

/// Offset in bytes of a line and column, which count characters from 1.
std::size_t offset_of(const std::string& text, const toml::source_position& at) {
  std::size_t offset = 0;
  for (unsigned line = 1; line < at.line; ++line) offset = text.find('\n', offset) + 1;
  const auto continues = [&](std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U;
  };
  for (unsigned column = 1; column < at.column; ++column) {
    ++offset;
    while (continues(offset)) ++offset;
  }
  return offset;
}

/// The text with the value of a parameter replaced. `text` has been parsed before, and declares it.
std::string with_value(const std::string& text, const std::string& name, const std::string& value) {
  const toml::table root = toml::parse(text);
  const toml::node* node = root["parameters"][name].node();
  if (const auto* fields = node->as_table()) node = fields->get("value");
  const std::size_t begin = offset_of(text, node->source().begin);
  const std::size_t end = offset_of(text, node->source().end);
  return text.substr(0, begin) + value + text.substr(end);
}

/// The value as TOML: a number in the unit of the parameter, or an expression in quotes.
std::string as_toml(const Scene& scene, const Parameter& parameter, const std::string& value,
                    const std::string& label) {
  if (const auto measure = parse_measure(value)) {
    const UnitValue found = value_in_unit_of(parameter, *measure);
    if (!found.fault.empty()) throw InputError(label + ": " + found.fault);
    if (!std::isfinite(found.value)) throw InputError(label + ": expected a finite number, found " + value);
    return exact_text(found.value);
  }
  try {
    (void)Expression::parse(value, scene.parameters.names());
  } catch (const ExpressionError& error) {
    throw InputError(label + ": in \"" + value + "\" at character " + std::to_string(error.offset + 1) +
                     ": " + error.what());
  }
  return "\"" + value + "\"";
}

/// Whether the scene declares a parameter; that of a family of matrices need not be declared.
bool declares(const Scene& scene, const std::string& name) {
  const auto* table = entry_as<Table>(scene.root, "parameters");
  return table != nullptr && table->find(name) != nullptr;
}

}  // namespace

ChangedScene with_settings(Scene scene, const std::vector<std::string>& settings, std::string_view option) {
  ChangedScene changed{std::move(scene), {}, {}};
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string_view text = setting;
    const std::string name(trimmed(text.substr(0, equals), " "));
    const std::string value(equals == std::string::npos ? "" : trimmed(text.substr(equals + 1), " "));
    if (name.empty() || value.empty())
      throw InputError(std::string(option) + setting + ": expected NAME=VALUE, such as drag=20");
    const std::string label = std::string(option) + name;
    const std::vector<std::string>& names = changed.scene.parameters.names();
    if (!declares(changed.scene, name)) {
      if (!changed.scene.parameters.index(name))
        throw InputError(label + ": no parameter is called '" + name + "'; " + suggestion(name, names));
      changed.warnings.push_back(label + ": has no effect: its values are those of the trace");
      continue;
    }
    const std::string toml = as_toml(changed.scene, changed.scene.parameters.at(name), value, label);
    Scene next =
        parse_scene(with_value(changed.scene.text, name, toml), changed.scene.path, changed.scene.generated);
    next.files = std::move(changed.scene.files);
    next.matrices = std::move(changed.scene.matrices);
    changed.scene = std::move(next);
    changed.names.push_back(name);
  }
  return changed;
}

}  // namespace eigentrail
