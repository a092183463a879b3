#include "reed/config/schema/arm_members.h"

#include <algorithm>

#include "reed/config/description/members.h"
#include "reed/config/schema/arm_bodies.h"
#include "reed/config/schema/arm_fields.h"
#include "reed/config/schema/box.h"
#include "reed/config/schema/member_order.h"

namespace reed {
namespace {

using Keys = std::initializer_list<const char*>;

template <typename Shape, typename Check>
Shape ReadShape(Reader& item, const char* key, Keys said_by_it, const char* expected, Check check) {
  for (const char* of_it : said_by_it)
    if (item.Has(of_it)) item.Fail(of_it, std::string("given twice; ") + key + " says it");
  toml::node* node = item.Get(key);
  if (!node->is_table()) item.document().Fail(node, item.KeyName(key), std::string("expected ") + expected);
  Reader in(item.document(), node->as_table(), item.KeyName(key));
  Shape shape;
  Fields(in, shape);
  in.RefuseUnknown();
  check(in, shape);
  return shape;
}

Tube ReadTube(Reader& item, Keys said_by_it) {
  return ReadShape<Tube>(
      item, "tube", said_by_it, "{outer = m, wall = m, material = text}", [](Reader& in, const Tube& tube) {
        if (2.0 * tube.wall_m > tube.outer_m)
          in.Fail("wall", ToText(tube.wall_m) + " m is more than half of outer = " + ToText(tube.outer_m) +
                              " m; allowed: up to that, which is a rod");
      });
}

Box ReadBox(Reader& item, Keys said_by_it) {
  return ReadShape<Box>(item, "box", said_by_it, "{width = m, height = m, wall = m, material = text}",
                        [](Reader& in, const Box& box) {
                          const double side_m = std::min(box.width_m, box.height_m);
                          if (4.0 * box.wall_m > side_m)
                            in.Fail("wall",
                                    ToText(box.wall_m) + " m is more than a quarter of the smaller side, " +
                                        ToText(side_m) + " m; allowed: up to that, or 0 for a solid bar");
                        });
}

BeamSection ReadSection(Reader& item) {
  BeamSection section;
  if (!item.Has("tube")) {
    Fields(item, section);
    return section;
  }
  const Tube tube = ReadTube(item, {"EA", "EI", "GJ", "rhoA"});
  double length_m = 0.0;
  LengthField(item, length_m);
  return SectionOf(tube, length_m);
}

void ReadSections(Reader& in, ArmDescription& arm) {
  ForEachTable(in, "sections", [&](Reader& item, std::size_t) {
    for (const char* description : {"link", "E", "G", "rho", "A", "I", "J", "od", "t"}) item.Get(description);
    arm.sections.push_back(ReadSection(item));
  });
  if (arm.sections.empty()) return;
  for (std::size_t i = 0; i < arm.joints.size(); ++i)
    if (!arm.joints[i].xyz_m.tail<2>().isZero(0.0))
      in.Fail("sections",
              "a section lies along x or z of its link, joint " + std::to_string(i + 1) +
                  " is beside both; allowed: xyz_m = [x, 0, 0], [[member]], or neither (rigid links)");
}

int ReadLink(Reader& item, int links) {
  int link = 0;
  if (!item.Has("link")) item.Fail("link", "missing: the number of the link, 1 ... " + std::to_string(links));
  item.Integer("link", link, {"1", 1.0, static_cast<double>(links)}, "");
  return link - 1;
}

FlexibleMember ReadMember(Reader& item, int links) {
  FlexibleMember member;
  member.link = ReadLink(item, links);
  MemberPlace(item, member);
  if (item.Has("tube") && item.Has("box")) item.Fail("box", "given beside tube; one of them is its section");
  if (item.Has("tube"))
    SetSection(SectionOf(ReadTube(item, {"EA", "EI_y", "EI_z", "GJ"}), 0.0), member);
  else if (item.Has("box"))
    SetSection(ReadBox(item, {"EA", "EI_y", "EI_z", "GJ"}), member);
  else
    MemberStiffnesses(item, member);
  MemberMass(item, member);
  const Eigen::Vector3d along = member.to_m - member.from_m;
  if (along.norm() < kShortestMember_m)
    item.Fail("to_m", "is " + ToShortText(along.norm()) + " m from from_m; allowed: 1e-04 m and more");
  if (!member.y_axis.isZero(0.0) &&
      along.cross(member.y_axis).norm() < 1e-3 * along.norm() * member.y_axis.norm())
    item.Fail("y_axis", "lies along the member; allowed: any direction across it");
  return member;
}

/// As they stand in the file.
void RefuseConflict(const Reader& item, const std::vector<FlexibleMember>& before,
                    const FlexibleMember& member) {
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (before[k].link != member.link) continue;
    if (const auto conflict = ConflictOf(before[k], "member[" + std::to_string(k) + "]", member))
      item.Fail(conflict->key, conflict->what + "; allowed: members of a link in order from base to tip");
  }
}

void ReadMembers(Reader& in, ArmDescription& arm) {
  ForEachTable(in, "member", [&](Reader& item, std::size_t) {
    const FlexibleMember member = ReadMember(item, arm.dof());
    RefuseConflict(item, arm.members, member);
    arm.members.push_back(member);
  });
  if (arm.members.empty()) return;
  if (!arm.sections.empty()) in.Fail("member", "given beside sections; one of them says how the arm bends");
  if (arm.members.size() > 2 * arm.joints.size())
    in.Fail("member", std::to_string(arm.members.size()) + " members; allowed: up to " +
                          std::to_string(2 * arm.joints.size()) +
                          ", twice the number of joints, on any links");
  std::stable_sort(arm.members.begin(), arm.members.end(),
                   [](const FlexibleMember& a, const FlexibleMember& b) { return a.link < b.link; });
}

}  // namespace

void ReadFlexibleMembers(Reader& in, ArmDescription& arm) {
  ReadSections(in, arm);
  ReadMembers(in, arm);
  try {
    FlexibleMembers(arm);
  } catch (const SectionError& error) {
    in.Fail(error.section < 0 ? "sections" : "sections[" + std::to_string(error.section) + "]", error.what());
  }
}

}  // namespace reed
