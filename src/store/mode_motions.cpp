#include "store/mode_motions.hpp"

#include <algorithm>
#include <limits>

namespace eigentrail {

ModeMotions::ModeMotions(const ModelDescription& description, const TracePoint& first)
    : shares_(description, first.node.linearization.M[0], first.node.path.x.col(0)) {}

std::vector<std::string> ModeMotions::labels() const {
  std::vector<std::string> labels;
  for (const MassMotion& motion : shares_.motions()) labels.push_back(motion.mass + " " + motion.kind);
  return labels;
}

bool ModeMotions::fits(const ModelDescription& description) const {
  const auto size = static_cast<Eigen::Index>(shares_.motions().size());
  for (const auto& [mode, ends] : modes_) {
    if (ends.first.size() != size || ends.last.size() != size) return false;
  }
  return shares_.fits(description);
}

void ModeMotions::append(const TracePoint& point) {
  if (shares_.motions().empty() || point.modes.empty()) return;
  const SystemMatrix& M = point.node.linearization.M[0];
  const Vector x = point.node.path.x.col(0);
  ComplexMatrix shapes(x.size(), static_cast<Eigen::Index>(point.modes.size()));
  for (std::size_t i = 0; i < point.modes.size(); ++i)
    shapes.col(static_cast<Eigen::Index>(i)) = point.modes[i].shape;
  const Matrix shares = shares_.of(M, x, shapes);
  for (std::size_t i = 0; i < point.modes.size(); ++i) {
    const Vector share = shares.col(static_cast<Eigen::Index>(i));
    const auto [mode, is_new] = modes_.try_emplace(static_cast<std::size_t>(point.modes[i].mode));
    if (is_new) mode->second = {share, share, std::abs(point.modes[i].s)};
    mode->second.last = share;
  }
}

std::vector<std::string> ModeMotions::names(std::size_t n_modes) const {
  std::vector<std::string> result(n_modes);
  if (shares_.motions().empty()) return result;
  std::vector<std::size_t> ascending;
  for (const auto& [mode, ends] : modes_) ascending.push_back(mode);
  std::stable_sort(ascending.begin(), ascending.end(), [&](std::size_t a, std::size_t b) {
    return modes_.at(a).frequency < modes_.at(b).frequency;
  });
  Matrix shares(static_cast<Eigen::Index>(shares_.motions().size()),
                static_cast<Eigen::Index>(ascending.size()));
  for (std::size_t i = 0; i < ascending.size(); ++i)
    shares.col(static_cast<Eigen::Index>(i)) = modes_.at(ascending[i]).first;
  const std::vector<std::string> names = shares_.names(shares);
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    if (ascending[i] < n_modes) result[ascending[i]] = names[i];
  }
  return result;
}

void ModeMotions::write(Hdf5File& file, std::size_t n_modes) {
  const std::size_t motions = shares_.motions().size();
  if (motions == 0) return;
  std::vector<double> values;
  for (const bool first : {true, false}) {
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const auto found = modes_.find(mode);
      for (std::size_t i = 0; i < motions; ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        values.push_back(found == modes_.end() ? std::numeric_limits<double>::quiet_NaN()
                         : first               ? found->second.first[at]
                                               : found->second.last[at]);
      }
    }
  }
  file.write_rows("kinetic_energy_share", 0, values);
  std::vector<std::string> now = names(n_modes);
  if (now != written_names_) file.write_rows("mode_name", 0, now);
  written_names_ = std::move(now);
}

}  // namespace eigentrail
