// Derivatives of the force of one element, as entries of the sparse matrices of a model.
#pragma once

#include <algorithm>
#include <vector>

#include "model/element.hpp"
#include "model/scatter.hpp"

namespace eigentrail {

/// Adds a series to an entry of a matrix series. Sets `finite` to false if a coefficient is not finite.
template <class Real, int Q>
void add_entry(Scatter<Real, Q>& sum, int row, int column, const Series<Real, Q>& value, bool& finite) {
  using std::isfinite;
  sum.add(row, column, value);
  for (int k = 0; k <= Q; ++k) finite = finite && isfinite(value[k]);
}

template <class Real, int Q>
bool is_constant(const Series<Real, Q>& value) {
  for (int k = 1; k <= Q; ++k) {
    if (value[k] != Real(0.0)) return false;
  }
  return true;
}

template <class Real, int Q>
bool is_zero(const Series<Real, Q>& value) {
  return value[0] == Real(0.0) && is_constant(value);
}

/// The moving vectors, states and strength of an element. The functions below do not depend on the type of
/// the element, so the compiler instantiates them once per order and not once per order and type.
struct Joined {
  const std::vector<Place>& arguments;
  const Quantity& strength;
  int first_state = 0;  ///< coordinate of the first state
  int n_states = 0;

  /// Number of components of all moving vectors, and of these and the states.
  int of_vectors() const { return 3 * static_cast<int>(arguments.size()); }
  int components() const { return of_vectors() + n_states; }
};

/// Sums the derivatives by coordinates first, so that each pair of coordinates has one entry of a sparse
/// matrix, however many components of the element they form. The quadrature points of a beam have twenty-one
/// components of a few coordinates of its nodes.
template <class Real, int Q>
class ElementMatrix {
 public:
  using Base = Series<Real, Q>;

  ElementMatrix(const Joined& joined, const PathValues<Base>& values) : joined_(joined), values_(values) {
    for (const Place& argument : joined.arguments) {
      for (const Term& term : argument.terms) {
        if (std::find(triples_.begin(), triples_.end(), term.triple) == triples_.end())
          triples_.push_back(term.triple);
      }
    }
    size_ = 3 * triples_.size() + static_cast<std::size_t>(joined.n_states);
    entries_.resize(size_ * size_);
  }

  /// Adds the derivative of the force in one direction.
  void add_column(int component, const ElementView<Series<Base, 1>>& view) {
    std::vector<Base> column(size_);
    for (int i = 0; i < joined_.components(); ++i) {
      const Base value = values_.times(joined_.strength, -view.component(i)[1]);
      if (is_zero(value)) continue;
      for_each_row(i, value, [&](std::size_t row, const Base& entry) { column[row] += entry; });
    }
    for (std::size_t i = 0; i < size_; ++i) {
      if (is_zero(column[i])) continue;
      for_each_row(component, column[i],
                   [&](std::size_t j, const Base& entry) { entries_[i * size_ + j] += entry; });
    }
  }

  void add_to(Scatter<Real, Q>& matrix, bool& finite) const {
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j < size_; ++j) {
        const Base& entry = entries_[i * size_ + j];
        if (!is_zero(entry)) add_entry<Real, Q>(matrix, coordinate(i), coordinate(j), entry, finite);
      }
    }
  }

 private:
  /// Calls visit(row, value) for every row of a component, with `value` times its weight.
  template <class Visit>
  void for_each_row(int component, const Base& value, Visit visit) const {
    if (component >= joined_.of_vectors()) {
      visit(3 * triples_.size() + static_cast<std::size_t>(component - joined_.of_vectors()), value);
      return;
    }
    for (const Term& term : joined_.arguments[static_cast<std::size_t>(component / 3)].terms) {
      const auto at = std::find(triples_.begin(), triples_.end(), term.triple) - triples_.begin();
      visit(static_cast<std::size_t>(3 * at + component % 3), values_.times(term.weight, value));
    }
  }

  int coordinate(std::size_t row) const {
    const std::size_t of_vectors = 3 * triples_.size();
    if (row < of_vectors) return 3 * triples_[row / 3] + static_cast<int>(row % 3);
    return joined_.first_state + static_cast<int>(row - of_vectors);
  }

  const Joined& joined_;
  const PathValues<Base>& values_;
  std::vector<int> triples_;  ///< whose coordinates form the components; states follow them
  std::size_t size_ = 0;
  std::vector<Base> entries_;  ///< row by row
};

}  // namespace eigentrail
