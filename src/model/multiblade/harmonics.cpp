#include "model/multiblade/harmonics.hpp"

namespace eigentrail {

std::vector<Harmonic> multiblade_harmonics(int n_blades) {
  std::vector<Harmonic> all{{}};
  for (int n = 1; 2 * n < n_blades; ++n) {
    const int cosine = static_cast<int>(all.size());
    const double slope = n;
    all.push_back({n, cosine + 1, -slope, 0.5});
    all.push_back({n, cosine, slope, 0.5});
  }
  if (n_blades % 2 == 0) all.emplace_back();
  return all;
}

std::vector<std::string> multiblade_names(std::size_t n_blades) {
  std::vector<std::string> names{"collective"};
  for (std::size_t n = 1; 2 * n < n_blades; ++n) {
    const std::string number = n == 1 ? "" : " " + std::to_string(n);
    names.push_back("cosine" + number);
    names.push_back("sine" + number);
  }
  if (n_blades % 2 == 0) names.emplace_back("differential");
  return names;
}

}  // namespace eigentrail
