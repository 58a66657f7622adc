#include "eigentrail/continuation/event_options.hpp"

#include "eigentrail/core/text.hpp"

namespace eigentrail {

EventOptions read_event_options(const Scene& scene) {
  const auto found = tables(scene, "events");
  EventOptions options;
  if (found.empty()) return options;
  if (found.size() > 1)
    throw scene_error(scene, found[1]->where, "[events]: a scene has one of these at most");
  std::set<int> used;
  TableReader table(scene, *found.front(), "[events]", used);
  const char* key = "damping_ratio";
  if (table.has(key)) {
    const Expression expression = table.expression(key);
    if (!expression.is_constant()) table.fail(key, "expected a number without parameters");
    options.damping_ratio = expression.evaluate(std::span<const double>());
    if (!is_damping_ratio(*options.damping_ratio))
      table.fail(key, "must lie between -1 and 1; found " + exact_text(*options.damping_ratio));
  }
  table.finish();
  return options;
}

}  // namespace eigentrail
