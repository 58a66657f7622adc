// Readers of the tables of a multibody scene, in the order in which read_multibody calls them, and the keys
// of these tables. Those of bodies and constraints: draft.hpp.
#pragma once

#include <memory>

#include "model/draft.hpp"

namespace eigentrail {

/// Adds the nodes of all [[beam]] tables to the bodies, with their masses and the constraints that hold the
/// ends, and the quadrature points to the beams. Bodies must have been read.
void read_beams(Draft& draft);
std::vector<FieldHelp> beam_fields();

/// Adds the blades to the beams: [[blade]] is a beam on a hub, placed by hub radius, azimuth, precone and
/// pitch, with damping ratios. Bodies must have been read.
void read_blades(Draft& draft);
std::vector<FieldHelp> blade_fields();

/// Reads [rotor]: N equal blades, of which the scene describes one, on a hub that is a body of a support. To
/// be called after all points and bodies; nothing if the scene has none. Throws InputError for fewer
/// than three blades and for a hub that is not on the z axis with its own z axis along it.
std::optional<BladedRotorDraft> read_bladed_rotor(Draft& draft);
std::vector<FieldHelp> bladed_rotor_fields();

/// Linear relations of the motions of joints: [[coupler]] and [[gear]]. The joints are read before.
std::vector<ConstraintRow> read_coupler(Draft& draft, TableReader& table, JointMotions& motions);
std::vector<ConstraintRow> read_gear(Draft& draft, TableReader& table, JointMotions& motions);

/// Adds the strips of all [[blade_element]] tables. They are at the n Gauss points between root and tip, so
/// loads that are polynomials of degree up to 2 n - 1 along the span are integrated exactly. `rotation` is
/// the angular velocity of the frame.
void read_strips(Draft& draft, const std::optional<ExpressionVector>& rotation);
std::vector<FieldHelp> strip_fields();

/// A straight line on a body, with directions in the body's axes.
struct BodyLine {
  int body = 0;
  ExpressionVector root, tip, y, z;
};

/// Reads the line on a body along which strips are: from `root` to `tip`, y the direction `leading` and z the
/// part of `lift` across it. `usual_axes`: those of leading and lift by default; absent: they are required.
BodyLine read_body_line(Draft& draft, TableReader& table, int body,
                        const std::optional<std::array<ExpressionVector, 2>>& usual_axes = std::nullopt);

/// Reads the number of strips, 1 to 64.
int read_strip_count(TableReader& table, int otherwise);

/// Adds the elements of all beams.
void add_beam_sections(Draft& draft);

/// Adds the damping of all beams at their quadrature points: that of their own, and of [[beam_damping]]
/// tables.
void read_beam_damping(Draft& draft);
std::vector<FieldHelp> beam_damping_fields();

/// Times must not be negative. One of several, which enter by their roots, must not become zero on the trace.
void check_time(Draft& draft, const TableReader& table, const std::string& key, const Expression& time,
                bool has_root);

/// The inflow of a rotor: its element, and what its strips need.
struct InflowDraft {
  std::string name;
  Inflow element;
  RotorDisc disc;
  bool annular = false;   ///< every strip has an annulus of its own, and `element` has no coordinates
  bool tip_loss = false;  ///< of annuli
  Expression guess, radius;
  Expression blades;      ///< of the rotor, for the loss at the tips
  int sense = 1;          ///< with [rotor]: that of the axis along the axis of rotation
  int first_triple = -1;  ///< of the blade whose strips have the annuli
  std::vector<Inflow> annuli = {};

  /// Name of the annulus with index i.
  std::string label(std::size_t i) const { return name + ", annulus " + std::to_string(i + 1); }
};

/// All [[inflow]] tables, the velocities that rotors induce; they add their coordinates to the guess. To be
/// called once everything else that has coordinates in triples has been read. `rotation` is the angular
/// velocity of the frame. Without the effect (--without) there are none.
std::vector<InflowDraft> read_inflow(Draft& draft, const std::optional<ExpressionVector>& rotation);
std::vector<FieldHelp> inflow_fields();

/// Gives a strip of this length along the radius an annulus of its own, at its place in the guess.
void add_annulus(Draft& draft, const TableReader& table, InflowDraft& inflow, Strip& strip,
                 const Expression& width);

/// Adds the inflows of rotors, and everything on strips in moving air ([[strips]], [[lift_lag]] and
/// [[apparent_mass]]); beams and bodies must have been read. `rotation` is the angular velocity of the frame.
void read_air(Draft& draft, const std::optional<ExpressionVector>& rotation,
              std::vector<InflowDraft>& inflows);
std::vector<FieldHelp> strips_fields();
std::vector<FieldHelp> lift_lag_fields();
std::vector<FieldHelp> apparent_mass_fields();

/// All [[trim]] tables, into draft.data.trims: conditions at the equilibrium, and the parameters that they
/// determine. Everything else must have been read: conditions refer to points, joints, strips, springs and
/// inflows by their names.
void read_trims(Draft& draft, const std::vector<InflowDraft>& inflows);
std::vector<FieldHelp> trim_fields();

/// Speed of the rotor, about +z, from the angular velocity of [frame], which must be along z.
Expression rotor_speed(const Draft& draft, const std::optional<ExpressionVector>& rotation);

/// Divides what a scene describes into one blade and the support, and makes a rotor of them. Takes the
/// elements and constraints of the draft, whose `description` is that of one blade, the hub and the
/// support. Throws InputError for what joins the blade with the support or the turning frame beside the hub.
std::unique_ptr<Model> make_bladed_rotor(Draft& draft, ModelDescription description, const Expression& speed);

}  // namespace eigentrail
