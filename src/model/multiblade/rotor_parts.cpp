#include "model/readers.hpp"

#include <algorithm>

#include "eigentrail/core/text.hpp"
#include "model/multiblade/multiblade_rotor.hpp"

namespace eigentrail {
namespace {

/// What an element or a constraint acts on.
class Touched {
 public:
  explicit Touched(const Draft& draft)
      : stands_(draft.rotor->stands), hub_(draft.bodies[static_cast<std::size_t>(draft.rotor->hub)].triple) {}

  bool blade = false, hub = false;
  bool support = false;  ///< the support other than the hub
  bool frame = false;    ///< a place that is fixed in the frame

  /// A place without value is one that the element can do without.
  void place(std::string_view, const Place& place, std::string_view = {}) {
    frame = frame || (!place.moves() && place.fixed[0].slot >= 0);
    moving(place);
  }
  void point(std::string_view, const Place& point, std::string_view) { moving(point); }
  void direction(std::string_view, const Place& direction, std::string_view) { moving(direction); }
  void body(std::string_view, const std::array<Place, 3>& directors, std::string_view) {
    for (const Place& director : directors) moving(director);
  }
  void joint(std::string_view, const HingeAngle& angle, std::string_view) {
    for (const Place* direction : {&angle.axis, &angle.from, &angle.to}) moving(*direction);
  }
  void quantity(const QuantityField&, const Quantity&) {}
  void vector(const QuantityField&, const std::array<Quantity, 3>&) {}
  void matrix(const QuantityField&, const std::array<Quantity, 4>&) {}
  template <class... Numbers>
  void numbers(const Numbers&...) {}

  void constraint(const Constraint& constraint) {
    for (const ConstraintRow& one : constraint.rows) row(one);
  }
  void row(const ConstraintRow& row) {
    // A single place, not a difference of two, is held in the frame.
    if (row.coupled.empty() && !row.b && !row.a.second) frame = true;
    ConstraintRow::for_each_place(row, [this](const Place& one) { place("", one); });
  }

 private:
  void moving(const Place& place) {
    for (const Term& term : place.terms) {
      if (is_inflow(term.triple)) continue;  // of the rotor as a whole: blades and support may share it
      const bool of_hub = term.triple >= hub_ && term.triple < hub_ + 4;
      hub = hub || of_hub;
      support = support || (!of_hub && stands_[static_cast<std::size_t>(term.triple)]);
      blade = blade || !stands_[static_cast<std::size_t>(term.triple)];
    }
  }

  bool is_inflow(int triple) const { return static_cast<std::size_t>(triple) >= stands_.size(); }

  const std::vector<bool>& stands_;
  int hub_;
};

/// Where a table of this kind and label is in the scene; [rotor] if it is not found.
SourceLocation where_is(const Draft& draft, std::string_view kind, const std::string& label) {
  const std::vector<const Table*> all = tables(draft.scene, std::string(kind));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Value* name = all[i]->find("name");
    const auto* text = name == nullptr ? nullptr : std::get_if<std::string>(&name->data);
    if (label == (text != nullptr ? printable(*text) : numbered(kind, i))) return all[i]->where;
  }
  return draft.rotor->where;
}

void check_ties(const Draft& draft, const Touched& touched, std::string_view kind, const std::string& label) {
  if (!touched.blade || !(touched.support || touched.frame)) return;
  const std::string& hub = draft.bodies[static_cast<std::size_t>(draft.rotor->hub)].name;
  const std::string what = "[[" + std::string(kind) + "]] '" + label + "': joins the blade of [rotor] with ";
  const std::string advice = "; join it with a place on the hub '" + hub +
                             "', or name in [rotor] support what belongs to the support";
  throw scene_error(draft.scene, where_is(draft, kind, label),
                    what + (touched.support ? "its support beside the hub" : "the turning frame") + advice);
}

/// Divides elements and constraints, and counts the states of elements.
class Parts {
 public:
  explicit Parts(const Draft& draft) : draft_(draft) {
    for (Part* part : {&blade, &support}) {
      part->data.quantities = draft.data.quantities;
      part->data.parameters = draft.data.parameters;
      part->data.n_triples = draft.data.n_triples;
      part->data.n_coordinates = draft.data.n_coordinates;
      part->data.n_constraints = draft.data.n_constraints;
    }
    state_of_blade.assign(draft.state_names.size(), false);
    row_of_blade.assign(draft.constraint_names.size(), false);
    draft.data.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t) {
      for (const Placed<Element>& placed : list) add(placed);
    });
    for (const Constraint& constraint : draft.data.constraints) add(constraint);
    for (std::size_t i = 0; i < draft.data.trims.size(); ++i) add(draft.data.trims[i], static_cast<int>(i));
    if (!joined_)
      throw scene_error(draft.scene, draft.rotor->where,
                        "[rotor] hub: nothing joins the blade with '" +
                            draft.bodies[static_cast<std::size_t>(draft.rotor->hub)].name + "'");
  }

  struct Part {
    MultibodyData data;
    std::vector<int> trims;  ///< index of each of its conditions among those of the scene
  };
  Part blade, support;
  std::vector<bool> state_of_blade, row_of_blade;

 private:
  template <class Element>
  void add(const Placed<Element>& placed) {
    Touched touched(draft_);
    Element::fields(placed.element, touched);
    check_ties(draft_, touched, Element::name, placed.label);
    joined_ = joined_ || (touched.blade && touched.hub);
    if constexpr (std::is_same_v<Element, SpinningDisc>) {
      if (touched.blade)
        throw scene_error(draft_.scene, where_is(draft_, Element::name, placed.label),
                          "[[spinning_disc]] '" + placed.label +
                              "': not on the blade of a [rotor], whose gyroscopic moments come from the "
                              "inertia of its bodies; it may be on the hub");
    }
    for (int i = 0; i < number_of_states<Element>(); ++i)
      state_of_blade[static_cast<std::size_t>(placed.first_state + i)] = touched.blade;
    part_of(touched).data.elements.list<Element>().push_back(placed);
  }

  void add(const Constraint& constraint) {
    Touched touched(draft_);
    touched.constraint(constraint);
    check_ties(draft_, touched, constraint_kinds()[static_cast<std::size_t>(constraint.kind)].name,
               constraint.label);
    joined_ = joined_ || (touched.blade && touched.hub);
    for (std::size_t i = 0; i < constraint.rows.size(); ++i)
      row_of_blade[static_cast<std::size_t>(constraint.first_row) + i] = touched.blade;
    part_of(touched).data.constraints.push_back(constraint);
  }

  void add(const TrimCondition& trim, int index) {
    Touched touched(draft_);
    if (const auto* row = std::get_if<ConstraintRow>(&trim.quantity)) {
      touched.row(*row);
    } else {
      const TrimLoad& load = std::get<TrimLoad>(trim.quantity);
      load.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t) {
        for (const Placed<Element>& placed : list) Element::fields(placed.element, touched);
      });
      for (const Constraint& constraint : load.constraints) touched.constraint(constraint);
    }
    Part& part = part_of(touched);
    part.data.trims.push_back(trim);
    part.trims.push_back(index);
  }

  Part& part_of(const Touched& touched) { return touched.blade ? blade : support; }

  const Draft& draft_;
  bool joined_ = false;
};

/// Numbers and names the coordinates and constraints of the rotor.
class RotorNumbering {
 public:
  RotorNumbering(const Draft& draft, const Parts& parts, const ModelDescription& scene)
      : harmonics(multiblade_harmonics(draft.rotor->blades)), draft_(draft), scene_(scene) {
    map.hub_coordinate = 3 * draft.bodies[static_cast<std::size_t>(draft.rotor->hub)].triple;
    const std::size_t n = scene.coordinate_names.size();
    map.support.assign(n, -1);
    map.blade.assign(n, -1);
    map.stride.assign(n, 0);
    for (const MassCarrier& mass : scene.masses) {
      if (stands(mass)) add_support(mass);
    }
    for (const MassCarrier& mass : scene.masses) {
      if (!stands(mass)) add_blade(mass);
    }
    for (std::size_t i = 0; i < draft.rotor->inflows.size(); ++i)
      add_inflow(3 * (draft.rotor->stands.size() + i), draft.rotor->inflows[i]);
    for (std::size_t i = 0; i < parts.state_of_blade.size(); ++i)
      add_state(3 * static_cast<std::size_t>(draft.data.n_triples) + i, parts.state_of_blade[i]);
    for (std::size_t i = 0; i < parts.row_of_blade.size(); ++i) add_row(i, parts.row_of_blade[i]);
    map.n_coordinates = static_cast<int>(coordinate_names.size());
    map.n_constraints = static_cast<int>(constraint_names.size());
  }

  std::vector<Harmonic> harmonics;
  MultibladeMap map;
  std::vector<int> blade_rows, support_rows;  ///< as RotorPart::rows
  std::vector<std::string> coordinate_names, coordinate_units, constraint_names;
  std::vector<MassCarrier> masses;

 private:
  bool stands(const MassCarrier& mass) const {
    return draft_.rotor->stands[static_cast<std::size_t>(mass.first_triple)];
  }

  int next() const { return static_cast<int>(coordinate_names.size()); }

  void add_coordinate(std::size_t of_scene, const std::string& suffix) {
    coordinate_names.push_back(scene_.coordinate_names[of_scene] + suffix);
    coordinate_units.push_back(scene_.coordinate_units[of_scene]);
  }

  void add_support(const MassCarrier& mass) {
    masses.push_back({mass.name, next() / 3, mass.n_triples, true, {}});
    for (Eigen::Index i = 3 * mass.first_triple; i < 3 * (mass.first_triple + mass.n_triples); ++i) {
      map.support[static_cast<std::size_t>(i)] = next();
      add_coordinate(static_cast<std::size_t>(i), "");
    }
  }

  /// All coordinates of a point or body of the blade for one harmonic, then those for the next.
  void add_blade(const MassCarrier& mass) {
    const int first = next();
    const auto size = static_cast<int>(3 * mass.n_triples);
    for (std::size_t a = 0; a < harmonics.size(); ++a) {
      masses.push_back({mass.name, next() / 3, mass.n_triples, false, wave(a, first / 3, mass.n_triples)});
      // Both waves of a harmonic are found from its cosine and its sine.
      if (masses.back().wave.sense < 0) masses.back().first_triple -= mass.n_triples;
      for (int i = 0; i < size; ++i) {
        const auto of_scene = static_cast<std::size_t>(3 * mass.first_triple + i);
        map.blade[of_scene] = first + i;
        map.stride[of_scene] = size;
        add_coordinate(of_scene, " " + harmonics[a].name);
      }
    }
  }

  BladeWave wave(std::size_t a, Eigen::Index first, Eigen::Index n_triples) const {
    const Harmonic& harmonic = harmonics[a];
    if (harmonic.number == 0) return {harmonic.name, 0, 0, first, -1};
    const bool is_cosine = static_cast<std::size_t>(harmonic.partner) > a;
    const std::string number = harmonic.number == 1 ? "" : " " + std::to_string(harmonic.number);
    const auto sine = static_cast<Eigen::Index>(is_cosine ? a + 1 : a);
    return {(is_cosine ? "progressive" : "regressive") + number, harmonic.number, is_cosine ? 1 : -1, first,
            first + sine * n_triples};
  }

  void add_inflow(std::size_t first_of_scene, int sense) {
    map.inflows.push_back({static_cast<int>(first_of_scene), sense});
    for (std::size_t i = first_of_scene; i < first_of_scene + 3; ++i) {
      map.support[i] = next();
      add_coordinate(i, "");
    }
  }

  void add_state(std::size_t of_scene, bool of_blade) {
    (of_blade ? map.blade : map.support)[of_scene] = next();
    if (!of_blade) return add_coordinate(of_scene, "");
    map.stride[of_scene] = 1;
    for (const Harmonic& harmonic : harmonics) add_coordinate(of_scene, " " + harmonic.name);
  }

  void add_row(std::size_t of_scene, bool of_blade) {
    const int first = static_cast<int>(constraint_names.size());
    support_rows.push_back(of_blade ? -1 : first);
    blade_rows.push_back(of_blade ? first : -1);
    const std::string& name = scene_.constraint_names[of_scene];
    if (!of_blade) return constraint_names.push_back(name);
    for (const Harmonic& harmonic : harmonics) constraint_names.push_back(name + " " + harmonic.name);
  }

  const Draft& draft_;
  const ModelDescription& scene_;
};

/// Every state of an element of the blade is one of each harmonic.
void multiply_states(ModelDescription& description, const Parts& parts, int n_blades) {
  std::size_t next = 0;
  for (Effect& effect : description.effects) {
    const int of_scene = effect.states;
    for (int i = 0; i < of_scene; ++i) effect.states += parts.state_of_blade[next++] ? n_blades - 1 : 0;
  }
}

/// Names of the points, bodies and beams that do or do not stand.
std::vector<std::string> names_of(const std::vector<MassCarrier>& masses, bool stand) {
  std::vector<std::string> names;
  for (const MassCarrier& mass : masses) {
    const bool known = std::find(names.begin(), names.end(), mass.name) != names.end();
    if (mass.stands == stand && !known) names.push_back(mass.name);
  }
  return names;
}

}  // namespace

std::unique_ptr<Model> make_bladed_rotor(Draft& draft, ModelDescription description,
                                         const Expression& speed) {
  Parts parts(draft);
  RotorNumbering numbering(draft, parts, description);
  multiply_states(description, parts, draft.rotor->blades);
  const std::string hub = draft.bodies[static_cast<std::size_t>(draft.rotor->hub)].name;
  description.coordinate_names = std::move(numbering.coordinate_names);
  description.coordinate_units = std::move(numbering.coordinate_units);
  description.constraint_names = std::move(numbering.constraint_names);
  description.masses = std::move(numbering.masses);
  description.rotor = BladedRotor{draft.rotor->blades, hub, speed, names_of(description.masses, false),
                                  names_of(description.masses, true)};
  std::vector<RotorShares> blade_shares;
  for (std::size_t a = 0; a < numbering.harmonics.size(); ++a)
    blade_shares.push_back(numbering.map.blade_shares(a));
  RotorPart blade{Assembly(std::move(parts.blade.data)), draft.rotor->blades,
                  std::move(numbering.harmonics),        std::move(blade_shares),
                  std::move(numbering.blade_rows),       std::move(parts.blade.trims)};
  RotorPart support{Assembly(std::move(parts.support.data)),
                    1,
                    {Harmonic()},
                    {numbering.map.support_shares()},
                    std::move(numbering.support_rows),
                    std::move(parts.support.trims)};
  RotorEquations equations{std::move(blade), std::move(support), std::move(numbering.map), speed, hub};
  for (SpinningAxis& spin : description.spins) {
    for (Eigen::Index* at : {&spin.origin, &spin.director})
      *at = equations.map.support[static_cast<std::size_t>(*at)];
  }
  return std::make_unique<MultibladeRotor>(std::move(description), std::move(equations), draft.guess);
}

}  // namespace eigentrail
