// The members of an arm: as they are stated, or its sections laid along the lines of its joints. RT: set-up only.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "reed/config/description/arm_structure.h"
#include "reed/config/description/number_text.h"

namespace reed {

/// Sections and lines that do not belong together. section: 0-based, -1: their number.
struct SectionError : std::invalid_argument {
  SectionError(int index, const std::string& what) : std::invalid_argument(what), section(index) {}
  int section;
};

/// Sets everything of a member but its place.
inline void SetSection(const BeamSection& section, FlexibleMember& member) {
  member.EA_N = section.EA_N;
  member.EI_y_Nm2 = member.EI_z_Nm2 = section.EI_Nm2;
  member.GJ_Nm2 = section.GJ_Nm2;
  member.rhoA_kgpm = section.rhoA_kgpm;
}

/// Sections follow the chain: for each link its d along z, then the next joint's shift along x, where not zero. What lies
/// before the first joint and behind the last origin (the tool) is rigid. Empty where the links are rigid. Throws
/// SectionError.
inline std::vector<FlexibleMember> FlexibleMembers(const ArmStructure& arm) {
  constexpr double kSameLength_m = 1e-6;
  if (arm.sections.empty()) return arm.members;
  std::vector<FlexibleMember> members;
  const auto add = [&](std::size_t link, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m) {
    if (from_m == to_m) return;
    const std::size_t index = members.size();
    FlexibleMember member;
    member.link = static_cast<int>(link);
    member.from_m = from_m;
    member.to_m = to_m;
    const std::string name = "section " + std::to_string(index + 1), length = ToShortText(member.length_m());
    if (index >= arm.sections.size())
      throw SectionError(-1, std::to_string(arm.sections.size()) + " sections are given; " + name +
                                 " is needed for a straight member of " + length +
                                 " m (non-zero d_i, then non-zero a_i, base to tip)");
    const BeamSection& section = arm.sections[index];
    if (std::abs(section.length_m - member.length_m()) > kSameLength_m)
      throw SectionError(static_cast<int>(index), name + " has length " + ToText(section.length_m) +
                                                      " m, but the joints are " + length + " m apart");
    SetSection(section, member);
    members.push_back(member);
  };
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    add(i, {0.0, 0.0, -arm.joints[i].d_m}, Eigen::Vector3d::Zero());
    if (i + 1 < arm.joints.size()) add(i, Eigen::Vector3d::Zero(), {arm.joints[i + 1].xyz_m.x(), 0.0, 0.0});
  }
  if (members.size() != arm.sections.size())
    throw SectionError(-1, std::to_string(arm.sections.size()) + " sections are given for " +
                               std::to_string(members.size()) +
                               " straight members (non-zero d_i, then non-zero a_i, base to tip)");
  return members;
}

}  // namespace reed
