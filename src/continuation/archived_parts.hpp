// Parts of results that several archives hold, all of whose members are written to an archive and read from
// it (core/archive.hpp). If a member is added to a struct, the code does not compile until its number is
// changed.
#pragma once

#include "core/archive.hpp"
#include "eigentrail/continuation/point_modes.hpp"

namespace eigentrail {

Members<3> archived(const Path*);
Members<2> archived(const PairSeries*);
Members<3> archived(const EquilibriumGuess*);
Members<2> archived(const EvaluationCounts*);
Members<5> archived(const ModeCounts*);
Members<18> archived(const RunCounts*);

}  // namespace eigentrail
