// Divides what a scene describes into one blade and the support, and makes a rotor of them.
#pragma once

#include <memory>

#include "model/draft.hpp"

namespace eigentrail {

/// Takes the elements and constraints of the draft, whose `description` is that of one blade, the hub and the
/// support. Throws InputError for what joins the blade with the support or the turning frame beside the hub.
std::unique_ptr<Model> make_bladed_rotor(Draft& draft, ModelDescription description, const Expression& speed);

}  // namespace eigentrail
