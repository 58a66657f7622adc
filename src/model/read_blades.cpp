#include "model/readers.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "model/beam_axis.hpp"
#include "model/beam_builder.hpp"

namespace eigentrail {
namespace {

enum class BladeMotion { flap, lag, torsion };

constexpr int shapes = 6;
/// Exact for squares of the shapes times properties that are linear between stations.
constexpr int points_between_stations = 8;

/// What resists the motion at a station: the stiffness of bending without axial force, or of twist.
Expression stiffness_at(const BeamTable::Stiffness& S, BladeMotion motion) {
  if (motion == BladeMotion::torsion) return S[section_entry(3, 3)];
  const std::size_t bending = motion == BladeMotion::flap ? 4 : 5;
  const Expression& coupling = S[section_entry(bending, 0)];
  return S[section_entry(bending, bending)] - coupling * coupling / S[section_entry(0, 0)];
}

Expression inertia_at(const BeamTable::Mass& mass, BladeMotion motion) {
  return motion == BladeMotion::torsion ? mass[3] + mass[4] : mass[0];
}

/// Shape k at s: s^p, and its strain, the derivative that bending or twist is.
struct RitzShape {
  double value = 0.0, strain = 0.0;
};
RitzShape ritz_shape(int k, double s, BladeMotion motion) {
  const int order = motion == BladeMotion::torsion ? 1 : 2;
  const int power = k + order;
  const double factor = order == 1 ? power : power * (power - 1.0);
  return {std::pow(s, power), factor * std::pow(s, power - order)};
}

/// Angular frequency (rad/s) of the first mode of a straight cantilever of that length in one motion alone:
/// at rest, without twist, shear and inertia of the sections in bending. It is the Rayleigh quotient of the
/// shape that the Ritz method finds at the first of the points that the scene is checked at, in polynomials
/// up to the sixth power of the span for torsion and the seventh for bending. The quotient is stationary in
/// the shape, so its derivatives by the parameters are those of the frequency.
Expression first_frequency(const Draft& draft, const BeamTable& table, const Expression& length,
                           BladeMotion motion) {
  std::vector<Expression> stiffness, inertia;
  for (const BeamTable::Stiffness& S : table.stiffness) stiffness.push_back(stiffness_at(S, motion));
  for (const BeamTable::Mass& mass : table.mass) inertia.push_back(inertia_at(mass, motion));
  std::vector<double> ends = table.span;
  if (ends.size() == 1) ends = {0.0, 1.0};

  // Of each station: integrals of products of shapes, weighted with its share.
  std::vector<Eigen::MatrixXd> K(stiffness.size(), Eigen::MatrixXd::Zero(shapes, shapes)), M = K;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    for (const auto& [at, weight] : gauss_points(points_between_stations)) {
      const double width = ends[i] - ends[i - 1];
      const double s = ends[i - 1] + at * width;
      Eigen::VectorXd value(shapes), strain(shapes);
      for (int k = 0; k < shapes; ++k) {
        const RitzShape one = ritz_shape(k, s, motion);
        value[k] = one.value;
        strain[k] = one.strain;
      }
      for (const auto& [station, part] : table.shares(s)) {
        K[station] += weight * width * part * strain * strain.transpose();
        M[station] += weight * width * part * value * value.transpose();
      }
    }
  }

  Eigen::MatrixXd K_sum = Eigen::MatrixXd::Zero(shapes, shapes), M_sum = K_sum;
  for (std::size_t i = 0; i < K.size(); ++i) {
    K_sum += draft.check_values(stiffness[i]).front() * K[i];
    M_sum += draft.check_values(inertia[i]).front() * M[i];
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K_sum, M_sum);
  const Eigen::VectorXd first = solver.eigenvectors().col(0);
  Expression strain_energy(0.0), kinetic(0.0);
  for (std::size_t i = 0; i < K.size(); ++i) {
    strain_energy = strain_energy + Expression(first.dot(K[i] * first)) * stiffness[i];
    kinetic = kinetic + Expression(first.dot(M[i] * first)) * inertia[i];
  }
  const Expression per_length = motion == BladeMotion::torsion ? length : length * length;
  return sqrt(strain_energy / kinetic) / per_length;
}

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
    const ExpressionVector root = draft_.at_guess(hub_) + hub_radius * along;
    const ExpressionVector tip = root + length * along;
    design.ends = {end(root, carrier_, true), end(tip, {}, false)};
  }

  BeamEnd end(const ExpressionVector& position, const Carrier& carrier, bool clamped) {
    BeamEnd result{{}, carrier, position, clamped};
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
