// The names of the laws, in the order of LawId. RT: safe.
#pragma once

#include <array>
#include <cstdint>

namespace reed::strategy {

enum class LawId : std::uint8_t {
  kSeparated,
  kPd,
  kPdTuned,
  kComputedTorque,
  kFixedNominal,
  kPaperPrinted,
  kPaperCorrected,
  kExternal,  // from outside, through reed/law.h
};
inline constexpr std::array<const char*, 8> kLawNames{
    "separated",       "pd",      "pd_tuned", "computed_torque", "fixed_nominal", "paper_printed",
    "paper_corrected", "external"};

}  // namespace reed::strategy
