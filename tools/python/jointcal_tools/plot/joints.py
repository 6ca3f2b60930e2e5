"""What each command of the program tells, and how it is drawn."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Other:
    """A curve of the third panel."""

    key: str
    label: str
    factor: float = 1.0  # from the program's number to the unit drawn


@dataclass(frozen=True)
class Joint:
    """A command of the program."""

    command: str
    title: str
    keys: tuple[str, ...]  # the vectors that are sought; their bounds are at `bound`, in this order
    labels: tuple[str, ...]
    bound: str
    unit: str
    per_unit: float  # from the program's numbers to the unit drawn
    known: float  # a bound above says that nothing is known
    max_bound: float  # default
    directions: bool  # errors are angles between lines, not distances
    sensors: int
    others: tuple[Other, ...]
    others_label: str
    others_log: bool = False
    people_bound: float | None = None  # default where the model of a person's joint speaks; None: the same
    limit_option: str = "--max-bound"

    @property
    def hinge(self) -> bool:
        return self.command == "hinge"


def axes_joint(command: str, title: str, others: tuple[Other, ...], others_label: str, others_log: bool = False,
               people_bound: float | None = None) -> Joint:
    return Joint(command, title, ("axis1", "axis2"), ("axis 1", "axis 2"), "uncertainty_deg", "deg", 1.0, 89.0, 3.0, True, 2,
                 others, others_label, others_log, people_bound)


JOINTS = {joint.command: joint for joint in (
    axes_joint("hinge", "hinge", (Other("sign_margin", "sign margin"),), "sign margin\n(cost ratio)", True),
    axes_joint("two-dof", "two axes", (Other("heading_offset_deg", "heading offset"),
                                       Other("carrying_angle_deg", "carrying angle")), "angle, deg", people_bound=15.0),
    Joint("center", "joint centre", ("joint_to_sensor1_m", "joint_to_sensor2_m"), ("joint to sensor 1", "joint to sensor 2"),
          "uncertainty_m", "mm", 1e3, 900.0, 10.0, False, 2, (Other("misfit", "misfit"),), "misfit", True),
    Joint("ball", "ball joint", ("joint_to_sensor1_m", "joint_to_sensor2_m"), ("joint to sensor 1", "joint to sensor 2"),
          "uncertainty_m", "mm", 1e3, 900.0, 60.0, False, 2, (Other("heading_offset_deg", "heading offset"),), "heading offset,\ndeg", limit_option="--max-lever"),
    Joint("chain", "hip and knee", ("hip_to_pelvis_m", "hip_to_thigh_m", "knee_to_thigh_m", "knee_to_shank_m"),
          ("hip to pelvis", "hip to thigh", "knee to thigh", "knee to shank"), "uncertainty_m", "mm", 1e3, 900.0, 10.0,
          False, 3, (Other("segment_length_m", "hip to knee", 1e3),), "hip to knee,\nmm"),
)}
