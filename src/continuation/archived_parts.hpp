// How parts of results that several archives hold are written to an archive and read from it: each function
// lists the members of a struct (core/archive.hpp). They decompose the structs by a structured binding: if a
// member is added to a struct and not listed here, the code does not compile.
#pragma once

#include "core/archive.hpp"
#include "eigentrail/continuation/prediction.hpp"

namespace eigentrail {

template <SameAs<Path> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [parameters, x, lambda] = self;
  visit(parameters, x, lambda);
}

template <SameAs<PairSeries> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [Z, Lambda] = self;
  visit(Z, Lambda);
}

template <SameAs<EquilibriumGuess> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [x, lambda, solved] = self;
  visit(x, lambda, solved);
}

template <SameAs<EvaluationCounts> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [residual, linearization] = self;
  visit(residual, linearization);
}

template <SameAs<ModeCounts> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [factorizations, iterations, solves, passed, modal_bases, modal_solves] = self;
  visit(factorizations, iterations, solves, passed, modal_bases, modal_solves);
}

template <SameAs<RunCounts> Self, class Visit>
void fields(Self& self, Visit& visit) {
  auto& [evaluations, modes, iterations, factorizations, spectra, event_factorizations,
         certificate_factorizations, certificate_bases, work, in_vain, equilibrium, reduction, correction,
         differentiation, matching, certificate, events, output] = self;
  visit(evaluations, modes, iterations, factorizations, spectra, event_factorizations,
        certificate_factorizations, certificate_bases, work, in_vain, equilibrium, reduction, correction,
        differentiation, matching, certificate, events, output);
}

}  // namespace eigentrail
