#include "model/multiblade/harmonics.hpp"

namespace eigentrail {

std::vector<Harmonic> multiblade_harmonics(int n_blades) {
  std::vector<Harmonic> all{{"collective"}};
  for (int n = 1; 2 * n < n_blades; ++n) {
    const int cosine = static_cast<int>(all.size());
    const double slope = n;
    const std::string number = n == 1 ? "" : " " + std::to_string(n);
    all.push_back({"cosine" + number, n, cosine + 1, -slope, 0.5});
    all.push_back({"sine" + number, n, cosine, slope, 0.5});
  }
  if (n_blades % 2 == 0) all.push_back({"differential"});
  return all;
}

std::vector<std::string> multiblade_names(int n_blades) {
  std::vector<std::string> names;
  for (Harmonic& harmonic : multiblade_harmonics(n_blades)) names.push_back(std::move(harmonic.name));
  return names;
}

}  // namespace eigentrail
