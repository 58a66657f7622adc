#include "projection_info.hpp"

#include <algorithm>
#include <cstdio>

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

}  // namespace eigentrail::app
