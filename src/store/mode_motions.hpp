// What moves in each mode, as the loci file has it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/hdf5_file.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/modes/energy_shares.hpp"

namespace eigentrail {

/// Collects the shares of kinetic energy of all modes where they first and where they last exist.
class ModeMotions {
 public:
  explicit ModeMotions(const ModelDescription& description) : description_(description) {}

  void append(const TracePoint& point);

  /// A name for each of `n_modes` modes that follows from where it first exists; empty where nothing is
  /// known.
  std::vector<std::string> names(std::size_t n_modes) const;

  /// Writes `motion`, `kinetic_energy_share` and `mode_name`; nothing for a model without masses.
  void write(Hdf5File& file, std::size_t n_modes) const;

 private:
  struct Ends {
    Vector first, last;      ///< by motion
    double frequency = 0.0;  ///< abs(s) where the mode first exists: the order in which names are numbered
  };

  const ModelDescription& description_;
  std::optional<EnergyShares> shares_;
  std::map<std::size_t, Ends> modes_;
};

}  // namespace eigentrail
