// The schema of a scenario: every key once, with unit, bound and meaning. Reader, writer and lister all walk
// this.
#pragma once

#include "reed/config/schema/bound.h"
#include "reed/config/schema/scenario.h"
#include "reed/law_names/law_names.h"
#include "reed_layout.h"

namespace reed {

inline constexpr const char* kDisturbancePlaces[] = {"tool", "arm"};
inline constexpr const char* kForceSources[] = {"none", "known", "unknown", "auto"};
inline constexpr const char* kOverrunPolicies[] = {"keep_grid", "skip", "hold", "stop"};
inline constexpr const char* kPhaseActions[] = {"count", "hold", "degrade", "fault"};
inline constexpr const char* kEdges[] = {"rising", "falling"};
inline constexpr const char* kLegKinds[] = {"hold", "joint", "cartesian", "slide", "sine", "fourier"};

template <typename V>
void Fields(V& v, PlantModelConfig& c) {
  v.Boolean("flexible_links", c.flexible_links, "links bend; false: rigid links, elastic joints");
  v.Integer("elements_per_link", c.elements_per_link, {"1", 1, 8}, "beam elements per straight member");
  v.Number("damping_ratio", c.damping_ratio, {"1", 0, 0.2}, "structural damping ratio");
  v.Number("max_step_s", c.max_step_s, {"s", 1e-6, 1e-2}, "largest integration step");
  v.Number("stiffness_scale", c.stiffness_scale, {"1", 1e-3, 1e6},
           "scales the stiffness of joints and links");
  v.Number("joint_stiffness_scale", c.joint_stiffness_scale, {"1", 1e-3, 1e6},
           "scales the stiffness of joints");
  v.Number("friction_scale", c.friction_scale, {"1", 0, 100}, "scales viscous and Coulomb friction");
  v.Number("payload_step_kg", c.payload_step_kg, {"kg", 0, 100}, "point mass that appears at the tool point");
  v.Number("payload_step_s", c.payload_step_s, {"s", 0, 3600},
           "when it appears, after the drives were enabled");
  v.Numbers(
      "p_true", c.p_true, {"1", -1e3, 1e3},
      "true parameters instead of the arm's truth.p, within their box; bodies and viscous friction follow");
}

template <typename V>
void Fields(V& v, DriveConfig& c) {
  v.Integer("torque_bits", c.torque_bits, {"1", 8, 32},
            "resolution of the torque over plus/minus the torque limit");
  v.Integer("command_timeout_cycles", c.command_timeout_cycles, {"1", 1, 1000},
            "periods without a valid command before the brakes close");
  v.Integer("excitation_joint", c.excitation_joint, {"1", 0, kMaxJoints},
            "joint, from 1, whose applied torque has sinusoids added while its brakes are open (tools/reed "
            "bode); 0: none");
  v.Number("excitation_Nm", c.excitation_Nm, {"N·m", 0, 1000}, "of each sinusoid");
  v.Numbers("excitation_hz", c.excitation_hz, {"Hz", 0.01, 4000}, "one sinusoid per entry");
}

/// What a data sheet says, and so the controller knows.
template <typename V>
void Fields(V& v, SensorData& c) {
  v.Boolean("wrench", c.wrench, "a wrist force sensor is fitted");
  v.Integer("encoder_bits", c.encoder_bits, {"1", 8, 32}, "steps per turn are 2^bits");
  v.Number("velocity_filter_hz", c.velocity_filter_hz, {"Hz", 1, 1e5},
           "first-order low pass on the differentiated encoder");
  v.Number("force_range_N", c.force_range_N, {"N", 1, bus::layout::kWrenchForceZ.max},
           "the reading saturates here");
  v.Number("force_noise_N", c.force_noise_N, {"N", 0, 100}, "standard deviation per axis");
  v.Number("force_quantum_N", c.force_quantum_N, {"N", 0, 10}, "step of the force reading");
  v.Number("moment_range_Nm", c.moment_range_Nm, {"N·m", 0.1, bus::layout::kWrenchMomentZ.max},
           "the reading saturates here");
}

template <typename V>
void Fields(V& v, SensorConfig& c) {
  Fields(v, static_cast<SensorData&>(c));
  v.Number("encoder_noise_rad", c.encoder_noise_rad, {"rad", 0, 0.01},
           "standard deviation of an angle, before it is rounded to a step");
  v.Number("moment_noise_Nm", c.moment_noise_Nm, {"N·m", 0, 100}, "standard deviation per axis");
  v.Number("moment_quantum_Nm", c.moment_quantum_Nm, {"N·m", 0, 10}, "step of the moment reading");
  v.Vector("force_bias_N", c.force_bias_N, {"N", -100, 100},
           "constant error of the force reading, axes of the sensor");
  v.Vector("moment_bias_Nm", c.moment_bias_Nm, {"N·m", -100, 100},
           "of the moment reading, axes of the sensor");
  v.Number("wrench_lost_from_s", c.wrench_lost_from_s, {"s", -1, 3600},
           "no wrench frames from here, after the drives were enabled; -1: never");
  v.Number("wrench_lost_to_s", c.wrench_lost_to_s, {"s", -1, 3600},
           "wrench frames again from here, later than wrench_lost_from_s; -1: never");
}

/// The part of a wall that the controller believes in.
template <typename V, typename Wall>
void BelievedFields(V& v, Wall& c) {
  v.Boolean("present", c.present, "there is a wall");
  v.Vector("point_m", c.point_m, {"m", -10, 10},
           "a point of the surface as the controller believes it, world frame");
  v.Vector("normal", c.normal, {"1", -1, 1}, "outward normal, wall to robot; normalised on reading");
}

template <typename V>
void Fields(V& v, BelievedWall& c) {
  BelievedFields(v, c);
}

template <typename V>
void Fields(V& v, WallConfig& c) {
  BelievedFields(v, c);
  v.Number("offset_m", c.offset_m, {"m", -0.1, 0.1},
           "true surface lies this far along the normal from the believed one");
  v.Number("stiffness_Npm", c.stiffness_Npm, {"N/m", 10, 1e7},
           "of the true wall; the controller does not know it");
  v.Number("damping_Nspm", c.damping_Nspm, {"N·s/m", 0, 1e5}, "of the true wall");
  v.Number("friction", c.friction, {"1", 0, 2}, "Coulomb coefficient");
  v.Number("friction_speed_mps", c.friction_speed_mps, {"m/s", 1e-5, 1},
           "sliding speed at which friction is fully developed");
}

template <typename V>
void Fields(V& v, DisturbanceConfig& c) {
  v.Choice("where", c.where, kDisturbancePlaces,
           "tool: in front of the wrist sensor, which reads it | arm: behind the sensor, which does not");
  v.Vector("bias_N", c.bias_N, {"N", -500, 500}, "constant force on the tool point, world frame");
  v.Vector("amplitude_N", c.amplitude_N, {"N", -500, 500}, "of each sinusoid per axis");
  v.Numbers("frequencies_hz", c.frequencies_hz, {"Hz", 0, 200},
            "one sinusoid per entry, phases from the seed");
  v.Vector("step_N", c.step_N, {"N", -500, 500}, "added from step_s on");
  v.Number("step_s", c.step_s, {"s", -1, 3600}, "after the drives were enabled; -1: no step");
}

template <typename V>
void Fields(V& v, LinkConfig& c) {
  v.Boolean("wire_time", c.wire_time,
            "frames arrive when a 1/5 Mbit/s CAN FD wire would have them: arbitration by identifier, the "
            "stuff bits of "
            "their content. Only in lockstep, as all of [link]");
  v.Number("foreign_load", c.foreign_load, {"1", 0, 0.95}, "share of that wire that others' frames take");
  v.Integer("foreign_id", c.foreign_id, {"1", -1, 2047},
            "their identifier, a smaller one wins the arbitration; -1: any, from the seed");
  v.Number("controller_s", c.controller_s, {"s", 0, 0.02},
           "wire_time: from the last answer's arrival to the command's sending");
  v.Number(
      "command_delay_s", c.command.delay_s, {"s", 0, 0.1},
      "commands arrive so much later: than on the wire, or, without wire_time, than lockstep's one period");
  v.Number("command_jitter_s", c.command.jitter_s, {"s", 0, 0.1},
           "and up to this more, alike; their order is kept");
  v.Number("command_loss", c.command.loss, {"1", 0, 1}, "share of the commands that do not arrive");
  v.Number("measurement_delay_s", c.measurement.delay_s, {"s", 0, 0.1},
           "states and wrench arrive so much later; behind the receive phase they count for a later cycle");
  v.Number("measurement_jitter_s", c.measurement.jitter_s, {"s", 0, 0.1}, "and up to this more, alike");
  v.Number("measurement_loss", c.measurement.loss, {"1", 0, 1}, "share of the frames that do not arrive");
}

template <typename V>
void Fields(V& v, ReferenceConfig& c) {
  v.Numbers("start_rad", c.start_rad, {"rad", -6.3, 6.3},
            "motor-side joint angles at the start; needed, or start_tip_m");
  v.Numbers("start_tip_m", c.start_tip_m, {"m", -10, 10},
            "instead of it: [x, y, z] of the tool point at the start, world frame, of the rigid arm. The "
            "joint angles "
            "are found near start_rad where both are given");
}

template <typename V>
void Fields(V& v, ReferenceLeg& c) {
  v.Choice("kind", c.kind, kLegKinds, "hold | joint | cartesian | slide | sine | fourier");
  v.Number("duration_s", c.duration_s, {"s", 1e-3, 3600}, "of the leg");
  v.Numbers("to_rad", c.to_rad, {"rad", -6.3, 6.3}, "joint: minimum-jerk move to these angles");
  v.Vector(
      "by_m", c.by_m, {"m", -5, 5},
      "cartesian: minimum-jerk displacement of the tool point, orientation kept as far as the joints allow");
  v.Vector("amplitude_m", c.amplitude_m, {"m", -1, 1},
           "slide: sinusoid of the tool point about the start of the leg");
  v.Number("frequency_hz", c.frequency_hz, {"Hz", 0, 50}, "slide, sine; fourier: of the first harmonic");
  v.Numbers("amplitude_rad", c.amplitude_rad, {"rad", -3.2, 3.2},
            "sine: per joint, about the start of the leg");
  v.Rows("sine_rad", c.sine_rad, {"rad", -3.2, 3.2},
         "fourier: a row per harmonic k, a number per joint: times sin(2 pi k frequency_hz t)");
  v.Rows("cosine_rad", c.cosine_rad, {"rad", -3.2, 3.2},
         "fourier: likewise, times cos(2 pi k frequency_hz t) - 1");
}

template <typename V>
void Fields(V& v, ForceConfig& c) {
  v.Choice("source", c.source, kForceSources,
           "none | known (wrench) | unknown | auto (by the wrench's freshness)");
  v.Number("desired_N", c.desired_N, {"N", 0, 500}, "normal force F_d after the ramp");
  v.Number("start_s", c.start_s, {"s", 0, 3600}, "the reference force ramps up from here");
  v.Number("ramp_s", c.ramp_s, {"s", 1e-3, 60}, "length of the ramps");
  v.Number("end_s", c.end_s, {"s", 0, 1e9}, "and down from here");
  v.Number("contact_threshold_N", c.contact_threshold_N, {"N", 0.05, 100},
           "a larger normal force latches force mode");
  v.Number("approach_speed_mps", c.approach_speed_mps, {"m/s", 1e-4, 0.2},
           "normal speed while the wall is sought");
}

template <typename V>
void Fields(V& v, ControlConfig& c) {
  v.Text("law", c.law, strategy::kLawChoices);
  v.Numbers("K_d", c.K_d, {"N·m·s/rad", 0, 1e4},
            "gain on s (31), per joint; needed. How to choose it: below");
  v.Numbers("Lambda", c.Lambda, {"1/s", 0, 500},
            "sliding surface (23), per joint; needed. How to choose it: below");
  v.Number("Gamma_known", c.Gamma_known, {"1", 0, 1e4}, "adaptation gain of the known-force law (34)");
  v.Number("Gamma_unknown", c.Gamma_unknown, {"1", 0, 1e4}, "adaptation gain of the unknown-force law (39)");
  v.Number("k_p", c.k_p, {"m/(s·N)", 1e-6, 1}, "force loop, proportional (30)");
  v.Number("k_i", c.k_i, {"m/(s²·N)", 0, 100}, "force loop, integral (30); k_i < a_force k_p");
  v.Number("a_force", c.a_force, {"1/s", 1, 1e4}, "force loop filter");
  v.Number("normal_speed_limit_mps", c.normal_speed_limit_mps, {"m/s", 1e-4, 1},
           "of the force loop, with anti-windup");
  v.Boolean("estimate_wall_stiffness", c.estimate_wall_stiffness, "k_p follows the estimated wall stiffness");
  v.Number("force_bandwidth_radps", c.force_bandwidth_radps, {"1/s", 1, 500},
           "k_p times the estimated wall stiffness (52)");
  v.Number("sigma0_gain", c.sigma0_gain, {"1", 0, 1e4}, "c_0 (40)");
  v.Number("sigma1_gain", c.sigma1_gain, {"1", 0, 1e4}, "c_1 (41)");
  v.Number("sigma0_max", c.sigma0_max, {"N·m·s/rad", 0, 1e4}, "bound of sigma_0 for a joint with K_d = 10");
  v.Number("sigma1_max", c.sigma1_max, {"N·m", 0, 1e3}, "bound of sigma_1 for a joint with K_d = 10");
  v.Number("phi", c.phi, {"rad/s", 1e-4, 10}, "boundary layer of sat(s/phi)");
  v.Number("dead_zone_radps", c.dead_zone_radps, {"rad/s", 0, 1}, "no adaptation for smaller s");
  v.Number("leak_p", c.leak_p, {"1/s", 0, 100}, "p_hat leaks toward its start");
  v.Number("leak_sigma", c.leak_sigma, {"1/s", 0, 100}, "sigma leaks toward 0");
  v.Number("Gamma_friction", c.Gamma_friction, {"1/s", 0, 1e4},
           "adaptation gain of Coulomb friction (49), times K_d");
  v.Number("coulomb_known", c.coulomb_known, {"1", 0, 1},
           "share of arm.coulomb_declared that the controller starts from; nothing where arm.coulomb_nominal "
           "is given");
  v.Number("friction_speed_radps", c.friction_speed_radps, {"rad/s", 1e-4, 10},
           "speed at which modelled Coulomb friction is fully developed (48)");
  v.Number("observer_gain", c.observer_gain, {"1/s", 0, 1e3}, "K_o of the momentum observer");
  v.Boolean("observer", c.observer, "subtract the observed disturbance in free motion");
  v.Boolean("nodal_compensation", c.nodal_compensation,
            "theta_d after nodal displacement (22); false: theta_d = plan");
  v.Numbers("p_initial", c.p_initial, {"1", -1e3, 1e3}, "start of p_hat; absent: the arm's p_nom");
}

template <typename V>
void Fields(V& v, LimitConfig& c) {
  v.Number("torque_scale", c.torque_scale, {"1", 0.01, 1}, "of the arm's torque limit");
  v.Number("torque_rate_scale", c.torque_rate_scale, {"1/s", 0.1, 1e5},
           "largest change of a commanded torque, of the joint's torque limit");
  v.Number("torque_rate_Nmps", c.torque_rate_Nmps, {"N·m/s", 0, 1e7},
           "the same for every joint instead; 0: torque_rate_scale");
  v.Number("position_margin_rad", c.position_margin_rad, {"rad", 0, 1},
           "distance that references keep from the joint limits; half of it trips");
  v.Number("speed_scale", c.speed_scale, {"1", 0.01, 1}, "of the arm's speed limit");
  v.Number("contact_force_N", c.contact_force_N, {"N", 0.1, bus::layout::kWrenchForceZ.max},
           "contact force that trips: magnitude of the tared sensor, or the observed normal force of an arm "
           "that presses without one");
  v.Integer("hold_age_cycles", c.hold_age_cycles, {"1", 0, 100},
            "measurements up to this age are used as they are");
  v.Integer("stop_age_cycles", c.stop_age_cycles, {"1", 1, 1000},
            "older: torque ramps down; twice this age: fault");
  v.Number("torque_error_share", c.torque_error_share, {"1", 1e-3, 1e6},
           "a drive that reports a torque that differs from the asked one by more, of the arm's torque "
           "limit, for 15 cycles: trip");
  v.Number("speed_error_share", c.speed_error_share, {"1", 1e-3, 1e6},
           "a speed that contradicts the angle by more, of the arm's speed limit, for 5 cycles: trip");
  v.Number("unexplained_torque_share", c.unexplained_torque_share, {"1", 1e-3, 1e6},
           "a joint's observed torque that neither the model nor the force sensor explains, beyond this "
           "share of the arm's torque limit and twice the declared Coulomb friction, for 3 cycles: trip");
  v.Number(
      "following_error_share", c.following_error_share, {"1", 1e-3, 1e6},
      "a joint's speed that differs from the law's by more, of the arm's speed limit, for 5 cycles: trip");
  v.Number("stuck_rad", c.stuck_rad, {"rad", 1e-3, 1e6},
           "a joint that shall move by more and whose angle does not change by 1 mrad: trip");
  v.Number("standstill_rad", c.standstill_rad, {"rad", 1e-4, 1e6},
           "a joint that moves by more while the brakes are to be closed: trip");
  v.Number("tip_speed_mps", c.tip_speed_mps, {"m/s", 0, 100},
           "speed of the tool point that trips, near people; 0: none");
  v.Number("power_W", c.power_W, {"W", 0, 1e6}, "power of all motors that trips, near people; 0: none");
  v.Number("energy_J", c.energy_J, {"J", 0, 1e6},
           "kinetic energy of arm and rotors that trips, near people; 0: none");
  v.Boolean("monitors", c.monitors,
            "false: the controller stops for nothing, so that a bench can measure how long a hazard takes; "
            "lockstep only");
}

template <typename V>
void Fields(V& v, TimingConfig& c) {
  v.Number("rate_hz", c.rate_hz, {"Hz", 50, 8000}, "control rate");
  v.Number("rx_budget_us", c.rx_budget_us, {"µs", 0, 20000},
           "receive phase: SYNC sent to measurements taken; 0: 40 % of the period, or what SYNC, states and "
           "wrench "
           "take on a wire if that is more");
  v.Number("compute_budget_us", c.compute_budget_us, {"µs", 0, 20000},
           "compute phase; 0: half of what is left of the period");
  v.Number("tx_budget_us", c.tx_budget_us, {"µs", 0, 20000},
           "transmit phase; 0: half of what is left of the period");
  v.Choice("overrun", c.overrun, kOverrunPolicies,
           "after a cycle that ran past its period: keep_grid (go on) | skip (leave one period free) | hold "
           "(repeat the last command once) | stop");
  v.Integer("max_missed_in_row", c.max_missed_in_row, {"1", 1, 1000}, "more missed cycles in a row: fault");
  v.Choice(
      "phase_action", c.phase_action, kPhaseActions,
      "after a phase beyond its budget: count | hold (repeat the last command) | degrade (no adaptation, "
      "no new nodal displacement) | fault (after max_broken_in_row)");
  v.Integer("max_broken_in_row", c.max_broken_in_row, {"1", 0, 1000},
            "phase_action fault: more cycles in a row with a broken budget stop the arm");
  v.Integer("priority", c.priority, {"1", 1, 98}, "SCHED_FIFO priority of the loop");
  v.Integer("cpu", c.cpu, {"1", -1, 1023}, "core of the loop; -1: the last one it may use, in lockstep any");
  v.Integer("plant_cpu", c.plant_cpu, {"1", -1, 1023}, "core of the plant in realtime; -1: that of the loop");
  v.Integer("first_cycle", c.first_cycle, {"1", 0, 4294967295.0},
            "number of the first SYNC; a frame carries its lower 32 bits, which start over after 49 days at "
            "1 kHz");
}

template <typename V>
void Fields(V& v, FaultConfig& c) {
  v.Text("id", c.id, "its name, each once");
  v.Text("target", c.target,
         "what is faulty: jointN or joints, then .encoder, .speed, .torque, .frame, .drive, .brake or .node; "
         "wrench.force, wrench.force_x (_y, _z) or wrench.frame; sync.frame, command.frame, controller, bus "
         "(docs/faults.md)");
  v.Text("kind", c.kind, "what is wrong with it: the table in docs/faults.md");
  v.Number("size", c.size, {"unit of the kind", -1e6, 1e6}, "how much; 0: the kind's usual size");
  v.Number("from_s", c.from_s, {"s", -1, 3600},
           "starts at this time after the drives were enabled; -1: not by time");
  v.Integer("from_cycle", c.from_cycle, {"1", -1, 2000000000},
            "or in this cycle of the run, counted from 0; -1: not by number");
  v.Text("from_mode", c.from_mode, "or when the drives are off, ready, enabled, braked or in fault");
  v.Text("from_event", c.from_event,
         "or at contact_made, contact_lost, brakes_released, brakes_closed, or when the fault with this id "
         "begins");
  v.Text("signal", c.signal,
         "or when this signal passes level: normal_force_N, gap_m, tip_speed_mps, or jointN.angle_rad, "
         "jointN.speed_radps");
  v.Choice("edge", c.edge, kEdges, "rising: the signal is above level | falling: below");
  v.Number("level", c.level, {"unit of the signal", -1e6, 1e6}, "of the signal");
  v.Number("for_s", c.for_s, {"s", 0, 3600}, "the signal must stay beyond level for so long");
  v.Number("delay_s", c.delay_s, {"s", 0, 3600}, "from the trigger to the fault");
  v.Number("duration_s", c.duration_s, {"s", 0, 3600}, "of the fault; 0: to the end of the run");
  v.Boolean("once", c.once, "false: at every trigger again");
  v.Number("probability", c.probability, {"1", 0, 1},
           "of acting in a cycle of the window, drawn from the seed");
  v.Boolean("announced", c.announced, "the faulty device reports it, as far as its frames can");
  v.Text("detected_by", c.detected_by, "expected: names of reasons or events, with commas between them");
  v.Number("within_ms", c.within_ms, {"ms", 0, 1e6},
           "expected: from the fault to its detection; 0: not stated");
  v.Text("reaction", c.reaction, "expected: trip, source (another force source), hold or none");
  v.Number("safe_within_ms", c.safe_within_ms, {"ms", 0, 1e6},
           "expected: from the fault to the safe state; 0: not stated");
  v.Text("requirement", c.requirement, "the safety requirement that it tests (safety/*.toml)");
}

template <typename V>
void Fields(V& v, CheckConfig& c) {
  v.Text("name", c.name, "figure that is checked");
  v.Number("limit", c.limit, {"unit of the figure", -1e9, 1e9}, "largest value that passes");
}

template <typename V>
void ScenarioFields(V& v, Scenario& c) {
  v.Text("name", c.name, "of the scenario; absent: the file's name");
  v.Text("description", c.description, "one sentence");
  v.Number("duration_s", c.duration_s, {"s", 0.01, 1e6}, "from the moment the arm is active");
  v.Seed("seed", c.seed, "of every random number in the run");
  v.Boolean("allow_wire_overload", c.allow_wire_overload,
            "run a schedule that a 1/5 Mbit/s wire could not carry");
}

}  // namespace reed
