"""Messages that viewers draw without a set-up: foxglove's FrameTransforms, SceneUpdate and Log."""

from dataclasses import dataclass
from typing import Any, Callable

import numpy as np
from foxglove_schemas_protobuf.ArrowPrimitive_pb2 import ArrowPrimitive
from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.CubePrimitive_pb2 import CubePrimitive
from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.LinePrimitive_pb2 import LinePrimitive
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.Point3_pb2 import Point3
from foxglove_schemas_protobuf.Pose_pb2 import Pose
from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3
from google.protobuf.timestamp_pb2 import Timestamp

from reed_tools.record.signals import FAULT
from reed_tools.record.telemetry_log import Recording
from reed_tools.robots import arm_frames
from reed_tools.robots.arm_frames import rows_at
from reed_tools.robots.arm_lines import FORCE_mPN, LEAST_FORCE_N, aim, joint_transforms, wall_plate
from reed_tools.robots.joint_frames import quaternion_of, transform_of

BASE = "base"
ORANGE, GREY, BLUE, RED = (0.84, 0.37, 0.0, 1.0), (0.5, 0.5, 0.5, 0.5), (0.34, 0.71, 0.91, 0.4), (0.8, 0.1, 0.1, 1.0)
ARM_m, GHOST_m = 0.02, 0.01  # thickness


@dataclass
class Made:
    """Messages of one kind, each built when it is asked for."""

    kind: Any
    times_ns: np.ndarray
    message: Callable[[int], Any]


def stamp(time_ns: int) -> Timestamp:
    return Timestamp(seconds=int(time_ns) // 10**9, nanos=int(time_ns) % 10**9)


def frames(recording: Recording, effective: dict) -> Made:
    """Link frames and the force sensor's axes by the measured motor angles, and the true tool point, at the times of REED_SHAPE."""
    shape, measured, plant = (recording.tables[name] for name in ("REED_SHAPE", "REED_MEASURED", "REED_PLANT"))
    if not (recording.has("REED_MEASURED") and recording.has("REED_PLANT") and recording.has("REED_SHAPE")):
        return Made(FrameTransforms, np.array([], dtype=np.int64), lambda n: None)
    times_ns = shape["utime"].astype(np.int64) * 1000
    at_measured, at_plant = rows_at(measured, shape["cycle"]), rows_at(plant, shape["cycle"])

    def message(n: int) -> FrameTransforms:
        made, parent, time = FrameTransforms(), BASE, stamp(times_ns[n])
        for frame, p, q in joint_transforms(effective["arm"], measured["position"][at_measured[n]]):
            made.transforms.append(transform(time, parent, frame, p, q))
            parent = frame
        if "force_sensor" in effective["arm"]:  # a run of before knew none
            R, p = transform_of(effective["arm"]["force_sensor"])
            made.transforms.append(transform(time, parent, "force_sensor", p, quaternion_of(R)))
        made.transforms.append(transform(time, BASE, "true_tip", plant["tip"][at_plant[n]], (1.0, 0.0, 0.0, 0.0)))
        return made

    return Made(FrameTransforms, times_ns, message)


def transform(time: Timestamp, parent: str, child: str, p, q) -> FrameTransform:
    return FrameTransform(timestamp=time, parent_frame_id=parent, child_frame_id=child, translation=Vector3(x=p[0], y=p[1], z=p[2]),
                          rotation=quaternion(q))


def quaternion(q) -> Quaternion:
    return Quaternion(w=q[0], x=q[1], y=q[2], z=q[3])


def pictures(recording: Recording, effective: dict) -> Made:
    """The arm as it bends, the desired arm, the true wall and the force on the tip, at the times of REED_SHAPE."""
    arm = arm_frames.of(recording, effective["arm"])
    if arm is None:
        return Made(SceneUpdate, np.array([], dtype=np.int64), lambda n: None)
    times_ns = arm.utime * 1000
    plate = wall_plate(effective)

    def message(n: int) -> SceneUpdate:
        time = stamp(times_ns[n])
        entities = [entity(time, "arm", lines=[line(arm.bent[n], ARM_m, ORANGE)]),
                    entity(time, "desired arm", lines=[line(arm.desired[n], GHOST_m, GREY)])]
        if plate:
            cube = CubePrimitive(pose=pose(plate.centre, plate.q), size=Vector3(x=plate.size[0], y=plate.size[1], z=plate.size[2]),
                                 color=colour(BLUE))
            entities.append(entity(time, "wall", cubes=[cube]))
        entities.append(entity(time, "force on the tip", arrows=arrows(arm.bent[n][-1], arm.force[n])))
        return SceneUpdate(entities=entities)

    return Made(SceneUpdate, times_ns, message)


def entity(time: Timestamp, name: str, **parts) -> SceneEntity:
    return SceneEntity(timestamp=time, frame_id=BASE, id=name, frame_locked=True, **parts)


def colour(rgba) -> Color:
    return Color(r=rgba[0], g=rgba[1], b=rgba[2], a=rgba[3])


def pose(p, q) -> Pose:
    return Pose(position=Vector3(x=p[0], y=p[1], z=p[2]), orientation=quaternion(q))


def line(points, thickness_m: float, rgba) -> LinePrimitive:
    return LinePrimitive(type=LinePrimitive.LINE_STRIP, pose=pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)), thickness=thickness_m,
                         points=[Point3(x=p[0], y=p[1], z=p[2]) for p in points.tolist()], color=colour(rgba))


def arrows(tip, force) -> list[ArrowPrimitive]:
    size_N = float(np.linalg.norm(force))
    if size_N < LEAST_FORCE_N:
        return []
    return [ArrowPrimitive(pose=pose(tip, aim(force)), shaft_length=FORCE_mPN * size_N, shaft_diameter=0.01, head_length=0.02,
                           head_diameter=0.02, color=colour(RED))]


def log_lines(recording: Recording) -> Made:
    said = [(message, name) for channel, name in (("REED_EVENT", "firmware"), ("REED_PLANT_EVENT", "plant"))
            for message in recording.singles[channel]]
    said.sort(key=lambda item: item[0].utime)

    def message(n: int) -> Log:
        event, name = said[n]
        return Log(timestamp=stamp(event.utime * 1000), level=Log.ERROR if event.mode == FAULT else Log.INFO, message=event.text, name=name)

    return Made(Log, np.array([event.utime for event, _ in said], dtype=np.int64) * 1000, message)
