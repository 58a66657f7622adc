#include "continuation/event_tools.hpp"

#include <algorithm>
#include <iterator>

namespace eigentrail {

std::vector<int> sorted_modes(const std::vector<int>& modes) {
  std::vector<int> result;
  for (const int mode : modes) {
    if (mode >= 0 && std::find(result.begin(), result.end(), mode) == result.end()) result.push_back(mode);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

std::vector<Complex> roots_of(const Track& track, const std::vector<int>& members) {
  std::vector<Complex> roots;
  roots.reserve(members.size());
  for (const int i : members) roots.push_back(track.roots[i]);
  return roots;
}

PathNode with_tracks(const PathNode& node, const std::vector<std::size_t>& tracks) {
  PathNode base{node.p, node.path, {}, node.linearization, node.basis, node.pencil};
  for (const std::size_t i : tracks) base.tracks.push_back(node.tracks[i]);
  return base;
}

}  // namespace eigentrail
