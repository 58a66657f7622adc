#include "store/loci_summary.hpp"

#include <limits>

#include "store/provenance.hpp"

namespace eigentrail {

void clear_events(Hdf5Writer& file) {
  for (const char* name :
       {"event", "events", "event_parameter", "event_eigenvalue", "event_half_width", "event_puiseux",
        "event_node", "event_direction", "event_value", "event_shape", "event_sensitivity", "event_shift"})
    file.extend(name, 0, 0);
}

void write_events(Hdf5Writer& file, const std::vector<Event>& events, std::size_t first) {
  if (first >= events.size()) return;
  std::vector<std::string> lines;
  std::vector<double> parameters, half_widths;
  std::vector<Complex> eigenvalues, puiseux;
  std::vector<std::int64_t> numbers, nodes;
  std::vector<std::int64_t> directions;
  std::vector<double> values, shifts;
  std::vector<Complex> shapes, sensitivities;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto append = [](auto& all, const auto& row, std::size_t size) {
    using Item = typename std::decay_t<decltype(all)>::value_type;
    for (std::size_t i = 0; i < size; ++i)
      all.push_back(static_cast<Eigen::Index>(i) < row.size() ? row[static_cast<Eigen::Index>(i)]
                                                              : Item(nan));
  };
  for (std::size_t i = first; i < events.size(); ++i) {
    const Event& event = events[i];
    numbers.push_back(static_cast<std::int64_t>(i));
    lines.push_back(event_line(event));
    parameters.push_back(event.p);
    half_widths.push_back(event.kind == EventKind::veering ? event.half_width : nan);
    eigenvalues.push_back(event.s);
    puiseux.push_back(event.puiseux == 0.0 ? Complex(nan, nan) : event.puiseux);
    nodes.push_back(event.node);
    directions.push_back(event.direction);
    values.push_back(event.value);
    append(shapes, event.shape, file.shape("coordinate")[0]);
    append(sensitivities, event.sensitivity, file.shape("scene_parameter")[0]);
    append(shifts, event.shift, file.shape("scene_parameter")[0]);
  }
  file.write_rows("event", first, numbers);
  file.write_rows("events", first, lines);
  file.write_rows("event_parameter", first, parameters);
  file.write_rows("event_eigenvalue", first, eigenvalues);
  file.write_rows("event_half_width", first, half_widths);
  file.write_rows("event_puiseux", first, puiseux);
  file.write_rows("event_node", first, nodes);
  file.write_rows("event_direction", first, directions);
  file.write_rows("event_value", first, values);
  file.write_rows("event_shape", first, shapes);
  file.write_rows("event_sensitivity", first, sensitivities);
  file.write_rows("event_shift", first, shifts);
}

void write_summary(Hdf5Writer& file, const TraceResult& result) {
  const auto count = [&file](const std::string& name, std::uint64_t value) {
    file.set_attribute("count_" + name, static_cast<std::int64_t>(value));
  };
  file.set_attribute("message", result.message);
  write_notes(file, result.notes);
  file.set_attribute("seconds", result.seconds);
  count("nodes", static_cast<std::uint64_t>(result.nodes));
  count("events", result.events.size());
  count("rejected_steps", static_cast<std::uint64_t>(result.rejections.total()));
  count("modes_available", static_cast<std::uint64_t>(result.n_available));
  count("mode_steps", static_cast<std::uint64_t>(result.mode_steps));
  count("certified_mode_steps", static_cast<std::uint64_t>(result.certified_steps));
  count("mode_factorizations", result.counts.modes.factorizations);
  count("mode_iterations", result.counts.modes.iterations);
  count("mode_solves", result.counts.modes.solves);
  count("modes_passed", result.counts.modes.passed);
  count("modal_bases", result.counts.modes.modal_bases);
  count("modal_solves", result.counts.modes.modal_solves);
  count("certificate_factorizations", result.counts.certificate_factorizations);
  count("certificate_bases", result.counts.certificate_bases);
  count("event_factorizations", result.counts.event_factorizations);
  count("spectra", result.counts.spectra);
  count("equilibrium_iterations", result.counts.equilibrium_iterations);
  count("equilibrium_factorizations", result.counts.equilibrium_factorizations);
}

}  // namespace eigentrail
