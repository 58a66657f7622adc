#include "model/sample_interpolation.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// The smallest degree is taken whose leave-one-out error is within this factor of the least one.
constexpr double as_good = 1.1;
/// Poles are used if they bring the leave-one-out error down to this share: noise can lower it a little.
constexpr double worth_poles = 0.1;
/// Factors for rows and columns by which the mean magnitudes of the entries of all matrices come to about
/// one: states have units of their own.
struct EntryScale {
  Vector rows, columns;
  Vector matrices;  ///< per matrix of sampled_matrices(): one over its norm; zero if it is absent
};

EntryScale entry_scale(const SampledData& data) {
  const Eigen::Index n = data.size();
  EntryScale scale{Vector::Ones(n), Vector::Ones(n), Vector::Zero(sampled_matrices().size())};
  Matrix magnitudes = Matrix::Zero(n, n);
  Eigen::Index at = 0;
  for (const SampledMatrix& named : sampled_matrices()) {
    Matrix mean = Matrix::Zero(n, n);
    for (const Matrix& sample : data.*named.samples) mean += sample.cwiseAbs();
    const double norm = mean.norm();
    if (norm > 0.0) {
      scale.matrices[at] = static_cast<double>(data.count()) / norm;
      magnitudes += mean / norm;
    }
    ++at;
  }
  const auto factor = [](double largest) { return largest > 0.0 ? 1.0 / std::sqrt(largest) : 1.0; };
  constexpr int sweeps = 10;
  for (int i = 0; i < sweeps; ++i) {
    const Matrix scaled = scale.rows.asDiagonal() * magnitudes * scale.columns.asDiagonal();
    for (Eigen::Index k = 0; k < n; ++k) {
      scale.rows[k] *= factor(scaled.row(k).maxCoeff());
      scale.columns[k] *= factor(scaled.col(k).maxCoeff());
    }
  }
  return scale;
}

/// See SamplePiece::reduced: one row per entry of the matrices, brought to as many rows as samples, column by
/// column of the matrices.
Matrix reduce(const SampledData& data, std::size_t first, std::size_t count) {
  const EntryScale scale = entry_scale(data);
  const Eigen::Index n = data.size();
  const auto samples = static_cast<Eigen::Index>(count);
  Matrix reduced(0, samples);
  Eigen::Index which = 0;
  for (const SampledMatrix& named : sampled_matrices()) {
    const std::vector<Matrix>& list = data.*named.samples;
    const double factor = scale.matrices[which++];
    if (list.empty()) continue;
    for (Eigen::Index column = 0; column < n; ++column) {
      Matrix rows(n, samples);
      for (Eigen::Index k = 0; k < samples; ++k)
        rows.col(k) = list[first + static_cast<std::size_t>(k)].col(column);
      rows.colwise() -= Vector(rows.rowwise().mean());
      if (rows.isZero(0.0)) continue;
      Matrix both(reduced.rows() + n, samples);
      both << reduced, factor * scale.columns[column] * scale.rows.asDiagonal() * rows;
      reduced = triangular_factor(both);
    }
  }
  return reduced;
}

/// An interpolant as it is chosen.
struct Choice {
  int degree = 0;
  Denominator denominator = {};
  std::vector<Denominator> without_one = {};
};

std::vector<double> without(std::vector<double> nodes, std::size_t left_out) {
  nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(left_out));
  return nodes;
}

Matrix without(const Matrix& columns, std::size_t left_out) {
  const auto at = static_cast<Eigen::Index>(left_out);
  Matrix result(columns.rows(), columns.cols() - 1);
  result << columns.leftCols(at), columns.rightCols(columns.cols() - at - 1);
  return result;
}

/// Denominators for all samples and without each of them; nothing if one cannot be fitted.
std::optional<Choice> with_poles(const std::vector<double>& nodes, const Matrix& reduced, int degree,
                                 int n_poles) {
  Choice choice{degree};
  if (n_poles == 0) {
    choice.without_one.assign(nodes.size(), {});
    return choice;
  }
  const auto all = fitted_denominator(nodes, reduced, degree, n_poles);
  if (!all) return std::nullopt;
  choice.denominator = *all;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto others = fitted_denominator(without(nodes, i), without(reduced, i), degree, n_poles);
    if (!others) return std::nullopt;
    choice.without_one.push_back(*others);
  }
  return choice;
}

/// The highest degree that is tried with so many samples.
int highest_tried(std::size_t samples) {
  return std::max(1, std::min(static_cast<int>(samples) - 3, highest_degree));
}

/// The interpolant that is taken, with its credible error; `left_out` is of successive degrees, from the
/// number of poles or 1 on.
struct Best {
  Choice choice;
  LeftOutErrors left_out;
  double credible = INFINITY;
};

/// The smallest degree whose error is about the least one. Poles are fitted without the sample that is left
/// out, too. At least four nodes.
Best best_degree(const std::vector<double>& nodes, const Matrix& reduced, int n_poles) {
  const int lowest = std::max(1, n_poles);
  const int highest = highest_tried(nodes.size());
  std::vector<Choice> choices;
  LeftOutErrors left_out{lowest, Matrix::Zero(highest - lowest + 1, static_cast<Eigen::Index>(nodes.size()))};
  for (int degree = lowest; degree <= highest; ++degree) {
    auto norms = left_out.norms.row(degree - lowest);
    std::optional<Choice> choice = with_poles(nodes, reduced, degree, n_poles);
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
      norms[static_cast<Eigen::Index>(i)] =
          choice ? (reduced * leave_one_out(nodes, degree, i, choice->without_one[i])).norm() : INFINITY;
    }
    choices.push_back(std::move(choice).value_or(Choice{degree}));
  }
  const Vector errors = left_out.norms.rowwise().norm();
  const double least = errors.minCoeff<Eigen::PropagateNumbers>();
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    if (errors[i] <= as_good * least)
      return {std::move(choices[static_cast<std::size_t>(i)]), std::move(left_out),
              credible_error(errors, i)};
  }
  return {};
}

SamplePiece best_piece(std::size_t first, const std::vector<double>& nodes, Matrix reduced) {
  const int count = static_cast<int>(nodes.size());
  if (count < 4) {
    const int degree = std::max(0, std::min(1, count - 1));
    return {first, RationalInterpolant(nodes, degree), std::move(reduced)};
  }
  Best best = best_degree(nodes, reduced, 0);
  best.choice.without_one.clear();
  LeftOutErrors polynomials = best.left_out;
  const bool few = nodes.size() <= most_samples_with_poles && reduced.rows() > 0;
  const int poles = few ? std::min(most_poles, highest_tried(nodes.size())) : 0;
  for (int n_poles = 1; n_poles <= poles; ++n_poles) {
    Best other = best_degree(nodes, reduced, n_poles);
    if (other.credible < worth_poles * best.credible) best = std::move(other);
  }
  return {first,
          RationalInterpolant(nodes, best.choice.degree, std::move(best.choice.denominator)),
          std::move(reduced),
          std::move(best.choice.without_one),
          std::move(polynomials),
          std::move(best.left_out)};
}

}  // namespace

Vector LeftOutErrors::over(std::size_t first, std::size_t count) const {
  return norms.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count))
      .rowwise()
      .norm();
}

double credible_error(const Vector& errors, Eigen::Index i) {
  double beside = INFINITY;
  if (i > 0) beside = errors[i - 1];
  if (i + 1 < errors.size()) beside = std::min(beside, errors[i + 1]);
  return std::isfinite(beside) ? std::max(errors[i], beside) : errors[i];
}

Vector leave_one_out(const std::vector<double>& nodes, int degree, std::size_t left_out,
                     const Denominator& denominator) {
  const std::vector<double> others = without(nodes, left_out);
  const int highest = static_cast<int>(others.size()) - 1;
  const Vector values =
      RationalInterpolant(others, std::min(degree, highest), denominator).values(nodes[left_out]);
  const auto at = static_cast<Eigen::Index>(left_out);
  Vector missed(values.size() + 1);
  missed << -values.head(at), 1.0, -values.tail(values.size() - at);
  return missed;
}

std::vector<SamplePiece> interpolate_samples(const SampledData& data, const std::vector<double>& values,
                                             const std::vector<std::size_t>& kinks,
                                             std::optional<int> degree) {
  std::vector<SamplePiece> pieces;
  std::vector<std::size_t> ends = kinks;
  ends.push_back(values.size() - 1);
  std::size_t first = 0;
  for (const std::size_t last : ends) {
    const std::vector<double> nodes(values.begin() + static_cast<std::ptrdiff_t>(first),
                                    values.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    Matrix reduced = reduce(data, first, nodes.size());
    if (degree) {
      const int highest = static_cast<int>(nodes.size()) - 1;
      pieces.push_back({first, RationalInterpolant(nodes, std::min(*degree, highest)), std::move(reduced)});
    } else {
      pieces.push_back(best_piece(first, nodes, std::move(reduced)));
    }
    first = last;
  }
  return pieces;
}

const SamplePiece& piece_at(const std::vector<SamplePiece>& pieces, double x) {
  for (const SamplePiece& piece : pieces) {
    if (x <= piece.interpolant.nodes().back()) return piece;
  }
  return pieces.back();
}

}  // namespace eigentrail
