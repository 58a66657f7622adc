#include "export_tables.hpp"

#include <algorithm>
#include <cmath>

#include "output.hpp"

namespace eigentrail::app {
namespace {

/// The eigenvalues at a place of the path.
struct Place {
  double p = 0.0;
  std::size_t step = 0;
  double t = 0.0;
  ComplexVector s;
};

/// The step that says something on a mode at a place: the step behind it where the mode begins at its end.
std::size_t step_of(const LociFile& loci, const Place& place, int mode) {
  const bool next =
      place.t == 1.0 && place.step + 1 < loci.steps.size() && loci.block_of(place.step, mode) == nullptr;
  return place.step + (next ? 1 : 0);
}

/// 1 or 0; NaN where the mode exists on no step at the place.
Cell certified_at(const LociFile& loci, const Place& place, int mode) {
  if (loci.steps.empty()) return NAN;
  const DenseBlock* block = loci.block_of(step_of(loci, place, mode), mode);
  return block == nullptr ? NAN : count(block->certified ? 1 : 0);
}

/// The stored points; a point belongs to the step that ends there.
std::vector<Place> stored_places(const LociFile& loci) {
  std::vector<Place> places;
  for (std::size_t node = 0; node < loci.n_nodes(); ++node) {
    const auto row = static_cast<Eigen::Index>(node);
    places.push_back(
        {loci.p[node], node > 0 ? node - 1 : 0, node > 0 ? 1.0 : 0.0, loci.eigenvalues.row(row)});
  }
  return places;
}

std::vector<Place> equidistant_places(const LociFile& loci, int points) {
  std::vector<Place> places;
  const double low = loci.lowest(), high = loci.highest();
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1);
    const double p = i + 1 == points ? high : low + share * (high - low);
    for (const PathPosition& position : loci.positions(p))
      places.push_back({p, position.step, position.t, loci.eigenvalues_at(position)});
  }
  return places;
}

double or_nan(double value) {
  return std::isfinite(value) ? value : NAN;
}

}  // namespace

ExportTable loci_table(const LociFile& loci, std::optional<int> points) {
  ExportTable table{"loci",
                    {"place", loci.parameter, "mode", "name", "real", "imag", "natural_frequency",
                     "damped_frequency", "damping_ratio", "log_decrement", "certified"}};
  if (loci.data_errors) table.columns.insert(table.columns.end(), {"interpolation_error", "digits_error"});
  const std::vector<Place> places = points ? equidistant_places(loci, *points) : stored_places(loci);
  for (std::size_t number = 0; number < places.size(); ++number) {
    const Place& place = places[number];
    for (Eigen::Index i = 0; i < place.s.size(); ++i) {
      const Complex s = place.s[i];
      if (std::isnan(s.real())) continue;
      const auto mode = static_cast<int>(i);
      const double size = std::abs(s);
      table.rows.push_back({count(number), place.p, count(mode + 1),
                            loci.mode_names[static_cast<std::size_t>(i)], s.real(), s.imag(), size,
                            std::abs(s.imag()), or_nan(-s.real() / size + 0.0), log_decrement(s),
                            certified_at(loci, place, mode)});
      if (!loci.data_errors) continue;
      const auto step = static_cast<Eigen::Index>(step_of(loci, place, mode));
      table.rows.back().emplace_back(loci.data_errors->interpolation(step, i));
      table.rows.back().emplace_back(loci.data_errors->digits(step, i));
    }
  }
  return table;
}

ExportTable events_table(const LociFile& loci) {
  ExportTable table{"events",
                    {"kind", loci.parameter, "real", "imag", "modes", "direction", "value", "half_width",
                     "puiseux_real", "puiseux_imag"}};
  if (loci.data_errors) table.columns.insert(table.columns.end(), {"interval_from", "interval_to"});
  for (const std::string& name : loci.scene_parameters)
    table.columns.insert(table.columns.end(),
                         {"sensitivity_" + name + "_real", "sensitivity_" + name + "_imag", "shift_" + name});
  for (std::size_t i = 0; i < loci.events.size(); ++i) {
    const LociEvent& event = loci.events[i];
    std::vector<Cell> row{event.kind,           event.parameter,        event.s.real(), event.s.imag(),
                          event.modes,          count(event.direction), event.value,    event.half_width,
                          event.puiseux.real(), event.puiseux.imag()};
    if (loci.data_errors) {
      row.emplace_back(loci.data_errors->intervals[i].from);
      row.emplace_back(loci.data_errors->intervals[i].to);
    }
    for (Eigen::Index q = 0; q < event.shift.size(); ++q) {
      row.emplace_back(event.sensitivity[q].real());
      row.emplace_back(event.sensitivity[q].imag());
      row.emplace_back(event.shift[q]);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ExportTable ranges_table(const LociFile& loci) {
  ExportTable table{"stable_ranges",
                    {"kind", "from", "to", "cause_from", "cause_to", "margin_from", "margin_to", "mode_from",
                     "mode_to", "least_margin", "largest_margin", "largest_at", "whole_model"}};
  if (!loci.ranges) return table;
  const auto mode = [](int number) { return number < 0 ? Cell(NAN) : count(number + 1); };
  for (const StableRange& range : *loci.ranges) {
    table.rows.push_back({std::string(stability_name(range.kind)), range.from.p, range.to.p, range.from.cause,
                          range.to.cause, range.from.margin, range.to.margin, mode(range.from.mode),
                          mode(range.to.mode), range.least_margin, range.largest_margin, range.largest_at,
                          count(range.whole ? 1 : 0)});
  }
  return table;
}

ExportTable shapes_table(const LociFile& loci) {
  ExportTable table{"mode_shapes", {"place", loci.parameter, "mode", "name", "coordinate", "real", "imag"}};
  const std::size_t n = loci.coordinates.size();
  read_mode_shapes(loci, [&](std::size_t node, std::span<const Complex> shapes) {
    for (std::size_t mode = 0; mode < loci.modes.size(); ++mode) {
      for (std::size_t i = 0; i < n; ++i) {
        const Complex z = shapes[mode * n + i];
        if (std::isnan(z.real())) continue;
        table.rows.push_back({count(node), loci.p[node], count(mode + 1), loci.mode_names[mode],
                              loci.coordinates[i], z.real(), z.imag()});
      }
    }
  });
  return table;
}

}  // namespace eigentrail::app
