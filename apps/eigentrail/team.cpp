#include "team.hpp"

namespace eigentrail::app {
namespace {

class Alone final : public Team {
 public:
  std::unique_ptr<Workers> workers(int jobs) override { return std::make_unique<Threads>(jobs); }
  bool leads() const override { return true; }
};

}  // namespace

int alone(const std::function<int(Team&)>& command) {
  Alone team;
  return command(team);
}

}  // namespace eigentrail::app
