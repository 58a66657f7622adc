// Section properties of a beam along its span.
#pragma once

#include <optional>

#include "model/station_columns.hpp"

namespace eigentrail {

/// Properties at stations along the span, linear between them. Stiffness and mass refer to the axis of the
/// beam and the axes of the section.
struct BeamTable {
  /// Mass per length and its moments: m, m y, m z, and the integrals of y y, z z and y z over it.
  using Mass = std::array<Expression, 6>;
  using Stiffness = std::array<Expression, section_entries>;  ///< as BeamPoint::stiffness

  std::vector<double> span;  ///< ascending from 0 to 1; only 0 if the beam is uniform
  std::vector<Stiffness> stiffness;
  std::vector<Mass> mass;
  std::vector<Expression> twist;           ///< of the section about the axis, rad
  std::vector<Expression> sweep, prebend;  ///< distance of the axis from the chord along y and z, m
  bool straight = true;                    ///< without sweep and prebend
  bool twisted = false;

  /// The stations on both sides of s, with their weights in linear interpolation.
  std::vector<StationShare> shares(double s) const { return station_shares(span, s); }
};

/// Reads the keys of a [[beam]] that describe sections. If the length of a blade is given, EA and GJ have the
/// defaults of blade_EA and blade_GJ.
BeamTable read_beam_table(Draft& draft, TableReader& table,
                          const std::optional<Expression>& blade_length = std::nullopt);

/// Extension of a section whose radius of gyration in lag is a hundredth of the length: it changes
/// frequencies of bending by less than stations usually are accurate.
Expression blade_EA(const Expression& EI_lag, const Expression& length);
/// Torsion of a circular section with Poisson's ratio 0.3, of all solid sections of given moments of inertia
/// that of largest torsional stiffness.
Expression blade_GJ(const Expression& EI_flap, const Expression& EI_lag);

/// These keys, with the defaults of a [[beam]] or of a [[blade]].
std::vector<FieldHelp> beam_table_fields(bool blade = false);

}  // namespace eigentrail
