// Puts an element that has been read among those of the model.
#pragma once

#include <algorithm>

#include "model/draft.hpp"

namespace eigentrail {

/// Collects the moving vectors of an element, each once, and stores their indices in Place::argument.
class ArgumentCollector {
 public:
  explicit ArgumentCollector(std::vector<Place>& arguments) : arguments_(arguments) {}

  void place(std::string_view, Place& place, std::string_view = {}) {
    if (!place.moves()) return;
    const auto same = [&](const Place& other) {
      return std::equal(place.terms.begin(), place.terms.end(), other.terms.begin(), other.terms.end(),
                        [](const Term& a, const Term& b) {
                          return a.triple == b.triple && a.weight.slot == b.weight.slot;
                        });
    };
    const auto known = std::find_if(arguments_.begin(), arguments_.end(), same);
    place.argument = static_cast<int>(known - arguments_.begin());
    if (known == arguments_.end()) arguments_.push_back(place);
  }
  void point(std::string_view key, Place& point, std::string_view) { place(key, point); }
  void direction(std::string_view key, Place& direction, std::string_view) { place(key, direction); }
  void body(std::string_view key, std::array<Place, 3>& directors, std::string_view) {
    for (Place& director : directors) place(key, director);
  }
  void joint(std::string_view key, HingeAngle& angle, std::string_view) {
    for (Place* direction : {&angle.axis, &angle.from, &angle.to}) place(key, *direction);
  }
  void quantity(const QuantityField&, const Quantity&) {}
  void vector(const QuantityField&, const std::array<Quantity, 3>&) {}
  void matrix(const QuantityField&, const std::array<Quantity, 4>&) {}
  template <class... Numbers>
  void numbers(const Numbers&...) {}

 private:
  std::vector<Place>& arguments_;
};

/// Adds an element, and its states to the coordinates, unless its effect is switched off.
template <class Element>
void add_element(Draft& draft, Element element, std::string label) {
  if (draft.is_left_out(Element::name)) return;
  Placed<Element> placed{
      std::move(element), std::move(label), {}, draft.strength(std::string(Element::name))};
  ArgumentCollector collector(placed.arguments);
  Element::fields(placed.element, collector);
  if constexpr (number_of_states<Element>() > 0) {
    placed.first_state = static_cast<int>(draft.state_names.size());
    for (const OwnState& state : Element::states) {
      draft.state_names.push_back(placed.label + "." + std::string(state.name));
      draft.state_units.emplace_back(state.unit);
    }
  }
  draft.data.elements.list<Element>().push_back(std::move(placed));
}

}  // namespace eigentrail
