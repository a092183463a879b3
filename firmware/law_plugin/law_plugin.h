// A law from a shared library: loaded, checked and started before anything moves. RT: set-up only; its step is as safe
// as the library makes it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "reed/config/controller/controller_config.h"
#include "reed/core/law/external_law.h"

namespace reed {

/// What a law is started with, SI.
struct LawSetup {
  int joints = 0;
  double period_s = 0.0;
  std::vector<double> K_d, Lambda, J_m;  // per joint
  std::vector<double> p_0;               // per parameter
};

class LawPlugin {
 public:
  /// spec: PATH, or PATH:ARGUMENT. Throws ConfigError with one line: no such file, no library, a missing function,
  /// another version of reed/law.h, or the library's own reason.
  LawPlugin(const std::string& spec, const LawSetup& setup);
  ~LawPlugin();
  LawPlugin(const LawPlugin&) = delete;
  LawPlugin& operator=(const LawPlugin&) = delete;

  const strategy::ExternalLaw& law() const noexcept { return law_; }
  const std::vector<std::string>& value_names() const noexcept { return value_names_; }

 private:
  void* Find(const char* name, bool needed) const;
  void Start(const LawSetup& setup, const std::string& argument);
  void TakeValueNames(const char* const* names);  // of values, then nullptr

  std::string path_;
  void* library_ = nullptr;
  std::unique_ptr<std::byte[]> state_;
  reed_law_output output_{};
  strategy::ExternalLaw law_;
  void (*stop_)(void*) = nullptr;
  std::vector<std::string> value_names_;
};

/// The law of a --law option for this scenario's arm and gains; nullptr where spec is empty. Throws as LawPlugin does.
std::unique_ptr<LawPlugin> OpenLaw(const std::string& spec, const ControllerConfig& scenario);

}  // namespace reed
