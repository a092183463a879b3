// What every rule between keys has: the scenario, and where its keys were written. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/schema/document.h"
#include "reed/config/schema/scenario.h"

namespace reed {

class RuleContext {
 public:
  RuleContext(const Document& doc, const Scenario& scenario) : s_(scenario), doc_(doc) {}

 protected:
  [[noreturn]] void Fail(const std::string& key, const std::string& problem) const {
    // Find where the key was written, so that the line can be named.
    doc_.Fail(const_cast<Document&>(doc_).root().at_path(key).node(), key, problem);
  }
  static std::string Joint(std::size_t i) { return "joint " + std::to_string(i + 1) + ": "; }
  bool Pressing() const { return s_.force.source != ForceConfig::Source::kNone && s_.force.desired_N > 0.0; }

  const Scenario& s_;

 private:
  const Document& doc_;
};

}  // namespace reed
