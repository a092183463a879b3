// A million broken frames to each receiver: the controller's, the plant's, and that of the software bus's datagrams. Nobody
// crashes, every value that is used is a number within the frame's range, and the drives do what their rules say.
#include <cmath>
#include <cstring>
#include <memory>

#include "reed/bus/codec/reed_codec.h"
#include "reed/bus/transport/msgpack_frame.h"
#include "reed/firmware/arm_bus/arm_bus.h"
#include "reed/tests/endurance/frame_mutants.h"
#include "reed/tests/endurance/how_long.h"
#include "reed/tests/plant_sim/endpoint_rig.h"

namespace reed {
namespace {

const long kFrames = test::HowMany(1'000'000, 100'000'000);
constexpr std::size_t kMostOfACycle = 40;

/// A few frames, as they come in one cycle, and sometimes many. Returns how many.
std::size_t PutSome(test::FrameMutants& mutants, bus::MemoryTransport& sender) {
  const std::size_t count = mutants.Below(100) == 0 ? 300 : 1 + mutants.Below(kMostOfACycle);
  for (std::size_t i = 0; i < count; ++i) {
    const bus::Frame frame = mutants.Next();
    sender.Send(std::span(&frame, 1));
  }
  return count;
}

bool Within(double value, bus::Bounds bounds) { return value >= bounds.min && value <= bounds.max; }

template <int N>
void ExpectSound(const Measurement<N>& seen) {
  for (int i = 0; i < N; ++i) {
    ASSERT_TRUE(Within(seen.theta[i], bus::layout::kJointStatePosition));
    ASSERT_TRUE(Within(seen.theta_dot[i], bus::layout::kJointStateVelocity));
    ASSERT_TRUE(Within(seen.torque[i], bus::layout::kJointStateTorque));
    const auto k = static_cast<std::size_t>(i);
    ASSERT_LE(static_cast<int>(seen.drive[k]), static_cast<int>(DriveState::kFault));
    ASSERT_TRUE(seen.age[k] >= 0 && seen.age[k] <= Measurement<N>::kNever);
  }
  ASSERT_TRUE(Within(seen.force[0], bus::layout::kWrenchForceX) &&
              Within(seen.force[2], bus::layout::kWrenchForceZ));
  ASSERT_TRUE(seen.wrench_age >= 0 && seen.wrench_age <= Measurement<N>::kNever);
  ASSERT_TRUE(seen.unexpected_joint == -1 ||
              (seen.unexpected_joint >= N && seen.unexpected_joint < kMaxJoints));
}

std::uint64_t Sum(const bus::DecodeCounters& counters) {
  std::uint64_t sum = counters.accepted;
  for (const std::uint64_t rejected : counters.rejected) sum += rejected;
  return sum;
}

TEST(FrameFuzz, TheControllersReceiver) {
  constexpr std::size_t kMostTaken = 96 + 32;  // of one cycle (ArmBus::kMostFrames and a batch)
  test::FakeWire wire;
  bus::ReedControllerCodec codec;
  ArmBus<5> bus(wire.controller, codec);
  telemetry::Snapshot tap;
  test::FrameMutants mutants(1);
  mutants.cycle = 0xFFFF'0000U;
  std::uint64_t taken = 0;
  for (long sent = 0; sent < kFrames; ++mutants.cycle) {
    tap.ClearLists();
    bus.SendSync(mutants.cycle, tap);
    wire.plant.inbox().clear();
    sent += static_cast<long>(PutSome(mutants, wire.plant));
    const std::size_t before = wire.controller.inbox().size();
    bus.Receive(0, tap);
    const std::size_t of_this_cycle = before - wire.controller.inbox().size();
    ASSERT_LE(of_this_cycle, kMostTaken);
    taken += of_this_cycle;
    ASSERT_EQ(Sum(codec.counters()), taken) << "every frame is accepted, or refused for one reason";
    ASSERT_NO_FATAL_FAILURE(ExpectSound(bus.measurement())) << "behind frame " << sent;
  }
  for (std::size_t why = 1; why < codec.counters().rejected.size(); ++why)
    EXPECT_GT(codec.counters().rejected[why], 1000U) << "a kind that never came";
  EXPECT_GT(codec.counters().accepted, taken / 20);
}

TEST(FrameFuzz, TheDrivesReceiver) {
  const PlantConfig config = plant::TwoJointScenario();
  test::FakeWire wire;
  plant::RotorBody body;
  class : public plant::RecordSink {
   public:
    void Put(const plant::Record&) noexcept override {}
  } nobody;
  std::unique_ptr<plant::LockstepEndpoint> endpoint;
  test::FrameMutants mutants(2);
  plant::FakeController controller(wire.controller);  // a sound one, in between
  long enabled = 0, ended = 0;
  for (long sent = 0; sent < kFrames; ++mutants.cycle) {
    if (endpoint == nullptr || endpoint->outcome() != plant::Outcome::kRunning) {
      ASSERT_TRUE(endpoint == nullptr || endpoint->outcome() == plant::Outcome::kWrongLayout);
      ended += endpoint == nullptr ? 0 : 1;
      endpoint = std::make_unique<plant::LockstepEndpoint>(config, wire.plant, body, nobody);
    }
    controller.Sync(mutants.cycle);
    if (mutants.Below(8) == 0) sent += static_cast<long>(PutSome(mutants, wire.controller));
    controller.Command(mutants.cycle,
                       mutants.Below(4) == 0 ? bus::DriveRequest::kReady : bus::DriveRequest::kEnable, 5.0);
    const std::size_t before = wire.plant.inbox().size();
    endpoint->Poll(0);
    ASSERT_LE(before - wire.plant.inbox().size(), 64U) << "the rest waits for the next turn";
    wire.controller.inbox().clear();
    const plant::DriveChain& drives = endpoint->robot().drives();
    for (int i = 0; i < 2; ++i) {
      const double torque = drives.torque_Nm()[i];
      ASSERT_TRUE(std::abs(torque) <= config.arm.torque_limit_Nm[static_cast<std::size_t>(i)]);
      ASSERT_TRUE(!drives.braked() || torque == 0.0);
    }
    enabled += drives.braked() ? 0 : 1;
  }
  EXPECT_GT(enabled, kFrames / 100) << "drives that are never enabled prove nothing";
  EXPECT_GT(ended, 10);
}

/// A datagram is a map of names and values; what is broken in it is anything.
TEST(FrameFuzz, TheDatagramsOfTheSoftwareBus) {
  test::FrameMutants mutants(3);
  std::array<std::uint8_t, bus::kMaxPackedFrame> bytes{};
  std::array<long, 8> seen{};
  for (long sent = 0; sent < kFrames; ++sent) {
    const bus::Frame frame = mutants.Next();
    std::size_t size = bus::PackFrame(frame, 1.7e9, bytes);
    const std::uint64_t how = mutants.Below(8);
    if (how == 0) size = mutants.Below(size + 1);
    for (std::uint64_t changes = how < 2 ? 0 : mutants.Below(4); changes > 0; --changes)
      bytes[mutants.Below(size)] = static_cast<std::uint8_t>(mutants.Below(256));
    const auto exact =
        std::make_unique<std::uint8_t[]>(size);  // a byte behind the end is seen by the sanitizer
    std::memcpy(exact.get(), bytes.data(), size);
    bus::Frame read;
    const bus::Incoming what = bus::UnpackFrame(std::span(exact.get(), size), read);
    ++seen[static_cast<std::size_t>(what)];
    if (what != bus::Incoming::kFrame) continue;
    ASSERT_TRUE(bus::IsCanFdSize(read.size));
    ASSERT_LT(read.id, read.extended ? 1U << 29U : 1U << 11U);
  }
  EXPECT_GT(seen[static_cast<std::size_t>(bus::Incoming::kFrame)], kFrames / 20);
  EXPECT_GT(seen[static_cast<std::size_t>(bus::Incoming::kMalformed)], kFrames / 20);
}

}  // namespace
}  // namespace reed
