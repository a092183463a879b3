#include "reed/firmware/law_plugin/law_plugin.h"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>

#include "reed/config/description/config_error.h"

namespace reed {
namespace {

/// The reason without the path that dlerror() repeats.
std::string LoaderReason(const std::string& path) {
  const char* text = dlerror();
  std::string reason = text != nullptr ? text : "unknown reason";
  if (reason.rfind(path + ": ", 0) == 0) reason.erase(0, path.size() + 2);
  return reason;
}

constexpr std::size_t kLongestName = 40;

/// What a column of a table may be called.
bool IsIdentifier(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= kLongestName && letter(name[0]) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

template <typename Function>
Function* As(void* symbol) {
  return reinterpret_cast<Function*>(symbol);
}

}  // namespace

LawPlugin::LawPlugin(const std::string& spec, const LawSetup& setup) {
  const std::size_t colon = spec.find(':');
  path_ = spec.substr(0, colon);
  const std::string argument = colon == std::string::npos ? "" : spec.substr(colon + 1);
  if (!std::filesystem::is_regular_file(path_))
    throw ConfigError("--law " + path_ +
                      ": there is no such file; allowed: a shared library with the functions of reed/law.h");
  const std::string absolute = std::filesystem::absolute(path_);  // a bare name would be looked for elsewhere
  library_ = dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr)
    throw ConfigError("--law " + path_ + ": no library that can be loaded (" + LoaderReason(absolute) + ")");
  try {
    Start(setup, argument);
  } catch (...) {
    dlclose(library_);
    throw;
  }
}

LawPlugin::~LawPlugin() {
  if (stop_ != nullptr) stop_(law_.state);
  dlclose(library_);
}

void* LawPlugin::Find(const char* name, bool needed) const {
  void* symbol = dlsym(library_, name);
  if (symbol == nullptr && needed)
    throw ConfigError("--law " + path_ + ": the function " + name +
                      " is missing; reed/law.h has those that are needed");
  return symbol;
}

void LawPlugin::Start(const LawSetup& setup, const std::string& argument) {
  const auto version = As<decltype(reed_law_version)>(Find("reed_law_version", true));
  if (const std::uint32_t found = version(); found != REED_LAW_VERSION)
    throw ConfigError("--law " + path_ + ": built for version " + std::to_string(found) +
                      " of reed/law.h, allowed: " + std::to_string(REED_LAW_VERSION) + "; build it again");
  const auto state_size = As<decltype(reed_law_state_size)>(Find("reed_law_state_size", true));
  const auto start = As<decltype(reed_law_start)>(Find("reed_law_start", true));
  law_.step = As<decltype(reed_law_step)>(Find("reed_law_step", true));
  if (void* stop = Find("reed_law_stop", false)) stop_ = As<void(void*)>(stop);
  const reed_law_setup in{setup.joints,        static_cast<std::int32_t>(setup.p_0.size()),
                          setup.period_s,      setup.K_d.data(),
                          setup.Lambda.data(), setup.J_m.data(),
                          setup.p_0.data(),    argument.c_str()};
  state_ = std::make_unique<std::byte[]>(state_size(&in));  // zeroed, aligned for any type
  law_.state = state_.get();
  law_.output = &output_;
  if (const char* refused = start(&in, law_.state)) {
    stop_ = nullptr;
    throw ConfigError("--law " + path_ + (argument.empty() ? "" : ":" + argument) + ": " + refused);
  }
  if (void* traits = Find("reed_law_traits", false)) law_.traits = As<decltype(reed_law_traits)>(traits)();
  if (void* names = Find("reed_law_value_names", false))
    TakeValueNames(As<decltype(reed_law_value_names)>(names)());
}

void LawPlugin::TakeValueNames(const char* const* names) {
  for (; *names != nullptr; ++names) {
    const std::string name = *names;
    if (value_names_.size() == REED_LAW_MAX_VALUES)
      throw ConfigError("--law " + path_ + ": names more values than reed/law.h has, allowed: " +
                        std::to_string(REED_LAW_MAX_VALUES));
    if (!IsIdentifier(name) ||
        std::find(value_names_.begin(), value_names_.end(), name) != value_names_.end())
      throw ConfigError("--law " + path_ + ": value " + std::to_string(value_names_.size() + 1) +
                        " has no name of its own; allowed: different names of up to " +
                        std::to_string(kLongestName) + " letters, digits and _, a letter first");
    value_names_.push_back(name);
  }
  law_.num_values = static_cast<int>(value_names_.size());
}

std::unique_ptr<LawPlugin> OpenLaw(const std::string& spec, const ControllerConfig& scenario) {
  if (spec.empty()) return nullptr;
  LawSetup setup;
  setup.joints = scenario.arm.dof();
  setup.period_s = 1.0 / scenario.timing.rate_hz;
  setup.K_d = scenario.control.K_d;
  setup.Lambda = scenario.control.Lambda;
  setup.J_m = scenario.arm.rotor_inertia_kgm2;
  setup.J_m.resize(static_cast<std::size_t>(setup.joints), 0.0);
  setup.p_0 = scenario.control.p_initial;
  if (setup.p_0.empty()) {
    for (const NominalParameter& parameter : scenario.arm.parameters) setup.p_0.push_back(parameter.nominal);
  }
  return std::make_unique<LawPlugin>(spec, setup);
}

}  // namespace reed
