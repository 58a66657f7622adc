#include "projection_info.hpp"

#include <algorithm>
#include <cstdio>

#include "eigentrail/core/text.hpp"
#include "output.hpp"

namespace eigentrail::app {

void print_projection(const Projection& projection, const std::string& parameter) {
  std::vector<double> places = projection.sampled_at;
  std::sort(places.begin(), places.end());
  std::string list;
  for (const double p : places) list += (list.empty() ? "" : ", ") + rounded(p, 5);
  std::printf(
      "  projected from %lld freedoms: %d sparse factorizations by %s, %.3g MB, %ld solutions;\n"
      "        modes of the large model at %s = %s;\n"
      "        error of the projection %.1e (asked for %.1e) where it is worst, at %s = %s\n",
      static_cast<long long>(projection.basis.rows()), projection.factorizations, projection.method.c_str(),
      static_cast<double>(projection.peak_bytes) / 1e6, projection.solutions, parameter.c_str(), list.c_str(),
      projection.error, projection.target, parameter.c_str(), rounded(projection.error_at, 5).c_str());
  for (const std::string& note : projection.notes) std::printf("        %s\n", note.c_str());
}

void print_route(const ProjectionEstimate& estimate, const TraceOptions& options, std::FILE* to) {
  const auto megabytes = [](double bytes) { return rounded(bytes / 1e6, 3) + " MB"; };
  const std::string followed = in_words(options.modes);
  std::fprintf(to, "route\n");
  print_table(
      {{"  model", std::to_string(estimate.freedoms) + " freedoms, " + std::to_string(estimate.nonzeros) +
                       " nonzeros in M, C and K together"},
       {"  projection", "onto the vectors of " + followed + (estimate.two_sided ? ", right and left" : "") +
                            ", at both ends of the range of " + options.parameter +
                            " and where residuals are largest"},
       {"  factorization", estimate.method + " at each, " + megabytes(estimate.factor_bytes) + ", " +
                               rounded(estimate.factor_operations / 1e9, 3) + " Gflop"},
       {"  memory", megabytes(estimate.total_bytes) + " with the vectors"},
       {"  trace", "of the projected family, with some tens of coordinates, by the dense engine"},
       {"  error", "of the projection below " + rounded(estimate.target, 3) +
                       " of each eigenvalue; the tolerance " + exact_text(options.tolerance) +
                       " is that of the large model"}},
      to);
}

}  // namespace eigentrail::app
