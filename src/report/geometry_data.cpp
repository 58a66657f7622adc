// A stick figure of the scene: the origins of points and bodies, the named places on them, and lines between
// the two ends of rods, springs, dampers and joints. Tables of the scene with unknown or unexpected contents
// are left out of the figure without an error.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/scene/scene.hpp"
#include "report/file_data.hpp"

namespace eigentrail {
namespace {

using Triple = std::array<double, 3>;
using PlaceExpressions = std::array<Expression, 3>;

class Figure {
 public:
  Figure(const LociFile& loci, const std::vector<std::size_t>& nodes)
      : scene_(parse_scene(loci.attribute("scene"), loci.attribute("scene_path"))),
        carriers_(carriers_data(loci.coordinates)) {
    for (const std::size_t node : nodes) values_.push_back(si_values(scene_, loci.parameter, loci.p[node]));
    read_bodies();
    for (const auto& [kind, value] : scene_.root.entries) {
      const auto* array = std::get_if<Array>(&value.data);
      if (array == nullptr) continue;
      for (const Value& item : *array) {
        if (const auto* table = std::get_if<Table>(&item.data)) read_link(kind, *table);
      }
    }
  }

  Json data() const {
    if (carriers_.empty()) return nullptr;
    return {{"carriers", carriers_}, {"places", places_}, {"lines", lines_}};
  }

 private:
  std::optional<std::size_t> carrier(const std::string& name) const {
    for (std::size_t i = 0; i < carriers_.size(); ++i) {
      if (carriers_[i]["name"] == name) return i;
    }
    return std::nullopt;
  }

  void read_bodies() {
    for (const Table* table : tables(scene_, "body")) {
      TableReader reader(scene_, *table, "[[body]]", used_);
      const std::string name = reader.text("name");
      const auto body = carrier(name);
      if (!body) continue;
      if (reader.has("centre")) markers_[name + ".centre"] = add_place(body, reader.vector("centre"));
      if (!reader.has("markers")) continue;
      TableReader markers = reader.table("markers");
      for (const std::string& marker : markers.keys())
        markers_[name + "." + marker] = add_place(body, markers.vector(marker));
    }
  }

  /// The coordinates of a place at all nodes; a single triple if they are the same at all.
  Json coordinates(const PlaceExpressions& place) const {
    std::vector<Triple> list;
    for (const Vector& values : values_)
      list.push_back({place[0].value(values), place[1].value(values), place[2].value(values)});
    if (std::adjacent_find(list.begin(), list.end(), std::not_equal_to<>()) == list.end()) list.resize(1);
    return list;
  }

  /// Adds a place with coordinates in the axes of a carrier, or in the frame if there is none. Returns its
  /// index.
  std::size_t add_place(std::optional<std::size_t> carrier, const PlaceExpressions& at) {
    places_.push_back({{"carrier", carrier ? Json(*carrier) : Json()}, {"at", coordinates(at)}});
    return places_.size() - 1;
  }

  /// The place that a table names; nothing where it does not.
  std::optional<std::size_t> place(const Table& table, const std::string& kind, const char* key) try {
    TableReader reader(scene_, table, kind, used_);
    if (reader.is_table(key)) {
      TableReader inner = reader.table(key);
      const auto body = carrier(inner.text("body"));
      return body ? std::optional(add_place(body, inner.vector("at"))) : std::nullopt;
    }
    const NameOrPosition given = reader.name_or_position(key);
    if (const auto* fixed = std::get_if<PlaceExpressions>(&given)) return add_place(std::nullopt, *fixed);
    const auto& name = std::get<std::string>(given);
    if (const auto marker = markers_.find(name); marker != markers_.end()) return marker->second;
    if (const auto whole = carrier(name)) return markers_[name] = add_place(whole, {});
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }

  /// Adds a line for a table with two ends. A follower force is left out: its two places give only its
  /// direction.
  void read_link(const std::string& kind, const Table& table) {
    if (kind == "follower_force") return;
    const bool bearing = kind == "bearing" || kind == "internal_damping";
    const auto from = place(table, kind, bearing ? (kind == "bearing" ? "seat" : "about") : "from");
    const auto to = place(table, kind, bearing ? "point" : "to");
    if (from && to) lines_.push_back({{"kind", kind}, {"from", *from}, {"to", *to}});
  }

  Scene scene_;
  Json carriers_;
  std::vector<Vector> values_;  ///< SI values of the parameters at every node
  std::set<int> used_;          ///< parameters of the scene that places depend on
  std::map<std::string, std::size_t> markers_;
  Json places_ = Json::array();
  Json lines_ = Json::array();
};

}  // namespace

Json carriers_data(const std::vector<std::string>& coordinates) {
  Json list = Json::array();
  for (std::size_t i = 0; i + 2 < coordinates.size(); ++i) {
    const std::string& name = coordinates[i];
    if (!name.ends_with(".x") || name.ends_with("_axis.x")) continue;
    const std::string base = name.substr(0, name.size() - 2);
    if (coordinates[i + 1] != base + ".y" || coordinates[i + 2] != base + ".z") continue;
    const bool body = i + 11 < coordinates.size() && coordinates[i + 3] == base + ".x_axis.x";
    list.push_back({{"name", base}, {"first", i}, {"body", body}});
  }
  return list;
}

Json geometry_data(const LociFile& loci, const std::vector<std::size_t>& nodes) {
  try {
    return Figure(loci, nodes).data();
  } catch (const InputError&) {
    return nullptr;  // a scene that this version cannot read: the page shows shapes without a figure
  }
}

}  // namespace eigentrail
