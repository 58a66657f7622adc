// The state of a trace and its stages. The public function trace() builds one and returns its result.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "continuation/bridge.hpp"
#include "continuation/criterion.hpp"
#include "continuation/meetings.hpp"
#include "continuation/regrouping.hpp"
#include "continuation/reparametrize.hpp"
#include "eigentrail/continuation/step_control.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {

// Nothing derives from it. NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor)
class Tracer final : private Checkpoint {
 public:
  Tracer(const Model& model, const TraceOptions& options, const TraceObserver& observer, BasisChoice basis);

  TraceResult run();

  // tracer_state.cpp: leaving a trace between two points, and going on with it.
  /// Throws InputError when the bytes are no state of a trace of this model.
  void restore(std::string_view bytes);
  TraceResult resume();

 private:
  const TraceResult& so_far() const override { return result_; }
  std::string save() const override;
  /// Calls visit(...) with all that changes while a trace goes on.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit);
  /// What of a restored state does not fit the model; empty when all of it does.
  std::string misfit() const;

  /// Why a step was not taken, and which track is to blame (-1: none in particular).
  struct Trouble {
    enum class Kind {
      none,
      no_equilibrium,
      mode_lost,
      inaccurate,
      mismatch,
      merged,
      uncertified
    } kind = Kind::none;
    int track = -1;
    double error = 0.0;  ///< estimated error / accepted error, infinite when not known
    std::string reason;
    explicit operator bool() const { return kind != Kind::none; }
  };

  /// A step is accepted up to this share of the tolerance: the estimate leaves out what follows the next
  /// term.
  static constexpr double accepted_share = 0.5;

  // tracer_start.cpp: the first point.
  bool start();
  /// From here on series have this order.
  void use_order(int order);
  std::optional<std::vector<StartingMode>> starting_modes(const PathPoint& point);
  bool start_tracks(PathPoint& point, const std::vector<StartingMode>& modes, std::optional<PathNode>& node);

  // tracer.cpp: the loop.
  void prepare_to_follow();
  void follow();
  bool advance();
  Prediction predict(const PathNode& base, double h) const;
  /// The same from the node, with what the last step and the last attempt tell.
  Prediction predict_all(double h);
  bool is_far_from_events(const ContinuedMode& mode, std::size_t track, double h) const;
  /// Computes and differentiates the point at distance h; the tracks' eigenvalues have their modes.
  Trouble attempt(double h, std::optional<PathNode>& next);
  bool accept(double h, PathNode next, double next_step);
  bool give_up(const Trouble& trouble);
  double remaining() const;
  double seconds_so_far() const;
  double longest_allowed_step() const;

  // tracer_judgement.cpp: whether a step is taken, and what may help where it is not.
  /// `error` is that of the dense output, as a fraction of what is accepted.
  Trouble judge(double h, const PathNode& next, double& error);
  /// Estimated error of one track's dense output on the step, as a fraction of what is accepted.
  double track_error(double h, const PathNode& next, std::size_t track) const;
  Trouble measure_error(double h, const PathNode& next) const;
  Trouble check_path(double h, const PathNode& next) const;
  Trouble check_identity(const PathNode& next);
  Trouble certify(double h, const PathNode& next);
  double gap_of(std::size_t track) const;
  /// Changes what is followed together so that the step may be tried again as it is.
  bool remedy(const Trouble& trouble, double h, const std::optional<PathNode>& next);
  std::vector<Partner> helpful_partners(double h, const PathNode& next, std::size_t track, double error,
                                        std::vector<Partner> candidates) const;
  /// Joins single modes at the end of the step that limit each other's accuracy.
  void join_limiting_modes(double h, PathNode& next, double next_step);

  // tracer_labels.cpp: which eigenvalue is which mode.
  void label_arrival(double h, PathNode& next) const;
  void label_departure(double h, PathNode& next, const std::vector<bool>& coincide);
  void settle_real_block(Track& track);
  void name_in_collisions(int parent, int born);
  int partner_of(int mode);
  PathStep make_step(double h, const PathNode& next) const;
  std::vector<ModeState> mode_states(const PathNode& node) const;

  // tracer_events.cpp: special points.
  void find_events(double h, const PathNode& next);
  void add_event(Event event);
  /// A point beside the path's own ones.
  struct Probe {
    PathPoint point;
    PathNode node;
  };
  /// `basis` is the tangent basis of a point nearby.
  std::optional<Probe> probe(const Prediction& prediction, const Matrix& basis);
  std::optional<PathNode> probe(const PathNode& base, double h);

  // tracer_meetings.cpp: eigenvalues of one block that meet.
  /// Shortens the step so that it ends on the first meeting inside it.
  bool land_on_meeting(double& h, std::optional<PathNode>& next);
  void record_meetings_at_start();
  std::optional<Meeting> meeting_at(double h, const ExpectedMeeting& expected, const PathNode& node) const;
  enum class Approach { reached, nothing, failed };
  Approach land_as_told(double h, const ExpectedMeeting& expected, std::optional<PathNode>& next);
  Approach approach_meeting(const ExpectedMeeting& expected, double h, const PathNode& next,
                            StrandSampler& strands, bool trusting, double& distance, int& retrackings);
  void record_at(double h, const ExpectedMeeting& expected, int retrackings, PathNode& next,
                 std::vector<bool>& coincide);
  void record_meeting(const PathNode& node, std::size_t track, const Meeting& meeting, int retrackings);

  // tracer_veerings.cpp: exceptional points beside the real axis.
  void find_veerings(double h, const PathNode& next);
  bool is_known_veering(Complex position, const std::vector<int>& modes) const;
  std::optional<PathNode> as_one_block(double h, const PathNode& next, const ExpectedMeeting& expected);
  std::optional<PathNode> joined_at(const PathNode& apart, double distance);
  void record_veering(const PathNode& base, double h, const ExpectedMeeting& expected,
                      const std::vector<int>& modes);
  bool has_jumped(const PathNode& from, const Track& to, double distance) const;
  double veering_width() const;

  // tracer_criteria.cpp: zeros and extrema of functions of single eigenvalues, flutter among them.
  /// The last values of a criterion for a mode.
  class Watch {
   public:
    enum class Seen { nothing, zero, extremum };
    /// What lies between the last value and this one, or (an extremum) about at the last one.
    Seen next(double value);
    /// A value that is not told from zero.
    void skip() { skipped_ = known_; }
    bool is_known() const { return known_; }
    double value() const { return value_; }
    bool is_pair() const { return is_pair_; }
    void is_pair(bool value) { is_pair_ = value; }
    template <class Self, class Visit>
    static void fields(Self& self, Visit& visit) {
      visit(self.known_, self.skipped_, self.is_pair_, self.value_, self.change_, self.bend_, self.top_);
    }
    double bend() const { return bend_; }  ///< second difference at the extremum
    double top() const { return top_; }    ///< value at the extremum, about

   private:
    bool known_ = false, skipped_ = false, is_pair_ = false;
    double value_ = 0.0, change_ = 0.0, bend_ = 0.0, top_ = 0.0;
  };
  class StepCriteria;
  struct Member {
    std::size_t track, index;
  };
  enum class Sought { zero, extremum, dip };
  struct Aim {
    Criterion criterion;
    bool pair = false;
    Sought sought = Sought::zero;
  };
  /// A mode at a point beside an event, whose node has the mode's track only.
  struct Closer : Probe {
    Complex root;          ///< of its chart, upper member of a pair
    ComplexVector series;  ///< of that; empty where the root is not simple
    double gap = 0.0;      ///< to the next one in the block
  };
  Vector excitation(const PathNode& node) const;
  void find_zeros(double h, const PathNode& next);
  void watch(double h, const Member& member, StepCriteria& step, double last, double t);
  std::optional<Probe> probe_alone(Complex expected, std::size_t track, double distance);
  std::optional<Closer> look_closer(double h, StepCriteria& step, const Member& member, const Aim& aim,
                                    double distance);
  bool locate(double h, StepCriteria& step, const Member& member, const Aim& aim, double t);
  void note_unlocated(int mode, double p);
  void finish(double h, StepCriteria& step, const Closer& closer, const Vector& g, double offset,
              double distance, const Member& member, const Aim& aim, int retrackings);

  // tracer_sensitivity.cpp: what an event keeps of its eigenvector and of the other parameters.
  void record_zero(const Closer& closer, const Vector& g, double offset, const Member& member, const Aim& aim,
                   int retrackings);
  /// Eigenvector of the first of `members` of a track at an offset from the point.
  void keep_shape(const PathNode& node, std::size_t track, const std::vector<int>& members, double offset,
                  Event& event) const;
  /// ds/dq of the mean of `members`, and dp*/dq of where `moves` says how the event follows; one more
  /// back-substitution per parameter.
  PathPoint solved_point(const PathNode& node);
  using Movement =
      std::function<double(const Track& along_path, const PathNode& node_q, const Track& along_q)>;
  void keep_sensitivities(const PathPoint& point, const PathNode& node, std::size_t track,
                          const std::vector<int>& members, const Movement& moves, Event& event);
  int direction_of(const Closer& closer, const Vector& g, double offset, const Aim& aim) const;
  static double shift_of_meeting(const Track& along_path, const Track& along_q, EventKind kind,
                                 const std::vector<int>& members);
  void keep_fold_sensitivities(const PathNode& node, Event& event);

  // tracer_folds.cpp: where the equilibrium path bends back or meets another one.
  bool turn_to_plane(double h);
  void renew_plane();
  PathScales path_scales();
  bool reached_end(const PathNode& node) const;
  bool land_on_end(double& h, std::optional<PathNode>& next);
  double heading(const PathNode& node, double towards) const;
  double fold_distance(const PathNode& node) const;
  bool land_on_fold(double& h, std::optional<PathNode>& next);
  void keep_vanishing_mode(const PathNode& node, Event& event) const;
  void find_folds(double h, const PathNode& next);
  void add_static_event(const PathNode& node, Event event);
  void note_branch_point(double p);

  // tracer_branches.cpp: over points where another path crosses.
  /// A solved point of the path beside a branch point.
  struct Anchor {
    double coordinate = 0.0;
    Path path;
    double heading = 1.0;                ///< dp/dsigma
    double sign = 0.0, logarithm = 0.0;  ///< of det T^T K T
  };
  double coordinate(const Vector& x, double p) const;
  bool on_branch_point(double coordinate) const;
  std::optional<double> expect_branch_point(double h, const PathNode* next) const;
  std::optional<Anchor> anchor_at(const PathPoint& point);
  std::optional<Anchor> anchor(double distance);
  Bridge::Sizes bridge_sizes();
  bool build_bridge(double guess, double h);
  double locate_on(const Bridge& bridge, const Anchor& left, const Anchor& right, double guess);
  bool bridge_branch_point(double h, const PathNode* next);
  void bridge_start(PathPoint& point);
  std::optional<Spectrum> spectrum_beside_branch_point();
  void keep_to_bridge(Prediction& prediction) const;
  double distance_to_branch_point() const;
  void record_branch_point(const PathNode& node);

  // tracer_branch_choice.cpp: which path to go on along.
  /// The other path at a branch point: a plane across it, and the sign on it of choice 2.
  struct Crossing {
    PathPlane plane;
    double direction = 1.0;
  };
  int choice_at(std::size_t branch_point) const;
  bool leaves_path_at(const PathNode& node) const;
  std::optional<PathPlane> plane_across_other_path(const PathNode& node);
  std::optional<Anchor> anchor_on(const PathPlane& plane, const PathNode& node, double distance);
  std::optional<Bridge> bridge_other_path(const PathPlane& plane, const PathNode& node);
  void survey_branch_point(const PathNode& node);
  bool leave_path(int choice);

  // tracer_completeness.cpp
  void complete(PathNode& node);

  bool emit(const PathNode& node, const PathStep* step);
  bool stop(TraceStatus status, const std::string& message);
  std::string at_parameter(double p) const;
  /// Length of the range in the path's coordinate, about.
  double coordinate_range() const { return plane_ ? 1.0 : range(); }
  double range() const { return std::abs(options_.to - options_.from); }

  const TraceOptions& options_;
  const TraceObserver& observer_;
  PathProblem problem_;
  TraceResult result_;
  StepControl control_;
  double direction_ = 1.0;  ///< sign of steps in the path's coordinate
  PathNode node_;           ///< the last accepted point
  PathNode previous_;       ///< the one before it
  double last_step_ = 0.0;  ///< between the two, in the path's coordinate; 0: there is none in this one
  std::optional<PathNode> tried_;  ///< what an attempt with other blocks found ...
  double tried_step_ = 0.0;        ///< ... at this distance
  std::uint64_t strands_ = 0;      ///< numbered so far
  std::optional<PathPlane> plane_;
  /// Where the steady equations are too near to singular to be solved; in the coordinate of `plane_`.
  std::optional<Bridge> bridge_;
  struct BranchPoint {
    double coordinate = 0.0, p = 0.0;
  } branch_;  ///< on the bridge
  std::optional<Crossing> crossing_;
  std::size_t branch_points_ = 0;   ///< passed so far
  int bridges_tried_ = 0;           ///< from the last point
  std::vector<bool> certified_;     ///< per track of the step at hand
  double uncertified_below_ = 0.0;  ///< steps shorter than this are taken without certificate
  bool follows_all_ = false;
  std::map<int, int> partners_;  ///< modes that shared a real block: who comes back when a pair parts again
  double part_reach_ = 3.0;      ///< steps: blocks part when their meetings are farther than this
  std::vector<Criterion> criteria_;
  std::map<std::pair<int, std::size_t>, Watch> watches_;  ///< per mode and criterion
  std::vector<Event> no_veerings_;  ///< looked at, and none: too wide, or nothing to be told
  int merges_at_node_ = 0;
  double largest_position_ = 0.0;  ///< |x| on the path so far
  double turned_step_ =
      0.0;  ///< length of the next step in a coordinate that has just changed; 0: it has not
  double longest_step_ = 0.0;  ///< of late
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double seconds_before_ = 0.0;  ///< of the runs that this one goes on from
};

}  // namespace eigentrail
