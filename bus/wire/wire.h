// One CAN FD wire in virtual time: frames wait, the lowest identifier that waits is sent next, none is interrupted. Others'
// frames take their share. RT: safe after the constructor.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>

#include "reed/bus/wire/frame_bits.h"

namespace reed::bus {

/// Frames of others at random instants (a Poisson process), of all sizes alike. They hold the wire and reach nobody.
struct ForeignTraffic {
  double load = 0.0;    // share of the wire, 0 … kMostLoad
  int identifier = -1;  // 11 bits; -1: any, alike
  std::uint64_t seed = 1;

  static constexpr double kMostLoad = 0.95;
};

/// A frame that is through.
struct Sent {
  Frame frame;
  std::int64_t offered_ns = 0;
  std::int64_t arrived_ns = 0;  // its last bit; the intermission follows
};

class Wire {
 public:
  static constexpr std::size_t kRoom = 64;

  explicit Wire(const ForeignTraffic& others = {}, BitRates rates = {});

  /// `frame` is ready to be sent from `ready_ns` on, which is not before the last start that Next() has decided.
  /// False: there is no room.
  bool Offer(const Frame& frame, std::int64_t ready_ns) noexcept;

  /// The next frame that is sent, if it starts before `horizon_ns`: who might be offered later does not count.
  std::optional<Sent> Next(std::int64_t horizon_ns) noexcept;

  /// Time that others' frames have held the wire.
  std::int64_t foreign_ns() const noexcept { return foreign_ns_; }

 private:
  struct Waiting {
    Frame frame;
    std::int64_t ready_ns = 0;
  };
  void DrawForeign() noexcept;
  double Uniform() noexcept;
  std::int64_t Length_ns(const Frame& frame) const noexcept;

  BitRates rates_;
  ForeignTraffic others_;
  double mean_gap_ns_ = 0.0;  // between others' frames
  std::mt19937_64 random_;
  Waiting foreign_;  // the next one
  std::array<Waiting, kRoom> waiting_;
  std::size_t count_ = 0;
  std::int64_t free_ns_ = 0;  // the wire is, from here on
  std::int64_t foreign_ns_ = 0;
};

}  // namespace reed::bus
