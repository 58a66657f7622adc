// Shares of the masses' motions in the kinetic energy of each mode, and names of modes from them, for the
// loci file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/hdf5_writer.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/modes/energy_shares.hpp"
#include "eigentrail/modes/given_names.hpp"
#include "eigentrail/modes/rotor_names.hpp"

namespace eigentrail {

/// Whether the modes of a model without masses are named by the participation of its coordinates: a family of
/// matrices without constraints and shafts, with names of its own, and not too large.
bool named_by_coordinates(const ModelDescription& description);

/// The projection by whose freedoms the modes of a family are named: those of a large model, if they have
/// names of their own. Null else.
const Projection* named_by_freedoms(const Model& model);

/// Collects the shares of kinetic energy of every mode at the first and the last point where it exists.
class ModeMotions {
 public:
  ModeMotions() = default;

  /// The directions of motion ("flap", "lag") are defined at the point `first`.
  ModeMotions(const Model& model, const TracePoint& first);

  /// Names that the scene gives: from the modes at the first point, `first`, which has been appended. `label`
  /// begins the message of an InputError where a name finds no mode.
  void give_names(const std::vector<GivenName>& names, const TracePoint& first, const std::string& label);

  /// Says of which model the points are, after the members were read; it must outlive this.
  void belongs_to(const Model& model) { model_ = &model; }

  void append(const TracePoint& point);

  /// Labels of the motions, for example "blade flap", in the order of the shares; empty for a model without
  /// masses.
  std::vector<std::string> labels() const;

  /// A name for each of `n_modes` modes, from its shares at the first point where it exists; empty where
  /// unknown. Names that the scene gives come first. Rotors: from the shapes of their shafts there, and from
  /// the first point with a clear whirl.
  std::vector<std::string> names(std::size_t n_modes) const;

  /// Writes `kinetic_energy_share` and `mode_name`; nothing for a model without masses, or only names for one
  /// whose coordinates have names. Names are written
  /// only if they have changed, because HDF5 does not reuse the space of overwritten texts.
  void write(Hdf5Writer& file, std::size_t n_modes);

  /// Visits the members that are saved with the state of a trace.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.shares_, self.modes_, self.coordinates_, self.by_participation_, self.rotor_modes_,
          self.given_);
  }

  /// Whether a state that was read fits this model.
  bool fits(const ModelDescription& description) const;

 private:
  std::vector<std::string> own_names(std::size_t n_modes) const;
  void name_by_coordinates(const TracePoint& point);
  void name_by_freedoms(const Projection& projection, const TracePoint& point);
  void describe_rotor_modes(const TracePoint& point);

  struct Ends {
    Vector first, last;       ///< by motion
    std::int64_t begins = 0;  ///< number of modes before it exists
    /// abs(s) where it first exists. Equal names are numbered in this order, those that exist earlier first:
    /// a mode keeps its name where another one begins.
    double frequency = 0.0;
    double turns = 0.0;  ///< Im s over the speed of a rotor of blades, likewise; NaN without one

    template <class Self, class Visit>
    static void fields(Self& self, Visit& visit) {
      visit(self.first, self.last, self.begins, self.frequency, self.turns);
    }
  };

  EnergyShares shares_;
  std::map<std::size_t, Ends> modes_;
  std::vector<std::string> coordinates_;  ///< names; empty unless modes are named by participation
  std::map<std::size_t, std::string> by_participation_;
  std::map<std::size_t, RotorMode> rotor_modes_;
  std::map<std::size_t, std::string> given_;  ///< names of the scene
  const Model* model_ = nullptr;
  std::vector<std::string> written_names_;
};

}  // namespace eigentrail
