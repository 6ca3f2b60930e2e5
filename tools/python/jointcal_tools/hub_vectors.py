# SPDX-License-Identifier: MIT
"""Prints the test vectors of docs/PROTOCOL.md: PYTHONPATH=tools/python python3 -m jointcal_tools.hub_vectors

Values are chosen for what may go wrong: zeros, and 0xff and 0x80 bytes; the most and the least of what repeats; names of all 16 bytes and
of none; numbers that have no sign, and those that have one. Floats are binary fractions, so that any language writes them alike.
"""

from __future__ import annotations

from . import hub
from .hub import pack

DAY_US = 86_400_000_000
AXIS1, AXIS2 = (0.0, 0.0, 1.0), (0.0, -0.6, 0.8)
LEVERS = {"joint_to_sensor1_m": (0.25, -0.125, 0.0625), "joint_to_sensor2_m": (-0.5, 0.75, 1.0)}
REJECTED = (0, 0, 0, 0, 2, 0, 1)
RIGHT_ANGLE = 1.5707963705062866
SENSOR = {"period_ns": 10_000_000, "counter_bits": 16, "gyr_rad_s": 0.0009765625, "acc_m_s2": 0.0048828125, "gyr_rail": 32767, "acc_rail": -32768,
          "max_drift_ppm": 200.0}
READING_MOST = (32767, -32768, 0, -1, 256, 2048)


def vectors() -> list[tuple[int, int, bytes]]:
    """Type, number and payload of each."""
    return [
        # Pair session.
        (hub.START, 0, hub.start(0x12345678, 500_000, 0.05235987901687622)),
        (hub.SAMPLE, 1, hub.sample(1 << 62, (0.5, -0.25, 1.0, 0.0, 9.8125, -1.5, 2.0, -3.0, 0.125, 9.75, 0.0, 0.5))),
        (hub.REQUEST, 2, pack(hub.REQUEST, token=7)),
        (hub.HELLO, 0, pack(hub.HELLO, nonce=0x12345678, refused=0, credit=24, version=(0, 3, 0))),
        (hub.ESTIMATE, 5, pack(hub.ESTIMATE, events=9, token=7, now_us=(1 << 62) + 30_000_000, status=2, engine=0, weak=0, hint=0, reason=0, flags=13,
                               model=1, ready_for=2, axis1=AXIS1, axis2=AXIS2, uncertainty_rad=(0.015625, 0.03125), sign_margin=12.5,
                               progress=(1.0, 1.0, 1.0), flexion_uncertainty_rad=0.03125, heading_rad=-1.5, **LEVERS, t_us=(1 << 62) + 30_000_000,
                               samples=1500, rejected=REJECTED)),
        (hub.COUNTERS, 0x01020304, pack(hub.COUNTERS, token=7, counts=(1000, 990, 12, 5, 3, 4, 1, 0, 0, 989), rejected=REJECTED)),
        (hub.CREDIT, 1, pack(hub.CREDIT, limit=26)),
        # Body session, to the hub.
        (hub.BEGIN, 0, pack(hub.BEGIN, nonce=0x12345678, every_us=1_000_000, angles_every_us=100_000, sensors=16, joints=15, flags=7)),
        (hub.SENSOR, 1, pack(hub.SENSOR, number=0, serial=0x0123456789ABCDEF, per_packet=16, name="pelvis", **SENSOR)),
        (hub.SENSOR, 2, pack(hub.SENSOR, number=15, serial=0, per_packet=1, name="left_hand_sensor", **SENSOR)),
        (hub.JOINT, 3, pack(hub.JOINT, number=1, kind=hub.HINGE, proximal=1, distal=2, max_bound_rad=0.125, name="")),
        (hub.JOINT, 4, pack(hub.JOINT, number=0, kind=hub.TWO_AXES, proximal=0, distal=15, max_bound_rad=0.0, name="right_elbow_x1yz")),
        (hub.PACKET, 5, pack(hub.PACKET, sensor=15, arrival_us=DAY_US, counter=65535, readings=[READING_MOST])),
        (hub.PACKET, 6, pack(hub.PACKET, sensor=0, arrival_us=hub.UNKNOWN_US, counter=0x01020304,
                             readings=[(k, -k, 256 * k, -256 * k, 32767 - k, k - 32768) for k in range(16)])),
        (hub.TIME, 7, pack(hub.TIME, now_us=DAY_US + 1)),
        (hub.PUT_KEPT, 8, pack(hub.PUT_KEPT, token=8, record=bytes(range(128)))),
        (hub.GET_KEPT, 9, pack(hub.GET_KEPT, token=0xFFFFFFFF, joint=14)),
        (hub.FORGET, 10, pack(hub.FORGET, token=9, joint=255)),
        (hub.SLEEP, 11, pack(hub.SLEEP, joint=0, asleep=1)),
        # From the hub.
        (hub.TABLE, 1, pack(hub.TABLE, refused=0, at=255, what="")),
        (hub.TABLE, 2, pack(hub.TABLE, refused=1, at=3, what="a_word_of_24_characters_")),
        (hub.EVENT, 3, pack(hub.EVENT, t_us=DAY_US, kind=0, joint=1, sensor=255, what=0, value=0.0)),
        (hub.EVENT, 4, pack(hub.EVENT, t_us=0, kind=5, joint=255, sensor=2, what=3, value=-0.0)),
        (hub.JOINT_STATE, 5, pack(hub.JOINT_STATE, token=0, joint=1, status=2, weak=0, hint=0, reason=0, flags=15, kept=1, kept_reason=0, lag_s=-0.03125,
                                  lag_bound_s=0.0078125, axis1=AXIS1, axis2=AXIS2, uncertainty_rad=(0.0625, 0.125), **LEVERS, heading_rad=-1.5,
                                  flexion_bound_rad=0.03125, relative_bound_rad=RIGHT_ANGLE, samples=1500)),
        (hub.SENSOR_STATE, 6, pack(hub.SENSOR_STATE, token=7, sensor=15, heard=1, bad=0x0801, readings=180_000, lost=9_000, late=3, duplicate=2, odd=1,
                                   restarts=4, steps=5, overruns=6, period_s=0.01, drift_ppm=-62.5, shift_s=0.03125, samples=170_000, missed=1_000,
                                   rejected=8, late_readings=9)),
        (hub.BODY_STATE, 7, pack(hub.BODY_STATE, token=7, t_us=DAY_US, rounds=180_000, restarts=1, lags_refused=2, events_dropped=3,
                                 units=(1 << 32) + 5, writes=13)),
        (hub.FLEXIONS, 8, pack(hub.FLEXIONS, t_us=DAY_US, flexions=[])),
        (hub.FLEXIONS, 9, pack(hub.FLEXIONS, t_us=DAY_US, flexions=[(k, k / 16 - 0.5, 0.03125) for k in range(22)])),
        (hub.ORIENTATIONS, 10, pack(hub.ORIENTATIONS, t_us=DAY_US, orientations=[(14, 0.5, -0.5, 0.5, -0.5, RIGHT_ANGLE)])),
        (hub.ORIENTATIONS, 11, pack(hub.ORIENTATIONS, t_us=DAY_US, orientations=[(k, 1.0, 0.0, -0.0, 0.0, 0.125) for k in range(9)])),
        (hub.ADVICE, 12, pack(hub.ADVICE, joint=255, sensor=255, hint=0, reason=0, text="")),
        (hub.ADVICE, 13, pack(hub.ADVICE, joint=1, sensor=255, hint=1, reason=1, text="Bend the knee. ".ljust(200, "."))),
        (hub.KEPT, 14, pack(hub.KEPT, token=8, joint=14, refusal=0, record=bytes(range(127, -1, -1)))),
        (hub.KEPT, 15, pack(hub.KEPT, token=9, joint=255, refusal=8, record=bytes(128))),
        (hub.VERSION_TOLD, 0, pack(hub.VERSION_TOLD, refused=2)),
        # Of no type that there is: counted as unknown.
        (0x7F, 0xFFFFFFFF, b""),
    ]


def lines() -> list[str]:
    """As they stand in the text."""
    return [f"vector {kind:02x} {number:08x} {payload.hex() or '-'} {hub.encode(kind, number, payload).hex()}" for kind, number, payload in vectors()]


if __name__ == "__main__":
    print("\n".join(lines()))
