#include "bench/benchmarks.hpp"

namespace eigentrail::test {

const std::vector<Benchmark>& benchmarks() {
  static const std::vector<Benchmark> all{{"accuracy", accuracy_and_factorizations},
                                          {"step_time", step_time},
                                          {"first_order", first_order},
                                          {"rotating_mass", rotating_mass},
                                          {"veerings", veerings},
                                          {"few_modes", few_modes},
                                          {"tolerance", tolerance},
                                          {"order", order},
                                          {"order_choice", order_choice},
                                          {"physics", physics},
                                          {"symmetric", symmetric},
                                          {"growth", growth},
                                          {"chains", chains},
                                          {"blades", blades},
                                          {"large_models", large_models},
                                          {"largest_models", largest_models},
                                          {"crossover", crossover},
                                          {"threads", threads}};
  return all;
}

}  // namespace eigentrail::test
