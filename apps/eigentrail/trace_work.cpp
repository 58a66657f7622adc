// The figures of the work of a trace, for --verbose.
#include <algorithm>
#include <cstdio>

#include "output.hpp"
#include "trace_summary.hpp"

namespace eigentrail::app {
namespace {

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
        "of "
        "the path's coordinate; %d missing modes added",
        g.joined, g.parted, g.charts, g.planes, g.repaired);
  }
  std::printf(
      "\n        %s LU per mode and step, %llu for the certificate, %llu for special points, %llu KINSOL "
      "iterations, %llu KKT "
      "factorizations\n",
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

}  // namespace

void print_figures_of_work(const TraceSummary& trace) {
  print_work(trace.result);
  print_effects(*trace.setup.model, trace.result.counts.evaluations);
}

}  // namespace eigentrail::app
