#include "scene/narrow_places.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "scene/interval.hpp"

namespace eigentrail {
namespace {

/// Degree of the term of the Taylor polynomial that is bounded.
constexpr int degree = 4;
/// A piece is described by a polynomial if that term is at most this share of the largest value of the
/// expression. The places are only to be noticed; a smaller share finds weaker ones.
constexpr double described = 1e-3;
/// Pieces are halved down to this share of the range. Where more pieces of one length than `most_open` are
/// not described, nothing is narrow: the function varies all over the range, or intervals say nothing of it,
/// as of terms that cancel each other.
constexpr double shortest = 1e-8;
constexpr std::size_t most_open = 512;
/// Pieces into which the range is divided at first, and places at which the scale of the values is taken.
constexpr int first_pieces = 16;
constexpr int samples = 256;
/// A place is narrow if its piece is shorter than this share of the range: between that and the longest step
/// the error of the dense output notices it.
constexpr double narrow = 1.0 / 64.0;
/// Places closer than this many lengths of their pieces are one.
constexpr double same = 8.0;

using Enclosure = Series<Interval, degree>;

/// A function of the traced parameter as a series about an interval of its values (declared unit).
using Function = std::function<Enclosure(const Interval&)>;

struct Piece {
  double begin = 0.0, end = 0.0;
  double length() const { return end - begin; }
  double middle() const { return 0.5 * (begin + end); }
};

/// A function with its values.
struct Described {
  Function series;
  std::function<double(double)> value;
};

/// Largest magnitude of the values at places all over the range.
double scale_of(const Described& f, double begin, double end) {
  double largest = 0.0;
  for (int i = 0; i <= samples; ++i) {
    const double value = std::abs(f.value(begin + (end - begin) * i / samples));
    if (std::isfinite(value)) largest = std::max(largest, value);
  }
  return largest;
}

/// SI values of all parameters where the traced one has a value, or as series about an interval of its
/// values. All expressions are looked at in the same places first, so they are kept.
class ParametersAlong {
 public:
  ParametersAlong(const Parameters& parameters, const Vector& values, int traced)
      : parameters_(parameters), values_(values), traced_(static_cast<std::size_t>(traced)) {}

  const std::vector<Enclosure>& at(const Interval& p) {
    std::vector<Enclosure>& known = enclosures_[{p.lower, p.upper}];
    if (!known.empty()) return known;
    Enclosure series(p);
    series[1] = 1.0;
    return known = si(series);
  }
  const std::vector<double>& at(double p) {
    std::vector<double>& known = numbers_[p];
    return known.empty() ? known = si(p) : known;
  }

 private:
  template <class Scalar>
  std::vector<Scalar> si(const Scalar& p) const {
    std::vector<Scalar> all;
    for (const double value : values_) all.emplace_back(value);
    all[traced_] = p;
    parameters_.to_si(std::span<Scalar>(all));
    return all;
  }

  const Parameters& parameters_;
  const Vector& values_;
  std::size_t traced_;
  std::map<std::pair<double, double>, std::vector<Enclosure>> enclosures_;
  std::map<double, std::vector<double>> numbers_;
};

/// The range in pieces on each of which the function is described by a polynomial; none where nothing is
/// narrow.
class Partition {
 public:
  Partition(const Described& f, double begin, double end)
      : f_(f), shortest_(shortest * (end - begin)), scale_(scale_of(f, begin, end)) {
    const double step = (end - begin) / first_pieces;
    std::vector<Piece> open;
    for (int i = 0; i < first_pieces; ++i)
      open.push_back({begin + i * step, i + 1 == first_pieces ? end : begin + (i + 1) * step});
    while (!open.empty() && open.size() <= most_open) open = halves_of(open);
    if (!open.empty()) pieces_.clear();
    std::ranges::sort(pieces_, {}, &Piece::begin);
  }

  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  bool is_described(const Piece& piece) const {
    const Interval term = f_.series({piece.begin, piece.end})[degree];
    return term.magnitude() * std::pow(0.5 * piece.length(), degree) <= described * scale_;
  }

  /// Keeps those pieces that are described, or not halved, and returns the halves of the others.
  std::vector<Piece> halves_of(const std::vector<Piece>& open) {
    std::vector<Piece> halves;
    for (const Piece& piece : open) {
      if (piece.length() <= shortest_ || is_described(piece)) {
        pieces_.push_back(piece);
        continue;
      }
      halves.push_back({piece.begin, piece.middle()});
      halves.push_back({piece.middle(), piece.end});
    }
    return halves;
  }

  const Described& f_;
  double shortest_;
  double scale_;
  std::vector<Piece> pieces_;
};

/// Middles of the shortest pieces between longer ones.
std::vector<Piece> shortest_of(const std::vector<Piece>& pieces, double range) {
  std::vector<Piece> found;
  for (std::size_t i = 0; i < pieces.size();) {
    std::size_t end = i + 1;
    const double length = pieces[i].length();
    const auto alike = [&](double other) { return other > 0.75 * length && other < 1.5 * length; };
    while (end < pieces.size() && alike(pieces[end].length())) ++end;
    const bool after_longer = i == 0 || pieces[i - 1].length() > length;
    const bool before_longer = end == pieces.size() || pieces[end].length() > length;
    if (length < narrow * range && after_longer && before_longer)
      found.push_back({pieces[i].begin, pieces[end - 1].end});
    i = end;
  }
  return found;
}

}  // namespace

std::vector<double> narrow_places(const Parameters& parameters, const Vector& values, int traced, double from,
                                  double to, std::span<const Expression> expressions) {
  const double begin = std::min(from, to);
  const double end = std::max(from, to);
  ParametersAlong along(parameters, values, traced);
  std::vector<Piece> found;
  const auto look_at = [&](const Described& f) {
    for (const Piece& piece : shortest_of(Partition(f, begin, end).pieces(), end - begin)) {
      const bool is_known = std::any_of(found.begin(), found.end(), [&](const Piece& other) {
        return std::abs(other.middle() - piece.middle()) <= same * std::max(other.length(), piece.length());
      });
      if (!is_known && std::isfinite(f.value(piece.middle()))) found.push_back(piece);
    }
  };
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (static_cast<int>(i) == traced || !parameters.depends_on(static_cast<int>(i), traced)) continue;
    look_at({[&](const Interval& p) { return along.at(p)[i]; }, [&](double p) { return along.at(p)[i]; }});
  }
  for (const Expression& expression : expressions) {
    if (!parameters.depends_on(expression, traced)) continue;
    look_at({[&](const Interval& p) { return expression.evaluate(std::span<const Enclosure>(along.at(p))); },
             [&](double p) { return expression.evaluate(std::span<const double>(along.at(p))); }});
  }
  std::vector<double> places;
  for (const Piece& piece : found) places.push_back(piece.middle());
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace eigentrail
