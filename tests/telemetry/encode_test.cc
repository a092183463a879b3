#include "reed/firmware/record/encode.h"

#include <gtest/gtest.h>

#include <string>

#include "reed/tests/support/no_alloc.h"
#include "reed/tests/telemetry/sample_snapshot.h"

namespace reed::telemetry {
namespace {

using test::SampleSnapshot;
using test::Value;

template <typename Message>
Message Decode(Bytes bytes) {
  Message message;
  EXPECT_EQ(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  return message;
}

std::vector<double> Values(int field, int count, std::int64_t cycle) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(Value(field, i, cycle));
  return values;
}

TEST(Encode, ControlHasEveryFieldInItsPlace) {
  MessageEncoder encoder;
  const auto c = Decode<reed::control_t>(encoder.Control(SampleSnapshot(9, 5, 6), 1234));
  EXPECT_EQ(c.utime, 1234);
  EXPECT_EQ(c.cycle, 9);
  EXPECT_EQ(c.t_s, Value(6, 0, 9));
  EXPECT_EQ(c.mode, 2);
  EXPECT_EQ(c.force_source, 1);
  ASSERT_EQ(c.dof, 5);
  const std::vector<double>* arrays[] = {&c.theta_plan, &c.theta_d, &c.theta_d_dot, &c.e,   &c.s,
                                         &c.v,          &c.v_dot,   &c.tau_law,     &c.tau, &c.D};
  for (int i = 0; i < 10; ++i) EXPECT_EQ(*arrays[i], Values(7 + i, 5, 9)) << "field " << 7 + i;
  EXPECT_EQ(std::vector(c.normal, c.normal + 3), Values(17, 3, 9));
  EXPECT_EQ(c.f_d, Value(18, 0, 9));
  EXPECT_EQ(c.f, Value(19, 0, 9));
  EXPECT_EQ(c.e_f, Value(20, 0, 9));
  EXPECT_EQ(c.e_f_integral, Value(21, 0, 9));
  EXPECT_EQ(c.z, Value(22, 0, 9));
  EXPECT_EQ(std::vector(c.tip_plan, c.tip_plan + 3), Values(23, 3, 9));
  EXPECT_EQ(c.observer, Values(24, 5, 9));
  EXPECT_EQ(c.k_hat_e, Value(25, 0, 9));
  EXPECT_EQ(c.limits, 9);
}

TEST(Encode, MeasuredHasEveryFieldInItsPlace) {
  MessageEncoder encoder;
  const auto m = Decode<reed::measured_t>(encoder.Measured(SampleSnapshot(8, 5, 6), 77));
  EXPECT_EQ(m.utime, 77);
  EXPECT_EQ(m.cycle, 8);
  EXPECT_EQ(m.position, Values(1, 5, 8));
  EXPECT_EQ(m.velocity, Values(2, 5, 8));
  EXPECT_EQ(m.torque, Values(3, 5, 8));
  EXPECT_EQ(m.age, (std::vector<std::int32_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(m.drive_state, (std::vector<std::int8_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(std::vector(m.force, m.force + 3), Values(4, 3, 8));
  EXPECT_EQ(std::vector(m.moment, m.moment + 3), Values(5, 3, 8));
  EXPECT_EQ(m.wrench_age, 2);
}

TEST(Encode, AdaptationTimingBusAndEventHaveEveryFieldInItsPlace) {
  MessageEncoder encoder;
  const Snapshot snapshot = SampleSnapshot(50, 5, 6);
  const auto a = Decode<reed::adaptation_t>(encoder.Adaptation(snapshot, 1));
  EXPECT_EQ(a.num, 6);
  EXPECT_EQ(a.p_hat, Values(26, 6, 50));
  EXPECT_EQ(a.eta_hat, Values(27, 6, 50));
  EXPECT_EQ(a.sigma0, Value(28, 0, 50));
  EXPECT_EQ(a.sigma1, Value(29, 0, 50));

  const auto t = Decode<reed::timing_t>(encoder.Timing(snapshot, 2));
  const std::int64_t timing[] = {t.wake_ns,  t.rx_ns,  t.compute_ns,         t.tx_ns,
                                 t.cycle_ns, t.missed, t.missed_host_paused, t.overruns,
                                 t.dropped};
  const std::int64_t expected_timing[] = {101, 102, 103, 104, 105, 156, 157, 158, 159};
  for (int i = 0; i < 9; ++i) EXPECT_EQ(timing[i], expected_timing[i]) << i;

  const auto b = Decode<reed::bus_t>(encoder.Bus(snapshot.bus, 50, 3));
  const std::int64_t counters[] = {
      b.frames_rx,      b.frames_tx,    b.lost,         b.crc_errors, b.repeated,
      b.wrong_sequence, b.wrong_length, b.out_of_range, b.unknown_id, b.malformed,
      b.error_frames,   b.overflowed,   b.tx_refused,   b.late};
  for (int i = 0; i < 14; ++i) EXPECT_EQ(counters[i], 51 + i) << i;
  EXPECT_EQ(b.cycle, 50);
  EXPECT_EQ(b.utime, 3);

  const auto e = Decode<reed::event_t>(encoder.Event(snapshot, 0, "joint 2 too fast", 4));
  EXPECT_EQ(e.mode, 3);
  EXPECT_EQ(e.force_source, 2);
  EXPECT_EQ(e.code, 1);
  EXPECT_EQ(e.joint, 1);
  EXPECT_EQ(e.value, Value(30, 0, 50));
  EXPECT_EQ(e.text, "joint 2 too fast");
}

TEST(Encode, TheLargestArmFitsOneDatagram) {
  MessageEncoder encoder;
  const Snapshot largest = SampleSnapshot(50, kMaxJoints, kMaxParameters);
  EXPECT_LT(encoder.Control(largest, 0).size(), kMaxMessageBytes);
  EXPECT_LT(encoder.Measured(largest, 0).size(), kMaxMessageBytes);
  EXPECT_LT(encoder.Adaptation(largest, 0).size(), kMaxMessageBytes);
  EXPECT_LT(encoder.Event(largest, 0, std::string(5000, 'x').c_str(), 0).size(), kMaxMessageBytes);
}

TEST(Encode, NumbersBeyondTheArraysAreCutAndNotRead) {
  MessageEncoder encoder;
  Snapshot snapshot = SampleSnapshot(1, kMaxJoints, kMaxParameters);
  snapshot.dof = 1000;
  snapshot.num_parameters = -3;
  EXPECT_EQ(Decode<reed::measured_t>(encoder.Measured(snapshot, 0)).dof, kMaxJoints);
  EXPECT_EQ(Decode<reed::adaptation_t>(encoder.Adaptation(snapshot, 0)).num, 0);
}

TEST(Encode, AfterTheFirstCycleTheHeapIsLeftAlone) {
  MessageEncoder encoder;
  const Snapshot snapshot = SampleSnapshot(50, 7, 12);
  const auto encode_all = [&] {
    encoder.Measured(snapshot, 0);
    encoder.Control(snapshot, 0);
    encoder.Adaptation(snapshot, 0);
    encoder.Timing(snapshot, 0);
    encoder.Bus(snapshot.bus, 50, 0);
  };
  encode_all();
  const test::NoAlloc guard("encoding");
  for (int i = 0; i < 10; ++i) encode_all();
}

}  // namespace
}  // namespace reed::telemetry
