#include "completeness/reference_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "completeness/spectrum_functions.hpp"

namespace eigentrail::test {
namespace {

constexpr int degree = 16;              ///< of the polynomials
constexpr int first_intervals = 16;     ///< of the range
constexpr double resolved = 1e-9;       ///< last coefficients, as a share of the largest
constexpr double most_rounding = 1e-2;  ///< the same, for narrow intervals
constexpr double nearby = 0.35;         ///< a root this far beside [-1, 1] counts as near
constexpr double narrowest = 1e-7;      ///< of the range: narrower intervals are not divided
constexpr double split_at = 0.48713;    ///< not in the middle, where special points may be by design

constexpr const char* kinds[] = {"divergence", "flutter", "collision"};

class Search {
 public:
  Search(const Family& family, double from, double to) : family_(family), from_(from), to_(to) {}

  ReferenceEvents run() {
    for (int f = 0; f < n_functions; ++f) {
      for (int i = 0; i < first_intervals; ++i) {
        const auto border = [&](int k) { return from_ + (to_ - from_) * k / first_intervals; };
        search(static_cast<Function>(f), border(i), border(i + 1));
      }
    }
    const auto by_place = [](const ReferenceEvent& a, const ReferenceEvent& b) { return a.p < b.p; };
    std::sort(result_.events.begin(), result_.events.end(), by_place);
    std::sort(result_.touching.begin(), result_.touching.end(), by_place);
    for (std::size_t i = 0; i < result_.events.size(); ++i) find_direction(i);
    check_counts();
    return result_;
  }

 private:
  const AtParameter& at(double p) {
    const auto known = known_.find(p);
    if (known != known_.end()) return known->second;
    ++result_.spectra;
    return known_[p] = spectrum_at(family_, p);
  }
  const Scaled& value(Function f, double p) { return at(p).values[f]; }

  /// The Chebyshev polynomial on an interval.
  std::vector<double> coefficients(Function f, double a, double b) {
    const auto function = [&](double x) {
      const double p = x == 1.0 ? b : x == -1.0 ? a : 0.5 * (a + b) + 0.5 * (b - a) * x;
      return value(f, p);
    };
    return chebyshev_coefficients(function, degree);
  }

  void split(Function f, double a, double b) {
    const double middle = a + split_at * (b - a);
    search(f, a, middle);
    search(f, middle, b);
  }

  void search(Function f, double a, double b) {
    const bool changes = value(f, a).sign != value(f, b).sign;
    if (b - a < narrowest * (to_ - from_)) {
      // Within this, an odd number of zeros is one and an even number none.
      if (changes) {
        add_event(f, a, b);
      } else {
        result_.touching.push_back(describe(f, 0.5 * (a + b), false));
      }
      return;
    }
    std::vector<double> c = coefficients(f, a, b);
    double largest = 0.0;
    for (const double value : c) largest = std::max(largest, std::abs(value));
    double last = 0.0;
    for (std::size_t i = c.size() - 4; i < c.size(); ++i) last = std::max(last, std::abs(c[i]));
    // Close to a zero the last coefficients are rounding, so a narrow interval may have larger ones. Those of
    // the function itself fall much faster with the width.
    const double width = (b - a) * first_intervals / (to_ - from_);
    if (last > std::min(resolved / (width * width), most_rounding) * largest) return split(f, a, b);
    while (c.size() > 1 && std::abs(c.back()) <= 3.0 * last) c.pop_back();
    int near = 0;
    for (const Complex root : chebyshev_roots(c)) {
      const double beyond = std::max(std::abs(root.real()) - 1.0, 0.0);
      near += std::hypot(beyond, root.imag()) < nearby;
    }
    if (near > 1 || (near == 0 && changes)) return split(f, a, b);
    if (!changes) return;
    if (f == D && std::abs(static_cast<int>(at(a).real.size()) - static_cast<int>(at(b).real.size())) != 2)
      return split(f, a, b);
    add_event(f, a, b);
  }

  /// The zero between two places of different sign.
  double locate(Function f, double& a, double& b) {
    const double enough = 1e-14 * (to_ - from_);
    for (int i = 0; i < 200 && b - a > enough; ++i) {
      const Scaled left = value(f, a);
      const Scaled right = value(f, b);
      // The secant, and every third time the middle.
      const double share = left.sign == 0 ? 0.0 : 1.0 / (1.0 + std::exp(right.log - left.log));
      double middle = i % 3 == 2 ? 0.5 * (a + b) : a + std::clamp(share, 1e-3, 1.0 - 1e-3) * (b - a);
      if (middle <= a || middle >= b) middle = 0.5 * (a + b);
      if (middle <= a || middle >= b) break;
      (value(f, middle).sign == left.sign ? a : b) = middle;
    }
    return 0.5 * (a + b);
  }

  /// The eigenvalue to which the function owes its zero at p. Two pairs that meet do
  /// not change the sign of D.
  ReferenceEvent describe(Function f, double p, bool changes) {
    const AtParameter& here = at(p);
    ReferenceEvent event{kinds[f], p, Complex(0.0), 0};
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](double size, Complex s, const char* kind) {
      if (size >= least) return;
      least = size;
      event.s = s;
      event.kind = kind;
    };
    if (f == F) {
      for (const Complex s : here.upper) consider(std::abs(s.real()) / std::abs(s), s, "flutter");
      for (std::size_t i = 0; i < here.real.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const double size = std::max(std::abs(here.real[i]), std::abs(here.real[j]));
          consider(std::abs(here.real[i] + here.real[j]) / (2.0 * size), here.real[i], "opposite");
        }
      }
    }
    if (f == D) {
      for (std::size_t i = 0; i < here.upper.size(); ++i) {
        const Complex s = here.upper[i];
        consider(s.imag() / std::abs(s), s.real(), "collision");
        for (std::size_t j = 0; j < i && !changes; ++j) {
          const Complex other = here.upper[j];
          consider(std::abs(s - other) / std::abs(s + other), 0.5 * (s + other), "coincidence");
        }
      }
      for (std::size_t i = 1; i < here.real.size(); ++i) {
        const double size = std::max(std::abs(here.real[i]), std::abs(here.real[i - 1]));
        consider((here.real[i] - here.real[i - 1]) / (2.0 * size), here.real[i], "collision");
      }
    }
    return event;
  }

  void add_event(Function f, double a, double b) {
    const double p = locate(f, a, b);
    ReferenceEvent event = describe(f, p, true);
    if (event.kind == "opposite") return;
    result_.events.push_back(event);
  }

  /// How many eigenvalues become unstable, from places on either side as far away as the neighbouring events
  /// allow: close to the zero the signs of real parts are rounding.
  void find_direction(std::size_t i) {
    constexpr double farthest = 1e-7;
    constexpr double nearest = 1e-10;  // of the range
    ReferenceEvent& event = result_.events[i];
    if (event.kind == "collision") return;
    double aside = farthest * (to_ - from_);
    constexpr double before_the_next = 0.4;
    if (i > 0) aside = std::min(aside, before_the_next * (event.p - result_.events[i - 1].p));
    if (i + 1 < result_.events.size())
      aside = std::min(aside, before_the_next * (result_.events[i + 1].p - event.p));
    aside = std::max(aside, nearest * (to_ - from_));
    for (; event.direction == 0 && aside >= nearest * (to_ - from_); aside /= 3.0) {
      const int more = at(event.p + aside).unstable() - at(event.p - aside).unstable();
      event.direction = event.kind == "flutter" ? more / 2 : more;
    }
  }

  /// All spectra that were computed must have as many unstable pairs and real eigenvalues as the events say.
  void check_counts() {
    const double margin = 1e-9 * (to_ - from_);
    const AtParameter* last = nullptr;
    double last_p = 0.0;
    for (const auto& [p, here] : known_) {
      const auto beside = [&, at = p](const ReferenceEvent& event) {
        return std::abs(event.p - at) < margin;
      };
      if (std::any_of(result_.events.begin(), result_.events.end(), beside) || !here.is_decided()) continue;
      if (last != nullptr) check_between(last_p, *last, p, here);
      last = &here;
      last_p = p;
    }
  }

  void check_between(double a, const AtParameter& left, double b, const AtParameter& right) {
    const auto between = [&](const ReferenceEvent& event) { return event.p > a && event.p < b; };
    const double undecided = 2.0 * narrowest * (to_ - from_);
    const auto near = [&](const ReferenceEvent& touch) {
      return touch.p > a - undecided && touch.p < b + undecided;
    };
    if (std::any_of(result_.touching.begin(), result_.touching.end(), near)) return;
    int unstable = 0;
    int collisions = 0;
    for (const ReferenceEvent& event : result_.events) {
      if (!between(event)) continue;
      unstable += event.kind == "flutter" ? 2 * event.direction : event.direction;
      collisions += event.kind == "collision";
    }
    const int seen = right.unstable() - left.unstable();
    const int real = static_cast<int>(right.real.size()) - static_cast<int>(left.real.size());
    const bool real_fits = std::abs(real) <= 2 * collisions && (std::abs(real) / 2 - collisions) % 2 == 0;
    if (seen == unstable && real_fits) return;
    std::ostringstream text;
    text.precision(12);
    text << "between " << a << " and " << b << ": " << seen << " more unstable eigenvalues, events say "
         << unstable << "; " << real << " more real ones, " << collisions << " collisions";
    result_.doubts.push_back(text.str());
  }

  const Family& family_;
  double from_, to_;
  std::map<double, AtParameter> known_;
  ReferenceEvents result_;
};

}  // namespace

RealPencil real_pencil(const Family& family, double p) {
  const auto value = [p](const MatrixSeries& series) {
    Matrix sum = series.back();
    for (std::size_t k = series.size() - 1; k-- > 0;) sum = sum * p + series[k];
    return sum;
  };
  return {value(family.M), value(family.C), value(family.K)};
}

ReferenceEvents reference_events(const Family& family, double from, double to) {
  return Search(family, from, to).run();
}

}  // namespace eigentrail::test
