// C01 to C03, C08: the rotating point mass of the seed paper, Sect. 6.3, Eq. (144), r >= 0, from its
// equilibrium in one scalar unknown. With L = 2 lambda and D = L - m w^2 the steady equations give
//     {x, y, z} = m w^2 e {D L, a_t L, a_n D} / (L (D^2 + a_t^2) + a_n^2 D),
// and x^2 + y^2 + z^2 = l^2 is left for D.
#include <array>
#include <cmath>
#include <sstream>

#include "hard_cases/parts.hpp"

namespace eigentrail::test {
namespace {

const char* const source =
    "seed paper, Sect. 6.3 (Table 1 where not stated); special points in 40-digit arithmetic, "
    "reference_multibody.py";

/// Data of Table 1, SI.
struct RotatingMass {
  Wide mass = 50, drag = 2, length = 5, offset = 1, normal = 1000;
};

/// A speed and a_t.
struct Operation {
  WideComplex speed, tangential;
};

using Position = std::array<WideComplex, 3>;

/// Coordinates relative to the hinge for a given D.
Position position(const RotatingMass& data, const Operation& at, WideComplex D) {
  const WideComplex pull = data.mass * at.speed * at.speed;
  const WideComplex L = D + pull;
  const WideComplex factor =
      pull * data.offset / (L * (D * D + at.tangential * at.tangential) + data.normal * data.normal * D);
  return {factor * D * L, factor * at.tangential * L, factor * data.normal * D};
}

/// (x^2 + y^2 + z^2) / l^2 - 1.
WideComplex length_error(const RotatingMass& data, const Operation& at, WideComplex D) {
  const Position x = position(data, at, D);
  return (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / (data.length * data.length) - Wide(1);
}

/// Where f changes its sign between a (f > 0) and b, to the last bit.
template <class Function>
Wide bisect(Wide a, Wide b, const Function& f) {
  for (int i = 0; i < 200; ++i) {
    const Wide middle = (a + b) / 2;
    if (middle == a || middle == b) break;
    (f(middle) > 0 ? a : b) = middle;
  }
  return (a + b) / 2;
}

/// Continues a root D from real parameters to complex ones in short steps.
WideComplex continue_root(const RotatingMass& data, const Operation& real, const Operation& target, Wide D0) {
  constexpr int steps = 40;
  WideComplex D = D0;
  for (int step = 1; step <= steps; ++step) {
    const Wide part = static_cast<Wide>(step) / steps;
    const Operation at{real.speed + part * (target.speed - real.speed),
                       real.tangential + part * (target.tangential - real.tangential)};
    for (int i = 0; i < 12; ++i) {
      const WideComplex h = Wide(1e-9) * D;
      const WideComplex slope =
          (length_error(data, at, D + h) - length_error(data, at, D - h)) / (Wide(2) * h);
      D -= length_error(data, at, D) / slope;
    }
  }
  return D;
}

/// T^T (.) T with an analytic T; `pivot` (0 or 1) names a coordinate that is not zero.
WidePencil reduced(const RotatingMass& data, const Operation& at, WideComplex D, int pivot) {
  const Position x = position(data, at, D);
  WideComplexMatrix T(3, 2);
  if (pivot == 0) {
    T << -x[1], -x[2], x[0], Wide(0), Wide(0), x[0];
  } else {
    T << x[1], Wide(0), -x[0], -x[2], Wide(0), x[1];
  }
  const WideComplex coriolis = Wide(2) * data.mass * at.speed;
  const WideComplex L = D + data.mass * at.speed * at.speed;
  const WideComplexMatrix I = WideComplexMatrix::Identity(3, 3);
  WideComplexMatrix C = data.drag * I;
  C(0, 1) -= coriolis;
  C(1, 0) += coriolis;
  WideComplexMatrix K(3, 3);
  K << D, at.tangential, data.normal, -at.tangential, D, Wide(0), -data.normal, Wide(0), L;
  const WideComplexMatrix Tt = T.transpose();
  return {Tt * (data.mass * I) * T, Tt * C * T, Tt * K * T};
}

/// The branch of largest lambda, unique for m w^2 e > |a_t| l.
WidePencil along_speed(const RotatingMass& data, WideComplex speed) {
  const Operation at{speed, -100};
  const Operation real{speed.real(), -100};
  const auto error = [&](Wide D) { return length_error(data, real, D).real(); };
  const Wide pull = data.mass * speed.real() * speed.real();
  Wide D = bisect(pull * Wide(1e-9), pull * 2 + 1000, error);
  WideComplex root = D;
  if (speed.imag() != 0) root = continue_root(data, real, at, D);
  return reduced(data, at, root, 0);
}

/// D where the error is largest for a given a_t at 40 rad/s; by its complex-step derivative.
Wide crest(const RotatingMass& data, const Operation& at) {
  constexpr Wide step = 1e-30L;
  return bisect(-2000, 2000, [&](Wide D) { return length_error(data, at, {D, step}).imag(); });
}

constexpr double fold_speed = 40.0;

/// Whether the path has an equilibrium at this a_t: beyond the fold the mass cannot be held.
bool before_fold(const RotatingMass& data, Wide tangential) {
  const Operation at{fold_speed, tangential};
  return length_error(data, at, crest(data, at)).real() >= 0;
}

/// Branch 0 comes from a_t = -100, branch 1 goes back from the fold.
WidePencil along_tangential(const RotatingMass& data, Wide tangential, int branch) {
  const Operation at{fold_speed, tangential};
  const Wide top = crest(data, at);
  const auto error = [&](Wide D) { return length_error(data, at, D).real(); };
  const Wide D = error(top) <= 0 ? top : bisect(top, branch == 0 ? 30000 : -30000, error);
  return reduced(data, at, D, 1);
}

std::string scene(const std::string& parameters, const std::string& trace) {
  return "[parameters]\n" + parameters + "\n[trace]\n" + trace +
         "\n[frame]\nangular_velocity = [0, 0, \"omega\"]\n\n"
         "[[point]]\nname = \"blade\"\nmass = \"mass\"\nposition = [\"offset + length\", 0, 0]\n\n"
         "[[rod]]\nfrom = [\"offset\", 0, 0]\nto = \"blade\"\nlength = \"length\"\n\n"
         "[[drag]]\npoint = \"blade\"\ncoefficient = \"drag\"\n\n"
         "[[transverse_force]]\npoint = \"blade\"\nhinge = [\"offset\", 0, 0]\ntangential = \"a_t\"\nnormal "
         "= \"a_n\"\n";
}

std::string table_1(double drag) {
  std::ostringstream text;
  text << "omega = 40.0\nmass = 50.0\nlength = 5.0\noffset = 1.0\ndrag = " << drag
       << "\na_t = -100.0\na_n = 1000.0\n";
  return text.str();
}

std::string speed_trace(double from, double to) {
  std::ostringstream text;
  text << "parameter = \"omega\"\nfrom = " << from << "\nto = " << to << "\n";
  return text.str();
}

HardCase speed_case(const std::string& name, double drag, double from, double to,
                    std::vector<SpecialPoint> special) {
  HardCase result;
  result.name = name;
  result.scene = scene(table_1(drag), speed_trace(from, to));
  result.from = from;
  result.to = to;
  RotatingMass data;
  data.drag = drag;
  result.pencil = [data](WideComplex speed, int) { return along_speed(data, speed); };
  result.spectrum = [data](double speed) { return Spectra{eigenvalues(along_speed(data, speed))}; };
  result.special = std::move(special);
  result.source = source;
  // The equilibrium itself has branch points 0.66 rad/s off the real axis.
  result.reach = 0.47 / std::abs(to - from);
  return result;
}

HardCase fold_in_force() {
  HardCase result;
  result.name = "C03_fold_in_tangential_force";
  result.from = -100.0;
  result.to = -17000.0;
  result.scene = scene(table_1(2.0), "parameter = \"a_t\"\nfrom = -100\nto = -17000\n");
  const RotatingMass data;
  result.pencil = [data](WideComplex a_t, int branch) { return along_tangential(data, a_t.real(), branch); };
  result.spectrum = [data](double a_t) -> Spectra {
    if (!before_fold(data, a_t)) return {{}, {}};
    return {eigenvalues(along_tangential(data, a_t, 0)), eigenvalues(along_tangential(data, a_t, 1))};
  };
  result.special = {{"collision", -16000.0048850866123502, -0.0200097606357542355105},
                    {"fold", -16000.00488509913870227772, 0.0}};
  result.source = source;
  result.reach = 0.0;  // only real special points were looked for
  return result;
}

/// C01 with r = 2 in other units, all times shorter by `speedup`; the speed is given in rad per that time.
/// The length has no influence.
HardCase scaled(const std::string& name, const std::string& parameters, double speedup) {
  HardCase result = speed_case(name, 2.0, 100.0, 5.0, {});
  result.scene = scene(parameters, speed_trace(100.0, 5.0));
  const auto slow = result.pencil;
  const Wide factor = speedup;
  result.pencil = [slow, factor](WideComplex speed, int branch) {
    WidePencil pencil = slow(speed, branch);
    pencil.C *= factor;
    pencil.K *= factor * factor;
    return pencil;
  };
  result.spectrum = [pencil = result.pencil](double speed) { return Spectra{eigenvalues(pencil(speed, 0))}; };
  result.special = {{"flutter", 12.4393882230095183014, {0.0, speedup * 5.25387667076506374971}}};
  return result;
}

}  // namespace

std::vector<HardCase> rotating_mass_cases() {
  // Masses by 1e-9, times by 1e-9: dampings by 1, stiffnesses by 1e9.
  const char* const micro =
      "omega = { value = 40.0, unit = \"rad/ns\" }\nmass = { value = 0.05, unit = \"mg\" }\n"
      "length = { value = 5.0, unit = \"um\" }\noffset = { value = 1.0, unit = \"um\" }\n"
      "drag = 2.0\na_t = -1e11\na_n = 1e12\n";
  const char* const kilo =
      "omega = 40.0\nmass = 50.0\nlength = { value = 5.0, unit = \"km\" }\n"
      "offset = { value = 1.0, unit = \"km\" }\ndrag = 2.0\na_t = -100.0\na_n = 1000.0\n";
  return {speed_case("C01_rotating_mass", 2.0, 100.0, 5.0,
                     {{"flutter", 12.4393882230095183014, {0.0, 5.25387667076506374971}}}),
          speed_case("C01_rotating_mass_drag_20", 20.0, 100.0, 5.0,
                     {{"flutter", 8.41860515331042239423, {0.0, 2.80286917231000229111}}}),
          speed_case("C02_rotating_mass_drag_500", 500.0, 20.0, 6.0,
                     {{"collision", 11.2936174862035816231, -4.63015461165238084335},
                      {"collision", 6.72870144151221395366, -1.47323972619259723333}}),
          fold_in_force(),
          scaled("C08_micrometres_and_nanoseconds", micro, 1e9),
          scaled("C08_kilometres", kilo, 1.0)};
}

}  // namespace eigentrail::test
