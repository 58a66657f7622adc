#include "model/expression_terms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eigentrail {
namespace {

/// Values of the parameters at which expressions are compared: those of the scene, and others beside them.
std::vector<Vector> places_to_compare(const Parameters& parameters) {
  constexpr int count = 3;
  std::vector<Vector> places;
  for (int place = 0; place < count; ++place) {
    Vector values = parameters.declared_values();
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      // Golden ratio: the fractional parts of its multiples are all different.
      const double share = std::fmod(static_cast<double>(place * (i + 1)) * std::numbers::phi, 1.0);
      values[i] += share * (1.0 + std::abs(values[i]));
    }
    places.push_back(parameters.in_si(std::move(values)));
  }
  return places;
}

/// Whether two expressions are `sign` times each other. They may be written differently ("a*b" and "b*a"), as
/// long as they have the same values.
bool agree(const Expression& a, const Expression& b, double sign, const std::vector<Vector>& places) {
  return std::all_of(places.begin(), places.end(),
                     [&](const Vector& si) { return a.value(si) == sign * b.value(si); });
}

}  // namespace

ExpressionTerms::ExpressionTerms(Eigen::Index rows, Eigen::Index columns, const Parameters& parameters)
    : rows_(rows), columns_(columns), places_(places_to_compare(parameters)) {}

void ExpressionTerms::add(Eigen::Index row, Eigen::Index column, const Expression& entry) {
  const auto [term, sign] = place_of(row, column, entry);
  terms_[term].matrix(row, column) = sign;
  term_at_[{row, column}] = term;
}

DenseTerms ExpressionTerms::take(const Expression& power) {
  for (AffineTerm<Matrix>& term : terms_) term.factor = term.factor * power;
  return std::move(terms_);
}

std::pair<std::size_t, double> ExpressionTerms::place_of(Eigen::Index row, Eigen::Index column,
                                                         const Expression& entry) {
  const auto across = term_at_.find({column, row});
  for (const double sign : {1.0, -1.0}) {
    if (across != term_at_.end() && agree(entry, terms_[across->second].factor, sign, places_))
      return {across->second, sign};
  }
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    if (terms_[i].factor == entry) return {i, 1.0};
  }
  terms_.push_back({entry, Matrix::Zero(rows_, columns_)});
  return {terms_.size() - 1, 1.0};
}

}  // namespace eigentrail
