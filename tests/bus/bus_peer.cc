// The C++ side of comparisons with foreign programs: codec and transports as a filter on lines of text.
//   bus_peer codec           stdin: "encode KIND NUMBERS..." or "decode ID HEX"; stdout: "ID#HEX" or "KIND
//   NUMBERS..." bus_peer listen BUS N    prints N frames as "ID#HEX" bus_peer send BUS        sends the
//   frames "ID#HEX" of stdin
#include <cstdio>
#include <ctime>
#include <iostream>
#include <sstream>
#include <string>

#include "reed/bus/codec/messages.h"
#include "reed/bus/transport/open_transport.h"

namespace {

using namespace reed::bus;

std::string Text(const Frame& frame) {
  char text[10];
  std::snprintf(text, sizeof text, frame.extended ? "%08X#" : "%03X#", frame.id);
  std::string out = text;
  for (std::size_t i = 0; i < frame.size; ++i) {
    std::snprintf(text, sizeof text, "%02X", frame.data[i]);
    out += text;
  }
  return out;
}

Frame Parse(const std::string& id, const std::string& hex) {
  Frame frame;
  frame.id = static_cast<std::uint32_t>(std::stoul(id, nullptr, 16));
  frame.extended = id.size() == 8;  // as candump has it
  frame.size = static_cast<std::uint8_t>(hex.size() / 2);
  for (std::size_t i = 0; i < frame.size; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(std::stoul(hex.substr(2 * i, 2), nullptr, 16));
  }
  return frame;
}

Frame ParseCandump(const std::string& text) {
  const std::size_t mark = text.find('#');
  return Parse(text.substr(0, mark), text.substr(mark + 1));
}

Frame Encode(FrameEncoder& encoder, std::istream& in) {
  std::string kind;
  int joint = 0, number = 0, low4 = 0;
  in >> kind;
  if (kind == "sync") {
    SyncMessage m;
    in >> m.cycle >> number;
    m.layout = static_cast<std::uint8_t>(number);
    return encoder.Sync(m);
  }
  if (kind == "joint") {
    JointStateMessage m;
    in >> joint >> m.position_rad >> m.velocity_radps >> m.torque_Nm >> number >> low4;
    m.state = static_cast<DriveState>(number);
    m.cycle_low4 = static_cast<std::uint8_t>(low4);
    return encoder.JointState(joint, m);
  }
  if (kind == "wrench") {
    WrenchMessage m;
    in >> m.cycle >> m.saturated;
    for (double& force : m.force_N) in >> force;
    for (double& moment : m.moment_Nm) in >> moment;
    return encoder.Wrench(m);
  }
  CommandMessage m;
  in >> m.cycle >> number;
  m.request = static_cast<DriveRequest>(number);
  for (double& torque : m.torque_Nm) in >> torque;
  return encoder.Command(m);
}

void PrintDecoded(Decoder& decoder, std::istream& in) {
  std::string id, hex;
  in >> id >> hex;
  const Decoded d = decoder.Decode(Parse(id, hex));
  std::cout.precision(17);
  if (d.reject != Reject::kNone) {
    std::cout << "reject " << static_cast<int>(d.reject);
  } else if (d.kind == MessageKind::kSync) {
    std::cout << "sync " << d.sync.cycle << ' ' << int{d.sync.layout};
  } else if (d.kind == MessageKind::kJointState) {
    const JointStateMessage& m = d.joint_state;
    std::cout << "joint " << d.joint << ' ' << m.position_rad << ' ' << m.velocity_radps << ' ' << m.torque_Nm
              << ' ' << static_cast<int>(m.state) << ' ' << int{m.cycle_low4};
  } else if (d.kind == MessageKind::kWrench) {
    std::cout << "wrench " << d.wrench.cycle << ' ' << d.wrench.saturated;
    for (const double force : d.wrench.force_N) std::cout << ' ' << force;
    for (const double moment : d.wrench.moment_Nm) std::cout << ' ' << moment;
  } else {
    std::cout << "command " << d.command.cycle << ' ' << static_cast<int>(d.command.request);
    for (const double torque : d.command.torque_Nm) std::cout << ' ' << torque;
  }
  std::cout << std::endl;
}

void RunCodec() {
  FrameEncoder encoder;
  Decoder decoder;
  for (std::string line, verb; std::getline(std::cin, line);) {
    std::istringstream in(line);
    in >> verb;
    if (verb == "encode") {
      std::cout << Text(Encode(encoder, in)) << std::endl;
    } else {
      PrintDecoded(decoder, in);
    }
  }
}

int Listen(Transport& bus, int wanted) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  std::array<Frame, 256> frames;
  std::cout << "ready" << std::endl;
  const int got = bus.Receive(frames, wanted, (std::int64_t{now.tv_sec} + 20) * 1'000'000'000);
  for (int i = 0; i < got; ++i) std::cout << Text(frames[static_cast<std::size_t>(i)]) << '\n';
  std::cout << "malformed " << bus.counters().malformed << std::endl;
  return got >= wanted ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string verb = argc > 1 ? argv[1] : "";
  if (verb == "codec") {
    RunCodec();
    return 0;
  }
  const auto bus = OpenTransport(argc > 2 ? argv[2] : "", Identifiers::kAny);
  if (verb == "listen") return Listen(*bus, std::stoi(argv[3]));
  for (std::string line; std::getline(std::cin, line);) {
    const Frame frame = ParseCandump(line);
    if (bus->Send(std::span(&frame, 1)) != 1) return 1;
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
