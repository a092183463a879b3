#include "reed/plant/dynamics/centre_line.h"

#include <Eigen/Geometry>

#include "reed/math/turn.h"

namespace reed::plant {

using Eigen::Vector3d;
using Eigen::VectorXd;

CentreLine::CentreLine(const ArmChain& chain, int samples)
    : chain_(chain), samples_(static_cast<std::size_t>(samples)) {
  for (const Member& member : chain.members) {
    for (int s = 1; s <= samples; ++s)
      sections_.emplace_back(member.length * s / (samples + 1), member.length);
    sections_.emplace_back(member.length, member.length);
  }
  points_.resize(2 + chain.elements.size() + chain.members.size() * samples_, Vector3d::Zero());
  for (const Element& element : chain.elements)
    if (StartsApart(element)) points_.push_back(Vector3d::Zero());
  points_.front() = chain.base;
}

bool CentreLine::StartsApart(const Element& element) { return element.member >= 0 && element.mount_shifts; }

const std::vector<Vector3d>& CentreLine::At(const VectorXd& x) {
  const Eigen::Index n = chain_.dof();
  Placement carrier;
  std::size_t k = 1;  // the base stays where it is
  for (const Element& element : chain_.elements) {
    const Placement base = carrier * element.mount;
    if (element.joint >= 0) {
      carrier = {base.R * math::TurnZ(x[n + element.joint]), base.p};
      points_[k++] = carrier.p;
      continue;
    }
    if (StartsApart(element)) points_[k++] = base.p;
    const auto member = static_cast<std::size_t>(element.member);
    const ElasticVec e = x.segment<kElastic>(2 * n + Eigen::Index{kElastic} * element.member);
    Section* section = &sections_[member * (samples_ + 1)];
    for (std::size_t s = 0; s <= samples_; ++s) {
      section[s].Deform(e, ElasticVec::Zero());
      points_[k++] = base * section[s].pose().p;
    }
    carrier = base * section[samples_].pose();
  }
  points_[k] = carrier * chain_.tool.p;
  return points_;
}

}  // namespace reed::plant
