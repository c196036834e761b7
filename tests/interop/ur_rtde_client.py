"""What a third-party client sees of a controller at argv[1], as JSON; run in a process of its own.

ur_rtde knows one port only, 30004, and ends its process on some errors.
"""

import json
import sys
import time

import rtde_io
import rtde_receive

SAMPLES = 20
DEADLINE = 20.0  # s of wall time


def samples(receive):
    """So many packages with different times."""
    seen = {}
    end = time.monotonic() + DEADLINE
    while len(seen) < SAMPLES and time.monotonic() < end:
        t = receive.getTimestamp()
        seen.setdefault(t, t)
        time.sleep(0.001)
    return list(seen)


def output_seen(receive, bit):
    end = time.monotonic() + DEADLINE
    while not receive.getDigitalOutState(bit) and time.monotonic() < end:
        time.sleep(0.001)
    return receive.getDigitalOutState(bit)


def main(host):
    receive = rtde_receive.RTDEReceiveInterface(host)
    write = rtde_io.RTDEIOInterface(host)
    found = {
        "times": samples(receive),
        "q": receive.getActualQ(),
        "pose": receive.getActualTCPPose(),
        "robot_mode": receive.getRobotMode(),
        "safety_mode": receive.getSafetyMode(),
        "before": receive.getDigitalOutState(2),
        "accepted": write.setStandardDigitalOut(2, True),
        "after": output_seen(receive, 2),
    }
    write.disconnect()
    receive.disconnect()
    json.dump(found, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
