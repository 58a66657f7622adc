#include "store/mode_motions.hpp"

#include <algorithm>
#include <limits>

#include "store/labelled_datasets.hpp"

namespace eigentrail {

void ModeMotions::append(const TracePoint& point) {
  if (description_.masses.empty() || point.modes.empty()) return;
  const SystemMatrix& M = point.node.linearization.M[0];
  const Vector x = point.node.path.x.col(0);
  if (!shares_) shares_.emplace(description_, M, x);
  ComplexMatrix shapes(x.size(), static_cast<Eigen::Index>(point.modes.size()));
  for (std::size_t i = 0; i < point.modes.size(); ++i)
    shapes.col(static_cast<Eigen::Index>(i)) = point.modes[i].shape;
  const Matrix shares = shares_->of(M, x, shapes);
  for (std::size_t i = 0; i < point.modes.size(); ++i) {
    const Vector share = shares.col(static_cast<Eigen::Index>(i));
    const auto [mode, is_new] = modes_.try_emplace(static_cast<std::size_t>(point.modes[i].mode));
    if (is_new) mode->second = {share, share, std::abs(point.modes[i].s)};
    mode->second.last = share;
  }
}

std::vector<std::string> ModeMotions::names(std::size_t n_modes) const {
  std::vector<std::string> result(n_modes);
  if (!shares_) return result;
  std::vector<std::size_t> ascending;
  for (const auto& [mode, ends] : modes_) ascending.push_back(mode);
  std::stable_sort(ascending.begin(), ascending.end(), [&](std::size_t a, std::size_t b) {
    return modes_.at(a).frequency < modes_.at(b).frequency;
  });
  Matrix shares(static_cast<Eigen::Index>(shares_->motions().size()),
                static_cast<Eigen::Index>(ascending.size()));
  for (std::size_t i = 0; i < ascending.size(); ++i)
    shares.col(static_cast<Eigen::Index>(i)) = modes_.at(ascending[i]).first;
  const std::vector<std::string> names = shares_->names(shares);
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    if (ascending[i] < n_modes) result[ascending[i]] = names[i];
  }
  return result;
}

void ModeMotions::write(Hdf5File& file, std::size_t n_modes) const {
  if (!shares_) return;
  std::vector<std::string> motions;
  for (const MassMotion& motion : shares_->motions()) motions.push_back(motion.mass + " " + motion.kind);
  write_dimension(file, {"motion", "1", "motion of a mass"}, motions);
  std::vector<double> values;
  for (const bool first : {true, false}) {
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const auto found = modes_.find(mode);
      for (std::size_t i = 0; i < motions.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        values.push_back(found == modes_.end() ? std::numeric_limits<double>::quiet_NaN()
                         : first               ? found->second.first[at]
                                               : found->second.last[at]);
      }
    }
  }
  write_dataset(file,
                {"kinetic_energy_share", "1",
                 "share of the mode's kinetic energy, where the mode first (left) and last (right) exists"},
                {"end", "mode", "motion"}, values);
  write_dataset(file, {"mode_name", "1", "what moves in the mode where it first exists"}, {"mode"},
                names(n_modes));
}

}  // namespace eigentrail
