// Elements with data of their own, evaluated from their records and, independently, by calls of their forces.
#pragma once

#include <cmath>

#include "model/evaluate_equations.hpp"

namespace eigentrail::test {

/// A number of 113 bits that mixes with those of the source.
using Number = Series<Extended, 0>;

/// Gives every field of an element a vector or a number of its own.
class Filler {
 public:
  explicit Filler(std::vector<Place>& arguments) : arguments_(arguments) {}

  int n_numbers() const { return n_numbers_; }

  /// Every second vector is a weighted sum of two.
  void place(std::string_view, Place& place, std::string_view = {}) {
    const int index = static_cast<int>(arguments_.size());
    place = {{{index, {}}}, {}, index};
    if (index % 2 == 1) place.terms.push_back({index - 1, {0.0, n_numbers_++}});
    arguments_.push_back(place);
  }
  void point(std::string_view key, Place& p, std::string_view) { place(key, p); }
  void direction(std::string_view key, Place& d, std::string_view) { place(key, d); }
  void body(std::string_view key, std::array<Place, 3>& directors, std::string_view) {
    for (Place& d : directors) place(key, d);
  }
  void joint(std::string_view key, HingeAngle& angle, std::string_view) {
    for (Place* d : {&angle.axis, &angle.from, &angle.to}) place(key, *d);
  }
  void quantity(const QuantityField&, Quantity& q) { numbers(q); }
  void vector(const QuantityField&, std::array<Quantity, 3>& v) { numbers(v); }
  void matrix(const QuantityField&, std::array<Quantity, 4>& m) { numbers(m); }
  template <class... Numbers>
  void numbers(Numbers&... all) {
    (fill(all), ...);
  }

 private:
  void fill(Quantity& q) { q = {1.0, n_numbers_++}; }
  template <std::size_t N>
  void fill(std::array<Quantity, N>& list) {
    for (Quantity& q : list) fill(q);
  }

  std::vector<Place>& arguments_;
  int n_numbers_ = 0;
};

/// An element with data, as a model of its own with coordinates q: those of its triples and states.
template <class Element>
struct Sample {
  Placed<Element> placed;
  MultibodyData data;
  ExtendedMatrix numbers;      ///< by slot, as polynomials in h
  ExtendedMatrix coordinates;  ///< likewise
  static constexpr int n_states = number_of_states<Element>();

  Sample() {
    Filler filler(placed.arguments);
    Element::fields(placed.element, filler);
    placed.label = Element::name;
    if (n_states > 0) placed.first_state = 0;
    data.n_triples = static_cast<int>(placed.arguments.size());
    data.n_coordinates = 3 * data.n_triples + n_states;
    data.quantities.assign(static_cast<std::size_t>(filler.n_numbers()), Expression());
    const auto wave = [](Eigen::Index i, double rate) {
      return Extended(std::sin(rate * static_cast<double>(i) + 1.0));
    };
    numbers.resize(filler.n_numbers(), 3);
    for (Eigen::Index i = 0; i < numbers.rows(); ++i) {
      numbers(i, 0) = Extended(1.1) + Extended(0.4) * wave(i, 5.0);
      numbers(i, 1) = Extended(0.3) * wave(i, 3.0);
      numbers(i, 2) = Extended(0.2) * wave(i, 7.0);
    }
    if constexpr (std::is_base_of_v<AirSection, Element>) {
      // Sections are slower than sound.
      const int sound = placed.element.speed_of_sound.slot;
      if (sound >= 0) numbers.row(sound) << Extended(30.0), Extended(1.0), Extended(0.0);
    }
    coordinates.resize(data.n_coordinates, 3);
    for (Eigen::Index i = 0; i < coordinates.rows(); ++i) {
      coordinates(i, 0) = Extended(0.7) * wave(i, 2.0) + Extended(0.05 * static_cast<double>(i));
      coordinates(i, 1) = Extended(0.5) * wave(i, 4.0);
      coordinates(i, 2) = Extended(0.4) * wave(i, 6.0);
    }
  }

  ExtendedVector at(const ExtendedMatrix& polynomials, const Extended& h) const {
    return polynomials.col(0) + polynomials.col(1) * h + polynomials.col(2) * (h * h);
  }

  /// The force on the coordinates at h, displaced, with rates and accelerations: the template with numbers.
  ExtendedVector force(const Extended& h, const ExtendedVector& displacement, const ExtendedVector& rates,
                       const ExtendedVector& accelerations) const {
    const ExtendedVector values = at(numbers, h), q = at(coordinates, h) + displacement;
    const auto vector = [&](const Place& place, const ExtendedVector& of) {
      ExtendedVector sum = ExtendedVector::Zero(3);
      for (const Term& term : place.terms) {
        const Extended weight = term.weight.slot < 0 ? Extended(1.0) : values[term.weight.slot];
        for (int i = 0; i < 3; ++i) sum[i] += weight * of[3 * term.triple + i];
      }
      return sum;
    };
    const auto numbers_of = [&](const Place& place, const ExtendedVector& of) {
      return Vec3<Number>(vector(place, of).template cast<Number>());
    };
    std::vector<MovingVector<Number>> vectors;
    for (const Place& place : placed.arguments)
      vectors.push_back({numbers_of(place, q), numbers_of(place, rates), numbers_of(place, accelerations)});
    std::vector<MovingState<Number>> states;
    for (int i = 0; i < n_states; ++i)
      states.push_back({Number(q[3 * data.n_triples + i]), Number(rates[3 * data.n_triples + i])});
    ElementView<Number> view([&](int slot) { return Number(values[slot]); }, vectors, states);
    placed.element.force(view);
    ExtendedVector result = ExtendedVector::Zero(data.n_coordinates);
    for (std::size_t a = 0; a < placed.arguments.size(); ++a) {
      for (const Term& term : placed.arguments[a].terms) {
        const Extended weight = term.weight.slot < 0 ? Extended(1.0) : values[term.weight.slot];
        for (int i = 0; i < 3; ++i) result[3 * term.triple + i] += weight * view.vectors()[a].force[i][0];
      }
    }
    for (int i = 0; i < n_states; ++i)
      result[3 * data.n_triples + i] = view.states()[static_cast<std::size_t>(i)].force[0];
    return result;
  }

  /// Central difference of the force in a direction of positions (0), rates (1) or accelerations (2).
  ExtendedVector derivative(const Extended& h, int motion, Eigen::Index direction) const {
    const Extended step(0x1p-30);
    ExtendedVector moved[3];
    for (ExtendedVector& v : moved) v = ExtendedVector::Zero(data.n_coordinates);
    moved[motion][direction] = step;
    const ExtendedVector ahead = force(h, moved[0], moved[1], moved[2]);
    moved[motion][direction] = -step;
    return (ahead - force(h, moved[0], moved[1], moved[2])) / (Extended(2.0) * step);
  }

  /// The same from the record.
  PathValues<double> path_values(int order) const {
    PathValues<double> values;
    values.order = order;
    const auto series = [&](const ExtendedMatrix& polynomials) {
      Matrix columns = Matrix::Zero(order + 1, polynomials.rows());
      for (int k = 0; k <= std::min(order, 2); ++k)
        columns.row(k) = to_double(polynomials.col(k)).transpose();
      return columns;
    };
    values.numbers = series(numbers);
    values.coordinates = series(coordinates);
    values.number_varies.assign(static_cast<std::size_t>(numbers.rows()), order > 0);
    values.coordinate_varies.assign(static_cast<std::size_t>(coordinates.rows()), order > 0);
    return values;
  }

  RecordedEquations record() const {
    eigentrail::Elements elements;
    std::get<std::vector<Placed<Element>>>(elements.lists).push_back(placed);
    return record_equations(data, elements, {});
  }
};

}  // namespace eigentrail::test
