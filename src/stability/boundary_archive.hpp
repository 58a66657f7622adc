// How the pieces of a boundary search are written to an archive and read from it (core/archive.hpp).
#pragma once

#include "continuation/archived_parts.hpp"
#include "stability/curve_follower.hpp"
#include "stability/line_scan.hpp"

namespace eigentrail {

Members<6> archived(const BoundarySeed*);
Members<4> archived(const LineExtremum*);
Members<2> archived(const Finding*);
Members<6> archived(const LineScan*);
Members<17> archived(const CurvePoint*);
Members<4> archived(const ChordStep*);
Members<2> archived(const BoundaryFunction*);
Members<7> archived(const FollowedCurve*);

}  // namespace eigentrail
