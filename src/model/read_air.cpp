#include "model/readers.hpp"

#include <algorithm>
#include <functional>
#include <numbers>

#include "model/add_element.hpp"
#include "model/beam_axis.hpp"
#include "model/coefficient_table.hpp"

namespace eigentrail {
namespace {

/// Default numbers of Gauss points. Two on an element do not lower the order of the beam's convergence.
constexpr int points_on_element = 2;
constexpr int points_on_body = 4;
/// Degree of the interpolants of polars: airfoils stall, which higher degrees answer with waves.
constexpr int polar_degree = 4;

/// Keys of [[strips]] that may have a value per station.
std::vector<FieldHelp> station_fields() {
  return {{"span", "list",
           "where the stations are, from the first where the beam begins to the last where it ends, in any "
           "unit; keys below then may be lists of a number per station, linear in between",
           "the same for all"},
          {"file", "text", "CSV file with columns span and any keys below, beside the scene", "none"},
          {"chord", "m", "chord"},
          {"quarter_chord_y", "m",
           "from the axis of the beam, or the line on the body, to the quarter chord, along the y axis of "
           "the section",
           "0"},
          {"incidence", "rad", "of the chord against the y axis of the section, nose up", "0"},
          {"lift_slope", "1/rad", "slope of the lift coefficient", "2 pi"},
          {"zero_lift_angle", "rad", "angle of attack without lift", "0"},
          {"drag", "", "drag coefficient", "0"},
          {"moment", "", "moment coefficient about the quarter chord, nose up", "0"}};
}

/// A point of a line along which strips are placed, the axis of a beam or a straight line on a body, with the
/// axes of the section there and the length that it stands for.
struct SpanPoint {
  double share = 0.0;  ///< 0 where the line begins, 1 where it ends
  Combination position, y, z;
  Expression width;
};

/// Sum of a factor times each of the combinations.
Combination sum_of(const std::vector<std::pair<Expression, Combination>>& parts) {
  Combination sum;
  for (const auto& [factor, part] : parts) {
    if (is_number(factor, 0.0)) continue;
    for (const auto& [triple, weight] : part) {
      const auto known =
          std::find_if(sum.begin(), sum.end(), [t = triple](const auto& one) { return one.first == t; });
      if (known == sum.end())
        sum.emplace_back(triple, factor * weight);
      else
        known->second = known->second + factor * weight;
    }
  }
  return sum;
}

/// The n Gauss points of every element of a beam, or of its part within `extent`.
std::vector<SpanPoint> points_of_beam(const Draft& draft, const BeamDraft& beam, int n,
                                      const std::array<double, 2>& extent) {
  const BeamAxis& axis = *beam.axis;
  std::vector<SpanPoint> points;
  for (int e = 0; e < axis.elements; ++e) {
    const double from = std::max(0.0, extent[0] * axis.elements - e);
    const double to = std::min(1.0, extent[1] * axis.elements - e);
    if (!(to > from)) continue;
    for (const auto& [at, weight] : gauss_points(n)) {
      const double xi = from + at * (to - from);
      const ShapeFunctions shape = shape_functions(axis.degree, xi);
      SpanPoint& point = points.emplace_back();
      point.share = (e + xi) / axis.elements;
      for (std::size_t a = 0; a < shape.value.size(); ++a) {
        const int triple = draft.bodies[beam.first_body + axis.node(e, a)].triple;
        point.position.emplace_back(triple, shape.value[a]);
        point.y.emplace_back(triple + 2, shape.value[a]);
        point.z.emplace_back(triple + 3, shape.value[a]);
      }
      point.width = Expression(weight * (to - from)) * axis.stretch(e, shape);
    }
  }
  return points;
}

/// The n Gauss points of the part of the line within `extent`.
std::vector<SpanPoint> points_of_body(const Draft& draft, const BodyLine& line, int n,
                                      const std::array<double, 2>& extent) {
  const ExpressionVector span = line.tip - line.root;
  const Expression length = sqrt(dot(span, span));
  std::vector<SpanPoint> points;
  for (const auto& [at, weight] : gauss_points(n)) {
    const double share = extent[0] + at * (extent[1] - extent[0]);
    Combination position = draft.on_directors(line.body, line.root + Expression(share) * span);
    position.emplace_back(draft.bodies[static_cast<std::size_t>(line.body)].triple, 1.0);
    points.push_back({share, std::move(position), draft.on_directors(line.body, line.y),
                      draft.on_directors(line.body, line.z),
                      Expression(weight * (extent[1] - extent[0])) * length});
  }
  return points;
}

class StripReader {
 public:
  StripReader(Draft& draft, TableReader& table, std::vector<InflowDraft>& inflows)
      : draft_(draft), table_(table), inflows_(inflows) {}

  std::vector<Strip> read(const std::optional<ExpressionVector>& rotation) {
    read_line();
    const bool turns = !draft_.stands(triple_);
    const std::vector<Strip> strips = make_strips(read_air(turns ? rotation : std::nullopt));
    table_.finish();
    return strips;
  }

 private:
  using Column = StationColumns::Column;

  void read_line() {
    const std::string on = table_.text("on");
    read_extent();
    const auto beam = std::find_if(draft_.beams.begin(), draft_.beams.end(),
                                   [&](const BeamDraft& b) { return b.name == on; });
    if (beam != draft_.beams.end()) {
      triple_ = draft_.bodies[beam->first_body].triple;
      points_ = points_of_beam(draft_, *beam, read_strip_count(table_, points_on_element), extent_);
      return;
    }
    std::vector<std::string> names = names_of(draft_.beams);
    const std::vector<std::string> bodies = names_of(draft_.bodies);
    names.insert(names.end(), bodies.begin(), bodies.end());
    const std::size_t body = index_of(on, names, table_, "on", "beam, blade or body") - draft_.beams.size();
    triple_ = draft_.bodies[body].triple;
    const BodyLine line =
        read_body_line(draft_, table_, static_cast<int>(body), std::array{unit_vector(1), unit_vector(2)});
    points_ = points_of_body(draft_, line, read_strip_count(table_, points_on_body), extent_);
  }

  double constant(const std::string& key, const Expression& e, const std::string& expected) {
    if (!e.is_constant()) table_.fail(key, expected + ", found an expression of parameters");
    return e.value();
  }

  void read_extent() {
    if (!table_.has("extent")) return;
    const std::string expected = "expected two numbers from 0 to 1, the second one larger";
    const std::vector<Expression> ends = table_.list("extent");
    if (ends.size() != 2) table_.fail("extent", expected + "; found " + std::to_string(ends.size()));
    for (std::size_t i = 0; i < 2; ++i) extent_[i] = constant("extent", ends[i], expected);
    if (!(extent_[0] >= 0.0 && extent_[1] > extent_[0] && extent_[1] <= 1.0)) table_.fail("extent", expected);
  }

  /// What all strips have in common.
  Strip read_air(const std::optional<ExpressionVector>& rotation) {
    Strip common;
    const ExpressionVector wind = draft_.read_vector(table_, "wind", "m/s", Range::any, ExpressionVector{});
    if (rotation) check_wind(wind, *rotation);
    common.wind = draft_.vector(wind);
    common.angular_velocity = draft_.vector(rotation.value_or(ExpressionVector{}));
    common.density =
        draft_.quantity(draft_.read_number(table_, "density", "kg/m^3", Range::non_negative, 1.225));
    if (table_.has("speed_of_sound"))
      common.speed_of_sound =
          draft_.quantity(draft_.read_number(table_, "speed_of_sound", "m/s", Range::positive));
    if (table_.has("polar")) common.polar = read_polar();
    if (table_.has("inflow")) read_inflow_of(common);
    return common;
  }

  std::shared_ptr<const Polar> read_polar() {
    const CoefficientTable table = read_coefficient_table(
        draft_.scene, table_, "polar", 0.0,
        {"the angle of attack", "rad", {{"lift", ""}, {"drag", ""}, {"moment", ""}}, polar_degree});
    draft_.notes.emplace_back(table_.label() + " polar", table.in_words());
    return std::make_shared<const Polar>(Polar{table.find("lift"), table.find("drag"), table.find("moment")});
  }

  void read_inflow_of(Strip& common) {
    const std::string name = table_.text("inflow");
    if (draft_.is_left_out(Inflow::name)) return;
    InflowDraft& inflow = inflows_[index_of(name, names_of(inflows_), table_, "inflow", "[[inflow]]")];
    common.inflow = inflow.element.velocity;
    common.disc = inflow.disc;
    if (!inflow.annular) return;
    if (inflow.first_triple >= 0 && inflow.first_triple != triple_)
      table_.fail("inflow", "'" + name +
                                "' is annular and has the strips of one blade, on one beam or body, which "
                                "stand for those of all; these are on another one");
    inflow.first_triple = triple_;
    annular_ = &inflow;
  }

  /// A wind across the axis of a rotating frame turns in the frame, and there is no steady state.
  void check_wind(const ExpressionVector& wind, const ExpressionVector& rotation) {
    draft_.require(table_, "wind",
                   "must be parallel to [frame] angular_velocity, or it turns in the frame and there is no "
                   "steady state; it is not",
                   [&](std::size_t i) { return draft_.are_parallel(rotation, wind, 1e-12, i); });
  }

  std::vector<Strip> make_strips(const Strip& common) {
    StationColumns columns(draft_, table_, station_fields());
    const Column chord = columns.required("chord", "m", Range::positive);
    const Column quarter_chord = columns.optional("quarter_chord_y", "m");
    const Column incidence = columns.optional("incidence", "rad");
    for (const char* key : {"lift_slope", "zero_lift_angle"}) {
      if (common.polar && columns.has(key)) table_.fail(key, "is part of the polar; give one of them");
    }
    const Column slope = columns.optional("lift_slope", "1/rad", Range::any, 2.0 * std::numbers::pi);
    const Column zero_lift = columns.optional("zero_lift_angle", "rad");
    const Column drag = columns.optional("drag", "", Range::non_negative);
    const Column moment = columns.optional("moment", "");
    std::vector<Strip> strips;
    for (const SpanPoint& point : points_) {
      const auto at = [&](const Column& column) {
        Expression sum(0.0);
        for (const StationShare& share : station_shares(columns.span(), point.share))
          sum = sum + Expression(share.weight) * column[share.station];
        return sum;
      };
      const auto unless_absent = [&](const char* key, const Column& column) {
        return columns.has(key) ? draft_.quantity(at(column)) : Quantity();
      };
      Strip& strip = strips.emplace_back(common);
      const Expression angle = at(incidence);
      const Expression c = cos(angle), s = sin(angle);
      strip.quarter_chord = draft_.place_of(sum_of({{1.0, point.position}, {at(quarter_chord), point.y}}));
      strip.leading = draft_.place_of(sum_of({{c, point.y}, {s, point.z}}));
      strip.lift = draft_.place_of(sum_of({{c, point.z}, {Expression(0.0) - s, point.y}}));
      strip.width = draft_.quantity(point.width);
      strip.chord = draft_.quantity(at(chord));
      strip.lift_slope = draft_.quantity(at(slope));
      strip.zero_lift = unless_absent("zero_lift_angle", zero_lift);
      strip.drag = unless_absent("drag", drag);
      strip.moment = unless_absent("moment", moment);
      if (annular_ != nullptr) add_annulus(draft_, table_, *annular_, strip, point.width);
    }
    return strips;
  }

  Draft& draft_;
  TableReader& table_;
  std::vector<InflowDraft>& inflows_;
  InflowDraft* annular_ = nullptr;  ///< gives each strip an annulus; null: none
  int triple_ = 0;                  ///< the first one of what the strips are on
  std::vector<SpanPoint> points_;
  std::array<double, 2> extent_ = {0.0, 1.0};
};

/// The strips of a [[strips]] table.
struct StripTable {
  std::string name;
  std::vector<Strip> strips;

  /// Name of the strip with index i.
  std::string label(std::size_t i) const { return name + ", strip " + std::to_string(i + 1); }
};

/// Calls add(table, strips) for every table of a kind, with the tables of strips that it is for.
void for_each_of_strips(Draft& draft, std::string_view kind, const std::vector<StripTable>& all,
                        const std::function<void(TableReader&, const StripTable&)>& add) {
  const std::vector<std::string> names = names_of(all);
  std::vector<std::string> done;
  draft.for_each_table(kind, [&](TableReader& table, std::size_t) {
    const std::string name = table.has("strips") ? table.text("strips") : "";
    if (names.empty()) table.fail("strips", "the scene has no [[strips]]");
    if (!name.empty()) index_of(name, names, table, "strips", "[[strips]]");
    for (const StripTable& strips : all) {
      if (!name.empty() && strips.name != name) continue;
      if (std::find(done.begin(), done.end(), strips.name) != done.end())
        table.fail("strips", "'" + strips.name + "' has a [[" + std::string(kind) + "]] already");
      done.push_back(strips.name);
      add(table, strips);
    }
    table.finish();
  });
}

/// Shares or rates of the exponentials, pair by pair: each pair is an element of its own.
std::vector<std::array<Quantity, 2>> read_pairs(Draft& draft, TableReader& table, const std::string& key,
                                                Range range, const std::array<double, 2>& otherwise) {
  std::vector<Expression> values = {otherwise[0], otherwise[1]};
  if (table.has(key)) values = table.list(key, "");
  if (values.size() != 2 && values.size() != 4)
    table.fail(key, "expected two or four numbers, found " + std::to_string(values.size()));
  std::vector<std::array<Quantity, 2>> pairs;
  for (std::size_t i = 0; i < values.size(); i += 2) {
    for (const std::size_t k : {i, i + 1}) draft.check_range(table, key, values[k], range);
    pairs.push_back({draft.quantity(values[i]), draft.quantity(values[i + 1])});
  }
  return pairs;
}

std::vector<StripTable> read_strip_tables(Draft& draft, const std::optional<ExpressionVector>& rotation,
                                          std::vector<InflowDraft>& inflows) {
  std::vector<StripTable> result;
  draft.for_each_table(Strip::name, [&](TableReader& table, std::size_t i) {
    StripTable strips{label_of(table, Strip::name, i), {}};
    check_is_new(table, "[[strips]]", strips.name, names_of(result));
    strips.strips = StripReader(draft, table, inflows).read(rotation);
    result.push_back(std::move(strips));
  });
  return result;
}

void read_lift_lag(Draft& draft, const std::vector<StripTable>& all) {
  for_each_of_strips(draft, LiftLag::name, all, [&](TableReader& table, const StripTable& strips) {
    const auto shares = read_pairs(draft, table, "A", Range::any, {0.165, 0.335});
    const auto rates = read_pairs(draft, table, "b", Range::positive, {0.0455, 0.3});
    if (shares.size() != rates.size()) table.fail("b", "expected as many numbers as A has");
    // Lifts of pairs add up because lift is proportional to the downwash.
    if (shares.size() > 1 && strips.strips.front().polar)
      table.fail("A", "strips with a polar take two exponentials");
    for (std::size_t i = 0; i < strips.strips.size(); ++i) {
      for (std::size_t pair = 0; pair < shares.size(); ++pair)
        add_element(draft, LiftLag{strips.strips[i], shares[pair], rates[pair]},
                    strips.label(i) + (pair == 0 ? "" : ", more"));
    }
  });
}

void read_apparent_mass(Draft& draft, const std::vector<StripTable>& all) {
  for_each_of_strips(draft, ApparentMass::name, all, [&](TableReader&, const StripTable& strips) {
    for (std::size_t i = 0; i < strips.strips.size(); ++i) {
      ApparentMass mass{strips.strips[i]};
      mass.inflow = {};  // small beside the speed of the section
      add_element(draft, mass, strips.label(i));
    }
  });
}

}  // namespace

void read_air(Draft& draft, const std::optional<ExpressionVector>& rotation,
              std::vector<InflowDraft>& inflows) {
  const std::vector<StripTable> all = read_strip_tables(draft, rotation, inflows);
  for (const InflowDraft& inflow : inflows) {
    if (!inflow.annular) add_element(draft, inflow.element, inflow.name);
    for (std::size_t i = 0; i < inflow.annuli.size(); ++i)
      add_element(draft, inflow.annuli[i], inflow.label(i));
  }
  for (const StripTable& table : all) {
    for (std::size_t i = 0; i < table.strips.size(); ++i) add_element(draft, table.strips[i], table.label(i));
  }
  read_lift_lag(draft, all);
  read_apparent_mass(draft, all);
}

std::vector<FieldHelp> strips_fields() {
  std::vector<FieldHelp> fields = {
      {"on", "name of a beam, blade or body", "what the strips are on"},
      {"extent", "two numbers", "the part of it that has strips, as shares of its length", "[0, 1]"},
      {"strips", "", "number of strips: on each element of a beam, or on the body", "2; 4"},
      {"root", "[x, y, z] m", "on a body: where the strips begin, in the body's axes", "none"},
      {"tip", "[x, y, z] m", "on a body: where they end", "none"},
      {"leading", "[x, y, z]",
       "on a body: direction from trailing to leading edge; on a beam the y axis of the section",
       "[0, 1, 0]"},
      {"lift", "[x, y, z]", "on a body: direction of lift; on a beam the z axis of the section", "[0, 0, 1]"},
      {"wind", "[x, y, z] m/s", "velocity of the air; in a rotating frame parallel to its axis", "[0, 0, 0]"},
      {"density", "kg/m^3", "density of the air", "1.225"},
      {"speed_of_sound", "m/s", "lift and moment then have the factor of Prandtl and Glauert",
       "incompressible"},
      {"inflow", "name of an inflow", "the [[inflow]] of the rotor", "none"},
      {"polar", "text",
       "CSV file with the angle of attack, `alpha [deg]`, and columns lift, drag, moment: coefficients in "
       "place of lift_slope and zero_lift_angle",
       "none"}};
  for (FieldHelp& field : station_fields()) fields.push_back(std::move(field));
  return fields;
}

std::vector<FieldHelp> lift_lag_fields() {
  return {{"strips", "name of strips", "the strips whose lift lags", "all"},
          {"A", "two or four numbers", "shares of the exponentials in Wagner's function", "[0.165, 0.335]"},
          {"b", "as many numbers", "their rates, per half chord of way", "[0.0455, 0.3]"}};
}

std::vector<FieldHelp> apparent_mass_fields() {
  return {{"strips", "name of strips", "the strips that move air", "all"}};
}

}  // namespace eigentrail
