// Every effect that a multibody scene can name, one line each.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "model/elements/constraints.hpp"
#include "model/elements/drag.hpp"
#include "model/elements/follower_force.hpp"
#include "model/elements/force.hpp"
#include "model/elements/gravity.hpp"
#include "model/elements/point_mass.hpp"
#include "model/elements/rotating_frame.hpp"
#include "model/elements/spring.hpp"
#include "model/elements/transverse_force.hpp"

namespace eigentrail {

/// An element with its place in the assembled equations.
template <class Element>
struct Placed {
  Element element;
  std::string label;        ///< the scene's name for it, or "rod 2"
  std::vector<int> points;  ///< moving points it joins, each once
  int first_row = 0;        ///< of its constraints
};

template <class... Element>
struct ElementTable {
  std::tuple<std::vector<Placed<Element>>...> lists;
  static constexpr std::size_t kinds = sizeof...(Element);

  /// Calls visit(list, index) for the list of every kind, in the order of the registry.
  template <class Visit>
  void for_each(Visit&& visit) {
    std::size_t index = 0;
    std::apply([&](auto&... list) { (visit(list, index++), ...); }, lists);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::size_t index = 0;
    std::apply([&](const auto&... list) { (visit(list, index++), ...); }, lists);
  }
};

using Elements = ElementTable<  //
    PointMass,                  //
    RotatingFrame,              //
    Gravity,                    //
    DeadForce,                  //
    FollowerForce,              //
    TransverseForce,            //
    Spring,                     //
    GuidedSpring,               //
    Drag,                       //
    Rod,                        //
    Plane,                      //
    FixedCoordinate>;

/// Masses, the frame and gravity are read from [[point]], [frame] and [gravity]; all others from a table
/// each.
template <class Element>
inline constexpr bool has_own_table =
    !std::is_same_v<Element, PointMass> && !std::is_same_v<Element, RotatingFrame> &&
    !std::is_same_v<Element, Gravity>;

template <class Element>
concept HasForce = requires {
  Element::depends;
};

template <class Element>
concept HasConstraint = requires {
  Element::constraint_count;
};

}  // namespace eigentrail
