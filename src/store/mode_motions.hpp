// What moves in each mode, as the loci file has it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/hdf5_file.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/modes/energy_shares.hpp"

namespace eigentrail {

/// Collects the shares of kinetic energy of all modes where they first and where they last exist.
class ModeMotions {
 public:
  ModeMotions() = default;

  /// Directions of motion are those at the point `first`.
  ModeMotions(const ModelDescription& description, const TracePoint& first);

  void append(const TracePoint& point);

  /// "blade flap": the motions, in the order of the shares; empty for a model without masses.
  std::vector<std::string> labels() const;

  /// A name for each of `n_modes` modes that follows from where it first exists; empty where nothing is
  /// known.
  std::vector<std::string> names(std::size_t n_modes) const;

  /// Fills `kinetic_energy_share` and `mode_name`; nothing for a model without masses. HDF5 does not use the
  /// room of texts again: they are written when they have changed only.
  void write(Hdf5File& file, std::size_t n_modes);

  /// Its state, for files that a trace goes on from.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.shares_, self.modes_);
  }

  /// Whether a state that was read is one of this model.
  bool fits(const ModelDescription& description) const;

 private:
  struct Ends {
    Vector first, last;      ///< by motion
    double frequency = 0.0;  ///< abs(s) where the mode first exists: the order in which names are numbered

    template <class Self, class Visit>
    static void fields(Self& self, Visit& visit) {
      visit(self.first, self.last, self.frequency);
    }
  };

  EnergyShares shares_;
  std::map<std::size_t, Ends> modes_;
  std::vector<std::string> written_names_;
};

}  // namespace eigentrail
