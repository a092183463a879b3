#include "reed/inspect/case_names.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace reed::inspect {
namespace {

constexpr auto kInputs = std::to_array<std::string_view>({
    "q",
    "qd",
    "qdd",
    "v",
    "vd",
    "tool_offset",
    "wrench_world_tip",
    "wrench_world_at_tip",  // model
    "dq",
    "q_d",
    "dq_d",
    "ddq_d",
    "Kd",
    "Lambda",  // laws
    "eta_hat",
    "sigma0",
    "sigma1",
    "normal",
    "F_d_normal",
    "p_hat",
    "e_f",
    "int_e_f",
    "kp",
    "ki",
});
/// What case files carry beside inputs and results.
constexpr auto kBeside = std::to_array<std::string_view>({
    "p", "self_weight_N_per_m", "tip_deflection_with_joint_springs_pynite_short_member",  // arms
    "link", "length", "EI", "rhoA", "bending", "axial_freq_hz", "torsion_freq_hz",        // beams
});

template <std::size_t N>
bool IsIn(const std::array<std::string_view, N>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

std::string List() {
  std::string text;
  for (const std::string_view name : kInputs) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

}  // namespace

void RequireKnownNames(const std::vector<std::string>& names, const NamedValues& result) {
  const auto has = [&names](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (std::any_of(names.begin(), names.end(), [&result](const auto& name) { return result.Has(name); }))
    return;
  for (const std::string& name : names) {
    if (!IsIn(kInputs, name) && !IsIn(kBeside, name)) {
      throw CaseError(name + ": nothing reads it; allowed: " + List());
    }
  }
  const bool asks =
      std::any_of(names.begin(), names.end(), [](const auto& name) { return IsIn(kInputs, name); });
  if (asks && !has("q")) throw CaseError("q: missing; without it nothing can be computed");
}

}  // namespace reed::inspect
