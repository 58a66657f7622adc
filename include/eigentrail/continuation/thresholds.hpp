// Thresholds that decide what a trace finds: whether an event is listed and with which kind, whether two
// events are the same, whether a track still follows its mode. They are not options of a scene. The values
// follow from rounding and from the accuracy of the numerical methods, and no result may depend on the exact
// values: a test varies each of them by a factor of three.
#pragma once

namespace eigentrail {

/// What counts as zero.
struct RoundingThresholds {
  /// Errors of the entries of M, C and K, in units of 2.2e-16 of their magnitudes: they are sums of products
  /// of numbers with errors of their own. An eigenvalue, its real part, or a function of a block is zero
  /// where it is below the error that follows (InvariantPair::rounding).
  double entries = 10.0;
};

/// Zeros and extrema of functions of single eigenvalues (events/criterion.hpp).
struct CriterionThresholds {
  /// In units of tolerance times max(|s|, reference). Where a function has an extremum this close to zero,
  /// two zeros may lie between two samples of a step. The extremum is then located.
  double near_axis = 10.0;
  /// In units of the tolerance. An extremum is listed if the damping ratio changes by more than this over
  /// half a step; smaller changes may come from the error of the dense output.
  double extremum = 1.0;
};

/// Coinciding eigenvalues of one block.
struct MeetingThresholds {
  /// As a share of the range: eigenvalues that coincide no farther than this from a point count as coinciding
  /// on it. Newton's method comes much closer. The limit is for double roots of the discriminant: their place
  /// is known only to the square root of rounding divided by the curvature there.
  double at_point = 1e-10;
  /// As a share of the step: an exceptional point with a half-width up to this gets a point of the trace. So
  /// narrow a veering cannot be distinguished from a collision on the dense output.
  double narrow = 3e-3;
  /// As a share of their distance: two roots of a discriminant that are complex conjugates to this accuracy
  /// are one veering, at their mean. Decides the place of a veering, not its kind.
  double beside_axis = 1e-3;
  /// As a share of the distance up to which roots are searched for (the step): a single root of a
  /// discriminant with an imaginary part up to this lies on the real axis, a collision and not a veering.
  double on_axis = 1e-9;
};

/// Exceptional points beside the real axis.
struct VeeringThresholds {
  /// As a share of the range: largest half-width of a veering. This is a definition, not an accuracy. The
  /// test that varies the thresholds leaves it out.
  double widest = 0.01;
};

/// Whether two events are the same.
struct EventThresholds {
  /// As a share of the range: events of one kind closer than this in p are the same. Places of zeros, extrema
  /// and coinciding eigenvalues are located to 1e-10 or better.
  double same_place = 1e-9;
  /// As a share of the range: the same for a zero of Re s at a double eigenvalue and the collision there.
  /// The place of such a zero is known only to the square root of the accuracy of other zeros.
  double same_double_root = 1e-6;
  /// As a share of the range: the same for veerings, in place and half-width. Those that the
  /// series do not tell to this are not listed.
  double same_veering = 1e-7;
  /// Largest relative difference of the eigenvalues of one veering. They vary there like the square root of
  /// the distance, and are less accurate than the place.
  double same_eigenvalue = 1e-6;
  /// A predicted veering is a known one if place and half-width differ by no more than this share of the
  /// known half-width plus `known_veering` of the range. The prediction comes from the series of a step and
  /// is inaccurate; a veering that is known is not located again.
  double known_veering_share = 0.01;
  double known_veering = 1e-6;
};

/// Folds and branch points.
struct StaticThresholds {
  /// At a singular stiffness, the share of the force of the traced parameter in the kernel of the stiffness:
  /// of the order of one at a fold, zero at a branch point except for the error of the point. Above this
  /// value the point is a fold.
  double branch_point_share = 1e-3;
  /// An eigenvalue up to this share of the reference counts as the zero eigenvalue of a singular stiffness.
  double zero = 1e-2;
};

/// Whether two tracks follow the same mode, and whether a track still follows its mode.
struct IdentityThresholds {
  /// Two tracks have merged if their eigenvalues are closer than this, relatively, ...
  double merged_distance = 1e-8;
  /// ... and their vectors have more than this modal assurance.
  double merged_assurance = 0.999;
  /// Without a certificate, a step is rejected if the modal assurance of a single mode between the two ends
  /// is below this.
  double least_assurance = 0.8;
};

/// All thresholds.
struct Thresholds {
  RoundingThresholds rounding = {};
  CriterionThresholds criterion = {};
  MeetingThresholds meeting = {};
  VeeringThresholds veering = {};
  EventThresholds event = {};
  StaticThresholds statics = {};
  IdentityThresholds identity = {};
};

}  // namespace eigentrail
