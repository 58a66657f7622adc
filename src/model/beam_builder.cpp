#include "model/beam_builder.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "model/beam_axis.hpp"

namespace eigentrail {
namespace {

/// Points per element and station at which the mass is integrated: exact for products of quadratic shape
/// functions with mass that is linear between stations, if elements are straight.
constexpr int mass_points = 2;
/// Least mass of a node, in proportion to what it has if each half of an element is shared linearly; two
/// thirds in a uniform beam. Less would be a node that moves in frequencies of its own, far above those of
/// the mesh.
constexpr double least_mass = 0.01;
constexpr int most_elements = 2000;

class BeamBuilder {
 public:
  BeamBuilder(Draft& draft, TableReader& table, const BeamDesign& design)
      : draft_(draft),
        table_(table),
        design_(design),
        axis_(beam_axis(design.sections, design.elements, design.degree, design.ends[0].position,
                        design.ends[1].position, design.y)) {}

  void build() {
    first_body_ = draft_.bodies.size();
    add_nodes();
    add_sections();
    hold(design_.ends[0], first_body_);
    hold(design_.ends[1], draft_.bodies.size() - 1);
  }

 private:
  std::string node_name(int i) const {
    if (i == 0) return design_.name + ".root";
    return design_.name + "." + (i == axis_.nodes() - 1 ? "tip" : std::to_string(i));
  }

  void add_nodes() {
    const std::vector<BeamTable::Mass> mass = nodal_masses();
    for (int i = 0; i < axis_.nodes(); ++i) {
      const auto index = static_cast<std::size_t>(i);
      const auto& taken = draft_.mass_names;
      if (std::find(taken.begin(), taken.end(), node_name(i)) != taken.end())
        table_.fail("name",
                    "a body or point is called '" + node_name(i) + "' already, like a node of this beam");
      const auto& [m, my, mz, yy, zz, yz] = mass[index];
      const Expression none(0.0);
      add_body(draft_, {node_name(i), 0, axis_.position[index], axis_.rotation[index], {}},
               {m, {none, my, mz}, {none, yy, zz, none, none, yz}});
    }
  }

  /// Every node has the integral of its shape function over the mass: the mass matrix is lumped. The errors
  /// of eigenvalues are of order 2 degree, as with the full matrix, since the nodes are those of
  /// Gauss-Lobatto quadrature (Fried & Malkus 1975). The parabola of an end node is negative on the far half
  /// of the element. Where the mass there outweighs its own, as at the thin tip of a blade, the node would
  /// have a negative mass, and modes of a passive beam would grow. A part of such elements is then shared
  /// linearly by the nodes of each half, which changes neither mass nor centre: as small a part as will do.
  std::vector<BeamTable::Mass> nodal_masses() const {
    std::vector<double> linear(static_cast<std::size_t>(axis_.elements), 0.0);
    const std::vector<BeamTable::Mass> masses = nodal_masses(linear);
    if (axis_.degree == 1) return masses;
    const std::vector<BeamTable::Mass> by_halves = nodal_masses(std::vector<double>(linear.size(), 1.0));
    for (int e = 0; e <= axis_.elements; ++e) {
      const std::size_t node = axis_.node(e, 0);
      const double least = least_ratio(masses[node], by_halves[node]);
      const double part = (least_mass - least) / (1.0 - least);
      for (int beside = std::max(e - 1, 0); beside <= std::min(e, axis_.elements - 1); ++beside) {
        double& of_element = linear[static_cast<std::size_t>(beside)];
        of_element = std::max(of_element, part);
      }
    }
    const bool positive = *std::max_element(linear.begin(), linear.end()) == 0.0;
    return positive ? masses : nodal_masses(linear);
  }

  /// Least eigenvalue of the moments of a node in proportion to others, wherever the request checks them.
  double least_ratio(const BeamTable::Mass& moments, const BeamTable::Mass& others) const {
    std::array<std::vector<double>, 6> own, scale;
    for (std::size_t k = 0; k < 6; ++k) {
      own[k] = draft_.check_values(moments[k]);
      scale[k] = draft_.check_values(others[k]);
    }
    const auto matrix = [](const std::array<std::vector<double>, 6>& at, std::size_t i) {
      const auto& [m, y, z, yy, zz, yz] = at;
      return Eigen::Matrix3d{{m[i], y[i], z[i]}, {y[i], yy[i], yz[i]}, {z[i], yz[i], zz[i]}};
    };
    double least = 1.0;
    for (std::size_t i = 0; i < own[0].size(); ++i) {
      // Directions without mass are in both; the same rounding is added to both.
      const Eigen::Vector3d size = matrix(scale, i).diagonal().cwiseSqrt();
      const Eigen::Vector3d unit = (size.array() > 0.0).select(size.cwiseInverse(), 1.0);
      const auto scaled = [&](const auto& at) -> Eigen::Matrix3d {
        return Eigen::Matrix3d(unit.asDiagonal() * matrix(at, i) * unit.asDiagonal()) +
               1e-12 * Eigen::Matrix3d::Identity();
      };
      const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled(own), scaled(scale),
                                                                             Eigen::EigenvaluesOnly);
      least = std::min(least, solver.eigenvalues()[0]);
    }
    return least;
  }

  /// Shares of the nodes of an element in the mass at xi, of which `linear` is shared by halves.
  std::vector<double> mass_shares(double xi, double linear) const {
    std::vector<double> shares = shape_functions(axis_.degree, xi).value;
    if (linear == 0.0) return shares;
    const double from_middle = 2.0 * xi - 1.0;
    const std::array by_halves = {std::max(0.0, -from_middle), 1.0 - std::abs(from_middle),
                                  std::max(0.0, from_middle)};
    for (std::size_t a = 0; a < 3; ++a) shares[a] += linear * (by_halves[a] - shares[a]);
    return shares;
  }

  std::vector<BeamTable::Mass> nodal_masses(const std::vector<double>& linear) const {
    std::vector<std::vector<double>> share(static_cast<std::size_t>(axis_.nodes()),
                                           std::vector<double>(design_.sections.span.size(), 0.0));
    std::vector<BeamTable::Mass> result(static_cast<std::size_t>(axis_.nodes()));
    for (int e = 0; e < axis_.elements; ++e) {
      for_each_mass_point(e, [&](double xi, double weight) {
        const std::vector<double> of_node = mass_shares(xi, linear[static_cast<std::size_t>(e)]);
        const Expression stretch =
            axis_.straight ? Expression(1.0) : axis_.stretch(e, shape_functions(axis_.degree, xi));
        for (std::size_t a = 0; a < of_node.size(); ++a) {
          for (const auto& [station, part] : design_.sections.shares((e + xi) / axis_.elements)) {
            const double w = weight * of_node[a] * part;
            if (axis_.straight)
              share[axis_.node(e, a)][station] += w;
            else
              add(result[axis_.node(e, a)], Expression(w) * stretch, design_.sections.mass[station]);
          }
        }
      });
    }
    if (!axis_.straight) return result;
    const Expression length = Expression(1.0 / axis_.elements) * axis_.length;
    for (std::size_t i = 0; i < result.size(); ++i) {
      for (std::size_t k = 0; k < share[i].size(); ++k)
        add(result[i], Expression(share[i][k]) * length, design_.sections.mass[k]);
    }
    return result;
  }

  static void add(BeamTable::Mass& sum, const Expression& weight, const BeamTable::Mass& moments) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + weight * moments[i];
  }

  /// Calls visit(xi, weight) for the points of the parts of an element between stations.
  void for_each_mass_point(int e, auto visit) const {
    std::vector<double> ends = {0.0};
    for (const double s : design_.sections.span) {
      const double xi = s * axis_.elements - e;
      if (xi > 1e-9 && xi < 1.0 - 1e-9) ends.push_back(xi);
    }
    ends.push_back(1.0);
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double width = ends[i] - ends[i - 1];
      for (const auto& [at, weight] : gauss_points(mass_points))
        visit(ends[i - 1] + at * width, weight * width);
    }
  }

  /// One fewer quadrature points than nodes: the lowest number that leaves no deformation without strain. The
  /// interpolation then has as many constraints as it can meet when the beam is slender, and does not lock
  /// (Noor & Peters 1981).
  void add_sections() {
    draft_.beams.push_back(
        {design_.name, design_.damping_times, first_body_, std::make_shared<const BeamAxis>(axis_)});
    for (int e = 0; e < axis_.elements; ++e) {
      for (const auto& [xi, weight] : gauss_points(axis_.degree)) add_section(e, xi, weight);
    }
  }

  void add_section(int e, double xi, double weight) {
    const ShapeFunctions shape = shape_functions(axis_.degree, xi);
    const Expression stretch = axis_.stretch(e, shape);
    std::vector<Expression> values(shape.value.begin(), shape.value.end());
    std::vector<Expression> slopes;
    for (const double slope : shape.slope) slopes.push_back(Expression(slope) / stretch);
    BeamSection section;
    const std::vector<Quantity> value_weights = quantities(values);
    const std::vector<Quantity> slope_weights = quantities(slopes);
    section.slope = interpolated(e, slope_weights, 0);
    for (int i = 0; i < 3; ++i) {
      section.directors[static_cast<std::size_t>(i)] = interpolated(e, value_weights, i + 1);
      section.rates[static_cast<std::size_t>(i)] = interpolated(e, slope_weights, i + 1);
    }
    section.width = draft_.quantity(Expression(weight) * stretch);
    set_stiffness(section, (e + xi) / axis_.elements);
    set_unloaded(section, e, values, slopes);
    draft_.beams.back().sections.push_back(std::move(section));
  }

  std::vector<Quantity> quantities(const std::vector<Expression>& expressions) {
    std::vector<Quantity> result;
    for (const Expression& e : expressions) result.push_back(draft_.quantity(e));
    return result;
  }

  /// Sum over the nodes of an element of weights times one of their four triples.
  Place interpolated(int e, const std::vector<Quantity>& weights, int triple) const {
    Place place;
    for (std::size_t a = 0; a < weights.size(); ++a)
      place.terms.push_back({draft_.bodies[first_body_ + axis_.node(e, a)].triple + triple, weights[a]});
    return place;
  }

  void set_stiffness(BeamSection& section, double s) {
    BeamTable::Stiffness S;
    for (const auto& [station, part] : design_.sections.shares(s)) {
      for (std::size_t i = 0; i < section_entries; ++i)
        S[i] = S[i] + Expression(part) * design_.sections.stiffness[station][i];
    }
    for (std::size_t i = 0; i < section_entries; ++i) {
      section.stiffness[i] = draft_.quantity_unless_zero(S[i]);
    }
  }

  /// Strains of the nodes where the scene gives them, so that the beam there is free of stress.
  void set_unloaded(BeamSection& section, int e, const std::vector<Expression>& values,
                    const std::vector<Expression>& slopes) {
    if (axis_.straight && !axis_.twisted) {
      section.unloaded[0] = draft_.quantity(1.0);
      return;
    }
    ExpressionVector along;
    ExpressionRotation directors, rates;
    for (std::size_t a = 0; a < values.size(); ++a) {
      along = along + slopes[a] * axis_.local_position[axis_.node(e, a)];
      for (std::size_t i = 0; i < 3; ++i) {
        directors[i] = directors[i] + values[a] * axis_.local_rotation[axis_.node(e, a)][i];
        rates[i] = rates[i] + slopes[a] * axis_.local_rotation[axis_.node(e, a)][i];
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      section.unloaded[i] = draft_.quantity(dot(directors[i], along));
      section.unloaded[3 + i] =
          draft_.quantity(Expression(0.5) * (dot(directors[k], rates[j]) - dot(directors[j], rates[k])));
    }
  }

  /// Welds a node to what holds the end.
  void hold(const BeamEnd& end, std::size_t node) {
    if (!end.clamped) return;
    const BodyDraft& body = draft_.bodies[node];
    const Place origin = draft_.point_place(body.triple);
    std::vector<ConstraintRow> rows;
    for (int i = 0; i < 3; ++i) rows.push_back({{origin, end.place}, {}, i, draft_.quantity(0.0)});
    const ExpressionRotation axes = body.rotation;
    for (std::size_t i = 0; i < 3; ++i) {
      const Place fixed = draft_.direction_on(end.carrier, draft_.in_axes_of(end.carrier, axes[i]));
      const Place next = draft_.point_place(body.triple + 1 + static_cast<int>((i + 1) % 3));
      rows.push_back({{next, {}}, Difference{fixed, {}}, 0, draft_.quantity(0.0)});
    }
    draft_.add_constraint("weld", body.name + " weld", std::move(rows));
  }

  Draft& draft_;
  TableReader& table_;
  const BeamDesign& design_;
  BeamAxis axis_;
  std::size_t first_body_ = 0;
};

}  // namespace

std::string read_beam_name(Draft& draft, TableReader& table) {
  std::vector<std::string> taken = names_of(draft.beams);
  taken.insert(taken.end(), draft.mass_names.begin(), draft.mass_names.end());
  return read_name(table, "beam, body or point", taken);
}

void read_elements(TableReader& table, BeamDesign& design) {
  if (table.has("elements")) design.elements = table.whole_number("elements", 1, most_elements);
  if (table.has("degree")) design.degree = table.whole_number("degree", 1, 2);
}

std::array<FieldHelp, 2> element_fields() {
  return {FieldHelp{"elements", "", "number of elements, 1 to " + std::to_string(most_elements), "10"},
          FieldHelp{"degree", "",
                    "2: three nodes per element, errors of fourth order; 1: two nodes, second order", "2"}};
}

void add_beam(Draft& draft, TableReader& table, const BeamDesign& design) {
  BeamBuilder(draft, table, design).build();
}

}  // namespace eigentrail
