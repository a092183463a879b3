// LCM over the network for viewers: best effort, never delays the log. For an ordinary
// thread.
#pragma once

#include <lcm/lcm.h>

#include <memory>
#include <string>

#include "reed/telemetry/message.h"
#include "reed/telemetry/sink_report.h"

namespace reed::telemetry {

class LcmPublisher {
 public:
  /// @param url  of liblcm; empty: the environment's LCM_DEFAULT_URL, or else the local default. An address that is not used
  /// (lcm_url.h) or a network that is not there leaves the publisher off, with report().problem saying why.
  /// @param wanted  false: off, and nothing to complain about
  LcmPublisher(const std::string& url, bool wanted);

  bool enabled() const noexcept { return lcm_ != nullptr; }
  void Publish(const char* channel, Bytes message);
  const SinkReport& report() const noexcept { return report_; }

 private:
  struct Close {
    void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
  };
  std::unique_ptr<lcm_t, Close> lcm_;
  SinkReport report_;
};

}  // namespace reed::telemetry
