#include "eigentrail/continuation/operating_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/point/refined_spectrum.hpp"
#include "continuation/point/separate_points.hpp"
#include "eigentrail/continuation/eigenvalue_error.hpp"
#include "eigentrail/continuation/scene_parts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/model/projection.hpp"
#include "eigentrail/model/sample_errors.hpp"
#include "eigentrail/model/sampled_data.hpp"
#include "eigentrail/modes/energy_shares.hpp"
#include "eigentrail/modes/participation.hpp"
#include "eigentrail/modes/rotor_names.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "eigentrail/reduction/independent_parts.hpp"

namespace eigentrail {
namespace {

/// The mode of an eigenvalue s with its right vector `of_QZ`, and what follows from the left one. `shares`
/// are set to those by which each equation and its coordinate take part in the mode.
OperatingMode mode_at(const ReducedPencil& pencil, Complex s, const ComplexVector& of_QZ, double scale,
                      double rounding, Vector& shares) {
  const Matrix &M = pencil.M[0], &C = pencil.C[0], &K = pencil.K[0];
  const ComplexVector z = of_QZ.normalized();
  const double s_ref = share_that_is_zero * scale;
  // left^T P(s) = 0
  const ComplexVector left = eigenvector_near(M.transpose(), C.transpose(), K.transpose(), s, s_ref);
  const ComplexVector slope = 2.0 * s * (M * z) + C * z;
  const Complex product = left.transpose() * slope;
  const double magnitude = std::norm(s) * M.norm() + std::abs(s) * C.norm() + K.norm();
  const ComplexVector force = s * (s * (M * z) + C * z) + K * z;
  double condition = magnitude * left.norm() / (std::abs(product) * std::max(std::abs(s), s_ref));
  if (!(condition * std::numeric_limits<double>::epsilon() < 1.0))
    condition = std::numeric_limits<double>::infinity();
  shares = participation(left, slope, z, std::isfinite(condition));
  return {s, condition, magnitude > 0.0 ? force.norm() / magnitude : 0.0, rounding, {}, {}};
}

/// Names the modes by their kinetic energy, where the masses are known.
void name_by_energy(const TraceSetup& setup, const PathPoint& point, std::vector<OperatingMode>& modes) {
  const ModelDescription& description = setup.model->description();
  const SystemMatrix& M = point.equilibrium.linearization.M[0];
  const Vector& x = point.equilibrium.x;
  const EnergyShares shares(description, M, x);
  if (shares.motions().empty() || modes.empty()) return;
  ComplexMatrix shapes(x.size(), static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) shapes.col(static_cast<Eigen::Index>(i)) = modes[i].shape;
  const double speed = blade_rotor_speed(description, setup.parameters_at(point.p));
  std::vector<double> turns;
  for (const OperatingMode& mode : modes) turns.push_back(mode.s.imag() / speed);
  const std::vector<std::string> names = shares.names(shares.of(M, x, shapes), turns);
  for (std::size_t i = 0; i < modes.size(); ++i) modes[i].what_moves = names[i];
}

/// Names the modes of a rotor by the motion of its shafts.
void name_by_shafts(const TraceSetup& setup, double p, std::vector<OperatingMode>& modes) {
  const std::vector<SpinningShaft>& shafts = setup.model->description().shafts;
  if (shafts.empty()) return;
  const Vector parameters = setup.parameters_at(p);
  std::vector<RotorMode> described;
  for (const OperatingMode& mode : modes)
    described.push_back(rotor_mode(*setup.model, parameters, mode.s, mode.shape, mode.rounding));
  const std::vector<std::string> names = rotor_mode_names(described, shafts);
  for (std::size_t i = 0; i < modes.size(); ++i) modes[i].what_moves = names[i];
}

/// The freedoms of the large model that move most, if they have names.
std::string name_by_freedoms(const Projection& projection, const ComplexVector& reduced) {
  return has_own_names(projection.names) ? largest_names(projection.basis * reduced, projection.names) : "";
}

/// Number of the first modes that are shown: those that are wanted, and those that grow. Refines them, and
/// sets their errors by rounding.
int refine_shown(const ReducedPencil& pencil, int wanted, Spectrum& spectrum, std::vector<double>& rounding) {
  std::vector<StartingMode>& modes = spectrum.modes;
  const auto others = std::stable_partition(modes.begin() + wanted, modes.end(),
                                            [](const StartingMode& mode) { return mode.s.real() > 0.0; });
  rounding = refine(pencil, static_cast<int>(others - modes.begin()), spectrum);
  int shown = wanted;
  for (std::size_t i = static_cast<std::size_t>(wanted); i < rounding.size(); ++i) {
    if (!(modes[i].s.real() > rounding[i])) continue;
    std::swap(modes[static_cast<std::size_t>(shown)], modes[i]);
    std::swap(rounding[static_cast<std::size_t>(shown)], rounding[i]);
    ++shown;
  }
  return shown;
}

/// `point` is computed in the coordinates in which the equations fall apart, if they do: zeros of rigid-body
/// motions are exact there.
OperatingPoint spectrum_at(const TraceSetup& setup, const PathPoint& point, double p) {
  OperatingPoint result;
  result.p = p;
  Spectrum spectrum = compute_spectrum(point.pencil);
  if (spectrum.status != SpectrumStatus::complete) {
    result.fault = spectrum.status == SpectrumStatus::singular_pencil
                       ? "the pencil is singular: every number is an eigenvalue"
                       : "LAPACK's QZ did not converge";
    return result;
  }
  if (point.basis.parts && setup.options.constant_modes == "list")
    mark_permanent_zeros(*point.basis.parts, spectrum.modes);
  const ModeChoice& choice = setup.options.modes;
  const int wanted = choose_modes(choice, spectrum.modes);
  std::vector<double> rounding;
  spectrum.modes.resize(static_cast<std::size_t>(refine_shown(point.pencil, wanted, spectrum, rounding)));
  const bool none = wanted == 1 && !choice.wants(spectrum.modes.front().s);
  if (none && choice.band) {
    result.none_in_band = true;
    result.fault = "none of " + in_words(choice) + "; the nearest is " +
                   exact_text(spectrum.modes.front().s.imag()) + " rad/s";
    return result;
  }
  if (none) result.note = "none of " + in_words(choice) + "; the mode that misses this least is shown";
  const ModelDescription& description = setup.model->description();
  const bool unconstrained =
      point.basis.is_identity || (point.basis.parts && setup.model->n_constraints() == 0);
  const Linearization& physical = point.equilibrium.linearization;
  const ReducedPencil in_coordinates =
      unconstrained
          ? ReducedPencil{{physical.M[0].dense()}, {physical.C[0].dense()}, {physical.K[0].dense()}, {}}
          : point.pencil;
  for (std::size_t i = 0; i < spectrum.modes.size(); ++i) {
    const StartingMode& start = spectrum.modes[i];
    const ComplexVector shape = point.basis.shapes(start.z, start.part, start.copy).col(0);
    Vector shares;
    OperatingMode& mode = result.modes.emplace_back(
        mode_at(unconstrained ? in_coordinates : in_coordinates.of(start.part), start.s,
                unconstrained ? shape : start.z, spectrum.scale, rounding[i], shares));
    mode.shape = shape.normalized();
    const Projection* projection = setup.model->projection();
    if (projection != nullptr && projection->is_of_family()) {
      mode.what_moves = name_by_freedoms(*projection, shape);
    } else if (unconstrained) {
      mode.what_moves = largest_names(shares, shape, description.coordinate_names);
    }
  }
  name_by_energy(setup, point, result.modes);
  name_by_shafts(setup, p, result.modes);
  return result;
}

}  // namespace

void check_within_samples(const TraceSetup& setup, const std::vector<double>& values) {
  const SampleErrors* errors = setup.model->sample_errors();
  if (errors == nullptr || errors->parameter() != setup.traced()) return;
  const std::string& name = setup.options.parameter;
  std::vector<double> samples = errors->values();
  for (double& sample : samples) sample /= setup.model->description().parameters.at(name).factor;
  for (const double value : values) {
    const std::string fault = outside_samples(name, value, samples);
    if (!fault.empty()) throw InputError(setup.scene.path + ": " + fault);
  }
}

Complex shown(const OperatingMode& mode) {
  return std::isfinite(mode.rounding) ? shown(mode.s, mode.rounding) : mode.s;
}

std::vector<OperatingPoint> operating_points(const TraceSetup& setup, const std::vector<double>& values) {
  check_within_samples(setup, values);
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.parts =
      find_independent_parts(setup.model->coefficient_matrices(problem.parameters, problem.traced));
  if (SceneOnRange scene = scene_at_start(problem, setup.options); scene.rests) {
    problem.rests = true;
    problem.parts = std::move(scene.parts);
  }
  std::vector<OperatingPoint> points;
  for_each_point(problem, values, Matrix(), [&](const PathPoint& point) {
    points.push_back(point.status == PointStatus::computed ? spectrum_at(setup, point, point.p)
                                                           : OperatingPoint{point.p, point.message});
  });
  return points;
}

}  // namespace eigentrail
