// Thresholds that decide what a trace finds: whether a special point is one and of what kind, whether two are
// the same, whether a mode is what it is taken for. They are no options of a scene: the defaults follow from
// rounding and from what the numerical methods resolve, and nothing may depend on their exact values. Tests
// vary each of them by a factor of three.
#pragma once

namespace eigentrail {

/// Zeros and extrema of functions of single eigenvalues (criteria).
struct CriterionThresholds {
  /// |Re s| / max(|s|, reference) that counts as zero at most. Eigenvalues of systems without damping stay on
  /// the imaginary axis but for rounding times the condition of the eigenvalue, ...
  double on_axis = 1e-9;
  /// ... that is, for so many times 2.2e-16 times the condition.
  double roundings = 1000.0;
  /// The same at a double root, where an eigenvalue is known to the root of rounding only.
  double double_root_on_axis = 1e-6;
  /// A mode that comes so close to the axis, in units of the dense output's error, may touch it between two
  /// samples of a step.
  double near_axis = 10.0;
  /// An extremum is told from the error of the dense output when the damping ratio changes by this many
  /// tolerances over half a step.
  double extremum = 1.0;
};

/// Meetings of eigenvalues that are followed in one block.
struct MeetingThresholds {
  /// Of the range: a meeting so close to a point lies on it. Where eigenvalues meet, the place of a double
  /// root is known to the root of rounding over its curvature; this is far above what Newton's method leaves.
  double at_point = 1e-10;
  /// Of the step: exceptional points this far off the real axis get a point of the trace of their own. They
  /// are so near that the dense output does not tell on which side of the axis they lie.
  double narrow = 3e-3;
  /// Of their separation: two roots of a discriminant that are mirror images of each other, to this accuracy,
  /// are one exceptional point and its conjugate. Decides how the place of a veering is averaged, not its
  /// kind.
  double beside_axis = 1e-3;
  /// Of the reach: a single exceptional point no farther off the axis lies on it.
  double on_axis = 1e-9;
};

/// Exceptional points beside the real axis.
struct VeeringThresholds {
  /// Of the range: half-width up to which two modes that come close and part again are a veering. This is a
  /// definition, not an accuracy: tests that vary it look at veerings away from it.
  double widest = 0.01;
  /// Terms of a series may be this share of its largest one where it is trusted to tell a root.
  double trusted_share = 0.02;
};

/// Whether two events are one.
struct EventThresholds {
  /// Of the range: places of zeros, extrema and meetings are settled to 1e-10 or better.
  double same_place = 1e-9;
  /// Of the range: a zero that Newton's method finds to be a double root is known to the root of what other
  /// zeros are.
  double same_double_root = 1e-6;
  /// Of the range: places of veerings off the axis are settled to 1e-8.
  double same_veering = 1e-7;
  /// Relatively: eigenvalues at a veering, which vary there like the root of the distance.
  double same_eigenvalue = 1e-6;
  /// A veering that is expected within this share of a known one's half-width, plus `known_veering` of the
  /// range, is that one: expectations come from the series of a step, and are followed to their place only
  /// once.
  double known_veering_share = 0.01;
  double known_veering = 1e-6;
};

/// Folds and branch points.
struct StaticThresholds {
  /// Share of the parameter's force in the kernel of a singular stiffness: at a fold it is of the order of
  /// one, at a branch point zero but for the error of the point.
  double branch_point_share = 1e-3;
  /// An eigenvalue below this share of the reference is the zero of the singular stiffness.
  double zero = 1e-2;
};

/// Whether two tracks stand for one mode, and whether a mode is still itself.
struct IdentityThresholds {
  /// Two tracks with eigenvalues closer than this, relatively, ...
  double merged_distance = 1e-8;
  /// ... and vectors of at least this modal assurance have merged.
  double merged_assurance = 0.999;
  /// Without a certificate a modal assurance below this makes a match suspicious.
  double least_assurance = 0.8;
};

struct Thresholds {
  CriterionThresholds criterion = {};
  MeetingThresholds meeting = {};
  VeeringThresholds veering = {};
  EventThresholds event = {};
  StaticThresholds statics = {};
  IdentityThresholds identity = {};

  /// Calls visit(name, member) for every threshold.
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("criterion.on_axis", self.criterion.on_axis);
    visit("criterion.roundings", self.criterion.roundings);
    visit("criterion.double_root_on_axis", self.criterion.double_root_on_axis);
    visit("criterion.near_axis", self.criterion.near_axis);
    visit("criterion.extremum", self.criterion.extremum);
    visit("meeting.at_point", self.meeting.at_point);
    visit("meeting.narrow", self.meeting.narrow);
    visit("meeting.beside_axis", self.meeting.beside_axis);
    visit("meeting.on_axis", self.meeting.on_axis);
    visit("veering.widest", self.veering.widest);
    visit("veering.trusted_share", self.veering.trusted_share);
    visit("event.same_place", self.event.same_place);
    visit("event.same_double_root", self.event.same_double_root);
    visit("event.same_veering", self.event.same_veering);
    visit("event.same_eigenvalue", self.event.same_eigenvalue);
    visit("event.known_veering_share", self.event.known_veering_share);
    visit("event.known_veering", self.event.known_veering);
    visit("statics.branch_point_share", self.statics.branch_point_share);
    visit("statics.zero", self.statics.zero);
    visit("identity.merged_distance", self.identity.merged_distance);
    visit("identity.merged_assurance", self.identity.merged_assurance);
    visit("identity.least_assurance", self.identity.least_assurance);
  }
};

}  // namespace eigentrail
