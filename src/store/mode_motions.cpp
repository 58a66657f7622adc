#include "store/mode_motions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "eigentrail/model/projection.hpp"
#include "eigentrail/modes/participation.hpp"

namespace eigentrail {

namespace {

/// Each name costs an LU; larger families go without.
constexpr std::size_t most_coordinates = 400;
/// Magnitude below which an eigenvalue counts as zero, as a share of the largest one.
constexpr double zero_share = 1e-9;

}  // namespace

const Projection* named_by_freedoms(const Model& model) {
  const Projection* projection = model.projection();
  const bool lifts = projection != nullptr && projection->is_of_family();
  return lifts && model.description().shafts.empty() && has_own_names(projection->names) ? projection
                                                                                         : nullptr;
}

bool named_by_coordinates(const ModelDescription& description) {
  return description.masses.empty() && description.constraint_names.empty() && description.shafts.empty() &&
         description.coordinate_names.size() <= most_coordinates &&
         has_own_names(description.coordinate_names);
}

ModeMotions::ModeMotions(const Model& model, const TracePoint& first)
    : shares_(model.description(), first.node.linearization.M[0], first.node.path.x.col(0)), model_(&model) {
  const ModelDescription& description = model.description();
  if (named_by_coordinates(description)) coordinates_ = description.coordinate_names;
}

std::vector<std::string> ModeMotions::labels() const {
  std::vector<std::string> labels;
  for (const MassMotion& motion : shares_.motions())
    labels.push_back(motion.mass + " " + motion.kind + (motion.wave.empty() ? "" : " " + motion.wave));
  return labels;
}

bool ModeMotions::fits(const ModelDescription& description) const {
  const auto size = static_cast<Eigen::Index>(shares_.motions().size());
  for (const auto& [mode, ends] : modes_) {
    if (ends.first.size() != size || ends.last.size() != size) return false;
  }
  const bool by_coordinates = named_by_coordinates(description);
  return coordinates_ == (by_coordinates ? description.coordinate_names : std::vector<std::string>()) &&
         shares_.fits(description);
}

void ModeMotions::name_by_coordinates(const TracePoint& point) {
  double largest = 0.0;
  for (const ModeState& mode : point.modes) {
    if (std::isfinite(std::abs(mode.s))) largest = std::max(largest, std::abs(mode.s));
  }
  const Linearization& at = point.node.linearization;
  std::optional<std::array<Matrix, 3>> dense;
  for (const ModeState& mode : point.modes) {
    const auto number = static_cast<std::size_t>(mode.mode);
    const bool usable = std::isfinite(std::abs(mode.s)) && mode.shape.allFinite();
    if (by_participation_.contains(number) || !usable) continue;
    if (!dense) dense = {at.M[0].dense(), at.C[0].dense(), at.K[0].dense()};
    const auto& [M, C, K] = *dense;
    by_participation_[number] =
        name_by_participation(M, C, K, mode.s, mode.shape, zero_share * largest, coordinates_);
  }
}

void ModeMotions::describe_rotor_modes(const TracePoint& point) {
  const Vector parameters = point.node.path.parameters.col(0);
  for (const ModeState& mode : point.modes) {
    const auto number = static_cast<std::size_t>(mode.mode);
    const auto known = rotor_modes_.find(number);
    if (known != rotor_modes_.end() && known->second.sense != 0) continue;
    if (!std::isfinite(std::abs(mode.s)) || !mode.shape.allFinite()) continue;
    const RotorMode now = rotor_mode(*model_, parameters, mode.s, mode.shape, mode.rounding);
    if (known == rotor_modes_.end()) {
      rotor_modes_[number] = now;
    } else if (now.oscillates && known->second.oscillates) {
      known->second.sense = now.sense;
    }
  }
}

/// Shapes of a projected family are those of its coordinates; names are those of the large model's.
void ModeMotions::name_by_freedoms(const Projection& projection, const TracePoint& point) {
  for (const ModeState& mode : point.modes) {
    const auto number = static_cast<std::size_t>(mode.mode);
    if (by_participation_.contains(number) || !mode.shape.allFinite() || mode.shape.size() == 0) continue;
    by_participation_[number] = largest_names(projection.basis * mode.shape, projection.names);
  }
}

void ModeMotions::append(const TracePoint& point) {
  if (!model_->description().shafts.empty()) describe_rotor_modes(point);
  if (!coordinates_.empty()) name_by_coordinates(point);
  if (const Projection* projection = named_by_freedoms(*model_)) name_by_freedoms(*projection, point);
  if (shares_.motions().empty() || point.modes.empty()) return;
  const SystemMatrix& M = point.node.linearization.M[0];
  const Vector x = point.node.path.x.col(0);
  ComplexMatrix shapes(x.size(), static_cast<Eigen::Index>(point.modes.size()));
  for (std::size_t i = 0; i < point.modes.size(); ++i)
    shapes.col(static_cast<Eigen::Index>(i)) = point.modes[i].shape;
  const Matrix shares = shares_.of(M, x, shapes);
  const double speed = blade_rotor_speed(model_->description(), point.node.path.parameters.col(0));
  const auto begins = static_cast<std::int64_t>(modes_.size());
  for (std::size_t i = 0; i < point.modes.size(); ++i) {
    const Vector share = shares.col(static_cast<Eigen::Index>(i));
    const auto [mode, is_new] = modes_.try_emplace(static_cast<std::size_t>(point.modes[i].mode));
    if (is_new)
      mode->second = {share, share, begins, std::abs(point.modes[i].s), point.modes[i].s.imag() / speed};
    mode->second.last = share;
  }
}

void ModeMotions::give_names(const std::vector<GivenName>& names, const TracePoint& first,
                             const std::string& label) {
  if (names.empty()) return;
  std::size_t n_modes = 0;
  for (const ModeState& mode : first.modes)
    n_modes = std::max(n_modes, static_cast<std::size_t>(mode.mode) + 1);
  const std::vector<std::string> own = own_names(n_modes);
  const Projection* projection = model_->projection();
  const bool lifts = projection != nullptr && projection->is_of_family();
  std::vector<NamedMode> modes;
  for (const ModeState& mode : first.modes) {
    modes.push_back({mode.s, lifts ? ComplexVector(projection->basis * mode.shape) : mode.shape,
                     own[static_cast<std::size_t>(mode.mode)]});
  }
  const std::vector<std::size_t> chosen =
      modes_of_names(names, modes, lifts ? projection->names : model_->description().coordinate_names, label);
  for (std::size_t i = 0; i < names.size(); ++i)
    given_[static_cast<std::size_t>(first.modes[chosen[i]].mode)] = names[i].name;
}

std::vector<std::string> ModeMotions::names(std::size_t n_modes) const {
  std::vector<std::string> result = own_names(n_modes);
  for (const auto& [mode, name] : given_) {
    if (mode < n_modes) result[mode] = name;
  }
  return result;
}

std::vector<std::string> ModeMotions::own_names(std::size_t n_modes) const {
  std::vector<std::string> result(n_modes);
  const auto put = [&](std::size_t mode, const std::string& name) {
    if (mode < n_modes) result[mode] = name;
  };
  for (const auto& [mode, name] : by_participation_) put(mode, name);
  std::vector<RotorMode> of_rotor;
  for (const auto& [mode, description] : rotor_modes_) of_rotor.push_back(description);
  std::size_t next = 0;
  const auto rotor_names = rotor_mode_names(of_rotor, model_->description().shafts);
  for (const auto& [mode, description] : rotor_modes_) put(mode, rotor_names[next++]);
  if (shares_.motions().empty()) return result;
  std::vector<std::size_t> ascending;
  for (const auto& [mode, ends] : modes_) ascending.push_back(mode);
  const auto order = [&](std::size_t mode) {
    return std::pair(modes_.at(mode).begins, modes_.at(mode).frequency);
  };
  std::ranges::stable_sort(ascending, [&](std::size_t a, std::size_t b) { return order(a) < order(b); });
  Matrix shares(static_cast<Eigen::Index>(shares_.motions().size()),
                static_cast<Eigen::Index>(ascending.size()));
  for (std::size_t i = 0; i < ascending.size(); ++i)
    shares.col(static_cast<Eigen::Index>(i)) = modes_.at(ascending[i]).first;
  std::vector<double> turns;
  for (const std::size_t mode : ascending) turns.push_back(modes_.at(mode).turns);
  const std::vector<std::string> names = shares_.names(shares, turns);
  for (std::size_t i = 0; i < ascending.size(); ++i) put(ascending[i], names[i]);
  return result;
}

void ModeMotions::write(Hdf5Writer& file, std::size_t n_modes) {
  const auto motions = static_cast<Eigen::Index>(shares_.motions().size());
  if (motions == 0 && by_participation_.empty() && rotor_modes_.empty() && given_.empty()) return;
  const Vector unknown = Vector::Constant(motions, std::numeric_limits<double>::quiet_NaN());
  std::vector<double> values;
  for (const auto end : {&Ends::first, &Ends::last}) {
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const auto found = modes_.find(mode);
      const Vector& shares = found == modes_.end() ? unknown : found->second.*end;
      values.insert(values.end(), shares.begin(), shares.end());
    }
  }
  if (motions > 0) file.write_rows("kinetic_energy_share", 0, values);
  std::vector<std::string> now = names(n_modes);
  if (now != written_names_) file.write_rows("mode_name", 0, now);
  written_names_ = std::move(now);
}

}  // namespace eigentrail
