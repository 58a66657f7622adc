#include "model/beam_table.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "model/station_columns.hpp"

namespace eigentrail {
namespace {

/// Ratio of shear and extensional stiffness of a solid rectangular section with Poisson's ratio 0.3: a shear
/// factor 5/6 times G/E = 1/2.6.
constexpr double usual_shear = 5.0 / 6.0 / 2.6;

using Column = std::vector<Expression>;
using StrainVector = std::array<Expression, 6>;

/// Column of the file for entry (i, j) of the stiffness, counted from 0: "S11", "S21".
std::string entry_key(std::size_t i, std::size_t j) {
  return "S" + std::to_string(std::max(i, j) + 1) + std::to_string(std::min(i, j) + 1);
}

/// N for forces by extension and shear, N m for those by curvature, N m^2 for moments by curvature.
std::string entry_unit(std::size_t i, std::size_t j) {
  const int curvatures = int{i > 2} + int{j > 2};
  return curvatures == 0 ? "N" : curvatures == 1 ? "N m" : "N m^2";
}

/// Columns that a file of stations may have.
std::vector<FieldHelp> file_fields() {
  std::vector<FieldHelp> fields = beam_table_fields();
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) fields.push_back({entry_key(i, j), entry_unit(i, j), ""});
  }
  return fields;
}

/// Adds k v v^T.
void add_product(BeamTable::Stiffness& S, const Expression& k, const StrainVector& v) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) S[section_entry(i, j)] = S[section_entry(i, j)] + k * v[i] * v[j];
  }
}

/// Stiffness from that of extension about the tension centre and of shear and twist about the shear centre.
/// Extension at (y, z) is Gamma_x + z kappa_y - y kappa_z; shear there is Gamma_y - z kappa_x, Gamma_z + y
/// kappa_x.
std::vector<BeamTable::Stiffness> engineering_stiffness(StationColumns& columns,
                                                        const std::optional<Expression>& blade_length) {
  // Keys that have been asked for are no misprints of one that is missing.
  for (const char* key : {"EA", "GJ", "EI_flap", "EI_lag", "GA_flap", "GA_lag"}) (void)columns.has(key);
  Column EA, GJ;
  if (!blade_length || columns.has("EA")) EA = columns.required("EA", "N", Range::positive);
  if (!blade_length || columns.has("GJ")) GJ = columns.required("GJ", "N m^2", Range::positive);
  const Column flap = columns.required("EI_flap", "N m^2", Range::positive);
  const Column lag = columns.required("EI_lag", "N m^2", Range::positive);
  for (std::size_t i = EA.size(); i < lag.size(); ++i) EA.push_back(blade_EA(lag[i], *blade_length));
  for (std::size_t i = GJ.size(); i < lag.size(); ++i) GJ.push_back(blade_GJ(flap[i], lag[i]));
  const auto shear = [&](const std::string& key) {
    if (columns.has(key)) return columns.required(key, "N", Range::positive);
    Column usual;
    for (const Expression& e : EA) usual.push_back(usual_shear * e);
    return usual;
  };
  const Column shear_lag = shear("GA_lag");
  const Column shear_flap = shear("GA_flap");
  const Column ty = columns.optional("tension_y", "m");
  const Column tz = columns.optional("tension_z", "m");
  const Column sy = columns.optional("shear_y", "m");
  const Column sz = columns.optional("shear_z", "m");
  std::vector<BeamTable::Stiffness> stiffness(columns.stations());
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    const Expression none(0.0);
    add_product(stiffness[i], EA[i], {1.0, none, none, none, tz[i], -ty[i]});
    add_product(stiffness[i], shear_lag[i], {none, 1.0, none, -sz[i], none, none});
    add_product(stiffness[i], shear_flap[i], {none, none, 1.0, sy[i], none, none});
    add_product(stiffness[i], GJ[i], {none, none, none, 1.0, none, none});
    add_product(stiffness[i], flap[i], {none, none, none, none, 1.0, none});
    add_product(stiffness[i], lag[i], {none, none, none, none, none, 1.0});
  }
  return stiffness;
}

/// The matrix of each station from the columns S11, S21, ... of the file. Those that are left out are zero.
std::vector<BeamTable::Stiffness> stiffness_columns(const TableReader& table, StationColumns& columns) {
  std::vector<BeamTable::Stiffness> stiffness(columns.stations());
  std::vector<Eigen::Matrix<double, 6, 6>> values(columns.stations(), Eigen::Matrix<double, 6, 6>::Zero());
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (!columns.in_file(entry_key(i, j))) continue;
      const Column column = columns.required(entry_key(i, j), entry_unit(i, j), Range::any);
      for (std::size_t k = 0; k < stiffness.size(); ++k) {
        stiffness[k][section_entry(i, j)] = column[k];
        values[k](static_cast<int>(i), static_cast<int>(j)) = column[k].value();
      }
    }
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (Eigen::LLT<Eigen::MatrixXd>(values[k]).info() != Eigen::Success)
      table.fail("file", "the matrix of station " + std::to_string(k + 1) +
                             " (columns S11, S21, ... S66) must be positive definite; it is not");
  }
  return stiffness;
}

/// A 6 x 6 matrix, the same for all stations. It must be symmetric and positive definite.
std::vector<BeamTable::Stiffness> full_stiffness(Draft& draft, TableReader& table, std::size_t stations) {
  const auto rows = table.matrix("stiffness");
  const bool square =
      rows.size() == 6 && std::all_of(rows.begin(), rows.end(), [](const auto& r) { return r.size() == 6; });
  if (!square) table.fail("stiffness", "expected a 6 x 6 matrix");
  for (const auto& row : rows) {
    for (const Expression& e : row) draft.check_range(table, "stiffness", e, Range::any);
  }
  for (std::size_t p = 0; p < draft.check_at.size(); ++p) {
    Eigen::Matrix<double, 6, 6> S;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j)
        S(static_cast<int>(i), static_cast<int>(j)) = draft.check_values(rows[i][j])[p];
    }
    if ((S - S.transpose()).norm() > 1e-12 * S.norm())
      table.fail("stiffness", "must be symmetric; it is not" + Draft::where_on_trace(p));
    if (Eigen::LLT<Eigen::MatrixXd>(S).info() != Eigen::Success)
      table.fail("stiffness", "must be positive definite; it is not" + Draft::where_on_trace(p));
  }
  BeamTable::Stiffness S;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) S[section_entry(i, j)] = rows[i][j];
  }
  return std::vector<BeamTable::Stiffness>(stations, S);
}

/// Moments of the mass about the axis. Without inertias the mass is spread as the stiffness is: m EI/EA.
std::vector<BeamTable::Mass> read_mass(const Draft& draft, const TableReader& table, StationColumns& columns,
                                       const std::vector<BeamTable::Stiffness>& stiffness) {
  const Column product = columns.optional("inertia_product", "kg m");
  const Column mass = columns.required("mass", "kg/m", Range::positive);
  const Column y = columns.optional("centre_y", "m");
  const Column z = columns.optional("centre_z", "m");
  const auto inertia = [&](const std::string& key, std::size_t bending) {
    if (columns.has(key)) return columns.required(key, "kg m", Range::non_negative);
    Column usual;
    for (std::size_t i = 0; i < mass.size(); ++i) {
      const BeamTable::Stiffness& S = stiffness[i];
      usual.push_back(mass[i] * S[section_entry(bending, bending)] / S[0]);
    }
    return usual;
  };
  const Column flap = inertia("inertia_flap", 4);
  const Column lag = inertia("inertia_lag", 5);
  std::vector<BeamTable::Mass> moments;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const std::vector<double> squares = draft.check_values(product[i] * product[i]);
    const std::vector<double> most = draft.check_values(flap[i] * lag[i]);
    draft.require(table, "inertia_product",
                  "no section has it: its square exceeds inertia_flap times inertia_lag",
                  [&](std::size_t p) { return !(squares[p] > most[p] * (1.0 + 1e-12)); });
    moments.push_back({mass[i], mass[i] * y[i], mass[i] * z[i], lag[i] + mass[i] * y[i] * y[i],
                       flap[i] + mass[i] * z[i] * z[i], product[i] + mass[i] * y[i] * z[i]});
  }
  return moments;
}

}  // namespace

Expression blade_EA(const Expression& EI_lag, const Expression& length) {
  return Expression(1e4) * EI_lag / (length * length);
}

Expression blade_GJ(const Expression& EI_flap, const Expression& EI_lag) {
  return Expression(1.0 / 2.6) * (EI_flap + EI_lag);
}

BeamTable read_beam_table(Draft& draft, TableReader& table, const std::optional<Expression>& blade_length) {
  StationColumns columns(draft, table, file_fields());
  BeamTable result;
  result.span = columns.span();
  if (table.has("stiffness"))
    result.stiffness = full_stiffness(draft, table, columns.stations());
  else if (columns.in_file("S11"))
    result.stiffness = stiffness_columns(table, columns);
  else
    result.stiffness = engineering_stiffness(columns, blade_length);
  result.mass = read_mass(draft, table, columns, result.stiffness);
  for (const char* key : {"sweep", "prebend"}) {
    if (columns.has(key) && columns.stations() < 2) table.fail(key, "needs stations; give span as well");
    result.straight = result.straight && !columns.has(key);
  }
  result.twisted = columns.has("twist");
  result.twist = columns.optional("twist", "rad");
  result.sweep = columns.optional("sweep", "m");
  result.prebend = columns.optional("prebend", "m");
  return result;
}

std::vector<FieldHelp> beam_table_fields(bool blade) {
  return {
      {"span", "list",
       "where the stations are, from the first at `from` to the last at `to`, in any unit; keys "
       "below then may be lists of a number per station, linear in between",
       "uniform beam"},
      {"file", "text",
       "CSV file with columns span and any keys below, beside the scene; units in brackets: `twist [deg]`",
       "none"},
      {"mass", "kg/m", "mass per length"},
      {"EA", "N", "extensional stiffness", blade ? "10^4 EI_lag/length^2" : ""},
      {"EI_flap", "N m^2", "stiffness of bending that moves along the z axis of the section"},
      {"EI_lag", "N m^2", "stiffness of bending that moves along its y axis"},
      {"GJ", "N m^2", "torsional stiffness", blade ? "(EI_flap + EI_lag)/2.6" : ""},
      {"GA_flap", "N", "shear stiffness along z, shear factor included", "0.32 EA"},
      {"GA_lag", "N", "shear stiffness along y", "0.32 EA"},
      {"stiffness", "6 x 6",
       "in place of all stiffnesses: of extension, shear along y and z, twist, bending about y and z; "
       "by station as columns S11, S21, S22, S31, ... S66 of the file",
       "none"},
      {"inertia_flap", "kg m", "mass moment of inertia per length about y, at the mass centre",
       "mass EI_flap/EA"},
      {"inertia_lag", "kg m", "likewise about z", "mass EI_lag/EA"},
      {"inertia_product", "kg m", "integral of y z over the mass per length, about the mass centre", "0"},
      {"centre_y", "m", "mass centre of the section", "0"},
      {"centre_z", "m", "likewise", "0"},
      {"tension_y", "m", "tension centre: an axial force there does not bend", "0"},
      {"tension_z", "m", "likewise", "0"},
      {"shear_y", "m", "shear centre: a transverse force there does not twist", "0"},
      {"shear_z", "m", "likewise", "0"},
      {"twist", "rad", "of the section about the axis of the beam, y towards z", "0"},
      {"sweep", "m", "distance of the axis of the beam from the line between the ends, along y", "0"},
      {"prebend", "m", "likewise along z", "0"}};
}

}  // namespace eigentrail
