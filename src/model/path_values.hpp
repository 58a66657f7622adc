// The data of one evaluation: coordinates and numbers of a multibody model as power series along a path.
#pragma once

#include <vector>

#include "eigentrail/core/series.hpp"
#include "model/element.hpp"

namespace eigentrail {

template <class Real>
struct PathValues {
  using Columns = typename BasicPath<Real>::Columns;
  /// A series of any order that occurs.
  using LongSeries = Series<Real, max_order>;

  int order = 0;
  Columns coordinates;                                 ///< (order + 1) x n
  Columns numbers;                                     ///< (order + 1) x (quantities, then multipliers)
  std::vector<char> coordinate_varies, number_varies;  ///< along the path

  LongSeries coordinate(int index) const { return series(coordinates, index); }
  LongSeries number(int slot) const { return series(numbers, slot); }

  Vec3<LongSeries> triple(int index) const {
    return {coordinate(3 * index), coordinate(3 * index + 1), coordinate(3 * index + 2)};
  }

  Vec3<LongSeries> vector(const Place& place) const {
    if (!place.moves())
      return {number(place.fixed[0].slot), number(place.fixed[1].slot), number(place.fixed[2].slot)};
    Vec3<LongSeries> sum = Vec3<LongSeries>::Zero();
    for (const Term& term : place.terms) {
      const Vec3<LongSeries> share = triple(term.triple);
      sum += term.weight.slot < 0 ? share : Vec3<LongSeries>(number(term.weight.slot) * share);
    }
    return sum;
  }

 private:
  LongSeries series(const Columns& columns, int index) const {
    LongSeries result;
    for (int k = 0; k <= order; ++k) result[k] = columns(k, index);
    return result;
  }
};

}  // namespace eigentrail
