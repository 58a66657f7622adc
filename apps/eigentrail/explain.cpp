#include "explain.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numeric>

#include "core/texts.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/route_choice.hpp"
#include "eigentrail/continuation/scene_parts.hpp"
#include "eigentrail/continuation/sensitivities.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/model/build.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/units.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "output.hpp"
#include "scene_in_words.hpp"

namespace eigentrail::app {
namespace {

/// The unit in which expressions see a parameter with a unit.
std::string unit_in_expressions(const Parameter& parameter) {
  const Dimension dimension = parameter.dimension.value_or(Dimension{});
  if (!parameter.is_angle) return si_unit(dimension);
  return dimension.is_number()                       ? "rad"
         : dimension == parse_unit("rpm")->dimension ? "rad/s"
                                                     : si_unit(dimension);
}

void print_parameters(std::FILE* to, const Model& model, int traced) {
  const Parameters& parameters = model.description().parameters;
  const Vector declared = parameters.declared_values();
  Vector si = declared;
  parameters.to_si(std::span<double>(si.data(), parameters.size()));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const std::string note = static_cast<int>(i) == traced ? "traced"
                             : parameters[i].definition    ? "derived"
                                                           : "";
    const std::string in_si = parameters[i].factor == 1.0
                                  ? ""
                                  : "= " + rounded(si[at], 9) + " " + unit_in_expressions(parameters[i]);
    rows.push_back({"  " + parameters[i].name, rounded(declared[at], 12), parameters[i].unit, in_si, note});
  }
  print_section(to, "parameters", rows);
}

/// What is known of the data of the model: samples and their interpolant.
void print_data(std::FILE* to, const Model& model) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [label, text] : model.description().data) rows.push_back({"  " + label, printable(text)});
  print_section(to, "data", rows);
}

/// What is recorded of an effect, and its share of all operations of a linearization.
std::vector<std::string> recorded(const Effect& effect, double all) {
  if (all == 0.0) return {};
  return {std::to_string(effect.records), std::to_string(effect.directions),
          std::to_string(effect.operations) + " (" + percent(effect.operations / all, 2) + ")"};
}

void print_effects(std::FILE* to, const Model& model) {
  const std::vector<Effect>& effects = model.description().effects;
  const double all = std::accumulate(effects.begin(), effects.end(), 0.0,
                                     [](double sum, const Effect& e) { return sum + e.operations; });
  std::vector<std::vector<std::string>> active;
  const auto add = [&](std::vector<std::string> row, const std::vector<std::string>& costs, std::string end) {
    row.insert(row.end(), costs.begin(), costs.end());
    row.push_back(std::move(end));
    active.push_back(std::move(row));
  };
  if (all > 0.0) add({"  effect", "number"}, {"records", "directions", "operations"}, "");
  std::string absent;
  for (const Effect& effect : effects) {
    if (effect.count > 0)
      add({"  " + effect.name, std::to_string(effect.count)}, recorded(effect, all), effect.description);
    else
      absent += (absent.empty() ? "" : ", ") + effect.name;
  }
  std::fprintf(to, "effects\n");
  print_table(active, to);
  if (!absent.empty()) std::fprintf(to, "    absent, never evaluated: %s\n", absent.c_str());
}

/// Lists the conditions of the trim, and the values of their unknowns at the beginning.
void print_trims(std::FILE* to, const Model& model, const PathPoint& point) {
  const bool computed = point.status == PointStatus::computed;
  std::vector<std::vector<std::string>> rows;
  Eigen::Index row = model.n_constraints();
  for (const Trim& trim : model.description().trims) {
    const Parameter& parameter = model.description().parameters[static_cast<std::size_t>(trim.parameter)];
    const double value = computed ? point.equilibrium.lambda[row++] : parameter.value;
    rows.push_back({"  " + parameter.name, trim.condition,
                    (computed ? "" : "guess ") + rounded(value, 8) + " " + parameter.unit});
  }
  print_section(to, "trim: unknown parameters, constant in the motion, and what holds at the equilibrium",
                rows);
}

/// Lists the states that elements have of their own.
void print_states(std::FILE* to, const Model& model) {
  int count = 0;
  for (const Effect& effect : model.description().effects) count += effect.states;
  const ModelDescription& description = model.description();
  std::vector<std::vector<std::string>> rows;
  std::size_t next = description.coordinate_names.size() - static_cast<std::size_t>(count);
  for (const EffectHelp& help : effect_reference()) {
    const auto effect = std::ranges::find(description.effects, help.name, &Effect::name);
    for (int i = 0; effect != description.effects.end() && i < effect->states; ++i, ++next)
      rows.push_back({"  " + printable(description.coordinate_names[next]),
                      description.coordinate_units[next],
                      help.states[static_cast<std::size_t>(i) % help.states.size()].help});
  }
  print_section(to, "states of elements, of first order", rows);
}

void print_model(std::FILE* to, const Model& model, int traced) {
  print_parameters(to, model, traced);
  print_data(to, model);
  print_effects(to, model);
  print_states(to, model);
}

/// Prints the effects for each mode, ordered by their influence on its eigenvalue.
void print_influences(std::FILE* to, const Influences& influences, const std::string& at) {
  std::fprintf(
      to,
      "influence of each effect on each mode at %s\n"
      "    change of s, relative to abs(s), per relative growth of the effect; the equilibrium follows\n",
      at.c_str());
  for (Eigen::Index i = 0; i < influences.s.size(); ++i) {
    const Complex s = influences.s[i];
    std::vector<EffectInfluence> ranked = influences.effects;
    std::ranges::stable_sort(ranked, std::ranges::greater(),
                             [i](const EffectInfluence& one) { return std::abs(one.derivatives[i]); });
    std::fprintf(to, "  mode %s  %s\n", std::to_string(i + 1).c_str(),
                 complex_text(s.real(), s.imag(), 8).c_str());
    std::vector<std::vector<std::string>> rows;
    for (const EffectInfluence& influence : ranked) {
      const Complex change = influence.derivatives[i] / (std::abs(s) > 0.0 ? std::abs(s) : 1.0);
      if (std::isnan(change.real())) {
        rows.push_back({"    " + influence.effect, "none: a multiple eigenvalue has no derivative"});
      } else {
        rows.push_back({"    " + influence.effect, rounded(std::abs(change), 3),
                        "real " + rounded(change.real(), 3), "imag " + rounded(change.imag(), 3)});
      }
    }
    print_table(rows, to);
  }
}

void explain_sensitivity(std::FILE* to, const Scene& scene, const OptionTexts& options) {
  const TraceSetup setup = prepare_trace(scene, options, Purpose::strengths);
  const Influences influences = effect_influences(setup);
  if (!influences.fault.empty()) throw InputError(scene.path + ": " + influences.fault);
  print_influences(to, influences, setup.options.parameter + " = " + exact_text(setup.options.from));
}

/// "; part 2 stands for 4 equal ones", for every number of equal ones; empty if no parts are equal. Equal
/// parts count as one.
std::string describe_equal(const IndependentParts& parts) {
  std::map<std::size_t, std::vector<std::string>> standing;  // parts by the number that they stand for
  for (std::size_t i = 0; i < parts.count(); ++i) {
    if (!parts.ranges[i].copies.empty())
      standing[1 + parts.ranges[i].copies.size()].push_back(std::to_string(i + 1));
  }
  std::string text;
  for (const auto& [equal, which] : standing) {
    const bool one = which.size() == 1;
    text += (one ? "; part " : "; parts ") + enumerated(which) + (one ? " stands for " : " stand for ") +
            std::to_string(equal) + (one ? " equal ones" : " equal ones each");
  }
  return text;
}

/// Size of the matrices that are factored: a complex part has half of the coordinates of its pair.
Eigen::Index solved_size(const IndependentParts::Range& range) {
  return range.complex_sign == 0 ? range.size : range.size / 2;
}

/// "; parts 2 and 3 are a conjugate pair of complex parts, ..."; empty if there is none.
std::string describe_pairs(const IndependentParts& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.count(); ++i) {
    if (parts.ranges[i].complex_sign <= 0) continue;
    text += "; parts " + std::to_string(i + 1) + " and " + std::to_string(i + 2) +
            " are a conjugate pair of complex parts, as forward and backward whirl of an isotropic shaft";
  }
  return text;
}

/// "3 independent parts: 3 of 2 freedoms"; empty where the equations do not fall apart.
std::string describe(const std::shared_ptr<const IndependentParts>& parts) {
  if (!parts) return "";
  if (!parts->falls_apart()) return "one; rows and columns scaled by powers of two";
  std::map<Eigen::Index, std::size_t, std::greater<>> number;  // of parts by size
  std::size_t total = 0;
  for (const IndependentParts::Range& range : parts->ranges) {
    number[solved_size(range)] += 1 + range.copies.size();
    total += 1 + range.copies.size();
  }
  const auto of_size = [](const auto& group) {
    const auto& [size, count] = group;
    return std::to_string(count) + " of " + std::to_string(size) + (size == 1 ? " freedom" : " freedoms");
  };
  return std::to_string(total) + " independent parts: " + joined(number, ", ", of_size) +
         describe_pairs(*parts) + describe_equal(*parts) + "; followed one by one";
}

void print_structure(std::FILE* to, const Structure& structure, bool has_constraints,
                     const std::string& in_parts, const std::string& parameter) {
  const auto along = [&](bool constant) {
    return constant ? "constant along " + parameter : "changes with " + parameter;
  };
  const char* stiffness = structure.circulatory ? "unsymmetric K (circulatory effects)" : "symmetric K";
  const char* damping = structure.gyroscopic ? (structure.damped ? "C with a gyroscopic and a symmetric part"
                                                                 : "skew C (gyroscopic)")
                        : structure.damped   ? "symmetric C"
                                             : "no C";
  std::vector<std::vector<std::string>> rows(
      {{"  mass", structure.symmetric_mass ? "symmetric M" : "unsymmetric M", along(structure.constant_mass)},
       {"  damping", damping,
        structure.damped || structure.gyroscopic ? along(structure.constant_damping) : ""},
       {"  stiffness", stiffness, along(structure.constant_stiffness)},
       {"  constraints", has_constraints ? "A" : "none",
        has_constraints ? along(structure.constant_constraints) : ""}});
  if (!in_parts.empty()) rows.push_back({"  parts", in_parts, ""});
  print_section(to, "structure of the pencil", rows);
}

/// Why a model takes its route.
std::string reason_of(const Route& route) {
  if (!route.work)
    return "the dense engine holds " + std::to_string(limits::matrix_rows) + " coordinates at most";
  const auto billions = [](double operations) { return rounded(1e-9 * operations, 2) + " billion"; };
  return billions(route.work->projected) + " operations, " + billions(route.work->dense) +
         " with all freedoms; taken from a ratio of " + rounded(worth_projecting, 3) + " on";
}

/// The route of a large model, before anything is factored.
void print_route(std::FILE* to, const Route& route, const ProjectionEstimate& estimate,
                 const TraceOptions& options) {
  const auto megabytes = [](double bytes) { return rounded(bytes / 1e6, 3) + " MB"; };
  const std::string followed = in_words(options.modes);
  const bool scene = estimate.coordinates > 0;
  std::string model = std::to_string(estimate.freedoms) + " freedoms";
  if (scene) {
    model += ": " + std::to_string(estimate.coordinates) + " coordinates, " +
             std::to_string(estimate.coordinates - estimate.freedoms) + " constraints";
  }
  model += ", " + std::to_string(estimate.nonzeros) +
           (scene ? " nonzeros in M, C, K and A together" : " nonzeros in M, C and K together");
  std::vector<std::vector<std::string>> rows{
      {"  model", model},
      {"  chosen", "the projection: " + reason_of(route)},
      {"  projection", "onto the vectors of " + followed + (estimate.two_sided ? ", right and left" : "") +
                           ", at both ends of the range of " + options.parameter +
                           " and where residuals are largest"},
      {"  factorization", estimate.method + " at each, " + megabytes(estimate.factor_bytes) + ", " +
                              rounded(estimate.factor_operations / 1e9, 3) + " Gflop"},
      {"  memory", megabytes(estimate.total_bytes) + " with the vectors"}};
  if (scene)
    rows.push_back({"  equilibrium",
                    estimate.moves ? "of all coordinates, followed: such a factorization for each correction"
                                   : "of all coordinates, solved once"});
  rows.push_back(
      {"  trace", scene ? "of the scene on the motions of the projection, some tens, by the dense engine"
                        : "of the projected family, with some tens of coordinates, by the dense engine"});
  rows.push_back({"  error", "of the projection below " + rounded(estimate.target, 3) +
                                 " of each eigenvalue; the tolerance " + exact_text(options.tolerance) +
                                 " is that of the large model"});
  print_section(to, "route", rows);
}

/// The method that computes the modes, and its cost relative to one LU per mode.
std::string describe_route(const Structure& structure, const ModeWork& work) {
  const ModeRoute route = cheapest_route(structure, work);
  if (route == ModeRoute::one_by_one)
    return "chord-Newton, one LU of size " + std::to_string(work.freedoms + 1) + " per mode and point";
  const double share =
      route_work(route, structure, work) / route_work(ModeRoute::one_by_one, structure, work);
  const std::string how = route == ModeRoute::symmetric
                              ? "all at once by real products of size n (undamped, symmetric)"
                              : "all at once by products in state space, size 2 n";
  return how + ": about " + percent(share, 2) + " of the work of one LU per mode";
}

void print_solvers(std::FILE* to, const Model& model, const Structure& structure, const ModeWork& work,
                   bool chosen, bool sparse, const Route& route) {
  const int order = work.order;
  std::string equilibrium =
      "KINSOL with line search at every point, predicted by its series of " + order_text(order, chosen);
  if (structure.known_equilibrium) {
    equilibrium = "known: x = 0; KINSOL is never called";
  } else if (structure.fixed_equilibrium) {
    equilibrium = "does not move: KINSOL at the first point only";
  }
  const std::string first = sparse ? "rank-revealing QR at the first point, then projected by sparse factors"
                                   : "rank-revealing QR at every point";
  std::string basis = first + ", series T_1 ... T_" + std::to_string(order);
  if (model.n_constraints() == 0) {
    basis = "identity: no constraints";
  } else if (structure.constant_constraints) {
    basis = first + ", T' = 0";
  }
  std::vector<std::vector<std::string>> rows{
      {"  matrices", sparse ? "sparse: many coordinates, few freedoms" : "dense"},
      {"  equilibrium", equilibrium},
      {"  tangent basis", basis},
      {"  starting spectrum", "LAPACK QZ of the scaled companion pencil"},
      {"  modes", describe_route(structure, work) + "; series of " + order_text(order, chosen)},
      {"  dense output", "Hermite interpolation of degree " + std::to_string(2 * order + 1)}};
  if (route.work) rows.push_back({"  not projected", reason_of(route)});
  print_section(to, "solvers", rows);
}

Sizes sizes_at(const Model& model, const PathPoint& point) {
  Sizes sizes{model.n_coordinates(), model.n_constraints(), 0, model.n_coordinates()};
  if (point.status != PointStatus::computed) return sizes;
  sizes.redundant = model.n_constraints() - point.equilibrium.kkt.constraints().rank();
  sizes.freedoms = point.pencil.size();
  return sizes;
}

}  // namespace

Route explain(std::FILE* to, const TraceSetup& setup, const OptionTexts& option_texts, bool sensitivity,
              const SparseSolverMaker& solver) {
  const auto& [scene, options, model] = setup;
  check_parameter_name(scene, options.parameter);
  if (sensitivity && is_matrix_family(scene))
    throw InputError(scene.path + ": --sensitivity ranks effects; a family of matrices has none");
  const int traced = setup.traced();
  const Structure structure = model->structure(traced);

  print_title(scene.title, to);
  const Route route = route_of(*model, options);
  if (route.is_projected) {
    print_model(to, *model, traced);
    print_route(to, route, estimate_projection(*model, options, solver), options);
    if (sensitivity) explain_sensitivity(to, scene, option_texts);
    return route;
  }
  const PathProblem problem = problem_along(*model, options.parameter);
  RunCounts counts;
  const Vector guess = model->initial_guess(parameters_at(problem, options.from));
  const PathPoint point = reduce_at(problem, options.from, {guess, Vector()}, Matrix(), counts);
  const bool computed = point.status == PointStatus::computed;
  const Sizes sizes = sizes_at(*model, point);
  auto parts = parts_of_family(problem, options);
  if (!parts && computed)
    parts = scene_on_range(problem, options, point.equilibrium.x, point.equilibrium.lambda).parts;
  if (computed) {
    std::vector<std::string> sentences = in_words(setup, structure, sizes);
    const std::vector<std::string> free = free_motions_in_words(*model, point, parts.get());
    sentences.insert(sentences.end(), free.begin(), free.end());
    for (const std::string& sentence : sentences) std::fprintf(to, "  %s\n", sentence.c_str());
  }
  print_model(to, *model, traced);
  print_trims(to, *model, point);
  print_structure(to, structure, model->n_constraints() > 0, describe(parts), options.parameter);
  const int cheapest = cheapest_order({sizes.freedoms, options.certify}, options.tolerance);
  // Infinite eigenvalues are detected only at the start of a trace. Its modes are then corrected one by one,
  // which is not known here.
  const auto modes = std::min<Eigen::Index>(options.modes.count.value_or(static_cast<int>(sizes.freedoms)),
                                            2 * sizes.freedoms);
  // Independent parts are followed one by one, each with matrices of its own size.
  const bool apart = parts && parts->falls_apart();
  Eigen::Index size = apart ? 0 : sizes.freedoms;
  for (std::size_t i = 0; apart && i < parts->count(); ++i)
    size = std::max(size, solved_size(parts->ranges[i]));
  print_solvers(to, *model, structure,
                {size, modes, options.modes.is_all() && !apart, options.order.value_or(cheapest)},
                !options.order, computed && point.equilibrium.linearization.K[0].is_sparse(), route);
  if (!computed) throw InputError(scene.path + ": " + point.message);
  if (sensitivity) explain_sensitivity(to, scene, option_texts);
  return route;
}

}  // namespace eigentrail::app
