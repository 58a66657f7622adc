// Evaluation of all elements of a multibody model in series of order Q along a path.
#pragma once

#include "model/registry.hpp"

namespace eigentrail {

/// What a multibody model is made of.
struct MultibodyData {
  Elements elements;
  std::vector<Expression> quantities;  ///< by slot
  Parameters parameters;
  int n_coordinates = 0;
  int n_constraints = 0;
};

template <int Q>
class Assembly {
 public:
  Assembly(const MultibodyData& data, const Path& path);

  EvaluationFault residual(SteadyResidual& result, EvaluationCounts& counts) const;
  EvaluationFault linearize(Linearization& result, EvaluationCounts& counts) const;

 private:
  using Base = Series<double, Q>;

  const MultibodyData& data_;
  PathValues<Base> values_;
};

extern template class Assembly<0>;
extern template class Assembly<1>;
extern template class Assembly<2>;
extern template class Assembly<3>;
extern template class Assembly<4>;
extern template class Assembly<5>;

}  // namespace eigentrail
