// What a multibody scene consists of.
#pragma once

#include <vector>

#include "model/trim.hpp"

namespace eigentrail {

/// The data of a multibody model. Counters of constraint kinds follow those of elements.
struct MultibodyData {
  Elements elements;
  std::vector<Constraint> constraints;
  std::vector<TrimCondition> trims;
  std::vector<Expression> quantities;  ///< by Quantity::slot
  Parameters parameters;
  int n_triples = 0;      ///< of points and bodies
  int n_coordinates = 0;  ///< 3 n_triples, and one for each state of an element
  int n_constraints = 0;
};

}  // namespace eigentrail
