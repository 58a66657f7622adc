#include "support/chains.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace eigentrail::test {
namespace {

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

EvaluationFault OtherKind::linearize(const Path& path, int order, Linearization& result,
                                     EvaluationCounts& counts) const {
  Linearization own;
  const EvaluationFault fault = model_.linearize(path, order, own, counts);
  result = {converted(own.M, kind_), converted(own.C, kind_), converted(own.K, kind_),
            converted(own.A, kind_)};
  return fault;
}

}  // namespace eigentrail::test
