// Where the projection becomes quicker than the dense engine: both ways over sizes and numbers of modes.
#include "bench/benchmarks.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/projection/route.hpp"
#include "support/large_families.hpp"
#include "support/large_scenes.hpp"

namespace eigentrail::test {
namespace {

Setting family(AffinePencil<SparseMatrix> pencil, double to, int modes) {
  TraceSetup setup = large_setup(std::move(pencil), 0.0, to, modes, 1e-6);
  Setting setting;
  setting.scene = std::move(setup.scene);
  setting.options = std::move(setup.options);
  setting.model = std::move(setup.model);
  return setting;
}

Setting plate(int cells, int modes) {
  return family(rotating_plate({cells}), 2.0, modes);
}

Setting circulatory_plate(int cells, int modes) {
  RotatingPlate plate;
  plate.cells = cells;
  plate.convection = 10.0;
  return family(rotating_plate(plate), 2.0, modes);
}

Setting shaft(int length, int modes) {
  SolidShaft one;
  one.length = length;
  one.width = 1;
  one.disc_width = 3;
  one.cell = 0.4 / length;
  one.flatness = 0.95;
  one.discs = {length / 4, 2 * length / 3};
  return family(solid_shaft(one), 700.0, modes);
}

OptionTexts some(int modes, const std::string& to) {
  return {{"modes", std::to_string(modes)}, {"to", to}, {"tolerance", "1e-6"}};
}

Setting cantilever(int elements, int modes) {
  return slender_cantilever(elements, some(modes, "6"));
}

Setting ladder_of(int bays, int modes) {
  return make_setting(ladder(bays), some(modes, "0.3"));
}

TimedTrace time_projected(const Setting& setting) {
  Setting projected;
  projected.scene = setting.scene;
  projected.options = setting.options;
  const std::shared_ptr<const Model> model(setting.model.get(), [](const Model*) {});
  const double seconds = seconds_of([&] { projected.model = project(model, setting.options); });
  TimedTrace timed = time_trace(projected, projected.options);
  timed.seconds += seconds;
  return timed;
}

/// Both ways for each size and number of modes, where a model has twice as many freedoms as modes.
void compare(const std::string& what, Setting (*make)(int, int), const std::vector<int>& sizes,
             const std::vector<int>& mode_numbers, Figures& figures) {
  for (const int modes : mode_numbers) {
    for (const int size : sizes) {
      const Setting setting = make(size, modes);
      const Eigen::Index freedoms = setting.model->n_coordinates() - setting.model->n_constraints();
      if (freedoms < 2 * modes) continue;
      const TraceWork work =
          trace_work(estimate_projection(*setting.model, setting.options), setting.options);
      const TimedTrace dense = time_trace(setting, setting.options), projected = time_projected(setting);
      figures.push_back({"dense / projected, time, " + what + ", " + std::to_string(modes) + " modes, " +
                             std::to_string(freedoms) + " freedoms",
                         dense.seconds / projected.seconds,
                         {},
                         time_text(dense.seconds) + " / " + time_text(projected.seconds) + ", " +
                             std::to_string(projected.result.n_independent) + " coordinates; counted " +
                             short_text(work.dense / work.projected)});
    }
  }
}

}  // namespace

Figures crossover(const BenchOptions& options) {
  Figures figures;
  if (options.smoke) {
    compare("plate", plate, {5}, {4}, figures);
    return figures;
  }
  const std::vector<int> modes{4, 12, 30};
  compare("plate", plate, {5, 6, 8, 10}, modes, figures);
  compare("circulatory plate", circulatory_plate, {5, 6, 8, 10}, modes, figures);
  compare("solid shaft", shaft, {12, 20}, modes, figures);
  compare("cantilever", cantilever, {10, 20, 40, 80}, modes, figures);
  compare("ladder", ladder_of, {1, 2, 3, 5}, modes, figures);
  return figures;
}

}  // namespace eigentrail::test
