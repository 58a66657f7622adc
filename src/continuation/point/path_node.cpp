#include "eigentrail/continuation/path_node.hpp"

#include <algorithm>

namespace eigentrail {
namespace {

void add(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& part) {
  sum.resize(std::max(sum.size(), part.size()), 0);
  for (std::size_t i = 0; i < part.size(); ++i) sum[i] += part[i];
}

}  // namespace

RunCounts& RunCounts::operator+=(const RunCounts& other) {
  // With a structured binding the code does not compile if a member is added and not listed here.
  const auto& [evaluations_, modes_, iterations, factorizations, spectra_, events, certificates, bases, work,
               in_vain, equilibrium, reduction, correction, differentiation, matching, certificate, event,
               output] = other;
  add(evaluations.residual, evaluations_.residual);
  add(evaluations.linearization, evaluations_.linearization);
  modes += modes_;
  equilibrium_iterations += iterations;
  equilibrium_factorizations += factorizations;
  spectra += spectra_;
  event_factorizations += events;
  certificate_factorizations += certificates;
  certificate_bases += bases;
  certificate_work += work;
  certificate_in_vain += in_vain;
  equilibrium_seconds += equilibrium;
  reduction_seconds += reduction;
  modes_seconds += correction;
  differentiation_seconds += differentiation;
  matching_seconds += matching;
  certificate_seconds += certificate;
  events_seconds += event;
  output_seconds += output;
  return *this;
}

}  // namespace eigentrail
