// Section properties of a beam along its span.
#pragma once

#include "model/draft.hpp"

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

  struct Share {
    std::size_t station = 0;
    double weight = 0.0;
  };
  /// The stations on both sides of s, with their weights in linear interpolation.
  std::vector<Share> shares(double s) const;
};

/// Reads the keys of a [[beam]] that describe sections.
BeamTable read_beam_table(Draft& draft, TableReader& table);

/// These keys.
std::vector<FieldHelp> beam_table_fields();

}  // namespace eigentrail
