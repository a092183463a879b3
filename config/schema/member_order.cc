#include "reed/config/schema/member_order.h"

#include <algorithm>

#include "reed/config/description/number_text.h"

namespace reed {
namespace {

constexpr double kSamePoint_m = 1e-6;

bool Same(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm() < kSamePoint_m; }

/// Length that both have in common, m: of members on one line.
double Overlap(const FlexibleMember& earlier, const FlexibleMember& later) {
  const Eigen::Vector3d x = (earlier.to_m - earlier.from_m) / earlier.length_m();
  const auto along = [&](const Eigen::Vector3d& point) { return x.dot(point - earlier.from_m); };
  for (const Eigen::Vector3d& end : {later.from_m, later.to_m})
    if (!Same(end, earlier.from_m + along(end) * x)) return 0.0;
  const auto [first, last] = std::minmax({along(later.from_m), along(later.to_m)});
  return std::min(last, earlier.length_m()) - std::max(first, 0.0);
}

}  // namespace

std::optional<MemberConflict> ConflictOf(const FlexibleMember& earlier, const std::string& name,
                                         const FlexibleMember& later) {
  if (Same(later.to_m, earlier.from_m)) return MemberConflict{"to_m", "is where " + name + " begins"};
  if (Same(later.from_m, earlier.from_m)) return MemberConflict{"from_m", "is where " + name + " begins"};
  if (Same(later.to_m, earlier.to_m)) return MemberConflict{"to_m", "is where " + name + " ends"};
  const double common_m = Overlap(earlier, later);
  if (common_m <= kSamePoint_m) return std::nullopt;
  return MemberConflict{"from_m", "the member lies on " + name + " for " + ToShortText(common_m) + " m"};
}

}  // namespace reed
