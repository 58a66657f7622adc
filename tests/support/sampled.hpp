// Sampled families for tests: functions p -> A(p) sampled at values of p.
#pragma once

#include <functional>
#include <random>

#include "eigentrail/import/importer.hpp"
#include "support/folder.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {

using MatrixFunction = std::function<Matrix(double)>;

inline SampledData sampled(const MatrixFunction& A, const std::vector<double>& values) {
  SampledData data;
  data.values = values;
  for (const double p : values) data.A.push_back(A(p));
  return data;
}

/// The samples as a scene with the parameter p, in a folder that is removed with the object.
class SampledScene {
 public:
  explicit SampledScene(const SampledData& data, const std::string& keys = "",
                        const std::string& trace = "") {
    Imported imported;
    imported.parameter = data.parameter_name;
    imported.samples = data;
    write_import(imported, folder_.path(), "samples", true);
    const auto [least, most] = std::minmax_element(data.values.begin(), data.values.end());
    text_ = "[sampled_family]\nfile = \"samples.h5\"\n" + keys + "[trace]\nparameter = \"p\"\n" +
            (trace.empty() ? "from = " + std::to_string(*least) + "\nto = " + std::to_string(*most) +
                                 "\ntolerance = 1e-10\n"
                           : trace);
  }

  Setting setting(Purpose purpose = Purpose::trace) const {
    Setting setting;
    static_cast<TraceSetup&>(setting) =
        prepare_trace(parse_scene(text_, folder_.path() + "/scene.toml"), {}, purpose);
    return setting;
  }
  std::string file() const { return folder_.path() + "/samples.h5"; }

 private:
  Folder folder_;
  std::string text_;
};

/// n values from 0 to 1; unless `seed` is zero, those inside are moved by up to 0.3 of their distance.
inline std::vector<double> sample_values(int n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) {
    const bool inside = i > 0 && i + 1 < n && seed != 0;
    values.push_back((i + (inside ? shift(engine) : 0.0)) / (n - 1));
  }
  return values;
}

}  // namespace eigentrail::test
