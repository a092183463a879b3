// A bus behind a link: what the arm sends leaves when the link lets it arrive. RT: safe after the constructor.
#pragma once

#include <array>
#include <memory>
#include <utility>

#include "reed/bus/transport/forwarding_transport.h"
#include "reed/plant/link/link.h"
#include "reed_layout.h"

namespace reed::plant {

class LinkTransport final : public bus::ForwardingTransport {
 public:
  /// bus outlives it.
  LinkTransport(bus::Transport& bus, const PlantConfig& config)
      : bus::ForwardingTransport(bus), config_(config) {
    StartOver();
  }

  /// Nothing is on its way.
  void StartOver() {
    link_ = std::make_unique<Link>(config_.link, config_.timing, config_.arm.dof(), config_.seed);
  }
  Link& link() noexcept { return *link_; }
  const bus::Frame& sync() const noexcept { return sync_; }
  const bus::Frame& command() const noexcept { return command_; }

  int Receive(std::span<bus::Frame> out, int wanted, std::int64_t deadline_ns) noexcept override {
    const int count = ForwardingTransport::Receive(out, wanted, deadline_ns);
    for (const bus::Frame& frame : out.first(static_cast<std::size_t>(count))) {
      if (frame.id == bus::layout::kSync.id) sync_ = frame;
      if (frame.id == bus::layout::kCommand.id) command_ = frame;
    }
    return count;
  }
  int Send(std::span<const bus::Frame> frames) noexcept override {
    link_->Answer(frames);
    std::array<bus::Frame, 16> batch;
    std::size_t count = 0;
    while (const auto frame = link_->TakeForController()) {
      batch[count++] = *frame;
      if (count == batch.size()) ForwardingTransport::Send(std::span(batch).first(std::exchange(count, 0)));
    }
    if (count > 0) ForwardingTransport::Send(std::span(batch).first(count));
    return static_cast<int>(frames.size());
  }

 private:
  PlantConfig config_;
  std::unique_ptr<Link> link_;
  bus::Frame sync_, command_;  // the last ones
};

}  // namespace reed::plant
