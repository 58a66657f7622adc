#include "trace_summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/model/projection.hpp"
#include "eigentrail/modes/whirl.hpp"
#include "output.hpp"
#include "scene/frequency_unit.hpp"

namespace eigentrail::app {
namespace {

/// Prints the largest errors that the data of the model cause, relative to max(|s|, reference).
void print_data_errors(const DataErrors& errors, const RecordedPath& path, double reference) {
  const auto largest = [&](const Matrix& bounds, Eigen::Index& at) {
    double most = 0.0;
    for (Eigen::Index step = 0; step < bounds.rows(); ++step) {
      for (Eigen::Index mode = 0; mode < bounds.cols(); ++mode) {
        const double size = std::max(std::abs(path.eigenvalues(step, mode)), reference);
        const double relative = bounds(step, mode) / size;
        if (!(relative > most)) continue;
        most = relative;
        at = mode;
      }
    }
    return most;
  };
  const auto text = [&](const char* what, const Matrix& bounds) {
    Eigen::Index mode = 0;
    const double most = largest(bounds, mode);
    return std::string(what) + " up to " + rounded(most, 2) + " (mode " + std::to_string(mode + 1) + ")";
  };
  std::printf("  data  relative error of eigenvalues %s",
              text("between samples", errors.interpolation).c_str());
  if (errors.digits.array().isNaN().all() || !((errors.digits.array() > 0.0).any())) {
    std::printf("\n");
  } else {
    std::printf(", %s\n", text("from their digits", errors.digits).c_str());
  }
}

/// Prints how a large model was projected, and its error.
void print_projection(const Projection& projection, const std::string& parameter) {
  std::vector<double> places = projection.sampled_at;
  std::sort(places.begin(), places.end());
  const std::string list = joined(places, ", ", [](double p) { return rounded(p, 5); });
  std::printf(
      "  projected from %lld freedoms: %d sparse factorizations by %s, %.3g MB, %ld solutions;\n"
      "        modes of the large model at %s = %s;\n"
      "        error of the projection %.1e (asked for %.1e) where it is worst, at %s = %s\n",
      static_cast<long long>(projection.freedoms), projection.factorizations, projection.method.c_str(),
      static_cast<double>(projection.peak_bytes) / 1e6, projection.solutions, parameter.c_str(), list.c_str(),
      projection.error, projection.target, parameter.c_str(), rounded(projection.error_at, 5).c_str());
  for (const std::string& note : projection.notes) std::printf("        %s\n", note.c_str());
}

void print_heading(const TraceSummary& trace) {
  const TraceOptions& options = trace.setup.options;
  const TraceResult& result = trace.result;
  const std::string& unit = trace.setup.model->description().parameters.at(options.parameter).unit;
  print_title(trace.setup.scene.title);
  std::printf("  %s  %s -> %s%s, tolerance %s, %s, %d of %d modes, %lld freedoms\n",
              options.parameter.c_str(), exact_text(options.from).c_str(), exact_text(result.reached).c_str(),
              (unit.empty() ? unit : ' ' + unit).c_str(), exact_text(options.tolerance).c_str(),
              order_text(result.order, !options.order).c_str(), result.n_modes, result.n_available,
              static_cast<long long>(result.n_independent));
  if (const Projection* projection = trace.setup.model->projection())
    print_projection(*projection, options.parameter);
  if (result.n_infinite > 0) {
    std::printf("  %d infinite eigenvalues at the start are not followed (singular mass)\n",
                result.n_infinite);
  }
}

/// Frequency and damping of an eigenvalue. Zero has no damping. A real one has no frequency: its rate stands
/// for the damping.
std::vector<std::string> motion_cells(Complex s, const FrequencyUnit& unit, double reference) {
  if (std::isnan(s.real())) return {"-", "-"};
  if (!std::isfinite(s.real())) return {"infinite", "-"};
  s = without_rounding(s, reference);
  if (s == 0.0) return {"0", "-"};
  if (s.imag() == 0.0) return {"-", rounded(s.real(), 6) + " 1/s"};
  return {rounded(std::abs(s.imag()) / unit.factor, 6), percent(-s.real() / std::abs(s), 4)};
}

void print_modes(const TraceSummary& trace, const std::vector<Permanence>& permanence,
                 const FrequencyUnit& unit) {
  const RecordedPath& path = trace.path;
  const std::array ends{path.shown_at(path.at_node(0)), path.shown_at(path.at_node(path.n_nodes() - 1))};
  std::vector<std::vector<std::string>> rows{
      {"mode", unit.name + " at " + exact_text(trace.setup.options.from), "damping",
       unit.name + " at " + exact_text(trace.result.reached), "damping", "what moves"}};
  // A mode that was found on the step at which the trace was stopped has no column yet.
  const int columns = std::min(trace.result.n_columns, static_cast<int>(path.eigenvalues.cols()));
  for (int mode = 0; mode < columns; ++mode) {
    // A pair that only rounding took for two real modes at the start has a second number, and no eigenvalue.
    if (path.eigenvalues.col(mode).array().isNaN().all()) continue;
    std::vector<std::string> row{std::to_string(mode + 1)};
    for (const ComplexVector& end : ends) {
      const bool is_zero = permanence[static_cast<std::size_t>(mode)] == Permanence::zero;
      const Complex s = is_zero ? Complex(0.0) : end[mode];
      const auto cells = motion_cells(s, unit, trace.result.s_ref);
      row.insert(row.end(), cells.begin(), cells.end());
    }
    row.push_back(cell_text(trace.mode_names[static_cast<std::size_t>(mode)]));
    rows.push_back(std::move(row));
  }
  print_table(rows);
}

/// A special point, and the interval in which it lies if the data have errors.
struct Found {
  Event event;
  Onset onset;
  std::string interval;
};

/// The special points, sorted by the parameter.
std::vector<Found> sorted_events(const TraceSummary& trace) {
  std::vector<Found> found;
  for (std::size_t i = 0; i < trace.result.events.size(); ++i) {
    found.push_back({trace.result.events[i], onset_at(trace.result.events[i], trace.ranges), ""});
    Event& event = found.back().event;
    event.s = without_rounding(event.s, trace.result.s_ref);
    event.p = without_rounding(event.p, trace.setup.options.from, trace.setup.options.to);
    if (trace.errors != nullptr && std::isfinite(trace.errors->intervals[i].from))
      found.back().interval =
          interval_text(trace.errors->intervals[i], trace.setup.options.from, trace.result.reached);
  }
  std::ranges::stable_sort(found, [](const Found& a, const Found& b) { return a.event.p < b.event.p; });
  return found;
}

/// "forward", "backward", "mixed" or "" for the mode of an event.
std::string whirl_at(const TraceSetup& setup, const Event& event) {
  return whirl_in_words(whirl_of(*setup.model, setup.parameters_at(event.p), event.shape));
}

/// "1x, forward" for a resonance with the first harmonic; its mode, frequency and damping.
std::vector<std::string> critical_speed_row(const TraceSummary& trace, const Found& found,
                                            const FrequencyUnit& unit) {
  const Event& event = found.event;
  const std::string whirl = whirl_at(trace.setup, event);
  const auto cells = motion_cells(event.s, unit, 0.0);
  return {"    " + rounded(event.value) + "x" + (whirl.empty() ? "" : ", " + whirl),
          trace.setup.options.parameter + " = " + rounded(event.p, 12),
          modes_text(event),
          cells[0] + " " + unit.name,
          "damping " + cells[1],
          found.interval};
}

/// "7 % from the operating range, 15 % wanted"; empty if a critical speed keeps its distance.
std::string separation_text(const Separation& found) {
  if (!found.is_too_close()) return "";
  const std::string range = rounded(found.range.from, 12) + " to " + rounded(found.range.to, 12);
  if (found.inside) return "in the operating range " + range;
  return percent(found.distance, 3) + " from the operating range " + range + ", " + percent(found.wanted, 3) +
         " wanted";
}

/// Prints the critical speeds that are too close to an operating range.
void print_separations(const TraceSummary& trace) {
  const TraceOptions& options = trace.setup.options;
  const OperatingRanges& operating = options.events.operating;
  if (operating.ranges.empty()) return;
  bool is_close = false;
  for (const Found& found : sorted_events(trace)) {
    if (found.event.kind != EventKind::resonance) continue;
    const std::string text = separation_text(*separation(operating, found.event.p, found.event.s));
    if (text.empty()) continue;
    is_close = true;
    std::printf("  margin  critical speed %sx at %s = %s: %s\n", rounded(found.event.value).c_str(),
                options.parameter.c_str(), rounded(found.event.p).c_str(), text.c_str());
  }
  const OperatingRange asked = speeds_in_question(operating);
  const auto [low, high] = std::minmax(options.from, trace.result.reached);
  const bool covers = (low <= asked.from && asked.to <= high) || (low <= -asked.to && -asked.from <= high);
  if (!covers)
    std::printf(
        "  margin  not known as a whole: critical speeds from %s to %s matter to the operating range %s\n",
        rounded(asked.from).c_str(), rounded(asked.to).c_str(), ranges_text(operating).c_str());
  if (is_close || !covers) return;
  std::printf("  margin  all critical speeds keep their distance from the operating range %s (%s)\n",
              ranges_text(operating).c_str(),
              operating.margin ? percent(*operating.margin, 3).c_str() : "API 684");
}

/// The places where growth begins or ends at infinity, in the order of the ranges.
std::vector<std::vector<std::string>> onsets_at_infinity(const TraceSummary& trace) {
  std::vector<std::vector<std::string>> rows;
  for (const StableRange& range : trace.ranges) {
    for (const bool begins : {true, false}) {
      const RangeEnd& end = begins ? range.from : range.to;
      if (end.cause != "infinity") continue;
      const bool above = (range.to.p > range.from.p) != begins;
      rows.push_back({"  infinity", "near " + trace.setup.options.parameter + " = " + rounded(end.p, 6), "",
                      "mode " + std::to_string(end.mode + 1), above ? "unstable above" : "unstable below"});
    }
  }
  return rows;
}

/// Prints onsets of instability first, then critical speeds, then all others.
void print_special_points(const TraceSummary& trace, const FrequencyUnit& unit) {
  const std::string& parameter = trace.setup.options.parameter;
  std::vector<std::vector<std::string>> onsets = onsets_at_infinity(trace), critical, others;
  for (const Found& found : sorted_events(trace)) {
    if (found.event.kind == EventKind::resonance) {
      critical.push_back(critical_speed_row(trace, found, unit));
      continue;
    }
    std::vector<std::string> row = event_row(found.event, parameter);
    std::string& remark = row.back();
    remark += (remark.empty() || found.interval.empty() ? "" : ", ") + found.interval;
    (found.onset != Onset::none ? onsets : others).push_back(std::move(row));
  }
  print_section(stdout, "  onset of instability", onsets);
  print_section(stdout, "  critical speeds", critical);
  print_separations(trace);
  print_section(stdout, "  other special points", others);
  for (const std::string& note : trace.result.notes) std::printf("  note  %s\n", note.c_str());
}

/// How much of the loci is certified.
std::string identity_text(const TraceSummary& trace) {
  const TraceResult& result = trace.result;
  if (!trace.setup.options.certify) return "identity of modes not certified (--no-certify)";
  if (result.certified_steps == result.mode_steps) return "identity of modes certified on every step";
  return "identity of modes NOT certified on " + std::to_string(result.mode_steps - result.certified_steps) +
         " of " + std::to_string(result.mode_steps) + " mode steps; info and the file say where";
}

/// Prints what was computed, how often, and how long it took.
void print_work(const TraceResult& result) {
  const RunCounts& counts = result.counts;
  const double per_mode_and_step =
      static_cast<double>(counts.modes.factorizations) / static_cast<double>(std::max(result.mode_steps, 1L));
  const Rejections& r = result.rejections;
  std::printf("  work  %d points, %d steps tried again", result.nodes, r.total());
  if (r.total() > 0) {
    std::printf(" (%d inaccurate, %d uncertified, %d no equilibrium, %d mode lost, %d mismatch, %d merged)",
                r.inaccurate, r.uncertified, r.no_equilibrium, r.mode_lost, r.mismatch, r.merged);
  }
  const Regroupings& g = result.regroupings;
  if (g.joined + g.charts + g.planes + g.repaired > 0) {
    std::printf(
        "\n        %d blocks of close modes formed, %d taken apart; %d changes between s and 1/s; %d changes "
        "of the path's coordinate; %d missing modes added",
        g.joined, g.parted, g.charts, g.planes, g.repaired);
  }
  std::printf(
      "\n        %s LU per mode and step, %llu for the certificate, %llu for special points, %llu KINSOL "
      "iterations, %llu KKT factorizations\n",
      rounded(per_mode_and_step, 3).c_str(),
      static_cast<unsigned long long>(counts.certificate_factorizations),
      static_cast<unsigned long long>(counts.event_factorizations),
      static_cast<unsigned long long>(counts.equilibrium_iterations),
      static_cast<unsigned long long>(counts.equilibrium_factorizations));
  if (counts.modes.modal_bases + counts.certificate_bases > 0) {
    std::printf(
        "        all modes at once: %llu bases, %llu solutions with them, %llu bases of the certificate\n",
        static_cast<unsigned long long>(counts.modes.modal_bases),
        static_cast<unsigned long long>(counts.modes.modal_solves),
        static_cast<unsigned long long>(counts.certificate_bases));
  }
  std::string shares;
  for (const auto& [what, seconds] : {std::pair("equilibrium", counts.equilibrium_seconds),
                                      {"reduction", counts.reduction_seconds},
                                      {"modes", counts.modes_seconds},
                                      {"differentiation", counts.differentiation_seconds},
                                      {"certificate", counts.certificate_seconds},
                                      {"matching", counts.matching_seconds},
                                      {"events", counts.events_seconds},
                                      {"output", counts.output_seconds}})
    shares += (shares.empty() ? "" : ", ") + std::string(what) + " " +
              percent(result.seconds > 0.0 ? seconds / result.seconds : 0.0, 2);
  std::printf("  time  %s s: %s\n", rounded(result.seconds, 3).c_str(), shares.c_str());
}

void print_effects(const Model& model, const EvaluationCounts& counts) {
  std::string line;
  for (std::size_t i = 0; i < model.description().effects.size(); ++i) {
    const std::uint64_t evaluations = counts.residual[i] + counts.linearization[i];
    if (evaluations == 0) continue;
    line +=
        (line.empty() ? "" : ", ") + model.description().effects[i].name + " " + std::to_string(evaluations);
  }
  std::printf("  evaluations  %s\n", line.c_str());
}

std::string end_text(const RangeEnd& end, Stability kind) {
  std::string text = end.cause;
  if (end.mode >= 0) text += ", mode " + std::to_string(end.mode + 1);
  const bool at_margin = kind == Stability::stable && end.margin != 0.0;
  return at_margin ? text + ", margin " + rounded(end.margin, 4) : text;
}

}  // namespace

std::vector<Permanence> permanence_of_modes(const LociFile& loci) {
  // Files of early versions lack the reference.
  if (!loci.attributes.contains("reference"))
    return std::vector<Permanence>(loci.modes.size(), Permanence::none);
  return eigentrail::permanence_of_modes(loci, {loci.number("tolerance"), loci.number("reference")});
}

void print_permanent(const std::vector<Permanence>& all, const std::vector<std::string>& names) {
  const auto list = [&](Permanence wanted) {
    std::string text;
    for (std::size_t mode = 0; mode < all.size(); ++mode) {
      if (all[mode] != wanted) continue;
      text += (text.empty() ? "" : ", ") + std::to_string(mode + 1);
      if (mode < names.size() && !names[mode].empty()) text += " (" + printable(names[mode]) + ")";
    }
    return text;
  };
  const std::string zeros = list(Permanence::zero);
  if (!zeros.empty()) {
    std::printf(
        "  zero throughout  modes %s: rigid-body motions, integrators or placeholders; stable ranges leave "
        "them out\n",
        zeros.c_str());
  }
  const std::string constants = list(Permanence::constant);
  if (!constants.empty()) std::printf("  constant  modes %s\n", constants.c_str());
}

void print_ranges(const std::vector<StableRange>& ranges, const std::string& parameter) {
  std::printf("  stable ranges%s\n", ranges.empty() ? "  none" : "");
  std::vector<std::vector<std::string>> rows;
  double low = 0.0, high = 0.0;
  for (const StableRange& range : ranges) {
    low = std::min({low, range.from.p, range.to.p});
    high = std::max({high, range.from.p, range.to.p});
  }
  for (const StableRange& range : ranges) {
    std::string margins;
    if (range.kind == Stability::stable) {
      margins = "margin " + rounded(range.least_margin, 4) + " to " + rounded(range.largest_margin, 4) +
                " 1/s, largest at " + rounded(range.largest_at, 6);
    }
    rows.push_back({"  " + stability_name(range.kind) + (range.whole ? "" : " among the followed modes"),
                    parameter + " = " + rounded(without_rounding(range.from.p, low, high), 12) + " -> " +
                        rounded(without_rounding(range.to.p, low, high), 12),
                    "from " + end_text(range.from, range.kind), "to " + end_text(range.to, range.kind),
                    margins});
  }
  print_table(rows);
}

void print_summary(const TraceSummary& trace, bool verbose) {
  const TraceOptions& options = trace.setup.options;
  const FrequencyUnit unit =
      frequency_unit(trace.setup.model->description().parameters.at(options.parameter).unit);
  print_heading(trace);
  const std::vector<Permanence> permanence =
      permanence_of_modes(trace.path, {options.tolerance, trace.result.s_ref});
  print_modes(trace, permanence, unit);
  if (trace.errors != nullptr) print_data_errors(*trace.errors, trace.path, trace.result.s_ref);
  print_special_points(trace, unit);
  print_permanent(permanence, trace.mode_names);
  print_ranges(trace.ranges, options.parameter);
  std::printf("  work  %d points, %s s; %s\n", trace.result.nodes, rounded(trace.result.seconds, 3).c_str(),
              identity_text(trace).c_str());
  if (!verbose) return;
  print_work(trace.result);
  print_effects(*trace.setup.model, trace.result.counts.evaluations);
}

}  // namespace eigentrail::app
