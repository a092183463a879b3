// The bus as both programs see it: one small interface, three transports behind it
// (socketcan_transport.h: vcan0, can0; udp_transport.h: python-can's udp_multicast format;
// memory_transport.h: within one process).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "reed/bus/frame/frame.h"

namespace reed::bus {

/// Counted since the transport was opened. Never reset, so a difference of two copies is a rate.
struct TransportCounters {
  std::uint64_t frames_rx = 0;
  std::uint64_t frames_tx = 0;
  std::uint64_t foreign_ids = 0;  // identifier not in the DBC, dropped (SocketCAN's filter drops them unseen)
  std::uint64_t malformed = 0;    // not a CAN FD data frame of the format, dropped
  std::uint64_t error_frames = 0;  // CAN controller reported an error (SocketCAN)
  std::uint64_t overflowed = 0;    // lost in the socket's receive queue (SO_RXQ_OVFL)
  std::uint64_t tx_refused = 0;    // the kernel did not take a frame; it is dropped, never retried
};

/// Datagrams that came for nothing.
constexpr std::uint64_t PassedOver(const TransportCounters& counters) noexcept {
  return counters.foreign_ids + counters.malformed;
}

/// Which frames a transport hands on.
enum class Identifiers : std::uint8_t { kOfTheDbc, kAny };

/// RT: safe (no allocation, no throw, no wait beyond `deadline_ns`). One owner thread.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Copies frames that others sent into `out`, in order of arrival, never the ones sent here.
  /// Returns once `wanted` (at most out.size()) frames are there or CLOCK_MONOTONIC passes `deadline_ns`; a
  /// deadline in the past takes what has arrived without waiting. More than `wanted` may be returned if they
  /// are already queued. Fewer, and sooner, when many frames came that are nobody's here (foreign_ids, malformed): the
  /// work of one call is bounded, and the caller may ask again.
  virtual int Receive(std::span<Frame> out, int wanted, std::int64_t deadline_ns) noexcept = 0;

  /// Sends all frames in order; returns how many the kernel took.
  virtual int Send(std::span<const Frame> frames) noexcept = 0;

  /// False after the interface went away: the bus is lost.
  virtual bool alive() const noexcept = 0;

  virtual const TransportCounters& counters() const noexcept = 0;

  /// "socketcan", "udp" or "memory", and the interface or GROUP:PORT. RT: set-up only.
  virtual std::string kind() const = 0;
  virtual std::string interface() const = 0;
};

/// Whether no real drive can be at its other end. RT: set-up only.
inline bool OnlySimulated(const Transport& bus) {
  return bus.kind() != "socketcan" || bus.interface().starts_with("vcan");
}

}  // namespace reed::bus
