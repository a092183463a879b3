// The two places where an encoded message goes: an LCM event log file and the LCM network. RT: set-up only
// and the publishing thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

// NOLINTBEGIN(bugprone-reserved-identifier): the tags of LCM's own types
struct _lcm_eventlog_t;
struct _lcm_t;
// NOLINTEND(bugprone-reserved-identifier)

namespace reed::plant {

/// Every message, in order. Throws std::runtime_error from the constructor when the file cannot be created.
class EventLogFile {
 public:
  explicit EventLogFile(const std::string& path);

  /// False once the file takes no more (disk full).
  bool Write(std::int64_t utime, const char* channel, std::span<const std::uint8_t> data);
  bool Flush();

 private:
  struct Close {
    void operator()(_lcm_eventlog_t* log) const;
  };
  std::unique_ptr<_lcm_eventlog_t, Close> log_;
};

/// LCM_DEFAULT_URL or udpm://239.255.76.67:7667?ttl=0: never beyond this machine unless the user says so.
class LcmNetwork {
 public:
  LcmNetwork();

  /// False when LCM could not be opened; `trouble` then says why and how to mend it.
  bool good() const { return lcm_ != nullptr; }
  const std::string& trouble() const { return trouble_; }
  void Publish(const char* channel, std::span<const std::uint8_t> data);

 private:
  struct Close {
    void operator()(_lcm_t* lcm) const;
  };
  std::unique_ptr<_lcm_t, Close> lcm_;
  std::string trouble_;
};

}  // namespace reed::plant
