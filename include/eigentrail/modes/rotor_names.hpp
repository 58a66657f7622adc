// Names of the modes of a rotor, as its engineers call them: "1st forward bending", "conical, backward".
#pragma once

#include <string>
#include <vector>

#include "eigentrail/modes/whirl.hpp"

namespace eigentrail {

/// How the shaft that moves most moves in a mode.
enum class ShaftMotion : int {
  cylindrical,  ///< straight, the axis parallel to itself or turned about a place beyond the shaft
  conical,      ///< straight, turned about a place on the shaft
  bending,      ///< not straight
  axial,
  torsion,
};

/// What a name is made of.
struct RotorMode {
  ShaftMotion motion = ShaftMotion::bending;
  int shaft = 0;           ///< index of the shaft that moves most
  int axis = 0;            ///< 1: in the plane of x, 2: in that of y, 0: neither
  int sense = 0;           ///< 1 forward, -1 backward, 2 mixed, 0 not known (yet)
  bool oscillates = true;  ///< whether Im s > 0
  bool is_zero = false;    ///< whether s is zero within rounding: a rigid-body motion
  double frequency = 0.0;  ///< abs(s) where the mode first exists; equal names are numbered in its order

  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.motion, self.shaft, self.axis, self.sense, self.oscillates, self.is_zero, self.frequency);
  }
};

/// Describes a mode of a model with shafts at a point; arguments as for whirl_of. `rounding`: error of s,
/// 1/s.
RotorMode rotor_mode(const Model& model, const Vector& parameters, Complex s, const ComplexVector& shape,
                     double rounding = 0.0);

/// A name for each mode. Bending modes are numbered for each sense of whirl: the first forward and the first
/// backward one make a pair.
std::vector<std::string> rotor_mode_names(const std::vector<RotorMode>& modes,
                                          const std::vector<SpinningShaft>& shafts);

}  // namespace eigentrail
