// Why a torque was changed or taken away, with fixed numbers: telemetry keeps its meaning across versions.
// From 32 on the arm stops (trips). From 96 on a limit acts: bit (code - 96) of control_t.limits.
// RT: safe.
#pragma once

#include <cstdint>

namespace reed::protect {

enum class Reason : std::int32_t {
  kNone = 0,
  // news
  kModeChange = 1,
  kForceSourceChange = 2,
  kContact = 3,
  kDriveState = 4,
  kPhaseBudget = 5,
  kCyclesMissed = 6,
  kCollision = 7,
  kForceZero = 8,
  kStretchHeld = 9,
  kCommandCut = 10,
  // trips
  kJointPosition = 32,
  kJointSpeed = 33,
  kContactForce = 34,
  kNotFinite = 35,
  kStaleMeasurement = 36,
  kDriveFault = 37,
  kForeignController = 38,
  kMissedCycles = 39,
  kBusLost = 40,
  kOperator = 41,
  kUnexpectedJoint = 42,
  kStaleWrench = 43,
  kPhaseBudgetInRow = 44,
  kWrenchRange = 45,
  kStretched = 46,
  kTorqueNotDelivered = 47,
  kSpeedContradicts = 48,
  kJointDoesNotFollow = 49,
  kFrozenWrench = 50,
  kTipSpeed = 51,
  kPower = 52,
  kNotAtStandstill = 53,
  kTorqueUnexplained = 54,
  kFollowingError = 55,
  kEnergy = 56,
  // limits that act
  kTorque = 96,
  kTorqueRate = 97,
  kNormalSpeed = 98,
  kHeldMeasurement = 99,
  kRampDown = 100,
  kStretch = 101,
};

constexpr bool IsTrip(Reason reason) noexcept {
  return static_cast<int>(reason) >= 32 && static_cast<int>(reason) < 96;
}
constexpr std::int32_t LimitBit(Reason reason) noexcept { return 1 << (static_cast<int>(reason) - 96); }

/// One line for people, with the unit of the value that goes with it.
constexpr const char* Text(int code) noexcept {
  switch (static_cast<Reason>(code)) {
    case Reason::kNone:
      return "none";
    case Reason::kModeChange:
      return "mode changed";
    case Reason::kForceSourceChange:
      return "force source changed";
    case Reason::kContact:
      return "contact: force mode latched, normal force in N";
    case Reason::kDriveState:
      return "a drive changed state, value is the state";
    case Reason::kPhaseBudget:
      return "a phase was longer than its budget, value is the phase: 0 receive, 1 compute, 2 transmit";
    case Reason::kCyclesMissed:
      return "cycles were missed, value is how many";
    case Reason::kCollision:
      return "collision: the observed torque of a joint jumped although nothing was to be touched, N·m";
    case Reason::kForceZero:
      return "the force sensor's zero differs from no force by more than its noise: a bias, or the arm "
             "starts in a wall, N";
    case Reason::kStretchHeld:
      return "the tip is held: nearly stretched or folded along the wall's normal, joint motion per tip "
             "motion in rad/m";
    case Reason::kCommandCut:
      return "a commanded torque is beyond what a frame carries and was cut; the wanted torque, N·m";
    case Reason::kJointPosition:
      return "joint position limit, rad";
    case Reason::kJointSpeed:
      return "joint speed limit, rad/s";
    case Reason::kContactForce:
      return "contact force limit, N";
    case Reason::kNotFinite:
      return "the law's torque is not a finite number";
    case Reason::kStaleMeasurement:
      return "joint measurement too old, cycles";
    case Reason::kDriveFault:
      return "a drive reports a fault or a closed brake, or was not ready or enabled in time; its state";
    case Reason::kForeignController:
      return "another controller sends on this bus";
    case Reason::kUnexpectedJoint:
      return "a drive answers for a joint that this arm does not have; is it the arm's configuration?";
    case Reason::kMissedCycles:
      return "too many missed cycles in a row";
    case Reason::kBusLost:
      return "the bus is lost";
    case Reason::kOperator:
      return "stopped by the operator";
    case Reason::kStaleWrench:
      return "force measurement too old for the law that tracks it, cycles";
    case Reason::kWrenchRange:
      return "the force sensor is at the end of its range, the contact force is not known; the largest "
             "reading, N";
    case Reason::kStretched:
      return "the arm cannot press in this pose: stretched or folded along the wall's normal, rad/m";
    case Reason::kTorqueNotDelivered:
      return "a drive delivers another torque than it was asked, the difference, N·m";
    case Reason::kSpeedContradicts:
      return "a joint's speed contradicts its angle, the difference, rad/s";
    case Reason::kJointDoesNotFollow:
      return "a joint shall move and its angle stands still: a closed brake, a stuck encoder or an obstacle, "
             "rad";
    case Reason::kFrozenWrench:
      return "the force sensor's reading does not change any more, N";
    case Reason::kTipSpeed:
      return "tip speed limit near people, m/s";
    case Reason::kPower:
      return "power limit near people, W";
    case Reason::kEnergy:
      return "energy limit near people, J";
    case Reason::kNotAtStandstill:
      return "the arm moves although its brakes are to be closed, rad";
    case Reason::kTorqueUnexplained:
      return "a joint has torque that neither the model nor the force sensor explains: a drive, an encoder, "
             "the "
             "sensor, or a collision, N·m";
    case Reason::kFollowingError:
      return "a joint does not have the speed that the law asks for, rad/s";
    case Reason::kPhaseBudgetInRow:
      return "a phase was longer than its budget in too many cycles in a row";
    case Reason::kTorque:
      return "torque limit acts, N·m";
    case Reason::kTorqueRate:
      return "torque rate limit acts, N·m/s";
    case Reason::kNormalSpeed:
      return "normal speed limit acts, m/s";
    case Reason::kHeldMeasurement:
      return "old measurement used, cycles";
    case Reason::kRampDown:
      return "torque ramps down: measurement too old, cycles";
    case Reason::kStretch:
      return "normal motion is held near a stretched arm, rad/m";
  }
  return "unknown";
}

}  // namespace reed::protect
