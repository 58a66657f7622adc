#include "model/readers.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace eigentrail {
namespace {

/// The motions that can be coupled, by name: that of the joint, or NAME.slide beside an angle, or NAME.axis
/// and NAME.cross_axis.
std::map<std::string, CoupledMotion> named_motions(const Draft& draft) {
  std::map<std::string, CoupledMotion> all;
  for (const auto& [label, motions] : draft.joints) {
    const bool two = motions.angles.size() > 1;
    for (std::size_t i = 0; i < motions.angles.size(); ++i)
      all[label + (two ? i == 0 ? ".axis" : ".cross_axis" : "")] = {{}, motions.angles[i], false};
    for (const HingeAngle& slide : motions.slides)
      all[label + (motions.angles.empty() ? "" : ".slide")] = {{}, slide, true};
  }
  return all;
}

/// Where a displacement begins: its value at the starting guess.
Expression slide_at_guess(const Draft& draft, const HingeAngle& joint) {
  const ExpressionVector axis = draft.at_guess(joint.axis), from = draft.at_guess(joint.from),
                         to = draft.at_guess(joint.to);
  Expression sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) sum = sum + axis[i] * (to[i] - from[i]);
  return sum;
}

/// ratios . motions = 0, of motions from the starting guess.
std::vector<ConstraintRow> couple(Draft& draft, const TableReader& table,
                                  const std::vector<std::string>& joints,
                                  const std::vector<Expression>& ratios) {
  const std::map<std::string, CoupledMotion> known = named_motions(draft);
  std::vector<std::string> names;
  for (const auto& [name, motion] : known) names.push_back(name);
  if (joints.size() < 2 || joints.size() != ratios.size())
    table.fail("joints", "expected two joints or more, and a ratio for each; found " +
                             std::to_string(joints.size()) + " joints and " + std::to_string(ratios.size()) +
                             " ratios");
  ConstraintRow row;
  Expression offset = 0.0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    index_of(joints[i], names, table, "joints", "joint that turns or slides");
    if (std::find(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(i), joints[i]) !=
        joints.begin() + static_cast<std::ptrdiff_t>(i))
      table.fail("joints", "has '" + joints[i] + "' twice");
    CoupledMotion motion = known.at(joints[i]);
    motion.ratio = draft.quantity(ratios[i]);
    if (motion.slides) offset = offset + ratios[i] * slide_at_guess(draft, motion.joint);
    row.coupled.push_back(motion);
  }
  row.offset = draft.quantity(offset);
  return {row};
}

/// +1 if the angles of two joints count the turns of their wheels, on the body or the frame that carries
/// both, about the same direction; -1 if about opposite ones.
double common_sense(const Draft& draft, const TableReader& table, const JointMotions& a,
                    const JointMotions& b) {
  if (!(a.from == b.from || a.to == b.to || a.from == b.to || a.to == b.from))
    table.fail("joints", "expected the joints of two wheels on one body, or on the frame, that carries both");
  const ExpressionVector axis = draft.at_guess(a.angles.front().axis),
                         other = draft.at_guess(b.angles.front().axis);
  const auto cosine = [&](std::size_t i) { return draft.vector_at(axis, i).dot(draft.vector_at(other, i)); };
  draft.require(table, "joints", "the axes of two wheels must be parallel; [[coupler]] relates other joints",
                [&](std::size_t i) { return std::abs(cosine(i)) > 1.0 - 1e-9; });
  const double side = a.from == b.from || a.to == b.to ? 1.0 : -1.0;
  return cosine(0) > 0.0 ? side : -side;
}

}  // namespace

std::vector<ConstraintRow> read_coupler(Draft& draft, TableReader& table, JointMotions&) {
  const std::vector<Expression> ratios = table.list("ratios", any_unit);
  for (const Expression& ratio : ratios) draft.check_range(table, "ratios", ratio, Range::any);
  return couple(draft, table, table.texts("joints"), ratios);
}

std::vector<ConstraintRow> read_gear(Draft& draft, TableReader& table, JointMotions&) {
  std::vector<Expression> teeth = table.list("teeth");
  for (const Expression& number : teeth) draft.check_range(table, "teeth", number, Range::positive);
  if (teeth.size() != 2)
    table.fail("teeth", "expected the numbers of two wheels, found " + std::to_string(teeth.size()));
  const std::vector<std::string> names = draft.joints_with_angles(1);
  const std::vector<std::string> joints = table.texts("joints");
  if (joints.size() != 2) table.fail("joints", "expected two joints, found " + std::to_string(joints.size()));
  for (const std::string& joint : joints)
    index_of(joint, names, table, "joints", "joint that turns about one axis");
  const double sense = common_sense(draft, table, draft.joints.at(joints[0]), draft.joints.at(joints[1]));
  const bool internal = table.has("internal") && table.flag("internal");
  teeth[1] = (internal ? -sense : sense) * teeth[1];
  return couple(draft, table, joints, teeth);
}

}  // namespace eigentrail
