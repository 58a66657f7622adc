// Reads [[body]]: mass, inertia, position, orientation, markers.
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "model/draft.hpp"

namespace eigentrail {
namespace {

/// Rotation about the unit axis k by Rodrigues' formula: R v = cos v + sin (k x v) + (1 - cos) (k . v) k.
ExpressionRotation about_axis(const ExpressionVector& k, const Expression& angle) {
  const Expression c = cos(angle);
  const Expression s = sin(angle);
  ExpressionRotation R;
  for (std::size_t i = 0; i < 3; ++i) {
    const ExpressionVector e = unit_vector(i);
    R[i] = c * e + s * cross(k, e) + ((Expression(1.0) - c) * k[i]) * k;
  }
  return R;
}

ExpressionRotation product(const ExpressionRotation& a, const ExpressionRotation& b) {
  return {turned(a, b[0]), turned(a, b[1]), turned(a, b[2])};
}

ExpressionRotation read_axis_angle(Draft& draft, TableReader table) {
  const ExpressionVector axis = table.vector("axis");
  const Expression angle = table.expression("angle", "rad");
  draft.check_range(table, "axis", axis, Range::positive);
  draft.check_range(table, "angle", angle, Range::any);
  table.finish();
  return about_axis(normalized(axis), angle);
}

/// Three successive rotations, each about an axis of the body as rotated by the ones before (intrinsic).
ExpressionRotation read_euler(Draft& draft, TableReader table) {
  const std::string sequence = table.text("sequence");
  const ExpressionVector angles = draft.read_vector(table, "angles", "rad", Range::any);
  table.finish();
  const auto is_axis = [](char c) { return c >= 'x' && c <= 'z'; };
  if (sequence.size() != 3 || !std::all_of(sequence.begin(), sequence.end(), is_axis) ||
      sequence[0] == sequence[1] || sequence[1] == sequence[2]) {
    table.fail("sequence",
               "expected three axes, no two neighbours alike, such as \"zyx\" or \"zxz\"; found \"" +
                   sequence + "\"");
  }
  ExpressionRotation R = no_rotation();
  for (std::size_t i = 0; i < 3; ++i) {
    R = product(R, about_axis(unit_vector(static_cast<std::size_t>(sequence[i] - 'x')), angles[i]));
  }
  return R;
}

/// Orientation from two of the axes. The first one is met exactly; of the second, the part normal to the
/// first is used.
ExpressionRotation read_axes(Draft& draft, TableReader& table, const std::vector<std::size_t>& given) {
  const std::array<std::string, 3> keys = {"x_axis", "y_axis", "z_axis"};
  std::array<ExpressionVector, 2> axes;
  for (std::size_t i = 0; i < 2; ++i) {
    axes[i] = draft.read_vector(table, keys[given[i]], any_unit, Range::positive);
  }
  draft.require(table, keys[given[1]], "must not be parallel to " + keys[given[0]] + "; it is",
                [&](std::size_t i) { return !draft.are_parallel(axes[0], axes[1], 1e-9, i); });
  const ExpressionVector first = normalized(axes[0]);
  const ExpressionVector second = normalized(axes[1] - dot(axes[1], first) * first);
  const std::size_t last = 3 - given[0] - given[1];
  const bool cyclic = given[1] == (given[0] + 1) % 3;
  ExpressionRotation R;
  R[given[0]] = first;
  R[given[1]] = second;
  R[last] = cyclic ? cross(first, second) : cross(second, first);
  return R;
}

ExpressionRotation read_orientation(Draft& draft, TableReader& table) {
  const bool axis_angle = table.has("axis_angle");
  const bool euler = table.has("euler");
  std::vector<std::size_t> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    if (table.has(std::string(1, "xyz"[i]) + "_axis")) axes.push_back(i);
  }
  const int ways = static_cast<int>(axis_angle) + static_cast<int>(euler) + static_cast<int>(!axes.empty());
  if (ways > 1 || axes.size() == 1 || axes.size() == 3) {
    table.fail(axes.empty() ? "euler" : std::string(1, "xyz"[axes[0]]) + "_axis",
               "an orientation is given once: axis_angle, euler, or two of x_axis, y_axis, z_axis");
  }
  if (axis_angle) return read_axis_angle(draft, table.table("axis_angle"));
  if (euler) return read_euler(draft, table.table("euler"));
  return axes.empty() ? no_rotation() : read_axes(draft, table, axes);
}

using ExpressionMatrix = std::array<std::array<Expression, 3>, 3>;

/// Reads [Ixx, Iyy, Izz] or a symmetric matrix, about the centre of mass in body axes.
ExpressionMatrix read_inertia(Draft& draft, TableReader& table) {
  ExpressionMatrix J;
  if (!table.has("inertia")) return J;
  const auto rows = table.matrix("inertia", "kg m^2");
  const bool diagonal = rows.size() == 1 && rows[0].size() == 3;
  const bool full = rows.size() == 3 &&
                    std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.size() == 3; });
  if (!diagonal && !full) table.fail("inertia", "expected [Ixx, Iyy, Izz] or a 3 x 3 matrix");
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (full) J[i][j] = rows[i][j];
      if (diagonal && i == j) J[i][i] = rows[0][i];
      draft.check_range(table, "inertia", J[i][j], Range::any);
    }
  }
  return J;
}

/// Checks the inertia. A mass distribution has positive semidefinite second moments tr(J)/2 - J: each
/// principal moment of inertia is at most the sum of the other two.
void check_inertia(const Draft& draft, const TableReader& table, const ExpressionMatrix& J) {
  for (std::size_t k = 0; k < draft.request.check_at.size(); ++k) {
    Eigen::Matrix3d inertia;
    for (std::size_t i = 0; i < 3; ++i) {
      inertia.row(static_cast<Eigen::Index>(i)) = draft.vector_at(J[i], k).transpose();
    }
    const double scale = inertia.cwiseAbs().maxCoeff();
    if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > 1e-12 * scale) {
      table.fail("inertia", "must be symmetric; it is not" + Draft::where_on_trace(k));
    }
    const Eigen::Matrix3d second = 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(second),
                                                                Eigen::EigenvaluesOnly);
    if (solver.eigenvalues()[0] >= -1e-12 * scale) continue;
    table.fail("inertia", "no body has it: one principal moment exceeds the sum of the other two" +
                              Draft::where_on_trace(k));
  }
}

/// Moments G of a body about its origin.
BodyMoments moments_of(const Expression& mass, const ExpressionVector& centre, const ExpressionMatrix& J) {
  BodyMoments moments{mass, {}, {}};
  const Expression half_trace = Expression(0.5) * (J[0][0] + J[1][1] + J[2][2]);
  for (std::size_t i = 0; i < 3; ++i) {
    moments.first[i] = mass * centre[i];
    moments.second[i] = half_trace - J[i][i] + mass * centre[i] * centre[i];
  }
  const std::array<std::array<std::size_t, 2>, 3> mixed = {{{0, 1}, {0, 2}, {1, 2}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [i, j] = mixed[k];
    moments.second[3 + k] = mass * centre[i] * centre[j] - J[i][j];
  }
  return moments;
}

void read_markers(Draft& draft, TableReader& table, BodyDraft& body, const ExpressionVector& centre) {
  body.markers["centre"] = centre;
  if (!table.has("markers")) return;
  TableReader markers = table.table("markers");
  for (const std::string& name : markers.keys()) {
    if (name == "centre") markers.fail(name, "is the centre of mass already; choose another name");
    body.markers[name] = draft.read_vector(markers, name, "m", Range::any);
  }
}

void add_directors(Draft& draft, int body) {
  const std::array<Place, 3> d = draft.directors(body);
  std::vector<ConstraintRow> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      rows.push_back({{d[i], {}}, Difference{d[j], {}}, 0, draft.quantity(i == j ? 1.0 : 0.0)});
    }
  }
  draft.add_constraint("directors", draft.bodies[static_cast<std::size_t>(body)].name + ".directors",
                       std::move(rows));
}

}  // namespace

void add_body(Draft& draft, BodyDraft body, const BodyMoments& moments) {
  body.triple = static_cast<int>(draft.guess.size()) / 3;
  MassDistribution& masses = draft.masses.emplace_back();
  masses.size = 4;
  for (int i = 0; i < 4; ++i)
    masses.carriers[static_cast<std::size_t>(i)] = draft.point_place(body.triple + i);
  masses.mass = draft.quantity_unless_zero(moments.mass);
  for (std::size_t i = 0; i < 3; ++i) masses.first[i] = draft.quantity_unless_zero(moments.first[i]);
  for (std::size_t i = 0; i < 6; ++i) masses.second[i] = draft.quantity_unless_zero(moments.second[i]);
  for (const Expression& e : body.position) draft.guess.push_back(e);
  for (const ExpressionVector& director : body.rotation) {
    for (const Expression& e : director) draft.guess.push_back(e);
  }
  draft.mass_names.push_back(body.name);
  draft.bodies.push_back(std::move(body));
  add_directors(draft, static_cast<int>(draft.bodies.size()) - 1);
}

void read_bodies(Draft& draft) {
  draft.for_each_table("body", [&](TableReader& table, std::size_t) {
    BodyDraft body;
    body.name = read_name(table, "body or point", draft.mass_names);
    const Expression mass = draft.read_number(table, "mass", "kg", Range::non_negative);
    const ExpressionVector centre = draft.read_vector(table, "centre", "m", Range::any, ExpressionVector{});
    const ExpressionMatrix J = read_inertia(draft, table);
    check_inertia(draft, table, J);
    body.position = draft.read_guess(table, "position");
    body.rotation = read_orientation(draft, table);
    read_markers(draft, table, body, centre);
    table.finish();
    add_body(draft, std::move(body), moments_of(mass, centre, J));
  });
}

}  // namespace eigentrail
