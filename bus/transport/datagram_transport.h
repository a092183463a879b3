// What both transports do alike: one datagram is one frame, batches in and out, waiting up to a deadline,
// counting. A transport adds how its sockets are opened and how a frame looks in a datagram. RT: safe after
// construction.
#pragma once

#include <array>
#include <span>

#include "reed/bus/transport/datagram_batch.h"
#include "reed/bus/transport/file_descriptor.h"
#include "reed/bus/transport/incoming.h"
#include "reed/bus/transport/transport.h"
#include "reed/bus/transport/uring_receiver.h"

namespace reed::bus {

class DatagramTransport : public Transport {
 public:
  int Receive(std::span<Frame> out, int wanted, std::int64_t deadline_ns) noexcept final;
  int Send(std::span<const Frame> frames) noexcept final;
  bool alive() const noexcept final { return alive_; }
  /// From here on the calling thread alone receives, and waits with one system call where the kernel can.
  /// False: it cannot, and two calls do the same. Set-up only.
  bool ReceiveOnThisThread() { return uring_.Open(receive_fd_); }
  /// From here on frames leave with the next Receive, all together: who sends last thing in a cycle and first
  /// thing in the next, and then waits, pays the kernel once, and wakes the other side once. Set-up only.
  void SendWithNextReceive() noexcept { holds_ = true; }
  /// Frames that no Receive followed leave now.
  void SendHeld() noexcept;
  const TransportCounters& counters() const noexcept final { return counters_; }

 protected:
  /// Takes both sockets; they may be the same descriptor's number for a transport with one socket.
  void Use(int receive_fd, int send_fd) noexcept;
  /// The receive socket drops what is sent here, and counts it among what it lost.
  void DropsOwn() noexcept { drops_own_ = true; }
  /// The send socket is one of UDP.
  void SendsUdp() noexcept { sending_.PassEqualSizesTogether(send_fd_); }

 private:
  virtual Incoming Read(const Datagram& datagram, Frame& out) noexcept = 0;
  /// Writes `frame` as one datagram; returns its size.
  virtual std::size_t Write(const Frame& frame,
                            std::span<std::uint8_t, SendBatch::kSlotBytes> out) noexcept = 0;

  static constexpr std::size_t kMostHeld = 4;

  bool Take(Incoming incoming) noexcept;
  int Pass(std::span<const Frame> frames) noexcept;
  int Drain(std::span<Frame> out) noexcept;
  int Await(std::span<Frame> out, int wanted) noexcept;
  int ReceiveByUring(std::span<Frame> out, int enough, std::int64_t deadline_ns) noexcept;
  template <typename Batch>
  int Read(const Batch& batch, int got, std::span<Frame> out) noexcept;
  void NoteError(int error) noexcept;

  int receive_fd_ = -1;
  int send_fd_ = -1;
  bool alive_ = true;
  bool holds_ = false;
  std::array<Frame, kMostHeld> held_{};
  std::size_t held_count_ = 0;
  bool drops_own_ = false;
  std::uint64_t own_dropped_ = 0;
  UringReceiver uring_;
  ReceiveBatch received_;
  SendBatch sending_;
  TransportCounters counters_;
};

}  // namespace reed::bus
