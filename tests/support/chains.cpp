#include "support/chains.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace eigentrail::test {
namespace {

constexpr int links = 13;
constexpr double hub_radius = 0.5, link_length = 10.0 / links;  // m
constexpr double link_mass = 20.0 * link_length;                // kg
constexpr double flap_stiffness = 5e5, lag_stiffness = 5e6;     // N m^2
constexpr double hinge_radius = 0.1, link = 0.05, tip_force = 0.1;

void write_chain(int number, int points, std::ostream& text) {
  const double angle = 2.0 * std::numbers::pi * number / 3.0;
  const double length = link * (1.0 + 0.07 * number);
  const auto place = [&](double radius) {
    std::ostringstream at;
    at.precision(17);
    at << '[' << radius * std::cos(angle) << ", " << radius * std::sin(angle) << ", 0]";
    return at.str();
  };
  std::string inner = place(hinge_radius);
  for (int i = 0; i < points; ++i) {
    const std::string name = "\"chain " + std::to_string(number) + " point " + std::to_string(i) + "\"";
    text << "[[point]]\nname = " << name << "\nmass = " << 1.0 + 0.1 * ((7 * i + 3 * number) % 5)
         << "\nposition = " << place(hinge_radius + (i + 1) * length) << "\n[[rod]]\nfrom = " << inner
         << "\nto = " << name << "\nlength = " << length << "\n[[fixed]]\npoint = " << name
         << "\ncoordinate = \"z\"\n";
    inner = name;
  }
  text << "[[force]]\npoint = " << inner << "\ncomponents = [" << -tip_force * std::sin(angle) << ", "
       << tip_force * std::cos(angle) << ", 0]\n[[drag]]\npoint = " << inner << "\ncoefficient = 0.01\n";
}

/// Link `i` of a blade at an angle, stiffer by `tuned` than it should be.
void write_link(int blade, int i, double angle, double tuned, std::ostream& text) {
  const auto name = [blade](int link) {
    return "blade " + std::to_string(blade) + " link " + std::to_string(link);
  };
  const double c = std::cos(angle), s = std::sin(angle);
  const double radius = hub_radius + i * link_length;
  text << "[[body]]\nname = \"" << name(i) << "\"\nmass = " << link_mass << "\ncentre = ["
       << 0.5 * link_length << ", 0, 0]\ninertia = [" << link_mass * link_length * link_length / 100.0 << ", "
       << link_mass * link_length * link_length / 12.0 << ", " << link_mass * link_length * link_length / 12.0
       << "]\nposition = [" << c * radius << ", " << s * radius << ", 0]\nx_axis = [" << c << ", " << s
       << ", 0]\nz_axis = [0, 0, 1]\nmarkers = { end = [" << link_length << ", 0, 0] }\n"
       << "[[universal]]\nname = \"" << name(i) << "\"\nfrom = ";
  if (i == 0) {
    text << "{ body = \"hub\", at = [" << c * hub_radius << ", " << s * hub_radius << ", 0] }";
  } else {
    text << "\"" << name(i - 1) << ".end\"";
  }
  text << "\nto = \"" << name(i) << "\"\naxis = \"" << name(i) << ".y\"\ncross_axis = \"" << name(i)
       << ".z\"\n";
  // A clamped blade's root is half a link away from the next joint.
  const double share = tuned * (i == 0 ? 2.0 : 1.0) / link_length;
  for (const auto& [about, stiffness] :
       {std::pair("axis", flap_stiffness), std::pair("cross_axis", lag_stiffness)}) {
    text << "[[torsional_spring]]\njoint = \"" << name(i) << "\"\nabout = \"" << about
         << "\"\nstiffness = " << share * stiffness << "\n";
  }
}

SystemSeries converted(const SystemSeries& series, OtherKind::Kind kind) {
  SystemSeries result;
  for (const SystemMatrix& B : series) {
    if (kind == OtherKind::Kind::dense)
      result.emplace_back(B.dense());
    else
      result.emplace_back(SparseMatrix(B.dense().sparseView()));
  }
  return result;
}

}  // namespace

std::string rotating_chains(int points) {
  std::ostringstream text;
  text.precision(17);
  text << "[parameters]\nomega = 1.0\n[trace]\nparameter = \"omega\"\nfrom = 1.0\nto = 10.0\n"
          "[frame]\nangular_velocity = [0, 0, \"omega\"]\n";
  for (int number = 0; number < 3; ++number) write_chain(number, points, text);
  return text.str();
}

std::string three_blades() {
  std::ostringstream text;
  text.precision(17);
  text << "[parameters]\nomega = 1.0\n[trace]\nparameter = \"omega\"\nfrom = 1.0\nto = 10.0\n"
          "[frame]\nangular_velocity = [0, 0, \"omega\"]\n"
          "[[body]]\nname = \"hub\"\nmass = 150\ninertia = [4, 4, 8]\nposition = [0, 0, 0]\n"
          "[[weld]]\nfrom = [0, 0, 0]\nto = \"hub\"\n";
  const double tuned[] = {1.0, 1.02, 0.98};
  for (int blade = 0; blade < 3; ++blade) {
    for (int i = 0; i < links; ++i)
      write_link(blade, i, 2.0 * std::numbers::pi * blade / 3.0, tuned[blade], text);
  }
  return text.str();
}

EvaluationFault OtherKind::linearize(const Path& path, int order, Linearization& result,
                                     EvaluationCounts& counts) const {
  Linearization own;
  const EvaluationFault fault = model_.linearize(path, order, own, counts);
  result = {converted(own.M, kind_), converted(own.C, kind_), converted(own.K, kind_),
            converted(own.A, kind_)};
  return fault;
}

}  // namespace eigentrail::test
