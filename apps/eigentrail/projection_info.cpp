#include "projection_info.hpp"

#include <algorithm>
#include <cstdio>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "output.hpp"

namespace eigentrail::app {

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

std::string reason_of(const Route& route) {
  if (!route.work)
    return "the dense engine holds " + std::to_string(limits::matrix_rows) + " coordinates at most";
  const auto billions = [](double operations) { return rounded(1e-9 * operations, 2) + " billion"; };
  return billions(route.work->projected) + " operations, " + billions(route.work->dense) +
         " with all freedoms; taken from a ratio of " + rounded(worth_projecting, 3) + " on";
}

void print_route(const Route& route, const ProjectionEstimate& estimate, const TraceOptions& options,
                 std::FILE* to) {
  const auto megabytes = [](double bytes) { return rounded(bytes / 1e6, 3) + " MB"; };
  const std::string followed = in_words(options.modes);
  const bool scene = estimate.coordinates > 0;
  std::string model = std::to_string(estimate.freedoms) + " freedoms";
  if (scene) {
    model += ": " + std::to_string(estimate.coordinates) + " coordinates, " +
             std::to_string(estimate.coordinates - estimate.freedoms) + " constraints";
  }
  model += ", " + std::to_string(estimate.nonzeros) +
           (scene ? " nonzeros in M, C, K and A together" : " nonzeros in M, C and K together");
  std::vector<std::vector<std::string>> rows{
      {"  model", model},
      {"  chosen", "the projection: " + reason_of(route)},
      {"  projection", "onto the vectors of " + followed + (estimate.two_sided ? ", right and left" : "") +
                           ", at both ends of the range of " + options.parameter +
                           " and where residuals are largest"},
      {"  factorization", estimate.method + " at each, " + megabytes(estimate.factor_bytes) + ", " +
                              rounded(estimate.factor_operations / 1e9, 3) + " Gflop"},
      {"  memory", megabytes(estimate.total_bytes) + " with the vectors"}};
  if (scene)
    rows.push_back({"  equilibrium",
                    estimate.moves ? "of all coordinates, followed: such a factorization for each correction"
                                   : "of all coordinates, solved once"});
  rows.push_back(
      {"  trace", scene ? "of the scene on the motions of the projection, some tens, by the dense engine"
                        : "of the projected family, with some tens of coordinates, by the dense engine"});
  rows.push_back({"  error", "of the projection below " + rounded(estimate.target, 3) +
                                 " of each eigenvalue; the tolerance " + exact_text(options.tolerance) +
                                 " is that of the large model"});
  print_section(to, "route", rows);
}

}  // namespace eigentrail::app
