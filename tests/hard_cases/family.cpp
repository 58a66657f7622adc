#include "hard_cases/family.hpp"

#include <algorithm>
#include <utility>

namespace eigentrail::test {
namespace {

WideComplexMatrix evaluate(const MatrixSeries& series, Eigen::Index n, WideComplex p) {
  WideComplexMatrix value = WideComplexMatrix::Zero(n, n);
  for (std::size_t k = series.size(); k-- > 0;) value = value * p + series[k].cast<WideComplex>();
  return value;
}

}  // namespace

Matrix rows(std::initializer_list<std::initializer_list<double>> values) {
  return Matrix(values);
}

Matrix diagonal(std::initializer_list<double> values) {
  Vector entries(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), entries.begin());
  return entries.asDiagonal();
}

Matrix quarter_turn() {
  return rows({{0, -1}, {1, 0}});
}

WidePencil evaluate(const Family& family, WideComplex p) {
  const Eigen::Index n = family.M[0].rows();
  return {evaluate(family.M, n, p), evaluate(family.C, n, p), evaluate(family.K, n, p)};
}

HardCase family_case(const std::string& name, const std::string& source, double from, double to,
                     const Family& family, std::vector<SpecialPoint> special) {
  return expression_case(
      name, source, from, to, family_scene(family, from, to),
      [family](WideComplex p) { return evaluate(family, p); }, std::move(special));
}

HardCase expression_case(const std::string& name, const std::string& source, double from, double to,
                         const std::string& scene, const std::function<WidePencil(WideComplex)>& pencil,
                         std::vector<SpecialPoint> special) {
  HardCase result;
  result.name = name;
  result.scene = scene;
  result.from = from;
  result.to = to;
  result.spectrum = [pencil](double p) { return Spectra{eigenvalues(pencil(p))}; };
  result.special = std::move(special);
  result.source = source;
  result.pencil = [pencil](WideComplex p, int) { return pencil(p); };
  return result;
}

void set_spectrum(HardCase& hard_case, const std::function<std::vector<Complex>(Wide)>& closed_form) {
  hard_case.spectrum = [closed_form](double p) { return Spectra{closed_form(p)}; };
}

void set_branches(HardCase& hard_case, std::vector<std::function<WideComplex(Wide)>> branches) {
  hard_case.has_branches = true;
  for (auto& branch : branches) {
    hard_case.branches.emplace_back([branch = std::move(branch)](double p) { return narrow(branch(p)); });
  }
}

}  // namespace eigentrail::test
