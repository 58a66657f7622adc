#include <algorithm>

#include "model/affine_factor.hpp"
#include "model/rotor/rotor_draft.hpp"

namespace eigentrail {
namespace {

struct EffectWords {
  const char* name;
  const char* description;
};

/// In the order of RotorEffect.
constexpr std::array<EffectWords, rotor_effect_count> words = {{
    {"shaft", "elastic forces of the shaft's elements"},
    {"shaft_mass", "inertia of the shaft's elements"},
    {"disc", "inertia of the discs"},
    {"gyroscopic", "gyroscopic moments of shafts and discs"},
    {"shaft_damping", "damping of shafts that does not rotate: alpha, beta"},
    {"internal_damping", "damping that rotates with the shaft"},
    {"bearing", "stiffness and damping of the bearings"},
    {"seal", "stiffness, damping and mass of bearings with added mass"},
    {"support", "freedoms that do not move"},
}};

bool is_empty(const PencilSum& sum) {
  return sum.M.empty() && sum.C.empty() && sum.K.empty();
}

Contribution contribution_of(const PencilSum& sum, Eigen::Index n) {
  const auto M = sum.M.terms(n), C = sum.C.terms(n), K = sum.K.terms(n);
  const bool symmetric = all_equal_transposes(C, 1.0);
  return {.inertia = !M.empty(),
          .conservative = !K.empty(),
          .circulatory = !all_equal_transposes(K, 1.0),
          .dissipative = !C.empty() && (symmetric || !all_equal_transposes(C, -1.0)),
          .gyroscopic = !symmetric};
}

}  // namespace

void check_rotor_without(const RotorDraft& rotor) {
  std::vector<std::string> can;
  for (std::size_t i = 0; i < rotor_effect_count; ++i) {
    if (!is_empty(rotor.sums[i]) && i != static_cast<std::size_t>(RotorEffect::shaft))
      can.emplace_back(words[i].name);
  }
  for (const std::string& name : rotor.draft.request.without) {
    if (std::find(can.begin(), can.end(), name) != can.end()) continue;
    std::string why = "is no effect of this rotor; ";
    if (name == "shaft") why = "cannot be left out: without its elastic forces there is no rotor; ";
    if (name == "support") why = "cannot be left out: it holds freedoms; remove its table; ";
    throw without_error(rotor.draft.scene, name, why + suggestion(name, can));
  }
}

std::vector<Effect> rotor_effects(const RotorDraft& rotor, Eigen::Index n) {
  std::vector<Effect> effects;
  for (std::size_t i = 0; i < rotor_effect_count; ++i) {
    Effect& effect = effects.emplace_back(Effect{words[i].name, words[i].description, 0, {}});
    if (i == static_cast<std::size_t>(RotorEffect::support)) {
      effect.count = rotor.counts[i];
      effect.contribution.constraint = true;
    } else if (!is_empty(rotor.sums[i]) && !rotor.draft.is_left_out(words[i].name)) {
      effect.count = rotor.counts[i];
      effect.contribution = contribution_of(rotor.sums[i], n);
    }
  }
  return effects;
}

AffinePencil<SparseMatrix> pencil_of_effects(RotorDraft& rotor, Eigen::Index n) {
  PencilSum all;
  for (std::size_t i = 0; i < rotor_effect_count; ++i) {
    if (is_empty(rotor.sums[i]) || rotor.draft.is_left_out(words[i].name)) continue;
    const Quantity strength = rotor.draft.strength(words[i].name);
    const Expression factor = rotor.draft.request.strengths ? strength.expression : Expression(1.0);
    all.M.add(rotor.sums[i].M, factor);
    all.C.add(rotor.sums[i].C, factor);
    all.K.add(rotor.sums[i].K, factor);
  }
  return {all.M.terms(n), all.C.terms(n), all.K.terms(n)};
}

}  // namespace eigentrail
