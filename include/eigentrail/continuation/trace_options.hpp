// Options of a trace. One list of fields serves the scene's [trace] table, the command line and the record of
// the options in the loci file.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eigentrail/continuation/event_options.hpp"
#include "eigentrail/continuation/thresholds.hpp"
#include "eigentrail/model/build.hpp"
#include "eigentrail/modes/given_names.hpp"
#include "eigentrail/modes/mode_choice.hpp"

namespace eigentrail {

/// Order of the series along the curves of boundaries, if the options give none. Traces choose the order by
/// its cost instead (route_choice.hpp).
constexpr int usual_order = 3;

struct TraceOptions {
  std::string parameter;    ///< name of the traced parameter
  double from = 0.0;        ///< where the trace begins, in the parameter's unit
  double to = 0.0;          ///< where it ends; may be below `from`, not equal
  double tolerance = 1e-6;  ///< bounds |s_dense - s| <= tolerance * max(|s|, reference); 1e-13 to 0.1
  ModeChoice modes = {};    ///< which modes are followed
  /// "list": zeros that do not move with the parameter are listed, and no number in `modes` counts them;
  /// "follow": they are modes like others.
  std::string constant_modes = "list";
  std::optional<int> order;         ///< of the series at each point, 1 to 4; absent: the one that costs least
  std::optional<double> reference;  ///< eigenvalues below this count as zero in `tolerance`, 1/s, > 0;
                                    ///< absent: 1e-3 of the median |s| of the followed modes at the start
  std::optional<double> first_step;  ///< in the parameter's unit, > 0; absent: from the series at the start
  std::optional<double> max_step;    ///< in the parameter's unit, > 0; absent: a quarter of the range
  int max_nodes = 100000;            ///< largest number of points, >= 2; the trace stops there
  bool certify = true;               ///< test at every step that no modes were exchanged (certificate.hpp)

  /// The path to continue on at each branch point, in their order: 1 is straight on, 2 and 3 are the two
  /// directions of the other path. A single number holds for all branch points; 1 is used after the last one.
  std::vector<int> branch = {};

  std::vector<std::string> without = {};  ///< effects of the scene that are switched off

  /// Values of other parameters that replace those declared in the scene, in their units. Not an option of a
  /// scene: it lets one model serve many traces at different values, in several threads.
  std::map<std::string, double> values = {};

  EventOptions events = {};  ///< of the scene's [events]

  std::vector<GivenName> mode_names = {};  ///< of the scene's [modes]

  /// Threads that share the modes of a point, >= 1. Not an option of a scene, because results do not depend
  /// on it.
  int threads = 1;

  Thresholds thresholds = {};  ///< not an option of a scene

  /// Calls visit(key, help, member) for every option.
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("parameter", "name of the traced parameter", self.parameter);
    visit("from", "where the trace begins, in the parameter's unit", self.from);
    visit("to", "where the trace ends, in the parameter's unit", self.to);
    visit("tolerance", "bound of the relative error of every eigenvalue, everywhere on the range",
          self.tolerance);
    visit("modes",
          "which modes to follow: \"all\", the number of the lowest ones, or some of count = 12, band = "
          "[\"0.05 Hz\", \"3 "
          "Hz\"], damping_below = 0.9, near = \"10 Hz\"",
          self.modes);
    visit("constant_modes",
          "eigenvalues that are zero for every value of the parameter (rigid-body motions): \"list\" them "
          "apart, or "
          "\"follow\" them like others",
          self.constant_modes);
    visit("order", "order of the power series at each point, 1 to 4, or \"auto\"", self.order);
    visit("reference", "eigenvalues below this (1/s) count as zero in the tolerance", self.reference);
    visit("first_step", "length of the first step, in the parameter's unit", self.first_step);
    visit("max_step", "longest step, in the parameter's unit", self.max_step);
    visit("max_nodes", "stop after this many points", self.max_nodes);
    visit("branch",
          "which path to go on along where another one crosses: 1 straight on, 2 or 3 the other one's two "
          "directions; a number for all such points, or a list \"1, 2\"",
          self.branch);
    visit("without", "effects of the scene that are switched off, separated by commas", self.without);
    visit("certify", "give evidence at every step that no modes were exchanged", self.certify);
  }
};

/// Options given on the command line: keys and texts, in order.
using OptionTexts = std::vector<std::pair<std::string, std::string>>;

/// An option that cannot be used: its key and what is wrong.
struct OptionFault {
  std::string key;
  std::string message;
};

/// All faults of the options: unknown or unsuitable parameters and violated bounds of the fields. Empty if
/// the options can be used.
std::vector<OptionFault> find_faults(const TraceOptions& options, const Parameters& parameters);

/// What a scene is prepared for.
enum class Purpose {
  trace,           ///< the model must depend on the traced parameter
  strengths,       ///< the same, with the strengths of the effects as further parameters
  operating_point  ///< single values of the parameter; the model may be the same for all, `to` may be absent
};

/// Options from the scene's [trace] and [events] tables, overridden by `overrides`. Numbers may be
/// expressions: plain numbers are in the parameter's unit, expressions of parameters are SI values. The
/// parameters that the options name are added to `used`. Throws InputError that names the faults.
TraceOptions read_trace_options(const Scene& scene, const OptionTexts& overrides, std::set<int>& used,
                                Purpose purpose = Purpose::trace);

/// A scene with its options and its model, ready to be traced.
struct TraceSetup {
  Scene scene;
  TraceOptions options;
  std::unique_ptr<Model> model;

  /// Index of the traced parameter.
  int traced() const { return scene.parameters.index(options.parameter).value(); }
  /// All parameters of the model with the traced one at p, in declared units.
  Vector parameters_at(double p) const {
    Vector values = model->description().parameters.declared_values();
    values[traced()] = p;
    return values;
  }
};

/// Reads the options and builds the model of a scene. Throws InputError for faults of the options or the
/// model.
TraceSetup prepare_trace(Scene scene, const OptionTexts& overrides, Purpose purpose = Purpose::trace);

/// A caller's own model for the parameters and options of a scene, which has no tables of elements.
using ModelMaker = std::function<std::unique_ptr<Model>(const Parameters&, const TraceOptions&)>;

/// The same with a model that the caller makes.
TraceSetup prepare_trace(Scene scene, const OptionTexts& overrides, const ModelMaker& make_model);

/// Every option as text, for the record in the loci file; options that were not given are "auto" or "all".
OptionTexts describe_options(const TraceOptions& options);

}  // namespace eigentrail
