// How the pieces of a boundary search are written to an archive and read from it (core/archive.hpp).
#pragma once

#include "continuation/archived_parts.hpp"
#include "stability/curve_follower.hpp"
#include "stability/line_scan.hpp"

namespace eigentrail {

template <SameAs<BoundarySeed> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [place, direction, kind, s, equilibrium, walked] = self;
  visit(place, direction, kind, s, equilibrium, walked);
}

template <SameAs<LineExtremum> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [place, s, equilibrium, sign] = self;
  visit(place, s, equilibrium, sign);
}

template <SameAs<Finding> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [what, where] = self;
  visit(what, where);
}

template <SameAs<LineScan> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [started, seeds, extrema, findings, s_ref, counts] = self;
  visit(started, seeds, extrema, findings, s_ref, counts);
}

template <SameAs<CurvePoint> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [place, tangent, normal, places, path, mode, functions, left, basis, equilibrium_condition,
         solves_equilibrium, s, shape, others, gap, number, flags] = self;
  visit(place, tangent, normal, places, path, mode, functions, left, basis, equilibrium_condition,
        solves_equilibrium, s, shape, others, gap, number, flags);
}

template <SameAs<ChordStep> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [length, left, right, rounding] = self;
  visit(length, left, right, rounding);
}

template <SameAs<BoundaryFunction> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [kind, damping_ratio] = self;
  visit(kind, damping_ratio);
}

template <SameAs<FollowedCurve> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [function, points, steps, begin, end, begin_reason, end_reason] = self;
  visit(function, points, steps, begin, end, begin_reason, end_reason);
}

}  // namespace eigentrail
