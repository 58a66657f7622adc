// Describes a mode by its motion: shares of its kinetic energy by body and direction, and a name from them.
//
// In a rotating frame, the directions of a mass are those of a blade: s along its radius, a along the axis of
// rotation, and a x s. Motion along a and rotation about a x s are flap; motion along a x s and rotation
// about a are lag; rotation about s is torsion; motion along s is axial. If the frame does not rotate, or if
// the mass is on the axis, the directions are x, y, z of the frame. Masses of one name are the nodes of a
// beam; their directions are those of the beam as a whole: s from end to end, a the mean z axis of its
// sections.
//
// Blades of a rotor in multiblade coordinates move together in waves. The two waves of a harmonic are taken
// apart: one turns with the rotor and one against it, as the frame that stands sees them (participation.hpp).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// A direction of motion of one mass.
struct MassMotion {
  std::string mass;  ///< name of the point or body
  std::string kind;  ///< "flap", "lag", "axial", "torsion", or "along x" ... "about z"
  std::string wave;  ///< of the blades of a rotor: see BladeWave; else empty

  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.mass, self.kind, self.wave);
  }
};

class EnergyShares {
 public:
  /// Takes the directions from the equilibrium `x` (n) with mass matrix M; they stay constant afterwards.
  EnergyShares(const ModelDescription& description, const SystemMatrix& M, const Vector& x);

  EnergyShares() = default;

  /// Lists the state, for files from which a trace is resumed.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.carriers_, self.motions_);
  }

  /// All motions that the masses of the model can have; empty for a matrix family, whose masses are unknown.
  const std::vector<MassMotion>& motions() const { return motions_; }

  /// Shares of z* M z by motion (rows) for the mode shapes z about x (columns of `shapes`, n x k). The shares
  /// of a mode sum to one. A product of inertia between two rotations contributes half to each.
  Matrix of(const SystemMatrix& M, const Vector& x, const ComplexMatrix& shapes) const;

  /// Whether a state that was read from a file fits the masses of this model.
  bool fits(const ModelDescription& description) const;

  /// A name for each mode from its shares (motions x modes): "flap", "lag 2", "flap-torsion", "hub along x
  /// and y". Equal names are numbered in the order of the modes. Blades of a rotor: "blade lag progressive",
  /// and "slow progressive" if the wave turns more slowly than the rotor, which is told from `turns`: Im s of
  /// each mode over the speed of the rotor.
  std::vector<std::string> names(const Matrix& shares, const std::vector<double>& turns = {}) const;

 private:
  struct Carrier {
    MassCarrier mass;
    bool blade = false;                                  ///< whether the directions are those of a blade
    std::array<Eigen::Index, 6> rows = {};               ///< rows of its motions along and about the axes
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: s, a, a x s; or x, y, z

    template <class Self, class Visit>
    static void fields(Self& self, Visit& visit) {
      visit(self.mass.name, self.mass.first_triple, self.mass.n_triples, self.mass.stands,
            self.mass.wave.name, self.mass.wave.harmonic, self.mass.wave.sense, self.mass.wave.rest_triple,
            self.mass.wave.sine_triple, self.blade, self.rows, self.axes);
    }
  };
  Eigen::Index row_of(const MassMotion& motion);

  std::vector<Carrier> carriers_;
  std::vector<MassMotion> motions_;
};

/// Speed of a rotor of blades, rad/s; NaN if the model has none. `parameters`: declared units.
double blade_rotor_speed(const ModelDescription& description, Vector parameters);

}  // namespace eigentrail
