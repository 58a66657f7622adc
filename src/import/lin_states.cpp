#include "import/lin_states.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "import/text_lines.hpp"
#include "model/multiblade/harmonics.hpp"

namespace eigentrail {

LinStates::LinStates(const std::vector<LinFile>& files) : files_(files) {
  for (const LinQuantity& state : files[0].states) parsed_.push_back(openfast_state(state.description));
  for (const LinFile& file : files) places_.push_back(places_in(file));
  find_frames();
  find_tuples();
}

Matrix LinStates::matrix(std::size_t file) const {
  return files_[file].A(places_[file], places_[file]);
}

void LinStates::describe(SampledData& data) const {
  std::vector<std::string> names;
  for (const OpenFastState& state : parsed_) names.push_back(short_name(state));
  const std::vector<std::string> parts = multiblade_names(static_cast<int>(n_blades_));
  std::vector<bool> fixed(parsed_.size(), false);
  for (const BladeStates& tuple : tuples_) {
    for (std::size_t k = 0; k < n_blades_; ++k) {
      for (const std::vector<Eigen::Index>* list : {&tuple.states, &tuple.rates}) {
        if (list->empty()) continue;
        const auto i = static_cast<std::size_t>((*list)[k]);
        OpenFastState state = parsed_[i];
        state.motion += " " + parts[k];
        state.blade = 0;
        names[i] = short_name(state);
        fixed[i] = true;
      }
    }
  }
  data.state_names = names;
  for (std::size_t i = 0; i < parsed_.size(); ++i) {
    data.state_units.push_back(parsed_[i].unit.empty() ? "1" : parsed_[i].unit);
    data.derivative_order.push_back(files_[0].states[i].derivative_order);
    data.state_frames.push_back(rotating_[i] && !fixed[i] ? StateFrame::rotating : StateFrame::fixed);
  }
}

/// For each state of the first file its place in another one.
std::vector<Eigen::Index> LinStates::places_in(const LinFile& file) const {
  std::map<std::string, Eigen::Index> own;
  for (std::size_t i = 0; i < file.states.size(); ++i) {
    if (!own.emplace(file.states[i].description, static_cast<Eigen::Index>(i)).second)
      throw InputError(file.path + ": lists the state '" + printable(file.states[i].description) + "' twice");
  }
  std::vector<Eigen::Index> result;
  for (const LinQuantity& state : files_[0].states) {
    const auto found = own.find(state.description);
    if (found == own.end())
      throw InputError(file.path + ": has no state '" + printable(state.description) + "', which " +
                       files_[0].path + " has; all files need the same states");
    result.push_back(found->second);
  }
  if (own.size() != result.size())
    throw InputError(file.path + ": has " + count_of(own.size(), "state") + ", " + files_[0].path + " has " +
                     std::to_string(result.size()) + "; all files need the same states");
  return result;
}

/// The frame of each state: that of most files, and rotating for states of blades.
void LinStates::find_frames() {
  std::set<std::string> differ, blades;
  for (std::size_t i = 0; i < parsed_.size(); ++i) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < files_.size(); ++f)
      count += files_[f].states[static_cast<std::size_t>(places_[f][i])].rotating ? 1 : 0;
    if (count != 0 && count != files_.size()) differ.insert(parsed_[i].motion);
    const bool marked = 2 * count > files_.size();
    if (marked != (parsed_[i].blade > 0)) blades.insert(short_name(parsed_[i]));
    rotating_.push_back(marked || parsed_[i].blade > 0);
  }
  const auto listed = [](const std::set<std::string>& names) {
    const std::string text = joined(names, "; ");
    constexpr std::size_t longest = 200;
    return text.size() > longest ? text.substr(0, longest) + " ..." : text;
  };
  if (!differ.empty())
    warnings_.push_back("the files disagree on the frame of these states: " + listed(differ) +
                        "; the frame of most files is used, and the rotating one for states of blades");
  if (!blades.empty())
    warnings_.push_back("the frames of these states are not those of their names: " + listed(blades) +
                        "; states of blades are taken as rotating, the others as marked");
}

void LinStates::find_tuples() {
  std::map<std::string, std::map<int, Eigen::Index>> motions, rates;
  for (std::size_t i = 0; i < parsed_.size(); ++i) {
    const OpenFastState& state = parsed_[i];
    n_blades_ = std::max(n_blades_, static_cast<std::size_t>(state.blade));
    if (state.blade > 0)
      (state.is_rate ? rates : motions)[state.motion][state.blade] = static_cast<Eigen::Index>(i);
  }
  const auto complete = [this](const std::map<int, Eigen::Index>& blades) {
    return n_blades_ >= 3 && blades.size() == n_blades_;
  };
  const auto indices = [](const std::map<int, Eigen::Index>& blades) {
    std::vector<Eigen::Index> result;
    for (const auto& [blade, index] : blades) result.push_back(index);
    return result;
  };
  std::vector<bool> done(parsed_.size(), false);
  for (const auto& [motion, blades] : motions) {
    if (!complete(blades)) continue;
    BladeStates tuple{indices(blades)};
    const auto own_rates = rates.find(motion);
    if (own_rates != rates.end() && complete(own_rates->second)) tuple.rates = indices(own_rates->second);
    for (const Eigen::Index i : tuple.states) done[static_cast<std::size_t>(i)] = true;
    for (const Eigen::Index i : tuple.rates) done[static_cast<std::size_t>(i)] = true;
    tuples_.push_back(std::move(tuple));
  }
  for (std::size_t i = 0; i < parsed_.size(); ++i)
    left_rotating_ = left_rotating_ || (rotating_[i] && !done[i]);
  if (left_rotating_ && n_blades_ > 0 && n_blades_ < 3)
    warnings_.push_back(
        "a rotor of " + count_of(n_blades_, "blade") +
        " has no multiblade coordinates in which its equations are constant; the states of the "
        "blades stay in the rotating frame, and the average over the azimuths is an approximation");
  else if (left_rotating_)
    warnings_.emplace_back(
        "some states in the rotating frame do not belong to all blades and stay as they are; the "
        "average over the azimuths is an approximation");
}

}  // namespace eigentrail
