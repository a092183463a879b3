// Members of a link are a row from base to tip: the wrench in one is what the next one hands to it. RT: set-up only.
#pragma once

#include <optional>
#include <string>

#include "reed/config/description/flexible_member.h"

namespace reed {

struct MemberConflict {
  const char* key;  // of the later member
  std::string what;
};

/// What keeps `later` from coming after `earlier` on the same link; nothing where it can. name: of `earlier`.
std::optional<MemberConflict> ConflictOf(const FlexibleMember& earlier, const std::string& name,
                                         const FlexibleMember& later);

}  // namespace reed
