// Families of matrices, polynomial in the parameter: scene text and pencil from one set of coefficients.
#pragma once

#include <string>
#include <vector>

#include "hard_cases/catalogue.hpp"
#include "support/matrix_text.hpp"

namespace eigentrail::test {

/// Source of cases of our own.
constexpr const char* own_closed_form = "own derivation, closed form";

using Family = FamilyMatrices;

/// Real matrix from rows, for families written by hand.
Matrix rows(std::initializer_list<std::initializer_list<double>> values);
Matrix diagonal(std::initializer_list<double> values);
/// {{0, -1}, {1, 0}}.
Matrix quarter_turn();

WidePencil evaluate(const Family& family, WideComplex p);

/// A case with scene and pencil of the family, and the spectrum from that pencil.
HardCase family_case(const std::string& name, const std::string& source, double from, double to,
                     const Family& family, std::vector<SpecialPoint> special);

/// A case with the given matrices as expressions; `pencil` must be the same.
HardCase expression_case(const std::string& name, const std::string& source, double from, double to,
                         const std::string& scene, const std::function<WidePencil(WideComplex)>& pencil,
                         std::vector<SpecialPoint> special);

/// Replaces the spectrum by a closed form.
void set_spectrum(HardCase& hard_case, const std::function<std::vector<Complex>(Wide)>& closed_form);

/// Gives the case analytic branches.
void set_branches(HardCase& hard_case, std::vector<std::function<WideComplex(Wide)>> branches);

}  // namespace eigentrail::test
