// List of all effects of multibody scenes except constraints, one line each.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "model/constraint.hpp"
#include "model/elements/apparent_mass.hpp"
#include "model/elements/beam.hpp"
#include "model/elements/bearing.hpp"
#include "model/elements/blade_element.hpp"
#include "model/elements/damper.hpp"
#include "model/elements/drag.hpp"
#include "model/elements/follower_force.hpp"
#include "model/elements/force.hpp"
#include "model/elements/gravity.hpp"
#include "model/elements/inflow.hpp"
#include "model/elements/internal_damping.hpp"
#include "model/elements/lift_lag.hpp"
#include "model/elements/maxwell_damper.hpp"
#include "model/elements/moment.hpp"
#include "model/elements/point_mass.hpp"
#include "model/elements/rotating_frame.hpp"
#include "model/elements/spinning_disc.hpp"
#include "model/elements/spring.hpp"
#include "model/elements/strip.hpp"
#include "model/elements/torsion.hpp"
#include "model/elements/transverse_force.hpp"

namespace eigentrail {

/// An element with its label, moving vectors and strength.
template <class Element>
struct Placed {
  Element element;
  std::string label;             ///< name in the scene, or "spring 2"
  std::vector<Place> arguments;  ///< its moving vectors, each once; Place::argument is the index
  Quantity strength = {};        ///< multiplies its forces; without slot: one
  int first_state = -1;          ///< index of its first state among those of all elements; -1: it has none
};

template <class... Element>
struct ElementTable {
  std::tuple<std::vector<Placed<Element>>...> lists;
  static constexpr std::size_t kinds = sizeof...(Element);

  template <class One>
  std::vector<Placed<One>>& list() {
    return std::get<std::vector<Placed<One>>>(lists);
  }
  template <class One>
  const std::vector<Placed<One>>& list() const {
    return std::get<std::vector<Placed<One>>>(lists);
  }

  /// Calls visit(list, index) for the list of every kind, in the order of the registry.
  void for_each(auto&& visit) const {
    std::size_t index = 0;
    std::apply([&](const auto&... list) { (visit(list, index++), ...); }, lists);
  }
};

using Elements = ElementTable<  //
    PointMass,                  //
    RigidBody,                  //
    RotatingFrame,              //
    Gravity,                    //
    DeadForce,                  //
    FollowerForce,              //
    TransverseForce,            //
    Moment,                     //
    Spring,                     //
    GuidedSpring,               //
    TorsionalSpring,            //
    Damper,                     //
    Drag,                       //
    TorsionalDamper,            //
    MaxwellDamper,              //
    TorsionalMaxwellDamper,     //
    InternalDamping,            //
    Bearing,                    //
    SpinningDisc,               //
    BladeElement,               //
    BeamSection,                //
    BeamDamping,                //
    Strip,                      //
    LiftLag,                    //
    ApparentMass,               //
    Inflow>;

/// Whether every [[table]] of that name is one element. The others have their own readers: masses, the frame
/// and gravity act on every mass, a beam is divided into elements and what is in moving air into strips.
template <class Element>
inline constexpr bool has_own_table =
    !std::is_same_v<Element, PointMass> && !std::is_same_v<Element, RigidBody> &&
    !std::is_same_v<Element, RotatingFrame> && !std::is_same_v<Element, Gravity> &&
    !std::is_same_v<Element, BladeElement> && !std::is_same_v<Element, BeamSection> &&
    !std::is_same_v<Element, BeamDamping> && !std::is_base_of_v<AirSection, Element> &&
    !std::is_same_v<Element, Inflow>;

}  // namespace eigentrail
