#include "support/large_scenes.hpp"

#include <sstream>

namespace eigentrail::test {

Setting slender_cantilever(int elements, const OptionTexts& overrides, const std::string& weight) {
  return scene_setting("rotating_cantilever", overrides,
                       {{"elements     = 10", "elements = " + std::to_string(elements) + "\ndegree = 1"},
                        {"slender = 1e-6", "slender = 1e-4\nweight = " + weight},
                        {"[[beam]] ", "[gravity]\nacceleration = [0, 0, \"-weight\"]\n[[beam]] "}});
}

std::string ladder(int bays) {
  std::ostringstream text;
  text << "[parameters]\nomega = 0\n[trace]\nparameter = \"omega\"\nfrom = 0\nto = 2\n"
          "[frame]\nangular_velocity = [0, 0, \"omega\"]\n";
  const auto beam = [&](const std::string& name, const std::string& from, const std::string& to,
                        const std::string& y_axis) {
    text << "[[beam]]\nname = \"" << name << "\"\nfrom = " << from << "\nto = " << to
         << "\nelements = 4\ndegree = 1\ny_axis = " << y_axis
         << "\nmass = 1\nEA = 1e4\nEI_flap = 1\nEI_lag = 2\nGJ = 1\n";
  };
  for (int bay = 1; bay <= bays; ++bay) {
    std::string corner[2];
    for (const int rail : {0, 1}) {
      const std::string place = rail == 0 ? "-0.5" : "0.5";
      const std::string number = std::to_string(rail) + std::to_string(bay);
      corner[rail] = "\"corner " + number + "\"";
      text << "[[body]]\nname = " << corner[rail]
           << "\nmass = 0.01\ninertia = [1e-4, 1e-4, 1e-4]\nposition = [" << bay << ", " << place << ", 0]\n";
      const std::string before = bay == 1
                                     ? "[0, " + place + ", 0]"
                                     : "\"corner " + std::to_string(rail) + std::to_string(bay - 1) + "\"";
      beam("rail " + number, before, corner[rail], "[0, 1, 0]");
    }
    beam("rung " + std::to_string(bay), corner[0], corner[1], "[1, 0, 0]");
  }
  return text.str();
}

}  // namespace eigentrail::test
