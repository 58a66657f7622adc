#include "store/loci_summary.hpp"

#include <limits>

#include "store/labelled_datasets.hpp"
#include "store/loci_schema.hpp"
#include "store/provenance.hpp"

namespace eigentrail {

void clear_events(Hdf5Writer& file) {
  for (const std::string& name : datasets_of_events()) file.extend(name, 0, 0);
}

void write_events(Hdf5Writer& file, const std::vector<Event>& events, std::size_t first) {
  if (first >= events.size()) return;
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto write = [&](const char* name, auto field) {
    file.write_rows(name, first, column_of(std::span(events).subspan(first), field));
  };
  // A row is as long as the dimension; where an event has no such vector, it is not known.
  const auto row = [&file](const char* dimension, auto member) {
    return [size = static_cast<Eigen::Index>(file.shape(dimension)[0]), member](const Event& event) {
      auto values = event.*member;
      const Eigen::Index known = values.size();
      values.conservativeResize(size);
      if (known < size) values.tail(size - known).setConstant(nan);
      return values;
    };
  };
  write("event", [number = first](const Event&) mutable { return number++; });
  write("events", event_line);
  write("event_parameter", &Event::p);
  write("event_eigenvalue", &Event::s);
  write("event_half_width",
        [](const Event& event) { return event.kind == EventKind::veering ? event.half_width : nan; });
  write("event_puiseux",
        [](const Event& event) { return event.puiseux == 0.0 ? Complex(nan, nan) : event.puiseux; });
  write("event_node", &Event::node);
  write("event_direction", &Event::direction);
  write("event_value", &Event::value);
  write("event_shape", row("coordinate", &Event::shape));
  write("event_sensitivity", row("scene_parameter", &Event::sensitivity));
  write("event_shift", row("scene_parameter", &Event::shift));
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
