// The lists that make up the catalogue.
#pragma once

#include <vector>

#include "hard_cases/catalogue.hpp"

namespace eigentrail::test {

std::vector<HardCase> veerings_and_crossings();  ///< H01 to H06
std::vector<HardCase> flutter_families();        ///< H07 to H12, H16 to H20
std::vector<HardCase> structures();              ///< H13 to H15, H21 to H23
std::vector<HardCase> rotating_mass_cases();     ///< C01 to C03, C08
std::vector<HardCase> constrained_cases();       ///< C04 to C07
std::vector<HardCase> own_clusters();            ///< own cases: several modes close to each other
std::vector<HardCase> own_structures();          ///< own cases: rotors, chains, graded and singular matrices

}  // namespace eigentrail::test
