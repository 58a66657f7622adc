#include "model/read_blades.hpp"

#include "model/beam_builder.hpp"
#include "model/first_frequency.hpp"
#include "model/read_beams.hpp"

namespace eigentrail {
namespace {

class BladeReader {
 public:
  BladeReader(Draft& draft, TableReader& table) : draft_(draft), table_(table) {}

  BeamDesign read() {
    BeamDesign design;
    design.name = read_beam_name(draft_, table_);
    read_hub();
    const Expression length = draft_.read_number(table_, "length", "m", Range::positive);
    place(design, length);
    read_elements(table_, design);
    design.sections = read_beam_table(draft_, table_, length);
    check_root(design.sections);
    design.damping_times = read_damping(design.sections, length);
    table_.finish();
    return design;
  }

 private:
  void read_hub() {
    if (table_.has("hub")) {
      hub_ = draft_.read_place(table_, "hub", &carrier_);
    } else {
      hub_ = draft_.fixed_place({0.0, 0.0, 0.0});
    }
    if (carrier_.point >= 0)
      table_.fail("hub", "a point has no orientation; a blade needs a body or a fixed place");
    axis_ = normalized(direction("axis", 2));
    const ExpressionVector along = direction("along", 0);
    const ExpressionVector across = cross(axis_, along);
    draft_.require(table_, "along", "must not be parallel to axis; it is", [&](std::size_t i) {
      return draft_.vector_at(across, i).norm() > 1e-9 * draft_.vector_at(along, i).norm();
    });
    tangent_ = normalized(across);
    radial_ = cross(tangent_, axis_);
  }

  /// In the frame, at the starting guess. By default an axis of the hub.
  ExpressionVector direction(const std::string& key, std::size_t usual) {
    if (!table_.has(key)) return draft_.in_frame(carrier_, unit_vector(usual));
    Carrier carrier;
    const ExpressionVector along = draft_.read_direction(table_, key, carrier);
    return draft_.in_frame(carrier, along);
  }

  Expression angle(const std::string& key) { return draft_.read_number(table_, key, "rad", Range::any, 0.0); }

  /// Turns about the rotor axis by the azimuth, out of the plane of the rotor by the precone, and about the
  /// axis of the blade by the pitch.
  void place(BeamDesign& design, const Expression& length) {
    const Expression hub_radius = draft_.read_number(table_, "hub_radius", "m", Range::non_negative);
    const Expression azimuth = angle("azimuth");
    const Expression precone = angle("precone");
    const Expression pitch = angle("pitch");
    const ExpressionVector radial = cos(azimuth) * radial_ + sin(azimuth) * tangent_;
    const ExpressionVector tangent = cos(azimuth) * tangent_ - sin(azimuth) * radial_;
    const ExpressionVector along = cos(precone) * radial + sin(precone) * axis_;
    const ExpressionVector up = cos(precone) * axis_ - sin(precone) * radial;
    design.y = cos(pitch) * tangent + sin(pitch) * up;
    const ExpressionVector root = position_of(draft_, hub_) + hub_radius * along;
    const ExpressionVector tip = root + length * along;
    design.ends = {end("hub", root, carrier_, true), end("length", tip, {}, false)};
  }

  BeamEnd end(const std::string& key, const ExpressionVector& position, const Carrier& carrier,
              bool clamped) {
    BeamEnd result{key, {}, carrier, position, clamped};
    if (carrier.is_frame()) {
      result.place = draft_.fixed_place(position);
    } else {
      const BodyDraft& body = draft_.bodies[static_cast<std::size_t>(carrier.body)];
      result.place = draft_.on_body(carrier.body, turned_back(body.rotation, position - body.position));
    }
    return result;
  }

  /// The axis of a curved blade begins on the axis of pitch.
  void check_root(const BeamTable& sections) {
    for (const auto& [key, values] : {std::pair("sweep", &sections.sweep), {"prebend", &sections.prebend}}) {
      if (!is_number(values->front(), 0.0))
        table_.fail(table_.has(key) ? key : "file",
                    std::string(key) + " must be 0 at the first station, where the blade meets the hub");
    }
  }

  std::vector<Expression> read_damping(const BeamTable& sections, const Expression& length) {
    std::vector<Expression> times(6, Expression(0.0));
    bool any = false;
    for (const auto& [key, motion, strains] :
         {std::tuple("damping_flap", BladeMotion::flap, std::array{2, 4}),
          std::tuple("damping_lag", BladeMotion::lag, std::array{1, 5}),
          std::tuple("damping_torsion", BladeMotion::torsion, std::array{3, 3})}) {
      if (!table_.has(key)) continue;
      any = true;
      const Expression ratio = draft_.read_number(table_, key, "", Range::non_negative);
      check_time(draft_, table_, key, ratio, true);
      const Expression time = Expression(2.0) * ratio / first_frequency(draft_, sections, length, motion);
      for (const int strain : strains) times[static_cast<std::size_t>(strain)] = time;
    }
    return any ? times : std::vector<Expression>();
  }

  Draft& draft_;
  TableReader& table_;
  Place hub_;
  Carrier carrier_;
  ExpressionVector axis_, radial_, tangent_;
};

}  // namespace

void read_blades(Draft& draft) {
  draft.for_each_table("blade", [&](TableReader& table, std::size_t) {
    add_beam(draft, table, BladeReader(draft, table).read());
  });
}

std::vector<FieldHelp> blade_fields() {
  const auto [elements, degree] = element_fields();
  std::vector<FieldHelp> fields = {
      {"name", "text", "its nodes are the bodies NAME.root, NAME.1, NAME.2, ..., NAME.tip"},
      {"hub", "place", "centre of the hub: of a body, to which the root is welded, or fixed", "[0, 0, 0]"},
      {"axis", "direction", "of the rotor; flap is motion along it", "z axis of the hub"},
      {"along", "direction", "of the blade at azimuth 0, as far as it is normal to the axis",
       "x axis of the hub"},
      {"hub_radius", "m", "from the centre of the hub to the root, along the blade"},
      {"length", "m", "from root to tip, along the axis of pitch"},
      {"azimuth", "rad", "turns the blade about the axis", "0"},
      {"precone", "rad", "turns its tip towards the axis", "0"},
      {"pitch", "rad", "turns all sections, y towards z, leading edge up", "0"},
      elements,
      degree,
      {"damping_flap", "",
       "ratio of the first flap mode at rest, without twist: bending about y and shear along z have stresses "
       "in proportion to stiffness times strain rate",
       "0"},
      {"damping_lag", "", "likewise of the first lag mode", "0"},
      {"damping_torsion", "", "likewise of the first torsion mode", "0"}};
  for (FieldHelp& field : beam_table_fields(true)) fields.push_back(std::move(field));
  return fields;
}

}  // namespace eigentrail
