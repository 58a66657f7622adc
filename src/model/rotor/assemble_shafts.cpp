// Adds the matrices of the shafts' elements.
//
// The equations are those of a frame that does not rotate. With u and t as displacement and slope in either
// plane, t = ry in the plane of x and t = -rx in that of y, a section's angular momentum 2 N Omega turns with
// it:
//
//   M u_x'' + 2 Omega N u_y' + K u_x = 0,   M u_y'' - 2 Omega N u_x' + K u_y = 0
//
// Damping of the rotating material, -eta K (d/dt in the shaft's own frame), adds eta K to C in both planes,
// and
// + Omega eta K u_y, - Omega eta K u_x: forces without a potential.

#include "model/rotor/rotor_draft.hpp"

namespace eigentrail {
namespace {

/// The freedoms of an element in a plane, and the sign with which rotations enter.
struct ElementPlane {
  std::array<Eigen::Index, 6> coordinates;
  double sign;

  double at(std::size_t i) const { return i % 2 == 1 ? sign : 1.0; }
};

void add_block(MatrixSum& to, const ElementPlane& rows, const ElementPlane& columns,
               const ElementMatrix& entries, const Expression& factor, double value) {
  if (is_number(factor, 0.0)) return;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j)
      to.add_product(rows.coordinates[i], columns.coordinates[j], factor, entries[i][j],
                     value * rows.at(i) * columns.at(j));
  }
}

/// An element between two nodes along one freedom: stiffness k [1, -1; -1, 1], inertia m [2, 1; 1, 2] / 6.
void add_rod(RotorDraft& rotor, const ShaftDraft& shaft, const NodeCoordinates& left,
             const NodeCoordinates& right, NodeFreedom freedom, const Expression& stiffness,
             const Expression& inertia) {
  const std::array<Eigen::Index, 2> at = {left[freedom], right[freedom]};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const double sign = i == j ? 1.0 : -1.0, share = i == j ? 1.0 / 3.0 : 1.0 / 6.0;
      rotor.sum(RotorEffect::shaft).K.add(at[i], at[j], stiffness, sign);
      rotor.sum(RotorEffect::shaft_mass).M.add(at[i], at[j], inertia, share);
      MatrixSum& damping = rotor.sum(RotorEffect::shaft_damping).C;
      damping.add_product(at[i], at[j], shaft.alpha, inertia, share);
      damping.add_product(at[i], at[j], shaft.beta, stiffness, sign);
      rotor.sum(RotorEffect::internal_damping).C.add_product(at[i], at[j], shaft.internal, stiffness, sign);
    }
  }
}

/// What all elements of a segment have in common.
struct SegmentMatrices {
  ElementMatrix stiffness, inertia, rotation;
  Expression axial_stiffness, axial_inertia, torsional_stiffness, torsional_inertia;
};

SegmentMatrices matrices_of(const ShaftDraft& shaft, const ShaftSegment& segment) {
  const Expression shear =
      shaft.shear ? *shaft.shear : cowper_shear_coefficient(shaft.nu, segment.outer, segment.inner);
  const ShaftPiece piece{segment.length / Expression(static_cast<double>(segment.elements)),
                         segment.outer,
                         segment.inner,
                         shaft.E,
                         shaft.G,
                         shaft.density,
                         shear};
  const ShaftMatrices<PlaneMatrix> ends = end_matrices(piece);
  const ShaftMatrices<InnerRows> inner = shaft.refined ? inner_matrices(piece) : ShaftMatrices<InnerRows>();
  const Expression polar = Expression(2.0) * piece.second_moment();
  const ElementMatrix rotation = element_matrix(ends.rotation, inner.rotation);
  return {element_matrix(ends.stiffness, inner.stiffness),
          element_matrix(ends.translation, inner.translation) + rotation,
          rotation,
          shaft.E * piece.area() / piece.length,
          shaft.density * piece.area() * piece.length,
          shaft.G * polar / piece.length,
          shaft.density * polar * piece.length};
}

void add_element(RotorDraft& rotor, const ShaftDraft& shaft, const SegmentMatrices& element,
                 std::size_t node) {
  const NodeCoordinates &left = shaft.nodes[node], &right = shaft.nodes[node + 1];
  InnerCoordinates inner{-1, -1, -1, -1};
  if (shaft.refined) inner = shaft.inner[node];
  const ElementPlane x{
      {left[along_x], left[about_y], right[along_x], right[about_y], inner[along_x], inner[about_y]}, 1.0};
  const ElementPlane y{
      {left[along_y], left[about_x], right[along_y], right[about_x], inner[along_y], inner[about_x]}, -1.0};
  PencilSum& damping = rotor.sum(RotorEffect::shaft_damping);
  PencilSum& internal = rotor.sum(RotorEffect::internal_damping);
  for (const ElementPlane* plane : {&x, &y}) {
    add_block(rotor.sum(RotorEffect::shaft_mass).M, *plane, *plane, element.inertia, 1.0, 1.0);
    add_block(rotor.sum(RotorEffect::shaft).K, *plane, *plane, element.stiffness, 1.0, 1.0);
    add_block(damping.C, *plane, *plane, element.inertia, shaft.alpha, 1.0);
    add_block(damping.C, *plane, *plane, element.stiffness, shaft.beta, 1.0);
    add_block(internal.C, *plane, *plane, element.stiffness, shaft.internal, 1.0);
  }
  MatrixSum& gyroscopic = rotor.sum(RotorEffect::gyroscopic).C;
  add_block(gyroscopic, x, y, element.rotation, shaft.speed, 2.0);
  add_block(gyroscopic, y, x, element.rotation, shaft.speed, -2.0);
  const Expression circulatory = shaft.speed * shaft.internal;
  add_block(internal.K, x, y, element.stiffness, circulatory, 1.0);
  add_block(internal.K, y, x, element.stiffness, circulatory, -1.0);
  if (shaft.axial)
    add_rod(rotor, shaft, left, right, along_z, element.axial_stiffness, element.axial_inertia);
  if (shaft.torsion)
    add_rod(rotor, shaft, left, right, about_z, element.torsional_stiffness, element.torsional_inertia);
}

}  // namespace

void assemble_shafts(RotorDraft& rotor) {
  for (const ShaftDraft& shaft : rotor.shafts) {
    for (const RotorEffect effect : {RotorEffect::shaft, RotorEffect::shaft_mass, RotorEffect::gyroscopic,
                                     RotorEffect::shaft_damping, RotorEffect::internal_damping})
      rotor.count(effect);
    std::size_t node = 0;
    for (const ShaftSegment& segment : shaft.segments) {
      const SegmentMatrices element = matrices_of(shaft, segment);
      for (int i = 0; i < segment.elements; ++i) add_element(rotor, shaft, element, node++);
    }
  }
}

}  // namespace eigentrail
