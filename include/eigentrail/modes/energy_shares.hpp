// What moves in a mode: shares of its kinetic energy by body and by direction, and a name that follows.
//
// In a rotating frame the directions are those of a blade: along its radius s, along the axis of rotation a,
// and along a x s. Motion along a and rotation about a x s are flap, motion along a x s and rotation about a
// are lag, rotation about s is torsion, motion along s is axial. Elsewhere they are the frame's x, y, z.
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

  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.mass, self.kind);
  }
};

class EnergyShares {
 public:
  /// Directions are those at the equilibrium `x` (n) with mass matrix M, and stay what they are.
  EnergyShares(const ModelDescription& description, const SystemMatrix& M, const Vector& x);

  EnergyShares() = default;

  /// Its state, for files that a trace goes on from.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.carriers_, self.motions_);
  }

  /// All that masses of the model may do; empty for a family of matrices, of which nothing is known.
  const std::vector<MassMotion>& motions() const { return motions_; }

  /// Shares of z* M z by motion (rows) for mode shapes z about x (columns of `shapes`, n x k); they add up to
  /// one. Products of inertia between two rotations are split in halves.
  Matrix of(const SystemMatrix& M, const Vector& x, const ComplexMatrix& shapes) const;

  /// Whether a state that was read is one of this model.
  bool fits(const ModelDescription& description) const;

  /// A name for each of some modes, given their shares (motions x modes) in the order in which equal names
  /// are numbered: "flap", "lag 2", "flap-torsion", "hub along x and y".
  std::vector<std::string> names(const Matrix& shares) const;

 private:
  struct Carrier {
    MassCarrier mass;
    bool blade = false;                                  ///< names of a blade's directions
    std::array<Eigen::Index, 6> rows = {};               ///< of its motions along and about the axes
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: s, a, a x s; or x, y, z

    template <class Self, class Visit>
    static void fields(Self& self, Visit& visit) {
      visit(self.mass.name, self.mass.first_triple, self.mass.n_triples, self.blade, self.rows, self.axes);
    }
  };
  Eigen::Index row_of(const std::string& mass, const std::string& kind);

  std::vector<Carrier> carriers_;
  std::vector<MassMotion> motions_;
};

}  // namespace eigentrail
