// One quadrature point of a geometrically exact beam (Simo 1985) in the coordinates of bodies: positions and
// three directors of its nodes (Betsch & Steinmann 2002, Romero & Armero 2002).
//
// The axes of a section are its directors d_x, d_y, d_z, d_x along the beam. With the position phi and the
// derivative ' along the arc length of the unloaded beam the strains are
//
//   extension, shear   Gamma_i = d_i . phi'                                   minus that of the unloaded beam
//   twist, bending     kappa_i = 1/2 (d_k . d_j' - d_j . d_k'),  ijk = xyz, yzx, zxy             likewise
//
// kappa_i is positive where sections further along are turned about d_i in the right-handed sense. Positions
// and directors are interpolated between nodes, so strains are quadratic in the coordinates and vanish under
// rigid motion. The energy per length is 1/2 e . S e with e = (Gamma_x, Gamma_y, Gamma_z, kappa_x, kappa_y,
// kappa_z).
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// Number of entries of a symmetric 6 x 6 matrix.
inline constexpr std::size_t section_entries = 21;

/// Index of entry (i, j) of a symmetric 6 x 6 matrix in its lower triangle, row by row.
constexpr std::size_t section_entry(std::size_t i, std::size_t j) {
  return i >= j ? i * (i + 1) / 2 + j : section_entry(j, i);
}

/// What the elastic forces and the damping of a beam at one quadrature point have in common. Quantities
/// without slot are zero.
struct BeamPoint {
  template <class Scalar>
  using Strain = std::array<Scalar, 6>;

  Place slope;                                      ///< phi'
  std::array<Place, 3> directors, rates;            ///< d_i and d_i'
  std::array<Quantity, section_entries> stiffness;  ///< S: N, N m, N m^2
  Quantity width;                                   ///< length that the point stands for, m

  static void fields(auto& self, auto& visit) {
    visit.direction("slope", self.slope, "");
    for (auto& director : self.directors) visit.direction("director", director, "");
    for (auto& rate : self.rates) visit.direction("rate", rate, "");
    visit.numbers(self.stiffness, self.width);
  }

  /// Gamma and kappa as they are, without those of the unloaded beam, or their rates: `product` gives that of
  /// two vectors, or its rate.
  auto strain_of(auto product) const {
    Strain<decltype(product(slope, slope))> e;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      e[i] = product(directors[i], slope);
      e[3 + i] = 0.5 * (product(directors[k], rates[j]) - product(directors[j], rates[k]));
    }
    return e;
  }

  /// width S e: forces and moments of the section times the length.
  template <class Scalar>
  Strain<Scalar> stress(const ElementView<Scalar>& at, const Strain<Scalar>& e) const {
    Strain<Scalar> s{};
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        const Quantity& entry = stiffness[section_entry(i, j)];
        if (entry.slot >= 0) s[i] += at.value(entry) * e[j];
      }
    }
    const Scalar length = at.value(width);
    for (Scalar& component : s) component *= length;
    return s;
  }

  /// Adds the forces that do the work -s . de.
  template <class Scalar>
  void add_stress(ElementView<Scalar>& at, const Strain<Scalar>& s) const {
    const Vec3<Scalar> along = at.position(slope);
    for (std::size_t i = 0; i < 3; ++i) {
      const Place& j = directors[(i + 1) % 3];
      const Place& k = directors[(i + 2) % 3];
      const Place& j_rate = rates[(i + 1) % 3];
      const Place& k_rate = rates[(i + 2) % 3];
      at.add_force(slope, -s[i] * at.position(directors[i]));
      at.add_force(directors[i], -s[i] * along);
      const Scalar half = 0.5 * s[3 + i];
      at.add_force(k, -half * at.position(j_rate));
      at.add_force(j_rate, -half * at.position(k));
      at.add_force(j, half * at.position(k_rate));
      at.add_force(k_rate, half * at.position(j));
    }
  }
};

/// Elastic forces: the negative gradient of the energy.
struct BeamSection : BeamPoint {
  static constexpr std::string_view name = "beam";
  static constexpr std::string_view description = "elastic forces of a beam at its quadrature points";
  static constexpr Contribution contribution{.conservative = true};

  std::array<Quantity, 6> unloaded;  ///< strains of the unloaded beam: 1 for Gamma_x of a straight one

  static void fields(auto& self, auto& visit) {
    BeamPoint::fields(self, visit);
    visit.numbers(self.unloaded);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    Strain<Scalar> e = strain_of(
        [&at](const Place& a, const Place& b) { return Scalar(at.position(a).dot(at.position(b))); });
    for (std::size_t i = 0; i < 6; ++i) {
      if (unloaded[i].slot >= 0) e[i] -= at.value(unloaded[i]);
    }
    add_stress(at, stress(at, e));
  }
};

/// Damping of the material, proportional to its stiffness: stresses D e' with the rates e' of the strains,
/// D_ij = time root_i S_ij root_j. The strain i alone has the time: time root_i^2. D has no negative
/// eigenvalue.
struct BeamDamping : BeamPoint {
  static constexpr std::string_view name = "beam_damping";
  static constexpr std::string_view description = "damping of a beam by the rates of its strains";
  static constexpr Contribution contribution{.dissipative = true};

  Quantity time;                  ///< s
  std::array<Quantity, 6> roots;  ///< without slot: one

  static void fields(auto& self, auto& visit) {
    BeamPoint::fields(self, visit);
    visit.numbers(self.time, self.roots);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    Strain<Scalar> e = strain_of([&at](const Place& a, const Place& b) {
      return Scalar(at.velocity(a).dot(at.position(b)) + at.position(a).dot(at.velocity(b)));
    });
    const auto multiply_by_roots = [&](Strain<Scalar>& list) {
      for (std::size_t i = 0; i < 6; ++i) {
        if (roots[i].slot >= 0) list[i] *= at.value(roots[i]);
      }
    };
    for (Scalar& rate : e) rate *= at.value(time);
    multiply_by_roots(e);
    Strain<Scalar> s = stress(at, e);
    multiply_by_roots(s);
    add_stress(at, s);
  }
};

}  // namespace eigentrail
